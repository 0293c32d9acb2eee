//! Pose graphs: key poses in sequence, led from one to the next by timers, touches, sensors and signals.

mod spec;

pub use spec::{FeedbackSpec, GraphSpec, LegSide, Quantity, SensorSpec, StateSpec, TransitionSpec, TurnAxis};
