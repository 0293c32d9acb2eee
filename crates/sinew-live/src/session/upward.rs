//! What a client sends in datagrams: signs of life, and what its actors perform.

use super::sample_code::{decode_sample, encode_sample};
use super::wire::{Malformed, Reader};
use sinew_control::perform::PerformerSample;
use sinew_control::{Action, Command};

/// One datagram of a client.
#[derive(Clone, Debug, PartialEq)]
pub enum Upward {
    /// It lives, and has seen frames up to this step.
    Alive {
        /// [`sinew_world::Frame::step`] of the newest frame.
        seen_step: u64,
    },
    /// A sample of one of its actors.
    Performed {
        /// Which, counted in the order in which it joined as them.
        actor: u8,
        /// What the capture system said.
        sample: Box<PerformerSample>,
    },
}

impl Upward {
    /// As bytes: at most 450, fit for any packet.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::new();
        match self {
            Upward::Alive { seen_step } => {
                out.push(0);
                out.extend(seen_step.to_le_bytes());
            }
            Upward::Performed { actor, sample } => {
                out.extend([1, *actor]);
                encode_sample(sample, &mut out);
            }
        }
        out
    }

    /// Reads a datagram. Any bytes may come.
    ///
    /// # Errors
    /// Bytes that are none.
    pub fn read(bytes: &[u8]) -> Result<Upward, Malformed> {
        let mut from = Reader(bytes);
        let upward = match from.u8()? {
            0 => Upward::Alive { seen_step: from.u64()? },
            1 => Upward::Performed { actor: from.u8()?, sample: Box::new(decode_sample(&mut from)?) },
            _ => return Err(Malformed("there is no such kind of datagram")),
        };
        from.end()?;
        Ok(upward)
    }

    /// What the stage is to do, for a client that plays these actors.
    pub(super) fn command(self, actors: &[String]) -> Option<Command> {
        match self {
            Upward::Alive { .. } => None,
            Upward::Performed { actor, sample } => {
                let name = actors.get(usize::from(actor))?;
                Some(Command::to(name.as_str(), Action::Perform { sample }))
            }
        }
    }
}
