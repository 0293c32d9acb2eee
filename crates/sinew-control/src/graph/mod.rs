//! Pose graphs: key poses in sequence, with transitions on timers, contacts, sensors and signals.

mod error;
#[expect(clippy::module_inception, reason = "a file is named after its noun")]
mod graph;
mod names;
mod player;
mod sensor;
mod spec;
mod steering;

pub use error::GraphError;
pub use graph::{Graph, MAX_STATES};
pub use names::{Names, Touchable, contact_between};
pub use player::{Cause, GraphPlayer, Transition};
pub use spec::{FeedbackSpec, GraphSpec, LegSide, Quantity, SensorSpec, StateSpec, TransitionSpec, TurnAxis};
pub use steering::Steering;
