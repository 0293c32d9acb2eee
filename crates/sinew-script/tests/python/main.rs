//! Scripts in a real child process.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

mod api;
mod devices;
mod dunk;
mod hostile;
mod modules;
mod reload;
mod scene;
mod state;
