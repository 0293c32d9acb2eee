//! Datagrams of a client: keep-alives, and performance samples of its actors.

use super::sample_code::{decode_sample, encode_sample};
use super::wire::{Malformed, Reader};
use sinew_control::perform::PerformerSample;
use sinew_control::{Action, Command};

/// One datagram of a client.
#[derive(Clone, Debug, PartialEq)]
pub enum ClientDatagram {
    /// A keep-alive, with the step of the newest frame that the client has received.
    Alive {
        /// [`sinew_world::Frame::step`] of the newest frame.
        seen_step: u64,
    },
    /// A sample of one of its actors.
    Performed {
        /// Index of the actor in the order of [`Hello::actors`](super::Hello::actors).
        actor: u8,
        /// What the capture system measured.
        sample: Box<PerformerSample>,
    },
}

impl ClientDatagram {
    /// Encodes it in at most 450 bytes, which fit into any packet.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::new();
        match self {
            ClientDatagram::Alive { seen_step } => {
                out.push(0);
                out.extend(seen_step.to_le_bytes());
            }
            ClientDatagram::Performed { actor, sample } => {
                out.extend([1, *actor]);
                encode_sample(sample, &mut out);
            }
        }
        out
    }

    /// Decodes a datagram. Any bytes are safe to pass.
    ///
    /// # Errors
    /// Invalid bytes.
    pub fn read(bytes: &[u8]) -> Result<ClientDatagram, Malformed> {
        let mut from = Reader(bytes);
        let datagram = match from.u8()? {
            0 => ClientDatagram::Alive { seen_step: from.u64()? },
            1 => ClientDatagram::Performed { actor: from.u8()?, sample: Box::new(decode_sample(&mut from)?) },
            _ => return Err(Malformed("the kind of datagram is unknown")),
        };
        from.end()?;
        Ok(datagram)
    }

    /// The command for the stage, from a client that plays these actors.
    pub(super) fn command(self, actors: &[String]) -> Option<Command> {
        match self {
            ClientDatagram::Alive { .. } => None,
            ClientDatagram::Performed { actor, sample } => {
                let name = actors.get(usize::from(actor))?;
                Some(Command::to(name.as_str(), Action::Perform { sample }))
            }
        }
    }
}
