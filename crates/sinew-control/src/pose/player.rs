//! The key pose player: blends the wanted pose from key pose to key pose.

use super::KeyPose;
use crate::Wanted;
use crate::ik::{IkHandles, between};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, log};
use sinew_snapshot::snapshot;
use sinew_world::{CharacterFrame, CharacterId, Frame};

/// Plays key poses: blends to the present one from the previous wanted pose.
#[derive(Clone, Debug, PartialEq)]
pub struct PosePlayer {
    /// IK handles; they are solved on the pose.
    pub ik: IkHandles,
    aim: KeyPose,
    /// What was wanted when the blend began.
    from: Blended,
    /// What is wanted now, before IK.
    now: Blended,
    elapsed_secs: f64,
    /// What was written last, to know its velocity.
    written: Option<[DQuat; Node::COUNT]>,
}

/// A pose on its way.
#[derive(Clone, Debug, PartialEq)]
struct Blended {
    rotations: [DQuat; Node::COUNT],
    gains: [f64; Node::COUNT],
    dampings: [f64; Node::COUNT],
}

snapshot!(PosePlayer { ik, aim, from, now, elapsed_secs, written });
snapshot!(Blended { rotations, gains, dampings });

impl PosePlayer {
    /// A player that has arrived at a pose.
    pub fn new(pose: &KeyPose) -> PosePlayer {
        let wanted = Blended { rotations: pose.rotations, gains: pose.gains, dampings: pose.dampings };
        PosePlayer {
            ik: IkHandles::default(),
            aim: pose.clone(),
            from: wanted.clone(),
            now: wanted,
            elapsed_secs: pose.blend_secs,
            written: None,
        }
    }

    /// Sets the body's present pose as the wanted one, so that the next blend starts there: for a character that was
    /// driven by another source.
    pub fn match_body(&mut self, character: &CharacterFrame) {
        let pose = character.pose();
        for node in Node::ALL.into_iter().skip(1) {
            self.now.rotations[node.index()] = pose.local(node).normalize();
        }
        self.written = None;
        self.restart();
    }

    /// Sets the target pose and starts a blend to it.
    pub fn aim(&mut self, pose: &KeyPose) {
        self.aim.clone_from(pose);
        self.restart();
    }

    /// The target pose.
    pub fn aimed_at(&self) -> &KeyPose {
        &self.aim
    }

    /// Progress of the blend, 0 to 1.
    pub fn progress(&self) -> f64 {
        if self.elapsed_secs >= self.aim.blend_secs { 1.0 } else { self.elapsed_secs / self.aim.blend_secs }
    }

    fn restart(&mut self) {
        self.from.clone_from(&self.now);
        self.elapsed_secs = 0.0;
    }

    /// Goes on by a step and writes what is wanted at its end. `own` is the character; a frame without it
    /// gets the pose without IK. Root and torques of the target are left alone.
    pub fn write(&mut self, frame: &Frame, own: CharacterId, body: &Body, step_secs: f64, target: &mut Wanted) {
        self.elapsed_secs = (self.elapsed_secs + step_secs).min(self.aim.blend_secs);
        let progress = self.progress();
        let share = progress * progress * (3.0 - 2.0 * progress);
        for at in 1..Node::COUNT {
            self.now.rotations[at] = between(self.from.rotations[at], self.aim.rotations[at], share);
            self.now.gains[at] = self.from.gains[at] + (self.aim.gains[at] - self.from.gains[at]) * share;
            self.now.dampings[at] = self.from.dampings[at] + (self.aim.dampings[at] - self.from.dampings[at]) * share;
            let joint = &mut target.joints[at];
            joint.rotation = self.now.rotations[at];
            joint.gain = self.now.gains[at];
            joint.damping = self.now.dampings[at];
        }
        if let Some(character) = frame.character(own) {
            self.ik.write(character, body, step_secs, target);
        }
        let before = self.written.filter(|_| self.aim.follow_velocity && step_secs > 0.0);
        for at in 1..Node::COUNT {
            let joint = &mut target.joints[at];
            joint.velocity =
                before.map_or(DVec3::ZERO, |before| log(before[at].conjugate() * joint.rotation) / step_secs);
        }
        self.written = Some(target.joints.map(|joint| joint.rotation));
    }
}
