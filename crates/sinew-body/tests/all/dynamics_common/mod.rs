//! Bodies, random states and reference files that the dynamics' tests and benchmarks share.
#![allow(dead_code, reason = "each test uses its share")]

pub mod bodies;
pub mod random;
pub mod vectors;
