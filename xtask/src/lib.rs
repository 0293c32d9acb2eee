//! The project's own chores. `cargo xtask check` is what contributors and CI run before a change goes in.

pub mod check;
pub mod command;
pub mod frame_map;
pub mod golden;
pub mod imports;
pub mod package;
pub mod page;
pub mod readme;
pub mod repository;
pub mod steps;
pub mod two_hosts;
