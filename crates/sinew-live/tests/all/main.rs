//! Everything that `sinew-live` is held to, as one program.

#[cfg(feature = "session")]
mod session;
#[cfg(feature = "session")]
mod session_bytes;
#[cfg(feature = "session")]
mod session_hostile;
#[cfg(feature = "session")]
mod session_setup;
mod streams;
