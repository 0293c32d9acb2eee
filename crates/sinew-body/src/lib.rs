//! The body behind a motion: masses, joint limits, shapes, and the dynamics of an articulated body.
//!
//! A [`humanoid::Body`] is the method's own character: 18 bodies with 6 + 24 + 12 degrees of freedom, whatever skeleton
//! the motion came on. A [`humanoid::Reduction`] turns a source skeleton's pose into that body's pose, and an answer of
//! the body back into a deviation of the source's own joints.
//!
//! ```
//! use sinew_body::humanoid::{Body, Node, Pose};
//!
//! let body = Body::standard(80.0, 1.7);
//! assert!((body.mass_kg() - 80.0).abs() < 1e-9);
//! // Standing, the head's joint is higher than the hips'.
//! let joints = Pose::STANDING.positions(&body);
//! assert!(joints[Node::Head.index()].y > joints[Node::Hips.index()].y);
//! ```
//!
//! | feature | gives |
//! |---|---|
//! | `lanes` | several characters side by side in one vector register: `wide::f64x4` and `f64x8` as `dynamics::Real` |
//!
//! Brings along fewer than 20 crates.
//!
//! What it does not do: time stepping, worlds, files.

// Unit tests share helpers with the integration tests, which know this crate by its name.
#[cfg(test)]
extern crate self as sinew_body;

pub mod dynamics;
mod gravity;
pub mod grounding;
pub mod humanoid;
pub mod measure;
pub mod walk;

pub use gravity::{STANDARD_GRAVITY_M_S2, strength_gravity_m_s2};
