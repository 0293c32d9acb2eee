//! The walk that the repository ships, for when no motion is at hand.

pub use sinew_body::walk::{Walk, WalkError};

/// `samples/walk.bvh`: [`Walk::default`] as a BVH file in centimetres.
pub static WALK_BVH: &[u8] = include_bytes!("../../../../samples/walk.bvh");
