//! Streams of performers, from their bytes to the pose, on a virtual clock.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

mod drift;
mod hostile;
mod impaired;
mod rehearsal;
mod silence;
mod suit;
mod vmc;
mod vmc_senders;
