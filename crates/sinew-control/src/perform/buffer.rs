//! The jitter buffer: poses by the sender's time, and interpolation at any time between them.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};
use sinew_snapshot::snapshot;
use std::collections::VecDeque;

/// Capacity: half a second at 120 Hz.
const CAPACITY: usize = 64;

/// Decay time of the extrapolated velocity beyond the last pose \[s\].
const DECAY_SECS: f64 = 0.05;

/// Maximum gap over which a velocity is measured \[s\].
const MAX_GAP_SECS: f64 = 0.1;

/// One pose of the stream.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Entry {
    pub time_secs: f64,
    pub pose: Pose,
}

/// The poses around the playhead, by time.
#[derive(Clone, Debug)]
pub(super) struct Buffer {
    entries: VecDeque<Entry>,
}

snapshot!(Entry { time_secs, pose });
snapshot!(Buffer { entries } valid |buffer| buffer.entries.len() <= CAPACITY);

impl Buffer {
    pub fn new() -> Buffer {
        Buffer { entries: VecDeque::with_capacity(CAPACITY + 1) }
    }

    pub fn clear(&mut self) {
        self.entries.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Number of buffered poses, including those behind the playhead that are not yet dropped.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// The latest pose.
    pub fn newest(&self) -> Option<&Entry> {
        self.entries.back()
    }

    /// The pose closest in time, before or after.
    pub fn nearest(&self, time_secs: f64) -> Option<&Entry> {
        let at = self.place_of(time_secs);
        let (before, after) = (at.checked_sub(1).and_then(|at| self.entries.get(at)), self.entries.get(at));
        match (before, after) {
            (Some(before), Some(after)) if after.time_secs - time_secs < time_secs - before.time_secs => Some(after),
            (Some(before), _) => Some(before),
            (None, after) => after,
        }
    }

    /// Time of the first pose that is not before a time \[s\].
    pub fn next_secs(&self, time_secs: f64) -> Option<f64> {
        self.entries.get(self.place_of(time_secs)).map(|entry| entry.time_secs)
    }

    /// Index at which a pose of this time is inserted.
    fn place_of(&self, time_secs: f64) -> usize {
        self.entries.partition_point(|entry| entry.time_secs < time_secs)
    }

    /// Inserts a pose in order; a full buffer drops the oldest. Returns its distances in time to its neighbours \[s\].
    pub fn insert(&mut self, entry: Entry) -> [Option<f64>; 2] {
        let at = self.place_of(entry.time_secs);
        let before = at.checked_sub(1).and_then(|at| self.entries.get(at)).map(|one| entry.time_secs - one.time_secs);
        let after = self.entries.get(at).map(|one| one.time_secs - entry.time_secs);
        self.entries.insert(at, entry);
        if self.entries.len() > CAPACITY {
            self.entries.pop_front();
        }
        [before, after]
    }

    /// Drops the oldest pose if it lies wholly behind the playhead, and returns the time from it to the next.
    pub fn pass(&mut self, playhead_secs: f64) -> Option<f64> {
        // Two poses behind the playhead are kept, so that a velocity is known.
        let third = self.entries.get(2)?;
        if third.time_secs > playhead_secs {
            return None;
        }
        let gone = self.entries.pop_front()?;
        self.entries.front().map(|next| next.time_secs - gone.time_secs)
    }

    /// The pose at a time: interpolated between two, the first one before it, extrapolated with decaying velocity after
    /// the last.
    pub fn at(&self, time_secs: f64) -> Option<Pose> {
        let next = self.place_of(time_secs);
        match (next.checked_sub(1).and_then(|at| self.entries.get(at)), self.entries.get(next)) {
            (Some(before), Some(after)) => {
                let share = (time_secs - before.time_secs) / (after.time_secs - before.time_secs);
                Some(between(&before.pose, &after.pose, share.clamp(0.0, 1.0)))
            }
            (None, Some(first)) => Some(first.pose),
            (Some(last), None) => Some(self.beyond(last, time_secs - last.time_secs)),
            (None, None) => None,
        }
    }

    fn beyond(&self, last: &Entry, ahead_secs: f64) -> Pose {
        let Some(before) = self.entries.len().checked_sub(2).and_then(|at| self.entries.get(at)) else {
            return last.pose;
        };
        let gap = last.time_secs - before.time_secs;
        if !(1e-4..=MAX_GAP_SECS).contains(&gap) {
            return last.pose;
        }
        let reach = DECAY_SECS * (1.0 - libm::exp(-ahead_secs / DECAY_SECS)) / gap;
        let moved = last.pose.hips_position - before.pose.hips_position;
        let locals = Node::ALL.map(|node| {
            let now = last.pose.local(node);
            let turned = log((before.pose.local(node).conjugate() * now).normalize());
            (now * exp(turned * reach)).normalize()
        });
        Pose::from_locals(last.pose.hips_position + moved * reach, &locals)
    }
}

/// A pose between two.
pub(super) fn between(from: &Pose, to: &Pose, share: f64) -> Pose {
    let locals = Node::ALL.map(|node| slerp(from.local(node), to.local(node), share));
    Pose::from_locals(from.hips_position.lerp(to.hips_position, share), &locals)
}

fn slerp(from: DQuat, to: DQuat, share: f64) -> DQuat {
    from.slerp(to, share).normalize()
}

/// The largest rotation of a joint \[rad\] and the displacement of the hips \[m\] between two poses.
pub(super) fn distance(from: &Pose, to: &Pose) -> (f64, f64) {
    let turns = Node::ALL.map(|node| {
        let apart: DVec3 = log((from.local(node).conjugate() * to.local(node)).normalize());
        apart.length()
    });
    (turns.into_iter().fold(0.0, f64::max), (to.hips_position - from.hips_position).length())
}
