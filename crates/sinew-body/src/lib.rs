//! The body behind a motion: masses, joint limits, shapes, and the dynamics of an articulated body.
//!
//! A [`humanoid::Body`] is the method's own character: 18 bodies with 6 + 24 + 12 degrees of freedom, whatever skeleton
//! the motion came on. A [`humanoid::Reduction`] turns a source skeleton's pose into that body's pose, and an answer of
//! the body back into a deviation of the source's own joints.
//!
//! This crate does not know time stepping, worlds or files.

pub mod dynamics;
pub mod humanoid;
