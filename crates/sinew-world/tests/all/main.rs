//! Everything that `sinew-world` is held to, as one program.

mod check;
mod common;
mod contacts;
mod determinism;
mod falls;
mod flight;
mod frame_bytes;
mod friction;
mod holds;
mod hostile;
mod kept;
mod meter;
mod prop_joints;
mod springs;
