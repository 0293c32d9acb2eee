//! Messages on the control stream: JSON behind its length (u32, little-endian).

use super::limits::{MAX_ACTORS_PER_CLIENT, MAX_NAME};
use super::{Refusal, Role, SessionError};
use serde::{Deserialize, Serialize};
use sinew_control::Command;

/// The first message of a client.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hello {
    /// [`super::PROTOCOL`] of the client.
    pub protocol: u32,
    /// The token's secret, URL-safe base64.
    pub secret: String,
    /// Actors that it wants to play; empty to watch only.
    pub actors: Vec<String>,
}

/// The part of a hello message that every version has.
#[derive(Deserialize)]
pub(super) struct AnyHello {
    pub protocol: u32,
}

/// A message of a client that has joined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ClientMessage {
    /// A command, to be applied in the next step.
    Command(Command),
    /// A key of the scene is pressed.
    Press(String),
    /// The client leaves.
    Leave,
}

/// A message of the server.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ServerMessage {
    /// The client has joined. The scene follows: [`Welcome::scene_bytes`] bytes of a take without commands.
    Welcome(Welcome),
    /// The client is refused.
    Refused(Refusal),
    /// A request of the client was rejected, for this reason.
    #[serde(rename = "not_passed")]
    Rejected(String),
}

/// The server's first message to a client that has joined.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Welcome {
    /// What it may do.
    pub role: Role,
    /// Actors that it plays.
    pub actors: Vec<String>,
    /// Physics steps done.
    pub step: u64,
    /// Physics steps a second.
    pub physics_hz: u32,
    /// The scene's seed.
    pub seed: u64,
    /// Length of the scene that follows \[bytes\].
    pub scene_bytes: u64,
}

impl Hello {
    /// Decodes a hello message. Any bytes are safe to pass.
    ///
    /// # Errors
    /// Invalid bytes, or another version of the protocol.
    pub fn read(bytes: &[u8]) -> Result<Hello, Refusal> {
        let greeting = |problem: String| Refusal::Greeting { problem };
        // Another version may have more fields than this one knows.
        let any: AnyHello = serde_json::from_slice(bytes).map_err(|error| greeting(short(&error.to_string())))?;
        if any.protocol != super::PROTOCOL {
            return Err(Refusal::Version { server: super::PROTOCOL, client: any.protocol });
        }
        let hello: Hello = serde_json::from_slice(bytes).map_err(|error| greeting(short(&error.to_string())))?;
        if hello.actors.len() > MAX_ACTORS_PER_CLIENT || hello.actors.iter().any(|actor| actor.len() > MAX_NAME) {
            return Err(greeting(format!("at most {MAX_ACTORS_PER_CLIENT} actors with short names are expected")));
        }
        Ok(hello)
    }
}

impl ClientMessage {
    /// Decodes a message of a client. Any bytes are safe to pass.
    ///
    /// # Errors
    /// [`SessionError::Malformed`]: what is invalid.
    pub fn read(bytes: &[u8]) -> Result<ClientMessage, SessionError> {
        let says: ClientMessage = serde_json::from_slice(bytes).map_err(|error| malformed(&error))?;
        match &says {
            ClientMessage::Press(key) if key.len() > MAX_NAME => {
                Err(SessionError::Malformed("the name of a key is too long".to_owned()))
            }
            _ => Ok(says),
        }
    }
}

impl ServerMessage {
    /// Decodes a message of a server. Any bytes are safe to pass.
    ///
    /// # Errors
    /// [`SessionError::Malformed`]: what is invalid.
    pub fn read(bytes: &[u8]) -> Result<ServerMessage, SessionError> {
        serde_json::from_slice(bytes).map_err(|error| malformed(&error))
    }
}

fn malformed(error: &serde_json::Error) -> SessionError {
    SessionError::Malformed(short(&error.to_string()))
}

/// Text from a peer, sanitized for display: at most 200 characters, no control characters.
pub(super) fn short(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
