//! Causes of events.

use serde::{Serialize, Serializer};
use std::fmt;

/// The cause of an event.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cause {
    /// A command from outside: user, key, network, take.
    Command,
    /// A command of the scene's `[[at]]`.
    Timeline {
        /// Its line in the scene file.
        line: usize,
    },
    /// A command of the scene's `[[when]]`.
    Reaction {
        /// Its line in the scene file.
        line: usize,
        /// The two that it waits for, as the scene names them.
        touching: [String; 2],
        /// The two that touched.
        touched: [String; 2],
    },
    /// A command of a Python controller, or its outcome.
    Script {
        /// The controller's name in the scene.
        controller: String,
    },
    /// A Python controller printed a line.
    Print {
        /// The controller's name in the scene.
        controller: String,
    },
    /// A timed effect ends.
    TimeOver,
    /// The start of the scene.
    SceneStart,
    /// The time of a reach is up.
    ReachArrives,
    /// A performer's stream begins, stops or comes back.
    Stream,
    /// A graph's state has lasted its time.
    GraphTimer,
    /// A graph's signal came.
    GraphSignal,
    /// A graph's sensor was beyond its threshold.
    GraphSensor {
        /// What it read, in the quantity's unit.
        value: f64,
    },
    /// Two things touched that a graph waits for.
    GraphTouch {
        /// The two.
        touched: [String; 2],
        /// Size of the impulse of this step \[N s\].
        impulse_n_s: f64,
    },
    /// A body's state was no longer finite.
    BodyDiverged,
    /// The force of a joint of props exceeded its breaking force.
    JointOverload {
        /// Its name in the scene.
        joint: String,
    },
    /// The force of an attachment exceeded its breaking force.
    HoldOverload {
        /// The force \[N\].
        force_n: f64,
        /// Its breaking force \[N\].
        max_n: f64,
    },
    /// The stage was restored from a snapshot.
    Restored,
    /// In a stage that was restored from another one's snapshot: the words of a cause from before.
    Earlier {
        /// The words.
        words: String,
    },
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Cause::Command => f.write_str("command"),
            Cause::Timeline { line } => write!(f, "scene, line {line}"),
            Cause::Reaction { line, touching: [one, other], touched: [a, b] } => {
                write!(f, "scene, line {line}: {one} touches {other} ({a} on {b})")
            }
            Cause::Script { controller } => f.write_str(controller),
            Cause::Print { controller } => write!(f, "{controller} prints"),
            Cause::TimeOver => f.write_str("its time is over"),
            Cause::SceneStart => f.write_str("the scene"),
            Cause::ReachArrives => f.write_str("the reach arrives"),
            Cause::Stream => f.write_str("its stream"),
            Cause::GraphTimer => f.write_str("time was up"),
            Cause::GraphSignal => f.write_str("the signal came"),
            Cause::GraphSensor { value } => write!(f, "the sensor read {value:.3}"),
            Cause::GraphTouch { touched: [a, b], impulse_n_s } => {
                write!(f, "{a} touches {b} with {impulse_n_s:.2} N s")
            }
            Cause::BodyDiverged => f.write_str("its body had gone wrong"),
            Cause::JointOverload { joint } => write!(f, "{joint} bore too much"),
            Cause::Restored => f.write_str("the restored snapshot"),
            Cause::Earlier { words } => f.write_str(words),
            Cause::HoldOverload { force_n, max_n } => write!(f, "{force_n:.0} N are more than {max_n:.0} N"),
        }
    }
}

impl Serialize for Cause {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
