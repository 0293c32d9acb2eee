//! Ports that performers are heard on, each with a thread of its own.

use crate::raw::RawReader;
use crate::vmc::{MAX_DATAGRAM_BYTES, VmcReader};
use sinew_control::perform::PerformerSample;
use std::collections::VecDeque;
use std::io::{ErrorKind, Read};
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Samples that wait for the stage; older ones give way.
const MAX_WAITING: usize = 64;

/// How long a port belongs to a sender that has fallen silent.
const OWNED: Duration = Duration::from_secs(2);

/// How often a thread looks whether it is to end.
const LOOK: Duration = Duration::from_millis(100);

/// A port cannot be opened.
#[derive(Debug, thiserror::Error)]
#[error("port {address}: {error}; is it in use? Choose another in the scene's source")]
pub struct PortError {
    address: SocketAddr,
    error: std::io::Error,
}

/// What came in that is no sample of the stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PortCounters {
    /// Datagrams or lines that could not be read.
    pub malformed: u64,
    /// Datagrams of somebody else than the present performer.
    pub foreign: u64,
    /// Samples that were thrown away because the stage did not take them in time.
    pub overflown: u64,
}

/// An open port. It is closed when it is dropped.
#[derive(Debug)]
pub struct Port {
    address: SocketAddr,
    shared: Arc<Shared>,
    thread: Option<std::thread::JoinHandle<()>>,
}

#[derive(Debug, Default)]
struct Shared {
    heard: Mutex<Heard>,
    ends: AtomicBool,
}

#[derive(Debug, Default)]
struct Heard {
    samples: VecDeque<(Instant, PerformerSample)>,
    counters: PortCounters,
}

impl Shared {
    fn heard(&self) -> MutexGuard<'_, Heard> {
        // Nothing is left half done under it.
        self.heard.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn ends(&self) -> bool {
        self.ends.load(Ordering::Relaxed)
    }

    fn push(&self, arrival: Instant, sample: PerformerSample) {
        let mut heard = self.heard();
        if heard.samples.len() >= MAX_WAITING {
            heard.samples.pop_front();
            heard.counters.overflown += 1;
        }
        heard.samples.push_back((arrival, sample));
    }
}

impl Port {
    /// Listens for VMC on a UDP port; port 0 takes a free one.
    ///
    /// # Errors
    /// When the port is taken or not ours.
    pub fn vmc(address: SocketAddr) -> Result<Port, PortError> {
        let wrong = |error| PortError { address, error };
        let socket = UdpSocket::bind(address).map_err(wrong)?;
        socket.set_read_timeout(Some(LOOK)).map_err(wrong)?;
        let own = socket.local_addr().map_err(wrong)?;
        Ok(Port::begin(own, move |shared| hear_vmc(&socket, shared)))
    }

    /// Listens for a raw stream on a TCP port; port 0 takes a free one. One connection at a time is heard.
    ///
    /// # Errors
    /// When the port is taken or not ours.
    pub fn raw(address: SocketAddr) -> Result<Port, PortError> {
        let wrong = |error| PortError { address, error };
        let listener = TcpListener::bind(address).map_err(wrong)?;
        listener.set_nonblocking(true).map_err(wrong)?;
        let own = listener.local_addr().map_err(wrong)?;
        Ok(Port::begin(own, move |shared| hear_raw(&listener, shared)))
    }

    fn begin(address: SocketAddr, hear: impl FnOnce(&Shared) + Send + 'static) -> Port {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        let thread = std::thread::Builder::new().name(format!("port {}", address.port()));
        let thread = thread.spawn(move || hear(&theirs)).ok();
        Port { address, shared, thread }
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// The next sample and when it arrived.
    pub fn next(&self) -> Option<(Instant, PerformerSample)> {
        self.shared.heard().samples.pop_front()
    }

    /// What came in besides.
    pub fn counters(&self) -> PortCounters {
        self.shared.heard().counters
    }
}

impl Drop for Port {
    fn drop(&mut self) {
        self.shared.ends.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn hear_vmc(socket: &UdpSocket, shared: &Shared) {
    let began = Instant::now();
    let mut reader = VmcReader::new();
    let mut owner: Option<(SocketAddr, Instant)> = None;
    // One more than allowed, so that a larger datagram is seen to be one.
    let mut bytes = vec![0; MAX_DATAGRAM_BYTES + 1];
    while !shared.ends() {
        let (length, from) = match socket.recv_from(&mut bytes) {
            Ok(got) => got,
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => continue,
            Err(_) => {
                std::thread::sleep(LOOK);
                continue;
            }
        };
        let arrival = Instant::now();
        match owner {
            Some((address, heard)) if address != from => {
                if arrival.duration_since(heard) < OWNED {
                    shared.heard().counters.foreign += 1;
                    continue;
                }
                reader = VmcReader::new();
            }
            _ => {}
        }
        let arrival_secs = arrival.duration_since(began).as_secs_f64();
        match reader.datagram(&bytes[..length], arrival_secs, &mut |sample| shared.push(arrival, sample)) {
            // Only who speaks VMC can own the port.
            Ok(()) => owner = Some((from, arrival)),
            Err(_) => shared.heard().counters.malformed += 1,
        }
    }
}

fn hear_raw(listener: &TcpListener, shared: &Shared) {
    let began = Instant::now();
    while !shared.ends() {
        match listener.accept() {
            Ok((stream, _)) => hear_stream(stream, shared, began),
            Err(_) => std::thread::sleep(LOOK / 4),
        }
    }
}

fn hear_stream(mut stream: TcpStream, shared: &Shared, began: Instant) {
    if stream.set_nonblocking(false).and_then(|()| stream.set_read_timeout(Some(LOOK))).is_err() {
        return;
    }
    let mut reader = RawReader::new();
    let mut heard = Instant::now();
    let mut bytes = vec![0; 16 << 10];
    while !shared.ends() && heard.elapsed() < 5 * OWNED {
        match stream.read(&mut bytes) {
            Ok(0) => return,
            Ok(length) => {
                heard = Instant::now();
                let arrival_secs = heard.duration_since(began).as_secs_f64();
                reader.bytes(&bytes[..length], arrival_secs, &mut |result| match result {
                    Ok(sample) => shared.push(heard, sample),
                    Err(_) => shared.heard().counters.malformed += 1,
                });
            }
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(_) => return,
        }
    }
}
