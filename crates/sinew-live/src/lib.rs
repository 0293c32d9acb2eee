//! Live performers and sessions over a network: motion capture streams in, simulated poses out, and one stage shared by
//! several machines.
//!
//! This crate does not know how a pose is followed: a capture stream becomes samples, samples become [`Command`]s, and
//! the stage does the rest.
//!
//! ```
//! use sinew_live::Impairment;
//!
//! // Samples of 60 a second over a network that loses every twentieth. The same seed loses the same ones.
//! let bad = Impairment { loss: 0.05, seed: 1, ..Impairment::default() };
//! let lost = (0..1000).filter(|&number| bad.delivery(number, 1.0 / 60.0).arrivals_secs[0].is_none()).count();
//! assert!((20..100).contains(&lost));
//! ```
//!
//! | feature | gives |
//! |---|---|
//! | `session` | one stage for actors on several machines; brings QUIC and tokio along |
//!
//! Brings along fewer than 110 crates; with `session` about 35 more.
//!
//! What it does not do: following a pose, scenes, takes.
//!
//! [`Command`]: sinew_control::Command

mod impairment;
mod mirror;
mod performers;
mod player;
mod player_error;
mod port;
mod port_owner;
pub mod raw;
mod raw_player;
#[cfg(feature = "session")]
pub mod session;
pub mod vmc;

pub use impairment::{Corruption, Delivery, Impairment};
pub use mirror::Mirror;
pub use performers::{Latency, Performers};
pub use player::ClipPlayer;
pub use player_error::PlayerError;
pub use port::{Port, PortCounters, PortError};
pub use raw_player::RawPlayer;
