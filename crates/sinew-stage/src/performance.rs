//! A character's performer on the stage.

use crate::event::CharacterEffect;
use sinew_body::humanoid::Pose;
use sinew_control::perform::{LiveSource, Presence};

/// Who acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Acts {
    /// The scene's own pose, graph or clip, until the performer is heard.
    Understudy,
    Performer,
    /// Neither: somebody let go of the performer.
    Others,
}

/// A performer's stream, and whether the character follows it at present.
pub(crate) struct Performance {
    source: LiveSource,
    has_understudy: bool,
    acts: Acts,
}

impl Performance {
    pub fn of(source: LiveSource, has_understudy: bool) -> Performance {
        let acts = if has_understudy { Acts::Understudy } else { Acts::Performer };
        Performance { source, has_understudy, acts }
    }

    pub fn source(&self) -> &LiveSource {
        &self.source
    }

    pub fn source_mut(&mut self) -> &mut LiveSource {
        &mut self.source
    }

    pub fn is_followed(&self) -> bool {
        self.acts == Acts::Performer
    }

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

    /// The performer, when it comes, will begin at this pose.
    pub fn stand_by(&mut self, pose: &Pose) {
        self.source.stand_by(pose);
    }

    /// Goes on by a step. Returns what the performer did, when it did something.
    pub fn advance(&mut self, now_secs: f64, step_secs: f64) -> Option<CharacterEffect> {
        let presence = self.source.advance(now_secs, step_secs)?;
        let replaces_understudy = presence == Presence::Performing && self.has_understudy_on();
        Some(CharacterEffect::Performer { presence, replaces_understudy })
    }
}
