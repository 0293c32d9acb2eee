//! Poses by the sender's time, and the pose at any time between them.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};
use sinew_snapshot::snapshot;
use std::collections::VecDeque;

/// Poses that are kept: half a second at 120 Hz.
const MOST: usize = 64;

/// How fast a motion that is carried on beyond its last pose dies out \[s\].
const DECAY_SECS: f64 = 0.05;

/// The longest gap over which a velocity is measured \[s\].
const LONGEST_GAP_SECS: f64 = 0.1;

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
snapshot!(Buffer { entries } valid |buffer| buffer.entries.len() <= MOST);

impl Buffer {
    pub fn new() -> Buffer {
        Buffer { entries: VecDeque::with_capacity(MOST + 1) }
    }

    pub fn clear(&mut self) {
        self.entries.clear();
    }

    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// How many poses wait, those behind the playhead not yet dropped included.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// The latest pose.
    pub fn newest(&self) -> Option<&Entry> {
        self.entries.back()
    }

    /// The pose closest in time, whichever side.
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

    /// Where a pose of this time belongs.
    fn place_of(&self, time_secs: f64) -> usize {
        self.entries.partition_point(|entry| entry.time_secs < time_secs)
    }

    /// Adds a pose in its place; the oldest gives way. Returns its distances in time to its neighbours \[s\].
    pub fn insert(&mut self, entry: Entry) -> [Option<f64>; 2] {
        let at = self.place_of(entry.time_secs);
        let before = at.checked_sub(1).and_then(|at| self.entries.get(at)).map(|one| entry.time_secs - one.time_secs);
        let after = self.entries.get(at).map(|one| one.time_secs - entry.time_secs);
        self.entries.insert(at, entry);
        if self.entries.len() > MOST {
            self.entries.pop_front();
        }
        [before, after]
    }

    /// Drops the oldest pose when it lies wholly behind the playhead, and says how long it lasted until the next.
    pub fn pass(&mut self, playhead_secs: f64) -> Option<f64> {
        // Two behind the playhead stay, so that a velocity is known.
        let third = self.entries.get(2)?;
        if third.time_secs > playhead_secs {
            return None;
        }
        let gone = self.entries.pop_front()?;
        self.entries.front().map(|next| next.time_secs - gone.time_secs)
    }

    /// The pose at a time: between two it is interpolated, before the first it is the first, after the last the motion runs out.
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
        if !(1e-4..=LONGEST_GAP_SECS).contains(&gap) {
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

/// The largest turn of a joint \[rad\] and the way of the hips \[m\] from one pose to another.
pub(super) fn distance(from: &Pose, to: &Pose) -> (f64, f64) {
    let turns = Node::ALL.map(|node| {
        let apart: DVec3 = log((from.local(node).conjugate() * to.local(node)).normalize());
        apart.length()
    });
    (turns.into_iter().fold(0.0, f64::max), (to.hips_position - from.hips_position).length())
}
