//! IK handles: limbs of the wanted pose that follow a point of the world.

mod handle;

pub(crate) use handle::between;
pub use handle::{IkHandles, Reach};
