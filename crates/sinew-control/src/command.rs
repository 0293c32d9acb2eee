//! Everything that changes a running stage from outside: user, script, scene time line, network and take speak in this type
//! alone, so that recording, replay and remote play are one mechanism.
//!
//! Names are those of the scene file: characters, objects, poses, graphs. Body parts are VRM 1.0 names. Vectors are
//! `[x, y, z]` in metres, newtons or m/s, in the world's axes (Y up) unless said otherwise.

use crate::ReachOrder;
use crate::perform::PerformerSample;
use crate::source::SourceSpec;
use crate::tracker::{KdDamping, KdPreset};
use serde::{Deserialize, Serialize};

/// One change to a running stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Command {
    /// The character that it is for; `None` for what concerns the stage or an object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub character: Option<String>,
    /// What is to happen.
    #[serde(flatten)]
    pub action: Action,
}

/// What a [`Command`] does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Action {
    /// Aim at a key pose from now on; stops a pose graph and lets go of an IK target.
    Pose {
        /// Its name.
        name: String,
    },
    /// Start a pose graph at its first state, or at another.
    Graph {
        /// Its name.
        name: String,
        /// The state to begin with.
        #[serde(default)]
        state: Option<String>,
    },
    /// Fire the graph transitions that wait for this word (a script's test).
    Signal {
        /// The word.
        name: String,
    },
    /// Bring a limb's end to a point and take the joint angles into the wanted pose.
    Ik {
        /// The part or alias whose limb reaches; `None` for the limb that something is attached to, else the right hand.
        #[serde(default)]
        link: Option<String>,
        /// Where to, in the world \[m\].
        target_m: [f64; 3],
    },
    /// Let a limb go back to the key pose; all limbs when no link is named.
    IkRelease {
        /// The part or alias.
        #[serde(default)]
        link: Option<String>,
    },
    /// Fasten an object (or another character's part, `name.part`) to a part.
    Attach {
        /// The part or alias.
        link: String,
        /// What is held; the nearest thing within reach of the part when left out.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        object: String,
        /// A spring instead of a rigid joint.
        #[serde(default)]
        soft: bool,
        /// Breaks above this force \[N\].
        #[serde(default)]
        break_n: Option<f64>,
    },
    /// Let go again.
    Detach {
        /// The part or alias.
        link: String,
        /// What was held; everything when left out.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        object: String,
    },
    /// A force on a part, or on an object when `character` is `None`.
    Push {
        /// The part, or the object's name.
        on: String,
        /// The force \[N\].
        force_n: [f64; 3],
        /// For how long \[s\].
        for_secs: f64,
        /// Axes of the character's facing (x left, y up, z forward) instead of the world's.
        #[serde(default)]
        facing: bool,
        /// Where it acts, in the part's or object's own frame \[m\]; its centre of mass when left out.
        #[serde(default)]
        at_m: Option<[f64; 3]>,
    },
    /// Scale all joint gains of the character (EQ3's global gain).
    Gain {
        /// Factor on the stiffness, 1 as in the scene.
        factor: f64,
        /// Only this part's joint.
        #[serde(default)]
        part: Option<String>,
    },
    /// Switch physics off on parts: they become kinematic and their velocity decays.
    ForcesOff {
        /// The parts; empty means the root (hips).
        #[serde(default)]
        parts: Vec<String>,
        /// For how long \[s\]; until [`Action::ForcesOn`] when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Switch physics on again.
    ForcesOn {
        /// The parts; empty means all.
        #[serde(default)]
        parts: Vec<String>,
    },
    /// Hold the whole character to the vertical plane of its facing, or of a given one.
    Plane {
        /// Facing of the plane \[degrees about +Y from +Z to +X\]; the character's own when left out.
        #[serde(default)]
        facing_deg: Option<f64>,
        /// For how long \[s\]; until [`Action::PlaneOff`] when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Free the character to three dimensions again.
    PlaneOff {},
    /// Scale gravity for a character (or for an object by `on`).
    Gravity {
        /// 1 as on Earth, 0 for none.
        scale: f64,
        /// The object, when `character` is `None`.
        #[serde(default)]
        on: Option<String>,
        /// Only this part of the character.
        #[serde(default)]
        part: Option<String>,
        /// Time over which the factor comes to this from what it is \[s\]; at once when left out.
        #[serde(default)]
        over_secs: Option<f64>,
        /// For how long \[s\]; until changed again when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Drive a joint of the scene: at most one of the four aims is stated; with none the joint is let go.
    Motor {
        /// The joint.
        joint: String,
        /// A hinge's speed \[rad/s\].
        #[serde(default)]
        speed_rad_s: Option<f64>,
        /// A hinge's angle from where it was at the start \[degrees\].
        #[serde(default)]
        angle_deg: Option<f64>,
        /// A slider's speed \[m/s\].
        #[serde(default)]
        speed_m_s: Option<f64>,
        /// A slider's shift from where it was at the start \[m\].
        #[serde(default)]
        shift_m: Option<f64>,
    },
    /// Cut a joint of the scene for good.
    Cut {
        /// The joint.
        joint: String,
    },
    /// Swap a part's collision shape for one named in the scene (`skis`), or back to its own with `own`.
    Shape {
        /// The part.
        part: String,
        /// A named shape of the scene; `own` for the part's own, `none` to take it away.
        shape: String,
        /// For how long \[s\]; until changed again when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Add one of the scene's shapes to a part, on top of what it has; it weighs nothing.
    AddShape {
        /// The part.
        part: String,
        /// A named shape of the scene.
        shape: String,
        /// For how long \[s\]; until removed when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Take a shape away again that was added.
    RemoveShape {
        /// The part.
        part: String,
        /// Its name.
        shape: String,
    },
    /// Switch one of the three layers on or off.
    Layer {
        /// Which.
        layer: Layer,
        /// On or off.
        on: bool,
    },
    /// Select a reflex by name (`balance`) and switch the layer on.
    Reflex {
        /// Its name.
        name: String,
        /// On or off.
        #[serde(default = "yes")]
        on: bool,
    },
    /// Start a Python controller of the scene (class name), or stop it with an empty name.
    Controller {
        /// Its name in the scene.
        name: String,
    },
    /// Hold parts more or less firmly: to their places, to their joint angles (tracker `kd`).
    Weights {
        /// The parts; empty means all.
        #[serde(default)]
        parts: Vec<String>,
        /// How far they are held to their places: 1 as the gains say, 0 not at all; as it was when left out.
        #[serde(default)]
        pin: Option<f64>,
        /// How far their joints are held to their angles.
        #[serde(default)]
        joint: Option<f64>,
        /// How long the change takes \[s\]; half a second when left out.
        #[serde(default)]
        fade_secs: Option<f64>,
        /// For how long, then as before \[s\]; until changed again when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Other gains of the tracker `kd`; what is left out stays as it is, or as the preset has it when one is named.
    Kd {
        /// Gains for a purpose.
        #[serde(default)]
        preset: Option<KdPreset>,
        /// Stiffness that holds parts to their places \[1/s², per unit mass\].
        #[serde(default)]
        k_p: Option<f64>,
        /// Its damping \[1/s, per unit mass\].
        #[serde(default)]
        d_p: Option<f64>,
        /// Stiffness of joints \[1/s², per unit of the inertia of what hangs from them\].
        #[serde(default)]
        k_q: Option<f64>,
        /// Its damping \[1/s, per unit of inertia\].
        #[serde(default)]
        d_q: Option<f64>,
        /// Against the performer's velocity or against the ground.
        #[serde(default)]
        damping: Option<KdDamping>,
        /// Give the forces that the performer's motion itself needs.
        #[serde(default)]
        feed_forward: Option<bool>,
        /// How long the change takes \[s\]; half a second when left out.
        #[serde(default)]
        fade_secs: Option<f64>,
        /// For how long, then as before \[s\]; until changed again when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Switch the kinematic forces of the tracker `kd` off, so that the body falls freely, or on again.
    Pins {
        /// On or off.
        on: bool,
        /// How long the change takes \[s\]; half a second when left out.
        #[serde(default)]
        fade_secs: Option<f64>,
        /// For how long, then the other way round \[s\]; until changed again when left out.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Follow with another tracker from now on.
    Tracker {
        /// `kinematic`, `pd`, `kd` or `response`.
        name: String,
    },
    /// Hand a prop a new place or velocity.
    Place {
        /// The object.
        object: String,
        /// Where its centre is to be \[m\].
        #[serde(default)]
        position_m: Option<[f64; 3]>,
        /// Its velocity \[m/s\].
        #[serde(default)]
        velocity_m_s: Option<[f64; 3]>,
    },
    /// Give a kinematic prop (a platform) an acceleration for a while.
    Accelerate {
        /// The object.
        object: String,
        /// The acceleration \[m/s²\].
        acceleration_m_s2: [f64; 3],
        /// For how long \[s\].
        for_secs: f64,
    },
    /// Read a controller's file again and go on with it.
    Reload {
        /// Its name in the scene.
        name: String,
        /// The new text; `None` reads the scene's file.
        #[serde(default)]
        text: Option<String>,
    },
    /// A script was stopped because it did not come back; recorded so that a replay stops it at the same step.
    ScriptKilled {
        /// Its name in the scene.
        name: String,
        /// Why.
        reason: String,
    },
    /// The scene was edited while it ran: recorded so that a replay edits it at the same step. Nobody else can give it.
    #[schemars(skip)]
    Edit {
        /// The whole text of the scene file.
        text: String,
    },
    /// A sample of a live performer arrives.
    Perform {
        /// What the capture system says.
        sample: Box<PerformerSample>,
    },
    /// Let a live performer's character follow its performer, or something else for a while.
    Live {
        /// On or off.
        on: bool,
    },
    /// Follow another source of its own from now on, within half a second: a pose, a graph, a clip, or another kind without `live` and
    /// `reach`. Clips are among the scene's files.
    Source {
        /// As in a character's table.
        source: Box<SourceSpec>,
    },
    /// Reach for something with arms, spine, head and legs, from whatever pose the character is in.
    Reach(ReachOrder),
    /// Let go of a reach: stand up, then back to the clip or pose of before.
    ReachEnd {},
    /// A line for the report's list of events.
    Say {
        /// The words.
        text: String,
    },
}

/// The three layers of control (Shapiro et al. 2007, section 6).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Layer {
    /// Key poses and pose graphs.
    #[default]
    Poses,
    /// Python controllers.
    Scripts,
    /// Controllers in Rust.
    Reflexes,
}

sinew_snapshot::snapshot!(enum Layer { 0: Poses, 1: Scripts, 2: Reflexes });

fn yes() -> bool {
    true
}

impl Action {
    /// Whether it is for the stage, its props, joints and controllers, whichever character is named beside it.
    pub fn is_for_stage(&self) -> bool {
        matches!(
            self,
            Action::Place { .. }
                | Action::Accelerate { .. }
                | Action::Motor { .. }
                | Action::Cut { .. }
                | Action::Reload { .. }
                | Action::ScriptKilled { .. }
                | Action::Edit { .. }
        )
    }
}

/// A line without words.
impl Default for Command {
    fn default() -> Command {
        Command::stage(Action::Say { text: String::new() })
    }
}

impl Command {
    /// A command for a character.
    pub fn to(character: impl Into<String>, action: Action) -> Command {
        Command { character: Some(character.into()), action }
    }

    /// A command for the stage.
    pub fn stage(action: Action) -> Command {
        Command { character: None, action }
    }
}
