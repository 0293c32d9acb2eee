//! A live performer, and whether the character follows it.

use super::Source;
use crate::perform::{LiveSource, Presence};
use crate::{Root, Wanted};
use sinew_body::humanoid::{Node, Pose};

impl Source for LiveSource {
    fn root(&self) -> Root {
        Root::Placed
    }

    /// Joints are those of the end of the step; the pose is foretold as far as the stream is known.
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

/// Who acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Acts {
    /// The character's own source, until the performer is heard.
    Understudy,
    Performer,
    /// Neither: somebody let go of the performer.
    Others,
}

/// A performer's stream, and whether the character follows it at present.
#[derive(Clone, Debug)]
pub struct Performer {
    source: LiveSource,
    has_understudy: bool,
    acts: Acts,
}

/// A performer came or went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StreamChange {
    /// What the performer is to the character now.
    pub presence: Presence,
    /// An understudy acted until now.
    pub replaces_understudy: bool,
}

impl Performer {
    /// Followed at once, or with an understudy (the character's own source) as soon as it is heard.
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

    /// Is followed from now on, or not.
    pub fn follow(&mut self, on: bool) {
        self.acts = if on { Acts::Performer } else { Acts::Others };
    }

    /// Something else is to be done. An understudy takes that as its own part.
    pub fn leave(&mut self) {
        if self.is_followed() {
            self.follow(false);
        }
    }

    /// Whether an understudy acts.
    pub fn has_understudy_on(&self) -> bool {
        self.acts == Acts::Understudy
    }

    /// Whether the performer is followed in the place of an understudy.
    pub fn has_understudy_off(&self) -> bool {
        self.has_understudy && self.is_followed()
    }

    /// Goes on by a step; an understudy's pose is where the performer will begin. Returns what the performer did, when it did something.
    pub fn advance(&mut self, now_secs: f64, step_secs: f64, understudy: Option<&Pose>) -> Option<StreamChange> {
        if let Some(pose) = understudy {
            self.source.stand_by(pose);
        }
        let presence = self.source.advance(now_secs, step_secs)?;
        let replaces_understudy = presence == Presence::Performing && self.has_understudy_on();
        Some(StreamChange { presence, replaces_understudy })
    }
}
