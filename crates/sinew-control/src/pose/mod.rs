//! Key poses: what files state, what they come to on a body, and the wanted pose that moves from one to the next.

pub(crate) mod number;
mod part_name;
mod spec;

pub use part_name::{PartName, UnknownPartName};
pub use spec::{FullJointSpec, IkSpec, JointSpec, PoseSpec};
