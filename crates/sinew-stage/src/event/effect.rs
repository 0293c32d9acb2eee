//! The effect of an event.

use super::{CharacterEffect, cut};
use serde::{Serialize, Serializer};
use sinew_control::OrderError;
use sinew_script::ScriptError;
use std::fmt;

/// What happened. Names are those of the scene.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Effect {
    /// To a character.
    Character {
        /// Its name.
        name: String,
        /// What.
        effect: CharacterEffect,
    },
    /// A command was refused; nothing else happened.
    Refused(OrderError),
    /// A prop has a new position or velocity.
    PropPlaced {
        /// The prop.
        prop: String,
    },
    /// A moving prop is accelerated.
    PropAccelerated {
        /// The prop.
        prop: String,
        /// The size of the acceleration \[m/s²\].
        acceleration_m_s2: f64,
        /// For how long \[s\].
        for_secs: f64,
    },
    /// A moving prop keeps its speed again.
    PropKeepsSpeed {
        /// The prop.
        prop: String,
    },
    /// A prop is pushed.
    PropPushed {
        /// The prop.
        prop: String,
        /// The size of the force \[N\].
        force_n: f64,
        /// For how long \[s\].
        for_secs: f64,
    },
    /// A prop has another factor on gravity.
    PropGravity {
        /// The prop.
        prop: String,
        /// The factor.
        scale: f64,
        /// How long it takes to come to it \[s\]; `None` for at once.
        over_secs: Option<f64>,
    },
    /// A joint's motor starts or stops.
    Motor {
        /// The joint.
        joint: String,
        /// Whether it is driven now.
        on: bool,
    },
    /// A joint was cut.
    JointCut {
        /// The joint.
        joint: String,
    },
    /// A joint broke.
    JointBreaks {
        /// The joint.
        joint: String,
    },
    /// The scene was edited: something came, went or was read anew.
    SceneEdited {
        /// Characters and props that came.
        came: Vec<String>,
        /// Characters and props that went.
        left: Vec<String>,
    },
    /// A controller continues with a new text.
    Reloaded {
        /// The controller.
        controller: String,
    },
    /// A controller was stopped by a command, as in a replay.
    ScriptStopped {
        /// The controller.
        controller: String,
        /// Why.
        reason: String,
    },
    /// The controller that is the cause did not return and was stopped.
    ScriptKilled {
        /// Why.
        reason: String,
    },
    /// The controller that is the cause raised an exception and has stopped.
    ScriptFailed {
        /// What it raised.
        error: ScriptError,
    },
    /// A controller's printed line.
    Printed {
        /// The line.
        line: String,
    },
    /// A line for the report.
    Said {
        /// The words.
        text: String,
    },
    /// In a stage that was restored from another one's snapshot: the words of an effect from before.
    Earlier {
        /// The words.
        words: String,
    },
    /// The stage was restored, and what of a controller's state could not be kept is as reading its text leaves it.
    StateLost {
        /// The controller's attributes and variables, each with what it holds.
        names: Vec<String>,
    },
}

impl Effect {
    /// What happened to a character.
    pub fn of(name: impl Into<String>, effect: CharacterEffect) -> Effect {
        Effect::Character { name: name.into(), effect }
    }

    /// What happened to a character, when it is this one.
    pub fn on(&self, character: &str) -> Option<&CharacterEffect> {
        match self {
            Effect::Character { name, effect } if name == character => Some(effect),
            _ => None,
        }
    }

    /// Whether a command was refused.
    pub fn is_refused(&self) -> bool {
        matches!(self, Effect::Refused(_))
    }

    /// In the words for something whose time is over.
    pub(crate) fn at_its_end(self) -> Effect {
        match self {
            Effect::Character { name, effect } => Effect::Character { name, effect: effect.at_its_end() },
            Effect::PropAccelerated { prop, .. } => Effect::PropKeepsSpeed { prop },
            other => other,
        }
    }

    /// Truncates untrusted texts.
    pub(super) fn shorten(&mut self) {
        match self {
            Effect::Character { effect, .. } => effect.shorten(),
            Effect::Refused(error) if error.problem().len() > super::MAX_TEXT => {
                *error = error.clone().map_problem(|mut problem| {
                    cut(&mut problem);
                    problem
                });
            }
            Effect::ScriptStopped { reason: text, .. }
            | Effect::ScriptKilled { reason: text }
            | Effect::Printed { line: text }
            | Effect::Said { text } => cut(text),
            Effect::ScriptFailed { error } => cut(&mut error.message),
            _ => {}
        }
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Effect::Character { name, effect } => effect.write(name, f),
            Effect::Earlier { words } => f.write_str(words),
            Effect::StateLost { names } => write!(f, "not kept in the snapshot: {}", names.join(", ")),
            Effect::Refused(error) => write!(f, "refused: {error}"),
            Effect::PropPlaced { prop } => write!(f, "{prop} is placed"),
            Effect::PropAccelerated { prop, acceleration_m_s2, for_secs } => {
                write!(f, "{prop} is accelerated by {acceleration_m_s2:.2} m/s² for {for_secs:.2} s")
            }
            Effect::PropKeepsSpeed { prop } => write!(f, "{prop} keeps its speed"),
            Effect::PropPushed { prop, force_n, for_secs } => {
                write!(f, "{prop} is pushed with {force_n:.0} N for {for_secs:.2} s")
            }
            Effect::PropGravity { prop, scale, over_secs } => {
                write!(f, "{prop}: gravity times {scale}")?;
                over(*over_secs, f)
            }
            Effect::Motor { joint, on: true } => write!(f, "{joint} is driven"),
            Effect::Motor { joint, on: false } => write!(f, "{joint} is driven no longer"),
            Effect::JointCut { joint } => write!(f, "{joint} is cut"),
            Effect::JointBreaks { joint } => write!(f, "{joint} breaks"),
            Effect::SceneEdited { came, left } => {
                f.write_str("the scene is edited")?;
                if !came.is_empty() {
                    write!(f, "; new: {}", came.join(", "))?;
                }
                if !left.is_empty() {
                    write!(f, "; gone: {}", left.join(", "))?;
                }
                Ok(())
            }
            Effect::Reloaded { controller } => write!(f, "{controller} goes on with its new text"),
            Effect::ScriptStopped { controller, reason } => write!(f, "{controller} is stopped: {reason}"),
            Effect::ScriptKilled { reason } => write!(f, "stopped: {reason}"),
            Effect::ScriptFailed { error } => write!(f, "stopped by an error: {error}"),
            Effect::Printed { line } => f.write_str(line),
            Effect::Said { text } => f.write_str(text),
        }
    }
}

/// How long something takes.
pub(super) fn over(over_secs: Option<f64>, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    over_secs.map_or(Ok(()), |secs| write!(f, " within {secs:.2} s"))
}

impl Serialize for Effect {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
