//! Masses, limits, kinematics and dynamics of a humanoid body.

pub mod dynamics;
