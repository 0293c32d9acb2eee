//! A reach from its start to its end, frame by frame.

use crate::meter::ReachFrame;
use crate::moving_goal::MovingGoal;
use crate::reacher::Reacher;
use sinew_body::humanoid::Pose;

/// How long the end is shown \[s\].
const HOLD_SECS: f64 = 0.4;

/// Plays a reach at a constant rate: follows targets that move, and goes on until the hand has arrived and they rest.
///
/// ```
/// use glam::DVec3;
/// use sinew_body::humanoid::Body;
/// use sinew_reach::{Goal, MovingGoal, ReachPlayback, Reacher, Start, Style, standing};
///
/// let body = Body::standard(80.0, 1.7);
/// let start = Start { pose: standing(&body, DVec3::ZERO, 0.0), before: None };
/// let reacher = Reacher::new(&body, &Style::default(), &start)?;
/// let goal = Goal { right: Some(DVec3::new(-0.2, 1.2, 0.45)), ..Goal::default() };
/// let mut playback = ReachPlayback::new(reacher, MovingGoal::new(goal, Vec::new())?, 60.0);
/// let mut poses = Vec::new();
/// while let Some(frame) = playback.next_frame() {
///     poses.push(frame.pose);
/// }
/// poses.extend(playback.stand_up());
/// assert!(poses.len() > 60);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ReachPlayback {
    reacher: Reacher,
    goal: MovingGoal,
    hz: f64,
    frame: usize,
    end_secs: f64,
}

impl ReachPlayback {
    /// Sends a reacher out for a goal, from its time 0 on, at `hz` frames a second \[Hz\].
    pub fn new(mut reacher: Reacher, goal: MovingGoal, hz: f64) -> ReachPlayback {
        // Where the target will be is known: the body goes there.
        reacher.reach(&goal.start);
        let mut playback = ReachPlayback { reacher, goal, hz, frame: 0, end_secs: 0.0 };
        playback.plan_end();
        playback
    }

    /// The next frame; `None` after the end, or after ten minutes.
    pub fn next_frame(&mut self) -> Option<ReachFrame> {
        let frame = self.frame as f64;
        if frame > self.end_secs * self.hz + 0.5 || frame > MovingGoal::MAX_SECS * self.hz {
            return None;
        }
        let secs = self.now_secs();
        self.reacher.advance(secs);
        let goal = self.goal.at(secs);
        if self.goal.moves() {
            self.reacher.follow(&goal);
            self.plan_end();
        }
        self.frame += 1;
        Some(ReachFrame { secs, goal, pose: self.reacher.pose_at(secs) })
    }

    /// Lets go and stands up: the poses from the next frame until the body stands.
    pub fn stand_up(&mut self) -> Vec<Pose> {
        self.reacher.advance(self.now_secs());
        self.reacher.release();
        let from = self.frame;
        self.frame = self.frame.max((self.reacher.done_secs() * self.hz).ceil() as usize);
        (from..self.frame).map(|frame| self.reacher.pose_at(frame as f64 / self.hz)).collect()
    }

    /// Time of the next frame \[s\].
    pub fn now_secs(&self) -> f64 {
        self.frame as f64 / self.hz
    }

    /// Who reaches.
    pub fn reacher(&self) -> &Reacher {
        &self.reacher
    }

    fn plan_end(&mut self) {
        self.end_secs = self.reacher.done_secs().max(self.goal.rests_secs()) + HOLD_SECS;
    }
}
