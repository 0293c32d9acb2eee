//! Whose stream a VMC port receives.

use std::net::{IpAddr, SocketAddr};
use std::time::{Duration, Instant};

/// Time for which a port stays reserved for a machine whose bones have stopped.
const MACHINE_TIMEOUT: Duration = Duration::from_secs(2);

/// Time after which another program of the same machine may go on: fifteen frames at 60 Hz.
const SENDER_TIMEOUT: Duration = Duration::from_millis(250);

/// Datagrams from one source port after which it is a sender's own, not one of a socket per message or frame.
const STEADY: u32 = 3;

/// Source ports that are remembered: a body, a face, and more.
const MAX_SOURCES: usize = 8;

/// What is to be done with a datagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Admission {
    /// It is the performer's.
    Read,
    /// It is the performer's, and another performer's came before.
    Begin,
    /// It is another performer's.
    Foreign,
    /// It says nothing about a body: of a program for faces, or before the performer's first bone.
    Beside,
}

/// The performer that a port belongs to: the machine whose bones came first. UDP has no connections, so that a source port
/// only tells a machine's programs apart when they keep theirs.
#[derive(Debug, Default)]
pub(crate) struct PortOwner {
    machine: Option<(IpAddr, Instant)>,
    sources: [Option<Source>; MAX_SOURCES],
    /// The source port of the body, if it is steady.
    body_port: Option<u16>,
}

/// A source port of the owner's machine.
#[derive(Clone, Copy, Debug)]
struct Source {
    port: u16,
    datagrams: u32,
    has_bones: bool,
    last: Instant,
}

impl PortOwner {
    /// Judges a valid datagram; `has_body` tells whether it has a bone of the body.
    pub fn admit(&mut self, from: SocketAddr, has_body: bool, now: Instant) -> Admission {
        let is_owner = match self.machine {
            Some((ip, last)) if ip == from.ip() => now.duration_since(last) < MACHINE_TIMEOUT || !has_body,
            Some((_, last)) if now.duration_since(last) < MACHINE_TIMEOUT => {
                return if has_body { Admission::Foreign } else { Admission::Beside };
            }
            _ => false,
        };
        if !is_owner {
            if !has_body {
                return Admission::Beside;
            }
            let is_first = self.machine.is_none();
            *self = PortOwner { machine: Some((from.ip(), now)), ..PortOwner::default() };
            self.source(from.port(), true, now);
            return if is_first { Admission::Read } else { Admission::Begin };
        }
        let source = self.source(from.port(), has_body, now);
        let mut admission = Admission::Read;
        match self.body_port {
            Some(port) if port == from.port() => {}
            Some(port) => {
                let is_silent = self.last_of(port).is_none_or(|last| now.duration_since(last) >= SENDER_TIMEOUT);
                if !(has_body && is_silent) {
                    return if has_body { Admission::Foreign } else { Admission::Beside };
                }
                self.body_port = None;
                admission = Admission::Begin;
            }
            None if source.datagrams >= STEADY && source.has_bones => self.body_port = Some(from.port()),
            // A steady source without bones is a face; its times are not the body's.
            None if source.datagrams >= STEADY => return Admission::Beside,
            None => {}
        }
        if has_body {
            self.machine = Some((from.ip(), now));
        }
        admission
    }

    /// The source of a datagram, counted; the one that was silent longest makes room for a new one.
    fn source(&mut self, port: u16, has_body: bool, now: Instant) -> Source {
        let known = self.sources.iter().position(|one| one.is_some_and(|one| one.port == port));
        // The body's own place is kept, or a crowd of ports would make it look silent.
        let is_body = |one: &Option<Source>| one.is_some_and(|one| Some(one.port) == self.body_port);
        let place = known.or_else(|| {
            let free = self.sources.iter().enumerate().filter(|(_, one)| !is_body(one));
            free.min_by_key(|(_, one)| one.map(|one| one.last)).map(|(place, _)| place)
        });
        let slot = &mut self.sources[place.unwrap_or_default()];
        let mut source = match *slot {
            Some(source) if source.port == port => source,
            _ => Source { port, datagrams: 0, has_bones: false, last: now },
        };
        source.datagrams = source.datagrams.saturating_add(1);
        source.has_bones |= has_body;
        // Only bones show that a body is still sent.
        if has_body || !source.has_bones {
            source.last = now;
        }
        *slot = Some(source);
        source
    }

    fn last_of(&self, port: u16) -> Option<Instant> {
        self.sources.iter().flatten().find(|source| source.port == port).map(|source| source.last)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> SocketAddr {
        text.parse().expect("an address")
    }

    #[test]
    fn a_socket_for_each_message_is_one_performer_and_its_timeout_is_by_machine() {
        let (mut owner, began) = (PortOwner::default(), Instant::now());
        for message in 0..500_u16 {
            let from = SocketAddr::new(at("127.0.0.1:1").ip(), 30_000 + message);
            let now = began + Duration::from_millis(u64::from(message));
            // Every tenth is a time or a blend shape.
            let admission = owner.admit(from, message % 10 != 9, now);
            assert_eq!(admission, Admission::Read, "message {message}");
        }
        let now = began + Duration::from_millis(600);
        assert_eq!(owner.admit(at("127.0.0.2:5"), true, now), Admission::Foreign);
        assert_eq!(owner.admit(at("127.0.0.2:5"), true, now + MACHINE_TIMEOUT), Admission::Begin);
    }

    #[test]
    fn a_face_takes_no_port_and_a_second_body_is_foreign_until_the_first_is_silent() {
        let (mut owner, began) = (PortOwner::default(), Instant::now());
        let (body, face, second) = (at("127.0.0.1:10"), at("127.0.0.1:20"), at("127.0.0.1:30"));
        for frame in 0..10 {
            let now = began + Duration::from_millis(frame * 16);
            assert_eq!(owner.admit(face, false, now), Admission::Beside, "before the body");
        }
        for frame in 10..100 {
            let now = began + Duration::from_millis(frame * 16);
            assert_eq!(owner.admit(body, true, now), Admission::Read);
            // The first two datagrams of an unknown port could be those of a socket per message.
            let is_known = frame >= 12;
            assert!(owner.admit(face, false, now) == Admission::Beside || !is_known, "frame {frame}");
            assert!(owner.admit(second, true, now) == Admission::Foreign || !is_known, "frame {frame}");
        }
        let silent = began + Duration::from_millis(100 * 16) + SENDER_TIMEOUT;
        assert_eq!(owner.admit(second, true, silent), Admission::Begin, "the program was started again");
    }
}
