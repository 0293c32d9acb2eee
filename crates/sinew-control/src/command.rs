//! Commands: the only way to change a running stage from outside. Users, scripts, a scene's time line, the network and takes
//! all send this one type, so recording, replay and remote play share one mechanism.
//!
//! Names (characters, props, poses, graphs) are those of the scene file; body parts are VRM 1.0 humanoid bones. Vectors are
//! `[x, y, z]` in the world frame (Y up) unless stated otherwise, in metres, newtons or m/s. A command takes effect at the
//! beginning of the next physics step. Ranges are checked when a command is resolved to an order (`Order`); a command out of
//! range is refused with an event and changes nothing.

use crate::ReachOrder;
use crate::perform::PerformerSample;
use crate::source::SourceSpec;
use crate::tracker::{KdDamping, KdPreset};
use serde::{Deserialize, Serialize};

/// One change to a running stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Command {
    /// The character to command; `None` for the stage or a prop.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub character: Option<String>,
    /// The change to make.
    #[serde(flatten)]
    pub action: Action,
}

/// What a [`Command`] does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub enum Action {
    /// Move to a key pose and hold it. Stops a running pose graph and releases IK targets.
    Pose {
        /// Name of the pose.
        name: String,
    },
    /// Start a pose graph.
    Graph {
        /// Name of the graph.
        name: String,
        /// State to start in; the graph's first state by default.
        #[serde(default)]
        state: Option<String>,
    },
    /// Fire the graph transitions that wait for this signal.
    Signal {
        /// Name of the signal.
        name: String,
    },
    /// Move the end of a limb to a point by inverse kinematics; the joint angles found become part of the wanted pose.
    Ik {
        /// Part or alias at the end of the limb; by default the limb that holds something, else the right hand.
        #[serde(default)]
        link: Option<String>,
        /// Target position, world frame \[m\].
        target_m: [f64; 3],
    },
    /// Release an IK target: the limb returns to the key pose.
    IkRelease {
        /// Part or alias at the end of the limb; all limbs by default.
        #[serde(default)]
        link: Option<String>,
    },
    /// Attach a prop, or another character's part (`name.part`), to a part.
    Attach {
        /// Part or alias that holds.
        link: String,
        /// What to hold; the nearest thing within reach of the part by default.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        object: String,
        /// Hold by a spring instead of a rigid joint.
        #[serde(default)]
        soft: bool,
        /// Force at which the attachment breaks \[N\]; unbreakable by default.
        #[serde(default)]
        break_n: Option<f64>,
    },
    /// Detach what a part holds.
    Detach {
        /// Part or alias that holds.
        link: String,
        /// What to let go of; everything by default.
        #[serde(default, skip_serializing_if = "String::is_empty")]
        object: String,
    },
    /// Apply a constant force to a part, or to a prop when `character` is `None`.
    Push {
        /// Part or prop to push.
        on: String,
        /// Force \[N\], world frame or, with `facing`, the character's.
        force_n: [f64; 3],
        /// Duration \[s\].
        for_secs: f64,
        /// The force is given in the character's facing frame (x left, y up, z forward).
        #[serde(default)]
        facing: bool,
        /// Point of application, frame of the part or prop \[m\]; its centre of mass by default.
        #[serde(default)]
        at_m: Option<[f64; 3]>,
    },
    /// Scale the gains of a character's joint springs (global gain k_sg of Shapiro et al. 2007, EQ3).
    Gain {
        /// Factor on the stiffness; 1 is the scene's own.
        factor: f64,
        /// Only the joint of this part; all joints by default.
        #[serde(default)]
        part: Option<String>,
    },
    /// Switch physics off for parts: they become kinematic and their velocity decays.
    ForcesOff {
        /// The parts; the hips when empty.
        #[serde(default)]
        parts: Vec<String>,
        /// Duration \[s\]; until [`Action::ForcesOn`] by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Switch physics on again for parts.
    ForcesOn {
        /// The parts; all when empty.
        #[serde(default)]
        parts: Vec<String>,
    },
    /// Constrain the character to a vertical plane (2D simulation).
    Plane {
        /// Heading of the plane \[degrees about +Y from +Z to +X\]; the character's own facing by default.
        #[serde(default)]
        facing_deg: Option<f64>,
        /// Duration \[s\]; until [`Action::PlaneOff`] by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Remove the plane constraint.
    PlaneOff {},
    /// Scale gravity for a character, or for the prop `on`.
    Gravity {
        /// Factor on the scene's gravity: 1 is normal, 0 is weightless.
        scale: f64,
        /// The prop, when `character` is `None`.
        #[serde(default)]
        on: Option<String>,
        /// Only this part of the character; the whole body by default.
        #[serde(default)]
        part: Option<String>,
        /// Ramp time from the present factor to `scale` \[s\]; immediate by default.
        #[serde(default)]
        over_secs: Option<f64>,
        /// Duration \[s\]; until changed again by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Drive a joint of the scene. Give at most one of the four targets; with none the motor is off.
    Motor {
        /// Name of the joint.
        joint: String,
        /// Hinge: target speed \[rad/s\].
        #[serde(default)]
        speed_rad_s: Option<f64>,
        /// Hinge: target angle, from the angle at the start of the scene \[degrees\].
        #[serde(default)]
        angle_deg: Option<f64>,
        /// Slider: target speed \[m/s\].
        #[serde(default)]
        speed_m_s: Option<f64>,
        /// Slider: target position, from the position at the start of the scene \[m\].
        #[serde(default)]
        shift_m: Option<f64>,
    },
    /// Remove a joint of the scene permanently.
    Cut {
        /// Name of the joint.
        joint: String,
    },
    /// Replace a part's collision shape.
    Shape {
        /// The part.
        part: String,
        /// A named shape of the scene (`skis`), `own` for the part's own shape, or `none` for no collisions.
        shape: String,
        /// Duration \[s\]; until changed again by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Add a massless collision shape of the scene to a part, beside the shapes that it has.
    AddShape {
        /// The part.
        part: String,
        /// A named shape of the scene.
        shape: String,
        /// Duration \[s\]; until removed by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Remove a shape that [`Action::AddShape`] added.
    RemoveShape {
        /// The part.
        part: String,
        /// Name of the shape.
        shape: String,
    },
    /// Switch one of a character's three control layers on or off.
    Layer {
        /// The layer.
        layer: Layer,
        /// On or off.
        on: bool,
    },
    /// Enable a reflex (`balance`) and switch the reflex layer on, or disable it.
    Reflex {
        /// Name of the reflex.
        name: String,
        /// On or off.
        #[serde(default = "yes")]
        on: bool,
    },
    /// Start one of the scene's Python controllers, or stop the present one.
    Controller {
        /// Name of the controller in the scene; empty to stop.
        name: String,
    },
    /// Tracker `kd`: scale how strongly parts are held to their positions and joint angles.
    Weights {
        /// The parts; all when empty.
        #[serde(default)]
        parts: Vec<String>,
        /// Weight of the position pins: 1 uses the full gains, 0 switches them off; unchanged by default.
        #[serde(default)]
        pin: Option<f64>,
        /// Weight of the joint springs; unchanged by default.
        #[serde(default)]
        joint: Option<f64>,
        /// Blend time \[s\]; 0.5 by default.
        #[serde(default)]
        fade_secs: Option<f64>,
        /// Duration, after which the old weights return \[s\]; until changed again by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Tracker `kd`: change gains. A field that is left out keeps its value, or takes the preset's when one is named.
    Kd {
        /// Named set of gains.
        #[serde(default)]
        preset: Option<KdPreset>,
        /// Stiffness of the position pins \[1/s², per unit mass\].
        #[serde(default)]
        k_p: Option<f64>,
        /// Damping of the position pins \[1/s, per unit mass\].
        #[serde(default)]
        d_p: Option<f64>,
        /// Stiffness of the joint springs \[1/s², per unit of inertia of the subtree\].
        #[serde(default)]
        k_q: Option<f64>,
        /// Damping of the joint springs \[1/s, per unit of inertia of the subtree\].
        #[serde(default)]
        d_q: Option<f64>,
        /// Whether damping acts on the velocity relative to the performer or to the ground.
        #[serde(default)]
        damping: Option<KdDamping>,
        /// Add the feed-forward forces of the performer's own motion.
        #[serde(default)]
        feed_forward: Option<bool>,
        /// Blend time \[s\]; 0.5 by default.
        #[serde(default)]
        fade_secs: Option<f64>,
        /// Duration, after which the old gains return \[s\]; until changed again by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Tracker `kd`: switch the external forces of the position pins on or off; without them the body falls freely.
    Pins {
        /// On or off.
        on: bool,
        /// Blend time \[s\]; 0.5 by default.
        #[serde(default)]
        fade_secs: Option<f64>,
        /// Duration, after which the switch goes back \[s\]; until changed again by default.
        #[serde(default)]
        for_secs: Option<f64>,
    },
    /// Change the tracker, the way in which the body follows its source.
    Tracker {
        /// `kinematic`, `pd`, `kd` or `response`.
        name: String,
    },
    /// Set the position or velocity of a prop.
    Place {
        /// Name of the prop.
        object: String,
        /// Position of its centre, world frame \[m\]; unchanged by default.
        #[serde(default)]
        position_m: Option<[f64; 3]>,
        /// Linear velocity, world frame \[m/s\]; unchanged by default.
        #[serde(default)]
        velocity_m_s: Option<[f64; 3]>,
    },
    /// Accelerate a kinematic prop, such as a platform.
    Accelerate {
        /// Name of the prop.
        object: String,
        /// Acceleration, world frame \[m/s²\].
        acceleration_m_s2: [f64; 3],
        /// Duration \[s\].
        for_secs: f64,
    },
    /// Reload a Python controller.
    Reload {
        /// Name of the controller in the scene.
        name: String,
        /// New source text; the scene's file is read again by default.
        #[serde(default)]
        text: Option<String>,
    },
    /// A script was stopped because it exceeded a limit. Recorded so that a replay stops it at the same step; a user cannot send it.
    ScriptKilled {
        /// Name of the controller in the scene.
        name: String,
        /// The limit that it exceeded.
        reason: String,
    },
    /// The scene was edited while it ran. Recorded so that a replay edits it at the same step; a user cannot send it.
    #[schemars(skip)]
    Edit {
        /// Full text of the edited scene file.
        text: String,
    },
    /// Deliver one sample of a live performer.
    Perform {
        /// The sample.
        sample: Box<PerformerSample>,
    },
    /// Let a character follow its live performer, or its understudy for a while.
    Live {
        /// On to follow the performer.
        on: bool,
    },
    /// Change the character's source; the motion blends over half a second. Takes every kind except `live` and `reach`; a clip must
    /// be among the scene's files.
    Source {
        /// The source, written as in a character's table of the scene.
        source: Box<SourceSpec>,
    },
    /// Reach for a target with arms, spine, head and legs, starting from the present pose.
    Reach(ReachOrder),
    /// End a reach: stand up, then return to the source of before.
    ReachEnd {},
    /// Add a line of text to the events of the report.
    Say {
        /// The text.
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
    /// Whether the action concerns the stage, its props, joints or controllers; a character named beside it is ignored.
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

/// [`Action::Say`] with an empty text.
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
