//! Orders for a character.

use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::perform::PerformerSample;
use sinew_control::source::SourceSpec;
use sinew_control::tracker::{Asked, KdDamping, KdPreset, TrackerKind};
use sinew_control::{Layer, ReachOrder};
use sinew_world::{Entity, PropId};
use std::fmt;

/// What a character is to do. Ranges are those of [`sinew_control::range`]; `for_secs` is how long it lasts \[s\], `None` for until
/// changed again. Everything takes effect in the step that follows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CharacterOrder {
    /// Aim at a key pose.
    Pose {
        /// One of the scene's, or `stand`.
        name: String,
    },
    /// Start a pose graph.
    Graph {
        /// One of the scene's.
        name: String,
        /// One of its states; its first when `None`.
        state: Option<String>,
    },
    /// Fire the graph transitions that wait for a word.
    Signal {
        /// The word.
        name: String,
    },
    /// Bring a limb's end to a point by inverse kinematics.
    LimbReach {
        /// A part of an arm or a leg; `None` for the limb that holds something, else the right hand.
        node: Option<Node>,
        /// Where to, world \[m\].
        target: DVec3,
    },
    /// Let a limb go back to the pose.
    LimbRelease {
        /// Its part; `None` for all limbs.
        node: Option<Node>,
    },
    /// Take hold of something.
    Attach {
        /// The part that holds.
        node: Node,
        /// A prop or another character's part; `None` for the nearest thing within reach.
        object: Option<Entity>,
        /// By a spring.
        soft: bool,
        /// Breaks above this force \[N\], in [`BREAK_FORCE_N`](sinew_control::range::BREAK_FORCE_N).
        break_force_n: Option<f64>,
    },
    /// Let go.
    Detach {
        /// The part that holds.
        node: Node,
        /// What it holds; `None` for everything.
        object: Option<Entity>,
    },
    /// Push a part.
    Push {
        /// The part.
        node: Node,
        /// Each component in [`FORCE_N`](sinew_control::range::FORCE_N).
        force: DVec3,
        /// Axes of the character's facing (x left, y up, z forward) instead of the world's.
        facing: bool,
        /// Where, in the part's frame \[m\]; its centre of mass when `None`.
        at: Option<DVec3>,
        /// For how long \[s\].
        for_secs: f64,
    },
    /// Scale joint gains.
    Gain {
        /// The part whose joint; `None` for all.
        node: Option<Node>,
        /// In [`GAIN`](sinew_control::range::GAIN).
        factor: f64,
    },
    /// Switch physics off on parts.
    ForcesOff {
        /// The parts.
        nodes: Vec<Node>,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Switch physics on again.
    ForcesOn {
        /// The parts.
        nodes: Vec<Node>,
    },
    /// Hold it to a vertical plane.
    Plane {
        /// About +Y from +Z to +X; its own facing when `None`.
        facing_deg: Option<f64>,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Free it to three dimensions.
    PlaneOff,
    /// Scale gravity.
    Gravity {
        /// The part; `None` for all.
        node: Option<Node>,
        /// In [`GRAVITY_SCALE`](sinew_control::range::GRAVITY_SCALE).
        scale: f64,
        /// Time in which it comes to that \[s\]; at once when `None`.
        over_secs: Option<f64>,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Give a part another collision shape.
    Shape {
        /// The part.
        node: Node,
        /// Which.
        shape: ShapeChoice,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Add a shape to a part.
    AddShape {
        /// The part.
        node: Node,
        /// One of the scene's.
        shape: String,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Take an added shape away.
    RemoveShape {
        /// The part.
        node: Node,
        /// One of the scene's.
        shape: String,
    },
    /// Switch a layer.
    Layer {
        /// Which.
        layer: Layer,
        /// On or off.
        on: bool,
    },
    /// Switch a reflex.
    Reflex {
        /// One of [`REFLEXES`](crate::scene::REFLEXES).
        name: String,
        /// On or off.
        on: bool,
    },
    /// Be run by a controller.
    Controller {
        /// One of the scene's; `None` for no controller.
        name: Option<String>,
    },
    /// Hold parts more or less firmly (tracker `kd`).
    Weights {
        /// The parts.
        nodes: Vec<Node>,
        /// To their places, in [`KD_WEIGHT`](sinew_control::range::KD_WEIGHT); as it was when `None`.
        pin: Option<f64>,
        /// To their joint angles; as it was when `None`.
        joint: Option<f64>,
        /// How long the change takes \[s\].
        fade_secs: f64,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Other gains of the tracker `kd`.
    Kd {
        /// What changes.
        change: KdChange,
        /// How long the change takes \[s\].
        fade_secs: f64,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Switch the kinematic forces of the tracker `kd`.
    Pins {
        /// On or off.
        on: bool,
        /// How long the change takes \[s\].
        fade_secs: f64,
        /// For how long \[s\].
        for_secs: Option<f64>,
    },
    /// Follow by another tracker.
    Tracker(TrackerKind),
    /// Take a sample of its performer.
    Perform(Box<PerformerSample>),
    /// Follow its performer, or no longer.
    Live {
        /// On or off.
        on: bool,
    },
    /// Follow another source of its own; the one before hands over.
    Source(Box<SourceSpec>),
    /// Reach with the whole body.
    Reach(ReachOrder<PropId>),
    /// Let go of a reach.
    ReachEnd,
    /// A line for the report.
    Say {
        /// The words.
        text: String,
    },
}

/// What changes in the gains of the tracker `kd`. What is `None` stays as it is, or is the preset's when there is one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KdChange {
    /// Gains for a purpose.
    pub preset: Option<KdPreset>,
    /// Stiffness of places \[1/s², per unit mass\], in [`KD_GAIN`](sinew_control::range::KD_GAIN).
    pub k_p: Option<f64>,
    /// Its damping \[1/s, per unit mass\].
    pub d_p: Option<f64>,
    /// Stiffness of joints \[1/s², per unit of inertia\].
    pub k_q: Option<f64>,
    /// Its damping \[1/s, per unit of inertia\].
    pub d_q: Option<f64>,
    /// Against what is damped.
    pub damping: Option<KdDamping>,
    /// Whether the motion's own forces are fed forward.
    pub feed_forward: Option<bool>,
}

/// The collision shape of a part.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum ShapeChoice {
    /// The part's own; `own` in scenes.
    #[default]
    Own,
    /// None at all; `none` in scenes.
    None,
    /// One of the scene's `[shapes]`.
    Named(String),
}

impl ShapeChoice {
    /// The choice of this name in scenes.
    pub fn of(name: &str) -> ShapeChoice {
        match name {
            "own" => ShapeChoice::Own,
            "none" => ShapeChoice::None,
            name => ShapeChoice::Named(name.to_owned()),
        }
    }
}

impl fmt::Display for ShapeChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            ShapeChoice::Own => "own",
            ShapeChoice::None => "none",
            ShapeChoice::Named(name) => name,
        })
    }
}

impl CharacterOrder {
    /// What it asks of the character's tracker beside following the wanted pose; `None` for nothing.
    pub(crate) const fn asks(&self) -> Option<Asked> {
        match self {
            CharacterOrder::Gain { .. } | CharacterOrder::Layer { layer: Layer::Poses, on: false } => {
                Some(Asked::Gains)
            }
            CharacterOrder::Reflex { on: true, .. } => Some(Asked::Torques),
            _ => None,
        }
    }

    /// Whether two orders set the same thing of the character.
    pub(super) fn sets_the_same(&self, other: &CharacterOrder) -> bool {
        use CharacterOrder as O;
        match (self, other) {
            (O::ForcesOn { nodes: a }, O::ForcesOn { nodes: b })
            | (O::Weights { nodes: a, .. }, O::Weights { nodes: b, .. }) => a == b,
            (O::Gravity { node: a, .. }, O::Gravity { node: b, .. })
            | (O::Gain { node: a, .. }, O::Gain { node: b, .. }) => a == b,
            (O::Shape { node: a, .. }, O::Shape { node: b, .. }) => a == b,
            (O::RemoveShape { node: a, shape: one }, O::RemoveShape { node: b, shape: two }) => a == b && one == two,
            (O::PlaneOff, O::PlaneOff) | (O::Kd { .. }, O::Kd { .. }) | (O::Pins { .. }, O::Pins { .. }) => true,
            _ => false,
        }
    }
}
