//! Orders for the stage: props, joints, controllers.

use glam::DVec3;
use sinew_world::{Aim, PropId, PropJointId};

/// What is to happen to the stage. Ranges are those of [`sinew_control::range`]. Everything takes effect in the step that follows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum StageOrder {
    /// Put a prop somewhere else, or give it another velocity.
    PlaceProp {
        /// The prop.
        prop: PropId,
        /// World \[m\].
        position: Option<DVec3>,
        /// World \[m/s\].
        velocity: Option<DVec3>,
    },
    /// Accelerate a moving prop.
    AccelerateProp {
        /// A prop with `moving = true`.
        prop: PropId,
        /// World \[m/s²\].
        acceleration: DVec3,
        /// For how long \[s\].
        for_secs: f64,
    },
    /// Push a prop.
    PushProp {
        /// The prop.
        prop: PropId,
        /// World axes \[N\].
        force: DVec3,
        /// Where, in its own frame \[m\]; its centre of mass when `None`.
        at: Option<DVec3>,
        /// For how long \[s\].
        for_secs: f64,
    },
    /// Scale gravity for a prop.
    PropGravity {
        /// The prop.
        prop: PropId,
        /// The factor.
        scale: f64,
        /// Time in which it comes to that \[s\]; at once when `None`.
        over_secs: Option<f64>,
        /// For how long \[s\]; `None` for until changed again.
        for_secs: Option<f64>,
    },
    /// Drive a joint that has a motor.
    Motor {
        /// The joint.
        joint: PropJointId,
        /// What its motor aims at; `None` lets it go.
        aim: Option<Aim>,
    },
    /// Cut a joint for good.
    CutJoint {
        /// The joint.
        joint: PropJointId,
    },
    /// Go on with a controller's new text.
    Reload {
        /// The controller.
        controller: String,
        /// The text; `None` reads the scene's file.
        text: Option<String>,
    },
    /// Stop a controller, as a take says that it was stopped.
    ScriptKilled {
        /// The controller.
        controller: String,
        /// Why.
        reason: String,
    },
    /// A line for the report.
    Say {
        /// The words.
        text: String,
    },
}

impl StageOrder {
    /// Whether two orders set the same thing.
    pub(super) fn sets_the_same(&self, other: &StageOrder) -> bool {
        use StageOrder as O;
        match (self, other) {
            (O::PropGravity { prop: a, .. }, O::PropGravity { prop: b, .. })
            | (O::AccelerateProp { prop: a, .. }, O::AccelerateProp { prop: b, .. }) => a == b,
            (O::Motor { joint: a, .. }, O::Motor { joint: b, .. }) => a == b,
            _ => false,
        }
    }
}
