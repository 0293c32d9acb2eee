//! Scripts in a real child process.

mod api;
mod dunk;
mod hostile;
mod modules;
mod reload;
mod scene;
