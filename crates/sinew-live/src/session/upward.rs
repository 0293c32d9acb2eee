//! What a client sends in datagrams: signs of life, and what its actors perform.

use super::limits::MOST_ACTORS_OF_ONE;
use super::wire::{Malformed, Reader};
use sinew_control::Command;

/// One datagram of a client.
#[derive(Clone, Debug, PartialEq)]
pub enum Upward {
    /// It lives, and has seen frames up to this step.
    Alive {
        /// [`sinew_world::Frame::step`] of the newest frame.
        seen_step: u64,
    },
}

impl Upward {
    /// As bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        match self {
            Upward::Alive { seen_step } => {
                let mut out = vec![0];
                out.extend(seen_step.to_le_bytes());
                out
            }
        }
    }

    /// Reads a datagram. Any bytes may come.
    ///
    /// # Errors
    /// Bytes that are none.
    pub fn read(bytes: &[u8]) -> Result<Upward, Malformed> {
        let mut from = Reader(bytes);
        let upward = match from.u8()? {
            0 => Upward::Alive { seen_step: from.u64()? },
            _ => return Err(Malformed("there is no such kind of datagram")),
        };
        from.end()?;
        Ok(upward)
    }

    /// What the stage is to do, for a client that plays these actors.
    pub(super) fn command(self, _actors: &[String]) -> Option<Command> {
        let _ = MOST_ACTORS_OF_ONE;
        None
    }
}
