//! The humanoid of the methods: 18 bodies, 42 degrees of freedom.

mod anthropometry;
mod body;
mod calibration;
mod flat_foot;
mod hips;
mod leg;
mod limb;
mod limit;
mod node;
mod overlay;
mod pose;
mod reduction;
mod rotation;
mod sole;
mod support;

pub use body::{Body, Link, Shape};
pub use hips::HipsDeviation;
pub use leg::{LegPose, solve_leg};
pub(crate) use leg::{OffLine, smoothstep, solve_leg_beside};
pub use limb::{Limb, LimbGoal, LimbTurns, TurnedLimb, solve_limb, solve_limb_turned};
pub use limit::{Limit, Swing};
pub use node::{Axis, Dof, LEGS, Node, UPPER_DOFS, UPPER_NODES, upper_dofs};
pub use overlay::{Deviation, Overlay};
pub use pose::Pose;
pub use reduction::{Person, Reduction, ReductionError};
pub use rotation::{exp, log, swing_twist};
pub use sole::Sole;
pub use support::{keep_support_hull, support_margin_m};
