//! Ports that receive performers' streams, each on its own thread.

use crate::port_owner::{Admission, PortOwner};
use crate::raw::RawReader;
use crate::vmc::{MAX_DATAGRAM_BYTES, VmcReader, has_body};
use sinew_control::perform::PerformerSample;
use std::collections::VecDeque;
use std::io::{ErrorKind, Read};
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Maximum number of samples that wait for the stage; the oldest are dropped.
const MAX_WAITING: usize = 64;

/// Time after which a silent connection is closed.
const SENDER_TIMEOUT: Duration = Duration::from_secs(10);

/// Interval at which a thread checks whether the port is closed.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// A port that cannot be opened.
#[derive(Debug, thiserror::Error)]
#[error("port {address}: {error}; is it in use? Choose another in the scene's source")]
pub struct PortError {
    address: SocketAddr,
    error: std::io::Error,
}

/// Input that did not become a sample of the stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PortCounters {
    /// Malformed datagrams or lines.
    pub malformed: u64,
    /// Datagrams with bones of another performer than the present one: from another machine, or another program of it.
    pub foreign: u64,
    /// Datagrams without bones from elsewhere than the performer, such as a face's.
    pub beside: u64,
    /// Whether samples have the time of their arrival, because the sender's own clock stands still or is out of range.
    pub goes_by_arrival: bool,
    /// Samples dropped because the stage did not take them in time.
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
    inbox: Mutex<Inbox>,
    ends: AtomicBool,
}

#[derive(Debug, Default)]
struct Inbox {
    samples: VecDeque<(Instant, PerformerSample)>,
    counters: PortCounters,
}

impl Shared {
    fn inbox(&self) -> MutexGuard<'_, Inbox> {
        // A poisoned lock guards valid data: no update can be interrupted halfway.
        self.inbox.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn ends(&self) -> bool {
        self.ends.load(Ordering::Relaxed)
    }

    fn push(&self, arrival: Instant, sample: PerformerSample) {
        let mut inbox = self.inbox();
        if inbox.samples.len() >= MAX_WAITING {
            inbox.samples.pop_front();
            inbox.counters.overflown += 1;
        }
        inbox.samples.push_back((arrival, sample));
    }
}

impl Port {
    /// Listens for VMC on a UDP port; port 0 takes a free one.
    ///
    /// # Errors
    /// The port is in use, or the address does not belong to this machine.
    pub fn vmc(address: SocketAddr) -> Result<Port, PortError> {
        let wrong = |error| PortError { address, error };
        let socket = UdpSocket::bind(address).map_err(wrong)?;
        socket.set_read_timeout(Some(POLL_INTERVAL)).map_err(wrong)?;
        let own = socket.local_addr().map_err(wrong)?;
        Ok(Port::begin(own, move |shared| receive_vmc(&socket, shared)))
    }

    /// Listens for a raw stream on a TCP port; port 0 takes a free one. One connection is served at a time.
    ///
    /// # Errors
    /// The port is in use, or the address does not belong to this machine.
    pub fn raw(address: SocketAddr) -> Result<Port, PortError> {
        let wrong = |error| PortError { address, error };
        let listener = TcpListener::bind(address).map_err(wrong)?;
        listener.set_nonblocking(true).map_err(wrong)?;
        let own = listener.local_addr().map_err(wrong)?;
        Ok(Port::begin(own, move |shared| receive_raw(&listener, shared)))
    }

    fn begin(address: SocketAddr, receive: impl FnOnce(&Shared) + Send + 'static) -> Port {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        let thread = std::thread::Builder::new().name(format!("port {}", address.port()));
        let thread = thread.spawn(move || receive(&theirs)).ok();
        Port { address, shared, thread }
    }

    /// The bound address.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// The next sample and the time of its arrival.
    pub fn next(&self) -> Option<(Instant, PerformerSample)> {
        self.shared.inbox().samples.pop_front()
    }

    /// Counters of input that did not become a sample.
    pub fn counters(&self) -> PortCounters {
        self.shared.inbox().counters
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

fn receive_vmc(socket: &UdpSocket, shared: &Shared) {
    let began = Instant::now();
    let mut reader = VmcReader::new();
    let mut owner = PortOwner::default();
    // One byte more than the maximum, so that a larger datagram is detected.
    let mut bytes = vec![0; MAX_DATAGRAM_BYTES + 1];
    while !shared.ends() {
        let (length, from) = match socket.recv_from(&mut bytes) {
            Ok(got) => got,
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => continue,
            Err(_) => {
                std::thread::sleep(POLL_INTERVAL);
                continue;
            }
        };
        let arrival = Instant::now();
        let bytes = &bytes[..length];
        // Only a sender of valid VMC reserves the port.
        let Ok(has_body) = has_body(bytes) else {
            shared.inbox().counters.malformed += 1;
            continue;
        };
        match owner.admit(from, has_body, arrival) {
            Admission::Read => {}
            Admission::Begin => reader = VmcReader::new(),
            Admission::Foreign => {
                shared.inbox().counters.foreign += 1;
                continue;
            }
            Admission::Beside => {
                shared.inbox().counters.beside += 1;
                continue;
            }
        }
        let arrival_secs = arrival.duration_since(began).as_secs_f64();
        // It was valid above.
        let _ = reader.datagram(bytes, arrival_secs, &mut |sample| shared.push(arrival, sample));
        if reader.goes_by_arrival() {
            shared.inbox().counters.goes_by_arrival = true;
        }
    }
}

fn receive_raw(listener: &TcpListener, shared: &Shared) {
    let began = Instant::now();
    while !shared.ends() {
        match listener.accept() {
            Ok((stream, _)) => receive_stream(stream, shared, began),
            Err(_) => std::thread::sleep(POLL_INTERVAL / 4),
        }
    }
}

fn receive_stream(mut stream: TcpStream, shared: &Shared, began: Instant) {
    if stream.set_nonblocking(false).and_then(|()| stream.set_read_timeout(Some(POLL_INTERVAL))).is_err() {
        return;
    }
    let mut reader = RawReader::new();
    let mut last_received = Instant::now();
    let mut bytes = vec![0; 16 << 10];
    while !shared.ends() && last_received.elapsed() < SENDER_TIMEOUT {
        match stream.read(&mut bytes) {
            Ok(0) => return,
            Ok(length) => {
                last_received = Instant::now();
                let arrival_secs = last_received.duration_since(began).as_secs_f64();
                reader.bytes(&bytes[..length], arrival_secs, &mut |result| match result {
                    Ok(sample) => shared.push(last_received, sample),
                    Err(_) => shared.inbox().counters.malformed += 1,
                });
            }
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            Err(_) => return,
        }
    }
}
