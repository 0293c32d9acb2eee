//! What a client has received, in numbers.

use super::SessionError;
use serde::Serialize;
use sinew_world::Frame;
use std::collections::BTreeMap;
use std::time::Instant;

/// What a client has received. Its size does not grow with the session's length.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ClientStats {
    /// Frames that arrived.
    pub frames: u64,
    /// Of these, those that arrived after a later one.
    pub frames_late: u64,
    /// Frames whose hash is not what the server said; 0 in a sound session.
    pub frames_that_differ: u64,
    /// Frames that could not be read.
    pub frames_malformed: u64,
    /// Bytes of frames.
    pub frame_bytes: u64,
    /// Step of the first frame that arrived.
    pub first_step: Option<u64>,
    /// Step of the newest frame.
    pub last_step: Option<u64>,
    /// Times that the connection was lost and made again.
    pub rejoined: u64,
    /// Datagrams of performance that did not go out.
    pub samples_not_sent: u64,
    /// The round trip as the connection sees it now \[ms\].
    pub round_trip_ms: f64,
    /// [`Frame::hash`] of received frames by their step, in hexadecimal: of every step that is a multiple of
    /// [`ClientStats::HASH_STEPS`], the last [`ClientStats::MAX_HASHES`] of them.
    pub hashes: BTreeMap<u64, String>,
    /// What was sent, with the step of the newest frame then: the last [`ClientStats::MAX_SENT`].
    pub sent: Vec<SentOrder>,
    /// What the server did not pass on, with its reason: the last [`ClientStats::MAX_SENT`].
    pub not_passed: Vec<String>,
    /// When the newest frame arrived.
    #[serde(skip)]
    arrived: Option<Instant>,
}

/// Something that a client sent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SentOrder {
    /// A key, or the command's word.
    pub what: String,
    /// Step of the newest frame that had arrived.
    pub seen_step: u64,
    /// Time since it had \[ms\].
    pub since_ms: f64,
}

impl ClientStats {
    /// Every so many steps a hash is kept.
    pub const HASH_STEPS: u64 = 60;
    /// Hashes that are kept.
    pub const MAX_HASHES: usize = 10_000;
    /// Sent orders that are kept.
    pub const MAX_SENT: usize = 1_000;

    /// Takes a frame down. Returns whether it is newer than all before.
    pub(super) fn note(&mut self, frame: &Frame, said: u64, bytes: usize) -> bool {
        self.frames += 1;
        self.frame_bytes += bytes as u64;
        let hash = frame.hash();
        self.frames_that_differ += u64::from(hash != said);
        note_hash(&mut self.hashes, frame.step, hash);
        self.first_step.get_or_insert(frame.step);
        let is_newer = self.last_step.is_none_or(|last| frame.step > last);
        if is_newer {
            self.last_step = Some(frame.step);
            self.arrived = Some(Instant::now());
        } else {
            self.frames_late += 1;
        }
        is_newer
    }

    pub(super) fn note_sent(&mut self, what: String) {
        let seen_step = self.last_step.unwrap_or(0);
        let since_ms = self.arrived.map_or(0.0, |arrived| arrived.elapsed().as_secs_f64() * 1e3);
        push_last(&mut self.sent, SentOrder { what, seen_step, since_ms });
    }

    pub(super) fn note_not_passed(&mut self, problem: String) {
        push_last(&mut self.not_passed, problem);
    }
}

/// Keeps a hash if its step is one whose hashes are kept: of server and clients the same.
pub fn note_hash(hashes: &mut BTreeMap<u64, String>, step: u64, hash: u64) {
    if step.is_multiple_of(ClientStats::HASH_STEPS) {
        hashes.insert(step, format!("{hash:016x}"));
        if hashes.len() > ClientStats::MAX_HASHES {
            hashes.pop_first();
        }
    }
}

fn push_last<T>(list: &mut Vec<T>, one: T) {
    if list.len() >= ClientStats::MAX_SENT {
        list.remove(0);
    }
    list.push(one);
}

/// How a client stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Frames come.
    Connected,
    /// The connection was lost; another is being made.
    Rejoining,
    /// It is over.
    Ended(SessionError),
}
