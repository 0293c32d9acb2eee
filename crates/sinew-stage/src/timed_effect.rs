//! Things that last for a time: what is to be undone, and when.

use crate::fade::Fade;
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_world::{CharacterId, Entity, PropId};

/// What ends.
#[derive(Clone, Debug, PartialEq)]
pub enum Expiry {
    /// Forces on a part are switched on again.
    ForcesOff(CharacterId, Node),
    /// A character is freed from its plane.
    Plane(CharacterId),
    /// A character's gravity goes back to its scale in the scene.
    Gravity(CharacterId),
    /// Gravity on a part goes back to the character's scale in the scene.
    PartGravity(CharacterId, Node),
    /// A prop's gravity goes back to its scale in the scene.
    PropGravity(PropId),
    /// A part gets its own shape again.
    Shape(CharacterId, Node),
    /// A shape that was added to a part is taken away.
    ExtraShape(CharacterId, Node, String),
    /// A part is held as the scene says (tracker `kd`).
    Weights(CharacterId, Node),
    /// The gains of the tracker `kd` are those of the scene.
    Kd(CharacterId),
    /// Kinematic forces that were switched are switched back.
    Pins(CharacterId),
    /// A moving prop keeps its speed.
    Acceleration(PropId),
}

/// A force that lasts.
#[derive(Clone, Debug, PartialEq)]
pub struct LastingPush {
    /// On what.
    pub on: Entity,
    /// Where, in its own frame \[m\]; its centre of mass when `None`.
    pub at: Option<DVec3>,
    /// World axes \[N\].
    pub force: DVec3,
    /// The first step in which it no longer acts.
    pub until_step: u64,
}

/// TimedEffects that are under way.
#[derive(Clone, Debug, Default)]
pub struct TimedEffects {
    endings: Vec<(u64, Expiry)>,
    /// Forces that act now.
    pub pushes: Vec<LastingPush>,
    /// Factors on gravity that are on their way.
    pub fades: Vec<Fade>,
}

/// Pushes that act at the same time; further ones are refused.
pub const MAX_PUSHES: usize = 1000;

impl TimedEffects {
    /// Something ends at a step. What ended it before no longer counts: the newest command wins.
    pub fn end_at(&mut self, step: Option<u64>, ending: Expiry) {
        self.endings.retain(|(_, other)| *other != ending);
        if let Some(step) = step {
            self.endings.push((step, ending));
        }
    }

    /// What ends at or before a step, in the order in which it was begun.
    pub fn take_due(&mut self, step: u64) -> Vec<Expiry> {
        if self.endings.iter().all(|(at, _)| *at > step) {
            return Vec::new();
        }
        let due = self.endings.iter().filter(|(at, _)| *at <= step).map(|(_, ending)| ending.clone()).collect();
        self.endings.retain(|(at, _)| *at > step);
        due
    }
}
