//! Live performers and sessions: what comes in from the network, and what goes out to it.
//!
//! Nothing here knows how a pose is followed: a capture stream becomes samples, samples become [`Command`]s, and the stage
//! does the rest.
//!
//! [`Command`]: sinew_control::Command

#[cfg(feature = "session")]
pub mod session;
