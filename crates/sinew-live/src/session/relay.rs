//! A stretch of bad network: a UDP relay that delays, loses and reorders. For rehearsals and tests; it looks into no packet.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::io;
use std::net::{SocketAddr, UdpSocket};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{JoinHandle, spawn};
use std::time::{Duration, Instant};

/// What the way does to packets, in each direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkConditions {
    /// Time that every packet takes.
    pub delay: Duration,
    /// More time, evenly spread from none to this.
    pub jitter: Duration,
    /// Share of packets that are lost, 0 to 1.
    pub loss: f64,
    /// Where chance comes from.
    pub seed: u64,
}

/// Packets under way; more are lost.
const MAX_UNDER_WAY: usize = 20_000;

/// Clients that are told apart; those of more are not let through.
const MAX_CLIENTS: usize = 256;

/// Largest packet \[bytes\].
const MAX_PACKET: usize = 2048;

/// How often a thread looks whether it is still wanted.
const LOOK: Duration = Duration::from_millis(100);

/// A running relay. It ends when it is dropped.
pub struct Relay {
    address: SocketAddr,
    way: Arc<Way>,
    threads: Vec<JoinHandle<()>>,
}

/// What the threads share.
struct Way {
    conditions: LinkConditions,
    sky: Mutex<Sky>,
    came: Condvar,
    ended: AtomicBool,
    /// While set, nothing gets through.
    cut: AtomicBool,
    passed: AtomicU64,
    lost: AtomicU64,
}

struct Sky {
    chance: u64,
    number: u64,
    under_way: BinaryHeap<Reverse<Packet>>,
}

/// A packet, by the time when it is due.
struct Packet {
    due: Instant,
    number: u64,
    by: Arc<UdpSocket>,
    to: SocketAddr,
    bytes: Vec<u8>,
}

impl Relay {
    /// Takes packets at one address and passes them on to another, answers back.
    ///
    /// # Errors
    /// An address that cannot be bound.
    pub fn start(at: SocketAddr, to: SocketAddr, conditions: LinkConditions) -> io::Result<Relay> {
        let front = Arc::new(UdpSocket::bind(at)?);
        front.set_read_timeout(Some(LOOK))?;
        let address = front.local_addr()?;
        let sky = Sky { chance: conditions.seed, number: 0, under_way: BinaryHeap::new() };
        let way = Arc::new(Way {
            conditions,
            sky: Mutex::new(sky),
            came: Condvar::new(),
            ended: AtomicBool::new(false),
            cut: AtomicBool::new(false),
            passed: AtomicU64::new(0),
            lost: AtomicU64::new(0),
        });
        let deliverer = Arc::clone(&way);
        let reader = Arc::clone(&way);
        let threads = vec![spawn(move || deliverer.deliver()), spawn(move || reader.read_front(&front, to))];
        Ok(Relay { address, way, threads })
    }

    /// The address that it takes packets at.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Cuts the way, or mends it.
    pub fn cut(&self, is_cut: bool) {
        self.way.cut.store(is_cut, Ordering::Relaxed);
    }

    /// Packets passed on and lost so far.
    pub fn counts(&self) -> (u64, u64) {
        (self.way.passed.load(Ordering::Relaxed), self.way.lost.load(Ordering::Relaxed))
    }
}

impl Drop for Relay {
    fn drop(&mut self) {
        self.way.ended.store(true, Ordering::Relaxed);
        self.way.came.notify_all();
        for thread in self.threads.drain(..) {
            let _ = thread.join();
        }
    }
}

impl Way {
    fn sky(&self) -> MutexGuard<'_, Sky> {
        self.sky.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn has_ended(&self) -> bool {
        self.ended.load(Ordering::Relaxed)
    }

    /// Packets from clients; each client gets a socket of its own towards the server, and a thread for what comes back.
    fn read_front(self: &Arc<Way>, front: &Arc<UdpSocket>, to: SocketAddr) {
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
                if back.connect(to).is_err() || back.set_read_timeout(Some(LOOK)).is_err() {
                    continue;
                }
                let back = Arc::new(back);
                backs.insert(from, Arc::clone(&back));
                let (way, front) = (Arc::clone(self), Arc::clone(front));
                // It ends with the relay.
                spawn(move || way.read_back(&back, &front, from));
            }
            if let Some(back) = backs.get(&from) {
                self.send_off(back, to, &bytes[..length]);
            }
        }
    }

    fn read_back(&self, back: &UdpSocket, front: &Arc<UdpSocket>, to: SocketAddr) {
        let mut bytes = [0; MAX_PACKET];
        while !self.has_ended() {
            if let Ok(length) = back.recv(&mut bytes) {
                self.send_off(front, to, &bytes[..length]);
            }
        }
    }

    fn send_off(&self, by: &Arc<UdpSocket>, to: SocketAddr, bytes: &[u8]) {
        let now = Instant::now();
        let mut sky = self.sky();
        let is_lost = sky.chance() < self.conditions.loss;
        let more = self.conditions.jitter.mul_f64(sky.chance());
        if is_lost || self.cut.load(Ordering::Relaxed) || sky.under_way.len() >= MAX_UNDER_WAY {
            self.lost.fetch_add(1, Ordering::Relaxed);
            return;
        }
        sky.number += 1;
        let due = now + self.conditions.delay + more;
        let packet = Packet { due, number: sky.number, by: Arc::clone(by), to, bytes: bytes.to_vec() };
        sky.under_way.push(Reverse(packet));
        self.came.notify_all();
    }

    fn deliver(&self) {
        let mut sky = self.sky();
        while !self.has_ended() {
            let now = Instant::now();
            let wait = sky.under_way.peek().map_or(LOOK, |Reverse(packet)| packet.due.saturating_duration_since(now));
            if wait.is_zero() {
                if let Some(Reverse(packet)) = sky.under_way.pop() {
                    drop(sky);
                    let connected = packet.by.peer_addr().is_ok();
                    let sent = if connected {
                        packet.by.send(&packet.bytes)
                    } else {
                        packet.by.send_to(&packet.bytes, packet.to)
                    };
                    // Nobody there any more: lost, as on any way.
                    let one = if sent.is_ok() { &self.passed } else { &self.lost };
                    one.fetch_add(1, Ordering::Relaxed);
                    sky = self.sky();
                }
                continue;
            }
            sky = self.came.wait_timeout(sky, wait).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl Sky {
    /// A number from 0 to less than 1 (SplitMix64).
    fn chance(&mut self) -> f64 {
        self.chance = self.chance.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.chance;
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
