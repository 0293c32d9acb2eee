//! A network emulator: a UDP relay that delays, drops and reorders packets, for rehearsals and tests. It does not read
//! their contents.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::io;
use std::net::{SocketAddr, UdpSocket};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{JoinHandle, spawn};
use std::time::{Duration, Instant};

/// Emulated conditions of the link, in each direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkConditions {
    /// Delay of every packet.
    pub delay: Duration,
    /// Maximum of the additional delay, uniformly distributed from 0.
    pub jitter: Duration,
    /// Packet loss, 0 to 1.
    pub loss: f64,
    /// Seed of the random generator.
    pub seed: u64,
}

/// Maximum number of packets in flight; more are dropped.
const MAX_IN_FLIGHT: usize = 20_000;

/// Maximum number of clients; packets of more are dropped.
const MAX_CLIENTS: usize = 256;

/// Maximum size of a packet \[bytes\].
const MAX_PACKET: usize = 2048;

/// Interval at which a thread checks whether the relay has ended.
const POLL_INTERVAL: Duration = Duration::from_millis(100);

/// A running relay. It ends when it is dropped.
pub struct Relay {
    address: SocketAddr,
    shared: Arc<RelayShared>,
    threads: Vec<JoinHandle<()>>,
}

/// State that the threads share.
struct RelayShared {
    conditions: LinkConditions,
    in_flight: Mutex<InFlight>,
    arrived: Condvar,
    ended: AtomicBool,
    /// While set, every packet is dropped.
    cut: AtomicBool,
    passed: AtomicU64,
    lost: AtomicU64,
}

struct InFlight {
    random: u64,
    number: u64,
    packets: BinaryHeap<Reverse<Packet>>,
}

/// A packet; ordered by the time when it is due.
struct Packet {
    due: Instant,
    number: u64,
    by: Arc<UdpSocket>,
    to: SocketAddr,
    bytes: Vec<u8>,
}

impl Relay {
    /// Receives packets at one address and forwards them to another, and answers back.
    ///
    /// # Errors
    /// An address that cannot be bound.
    pub fn start(at: SocketAddr, to: SocketAddr, conditions: LinkConditions) -> io::Result<Relay> {
        let front = Arc::new(UdpSocket::bind(at)?);
        front.set_read_timeout(Some(POLL_INTERVAL))?;
        let address = front.local_addr()?;
        let in_flight = InFlight { random: conditions.seed, number: 0, packets: BinaryHeap::new() };
        let shared = Arc::new(RelayShared {
            conditions,
            in_flight: Mutex::new(in_flight),
            arrived: Condvar::new(),
            ended: AtomicBool::new(false),
            cut: AtomicBool::new(false),
            passed: AtomicU64::new(0),
            lost: AtomicU64::new(0),
        });
        let deliverer = Arc::clone(&shared);
        let reader = Arc::clone(&shared);
        let threads = vec![spawn(move || deliverer.deliver()), spawn(move || reader.read_front(&front, to))];
        Ok(Relay { address, shared, threads })
    }

    /// The address at which it receives packets.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Cuts the link, or restores it.
    pub fn cut(&self, is_cut: bool) {
        self.shared.cut.store(is_cut, Ordering::Relaxed);
    }

    /// Packets forwarded and lost so far.
    pub fn counts(&self) -> (u64, u64) {
        (self.shared.passed.load(Ordering::Relaxed), self.shared.lost.load(Ordering::Relaxed))
    }
}

impl Drop for Relay {
    fn drop(&mut self) {
        self.shared.ended.store(true, Ordering::Relaxed);
        self.shared.arrived.notify_all();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
    }
}

impl RelayShared {
    fn in_flight(&self) -> MutexGuard<'_, InFlight> {
        self.in_flight.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn has_ended(&self) -> bool {
        self.ended.load(Ordering::Relaxed)
    }

    /// Receives packets from clients. Each client gets its own socket towards the server, and a thread for the answers.
    fn read_front(self: &Arc<RelayShared>, front: &Arc<UdpSocket>, to: SocketAddr) {
        let mut backs: BTreeMap<SocketAddr, Arc<UdpSocket>> = BTreeMap::new();
        let mut bytes = [0; MAX_PACKET];
        while !self.has_ended() {
            let Ok((length, from)) = front.recv_from(&mut bytes) else { continue };
            if !backs.contains_key(&from) {
                if backs.len() >= MAX_CLIENTS {
                    continue;
                }
                let any: SocketAddr = if to.is_ipv4() { ([0, 0, 0, 0], 0).into() } else { ([0u16; 8], 0).into() };
                let Ok(back) = UdpSocket::bind(any) else { continue };
                if back.connect(to).is_err() || back.set_read_timeout(Some(POLL_INTERVAL)).is_err() {
                    continue;
                }
                let back = Arc::new(back);
                backs.insert(from, Arc::clone(&back));
                let (shared, front) = (Arc::clone(self), Arc::clone(front));
                // It ends with the relay.
                spawn(move || shared.read_back(&back, &front, from));
            }
            if let Some(back) = backs.get(&from) {
                self.enqueue(back, to, &bytes[..length]);
            }
        }
    }

    fn read_back(&self, back: &UdpSocket, front: &Arc<UdpSocket>, to: SocketAddr) {
        let mut bytes = [0; MAX_PACKET];
        while !self.has_ended() {
            if let Ok(length) = back.recv(&mut bytes) {
                self.enqueue(front, to, &bytes[..length]);
            }
        }
    }

    fn enqueue(&self, by: &Arc<UdpSocket>, to: SocketAddr, bytes: &[u8]) {
        let now = Instant::now();
        let mut in_flight = self.in_flight();
        let is_lost = in_flight.random() < self.conditions.loss;
        let more = self.conditions.jitter.mul_f64(in_flight.random());
        if is_lost || self.cut.load(Ordering::Relaxed) || in_flight.packets.len() >= MAX_IN_FLIGHT {
            self.lost.fetch_add(1, Ordering::Relaxed);
            return;
        }
        in_flight.number += 1;
        let due = now + self.conditions.delay + more;
        let packet = Packet { due, number: in_flight.number, by: Arc::clone(by), to, bytes: bytes.to_vec() };
        in_flight.packets.push(Reverse(packet));
        self.arrived.notify_all();
    }

    fn deliver(&self) {
        let mut in_flight = self.in_flight();
        while !self.has_ended() {
            let now = Instant::now();
            let wait = in_flight
                .packets
                .peek()
                .map_or(POLL_INTERVAL, |Reverse(packet)| packet.due.saturating_duration_since(now));
            if wait.is_zero() {
                if let Some(Reverse(packet)) = in_flight.packets.pop() {
                    drop(in_flight);
                    let connected = packet.by.peer_addr().is_ok();
                    let sent = if connected {
                        packet.by.send(&packet.bytes)
                    } else {
                        packet.by.send_to(&packet.bytes, packet.to)
                    };
                    // The receiver is gone: the packet is lost, as on a real network.
                    let one = if sent.is_ok() { &self.passed } else { &self.lost };
                    one.fetch_add(1, Ordering::Relaxed);
                    in_flight = self.in_flight();
                }
                continue;
            }
            in_flight = self.arrived.wait_timeout(in_flight, wait).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl InFlight {
    /// A number from 0 to less than 1 (SplitMix64).
    fn random(&mut self) -> f64 {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.random;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        (bits >> 11) as f64 / (1u64 << 53) as f64
    }
}

impl PartialEq for Packet {
    fn eq(&self, other: &Packet) -> bool {
        self.number == other.number
    }
}

impl Eq for Packet {}

impl PartialOrd for Packet {
    fn partial_cmp(&self, other: &Packet) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Packet {
    fn cmp(&self, other: &Packet) -> std::cmp::Ordering {
        (self.due, self.number).cmp(&(other.due, other.number))
    }
}
