//! Reaching: arms, spine, head and legs bring a hand to any target together (Huang, Kapadia, Terzopoulos 2011, *Full-Body Hybrid
//! Motor Control for Reaching*).
//!
//! A [`Reacher`] is a source of poses. It plans the whole motion when it is given a [`Goal`]: whether to step and how
//! ([`decide_step`]), how far the spine twists and swings, how far the hips sink, and where the elbow goes. From then
//! on every pose is a closed form of the time, and every control a [`MinimumJerk`] that can be redirected at any
//! moment.
//!
//! | job | file |
//! |---|---|
//! | arm: the hand's path (EQ1 to 4), two-bone limb | `hand_path.rs`, `arm.rs`, `compose.rs` |
//! | spine: twist (EQ5, EQ6), swing (EQ7), root (EQ8) | `spine.rs` |
//! | head | `head.rs` |
//! | legs: whether and how far to step (EQ9), strides | `legs.rs`, `walk.rs`, `feet.rs`, `weight.rs`, `sink.rs` |
//! | scheduler: states 0 to 3 | `plan.rs`, `schedule.rs`, `timing.rs` |
//! | what varies from seed to seed | `manner.rs` |
//! | open values | `values.rs` |
//! | the pose it begins in; goals; targets that move and fly | `start.rs`, `stop.rs`, `reacher.rs`, `moving_goal.rs`, `flight.rs` |
//! | from start to end frame by frame; what came of it | `playback.rs`, `meter.rs` |
//!
//! ```
//! use glam::DVec3;
//! use sinew_body::humanoid::Body;
//! use sinew_reach::{Goal, Reacher, Start, Style, standing};
//!
//! let body = Body::standard(80.0, 1.7);
//! let start = Start { pose: standing(&body, DVec3::ZERO, 0.0), before: None };
//! let mut reacher = Reacher::new(&body, &Style::default(), &start)?;
//! let goal = Goal { right: Some(DVec3::new(-0.2, 1.2, 0.45)), ..Goal::default() };
//! let outcome = reacher.reach(&goal).clone();
//! assert!(outcome.is_reached());
//! let halfway = reacher.pose_at(0.5 * outcome.arrives_secs);
//! assert!(halfway.is_finite());
//! # Ok::<(), sinew_reach::StyleError>(())
//! ```
//!
//! It has no feature, and brings along fewer than 20 crates.
//!
//! What it does not do: worlds and engines; fingers; a path for the whole body around obstacles (arms keep clear of them).

mod arm;
mod arm_place;
mod compose;
mod feet;
mod flight;
mod follow;
mod frame;
mod hand_path;
mod head;
mod heel;
mod leg_place;
mod legs;
mod manner;
mod meter;
mod minimum_jerk;
mod moving_goal;
mod obstacle;
mod outcome;
mod plan;
mod playback;
mod reacher;
mod reacher_snapshot;
mod rng;
mod route;
mod schedule;
mod self_touch;
mod sink;
mod solve;
mod spine;
mod start;
mod stop;
mod timing;
mod values;
mod walk;
mod weight;

pub use feet::{Feet, Placement, Stride};
pub use flight::{Flight, Meeting};
pub use hand_path::{HandPath, PRINTED_RATIO, PRINTED_SPEED_M_S};
pub use head::gaze_rotation;
pub use legs::{
    StepChoice, StepKind, decide_step, ground_direction, half_probability, step_bias, step_length, step_probability,
};
pub use meter::{ReachFrame, ReachMeter};
pub use minimum_jerk::{MinimumJerk, Value};
pub use moving_goal::{MovingGoal, MovingGoalError, Waypoint};
pub use obstacle::Obstacle;
pub use outcome::{Outcome, Reason};
pub use playback::ReachPlayback;
pub use reacher::{Goal, Reacher};
pub use rng::Rng;
pub use route::MAX_OBSTACLES;
pub use spine::{
    reaching_angle, root_shift, search_twist, squat_for, stoop_range_m, swing_axis, swing_shares, twist_shares,
};
pub use start::{Start, standing};
pub use values::{Style, StyleError, Values};
pub use walk::Step;
pub use weight::Support;
