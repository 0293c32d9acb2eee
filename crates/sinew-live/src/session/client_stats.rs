//! Statistics of a client's connection.

use super::SessionError;
use serde::Serialize;
use sinew_world::Frame;
use std::collections::BTreeMap;
use std::time::Instant;

/// Statistics of a client's connection. Its size does not grow with the session's length.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ClientStats {
    /// Frames that arrived.
    pub frames: u64,
    /// Of these, those that arrived after a later one.
    pub frames_late: u64,
    /// Frames whose hash differs from the one that the server sent; 0 unless a machine or program is faulty.
    pub frames_that_differ: u64,
    /// Frames that could not be decoded.
    pub frames_malformed: u64,
    /// Size of all frames \[bytes\].
    pub frame_bytes: u64,
    /// Step of the first frame that arrived.
    pub first_step: Option<u64>,
    /// Step of the newest frame.
    pub last_step: Option<u64>,
    /// Reconnections after a lost connection.
    pub rejoined: u64,
    /// Performance samples that were not sent because the send queue was full.
    pub samples_not_sent: u64,
    /// Current round-trip time of the connection \[ms\].
    pub round_trip_ms: f64,
    /// [`Frame::hash`] of received frames by their step, in hexadecimal: of every step that is a multiple of
    /// [`ClientStats::HASH_STEPS`], the last [`ClientStats::MAX_HASHES`] of them.
    pub hashes: BTreeMap<u64, String>,
    /// Requests that were sent, with the step of the newest frame at that time: the last [`ClientStats::MAX_SENT`].
    pub sent: Vec<SentRequest>,
    /// Reasons for which the server rejected requests: the last [`ClientStats::MAX_SENT`].
    #[serde(rename = "not_passed")]
    pub rejected: Vec<String>,
    /// When the newest frame arrived.
    #[serde(skip)]
    arrived: Option<Instant>,
}

/// A request that a client sent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SentRequest {
    /// The key, or the command's `do`.
    pub what: String,
    /// Step of the newest frame that had arrived by then.
    pub seen_step: u64,
    /// Time since that frame arrived \[ms\].
    pub since_ms: f64,
}

impl ClientStats {
    /// Physics steps between two kept hashes.
    pub const HASH_STEPS: u64 = 60;
    /// Maximum number of kept hashes.
    pub const MAX_HASHES: usize = 10_000;
    /// Maximum number of kept sent requests.
    pub const MAX_SENT: usize = 1_000;

    /// Counts a frame. Returns whether it is newer than all before.
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
        push_last(&mut self.sent, SentRequest { what, seen_step, since_ms });
    }

    pub(super) fn note_rejected(&mut self, problem: String) {
        push_last(&mut self.rejected, problem);
    }
}

/// Keeps a hash if its step is a multiple of [`ClientStats::HASH_STEPS`]; server and clients keep those of the same
/// steps.
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

/// State of a client's connection.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConnectionState {
    /// Connected; frames arrive.
    Connected,
    /// The connection was lost; the client reconnects.
    Rejoining,
    /// The session has ended for this client, for this reason.
    Ended(SessionError),
}
