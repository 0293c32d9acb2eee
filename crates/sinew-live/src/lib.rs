//! Live performers and sessions over a network: motion capture streams in, simulated poses out, and one stage shared by
//! several machines.
//!
//! This crate does not know how a pose is followed: a capture stream becomes samples, samples become [`Command`]s, and
//! the stage does the rest.
//!
//! [`Command`]: sinew_control::Command

mod impairment;
mod mirror;
mod performers;
mod player;
mod port;
pub mod raw;
mod raw_player;
#[cfg(feature = "session")]
pub mod session;
pub mod vmc;

pub use impairment::{Corruption, Delivery, Impairment};
pub use mirror::Mirror;
pub use performers::{Latency, Performers};
pub use player::ClipPlayer;
pub use port::{Port, PortCounters, PortError};
pub use raw_player::RawPlayer;
