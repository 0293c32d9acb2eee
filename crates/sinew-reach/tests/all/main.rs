//! Everything that `sinew-reach` is held to, as one program.

mod captured;
mod changes;
mod choices;
mod common;
mod equations;
mod from_walk;
mod motion;
mod people;
mod snapshots;
mod targets;
mod variety;
