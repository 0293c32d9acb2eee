//! A live performer, and whether the character follows it.

use super::Source;
use crate::perform::{LiveSource, Presence};
use crate::{Root, Wanted};
use sinew_body::humanoid::{Node, Pose};

impl Source for LiveSource {
    fn cloned(&self) -> Box<dyn Source> {
        Box::new(self.clone())
    }

    fn root(&self) -> Root {
        Root::Placed
    }

    /// Joints are those at the end of the step; the pose is extrapolated as far as the stream is known.
    fn wanted(&self, at_secs: f64, wanted: &mut Wanted) {
        for node in Node::ALL.into_iter().skip(1) {
            let joint = wanted.joint_mut(node);
            joint.rotation = self.pose().local(node).normalize();
            joint.velocity = self.turning(node);
        }
        (wanted.pose, wanted.root) = (self.pose_at(at_secs), Root::Placed);
    }

    fn firmness(&self, wanted: &mut Wanted) {
        for joint in &mut wanted.joints {
            (joint.gain, joint.damping) = (self.gain(), 1.0);
        }
    }
}

/// Which source plays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Acts {
    /// The understudy: the character's own source, until the first sample arrives.
    Understudy,
    Performer,
    /// Neither: a command stopped following the performer.
    Others,
}

/// A performer's stream, and whether the character follows it at present.
#[derive(Clone, Debug)]
pub struct Performer {
    source: LiveSource,
    has_understudy: bool,
    acts: Acts,
}

sinew_snapshot::snapshot!(enum Acts { 0: Understudy, 1: Performer, 2: Others });
sinew_snapshot::snapshot!(Performer { source, acts } fixed { has_understudy });

/// The state of the performer's stream changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamChange {
    /// The present state.
    pub presence: Presence,
    /// It replaces an understudy.
    pub replaces_understudy: bool,
}

impl Performer {
    /// Followed at once, or with an understudy (the character's own source) from the first sample on.
    pub fn new(source: LiveSource, has_understudy: bool) -> Performer {
        let acts = if has_understudy { Acts::Understudy } else { Acts::Performer };
        Performer { source, has_understudy, acts }
    }

    /// The stream.
    pub fn source(&self) -> &LiveSource {
        &self.source
    }

    /// The stream, to give it samples.
    pub fn source_mut(&mut self) -> &mut LiveSource {
        &mut self.source
    }

    /// Whether the character follows it.
    pub fn is_followed(&self) -> bool {
        self.acts == Acts::Performer
    }

    /// Starts or stops following.
    pub fn follow(&mut self, on: bool) {
        self.acts = if on { Acts::Performer } else { Acts::Others };
    }

    /// A command for another source. An understudy takes it itself.
    pub fn leave(&mut self) {
        if self.is_followed() {
            self.follow(false);
        }
    }

    /// Whether the understudy plays.
    pub fn has_understudy_on(&self) -> bool {
        self.acts == Acts::Understudy
    }

    /// Whether the performer is followed in the place of an understudy.
    pub fn has_understudy_off(&self) -> bool {
        self.has_understudy && self.is_followed()
    }

    /// Advances by a step; the performer will start at the understudy's pose. Returns a change of the stream's state.
    pub fn advance(&mut self, now_secs: f64, step_secs: f64, understudy: Option<&Pose>) -> Option<StreamChange> {
        if let Some(pose) = understudy {
            self.source.set_start_pose(pose);
        }
        let presence = self.source.advance(now_secs, step_secs)?;
        let replaces_understudy = presence == Presence::Performing && self.has_understudy_on();
        Some(StreamChange { presence, replaces_understudy })
    }
}
