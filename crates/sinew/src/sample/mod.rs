//! A walk that Sinew makes itself: something to start with when no motion is at hand.
//!
//! Its joint angles are Fourier series measured as means over the normal walks of seven people (`examples/measure_walk.rs`
//! measures, `walk_table.rs` holds the numbers). The hips' path follows from the standing foot, both feet are held on the
//! floor where they stand, and speed, cadence and stature are parameters: see [`Walk`]. The repository ships it as
//! `samples/walk.bvh` and `samples/walk.glb`, which `examples/make_samples.rs` writes.

mod frame;
mod gait;
mod series;
mod walk;
mod walk_table;

pub use walk::{Walk, WalkError};

/// `samples/walk.bvh`: [`Walk::default`] as a BVH file in centimetres.
pub static WALK_BVH: &[u8] = include_bytes!("../../../../samples/walk.bvh");
