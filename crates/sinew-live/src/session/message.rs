//! What the two sides say to each other on the control stream, as JSON behind its length (u32, little end first).

use super::limits::{MAX_ACTORS_OF_ONE, MAX_NAME};
use super::{Refusal, Role};
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
    /// Actors that it wants to play; none to watch only.
    pub actors: Vec<String>,
}

/// What is read of a greeting of any version.
#[derive(Deserialize)]
pub(super) struct AnyHello {
    pub protocol: u32,
}

/// A message of a client that has joined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ClientSays {
    /// A command, to be applied in the next step.
    Command(Command),
    /// A key of the scene is pressed.
    Press(String),
    /// It leaves.
    Leave,
}

/// A message of the server.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ServerSays {
    /// The client is in. The scene follows, as so many bytes of a take without commands.
    Welcome(Welcome),
    /// The client is not in.
    Refused(Refusal),
    /// Something that the client sent was not passed on.
    NotPassed(String),
}

/// What a client is told first.
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
    /// Reads a greeting.
    ///
    /// # Errors
    /// Why it is not to be answered with a welcome.
    pub fn read(bytes: &[u8]) -> Result<Hello, Refusal> {
        let greeting = |problem: String| Refusal::Greeting { problem };
        // Another version may say more than this one knows.
        let any: AnyHello = serde_json::from_slice(bytes).map_err(|error| greeting(short(&error.to_string())))?;
        if any.protocol != super::PROTOCOL {
            return Err(Refusal::Version { server: super::PROTOCOL, client: any.protocol });
        }
        let hello: Hello = serde_json::from_slice(bytes).map_err(|error| greeting(short(&error.to_string())))?;
        if hello.actors.len() > MAX_ACTORS_OF_ONE || hello.actors.iter().any(|actor| actor.len() > MAX_NAME) {
            return Err(greeting(format!("at most {MAX_ACTORS_OF_ONE} actors with short names are expected")));
        }
        Ok(hello)
    }
}

impl ClientSays {
    /// Reads a message of a client. Any bytes may come.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(bytes: &[u8]) -> Result<ClientSays, String> {
        let says: ClientSays = serde_json::from_slice(bytes).map_err(|error| short(&error.to_string()))?;
        match &says {
            ClientSays::Press(key) if key.len() > MAX_NAME => Err("a key has a shorter name".to_owned()),
            _ => Ok(says),
        }
    }
}

impl ServerSays {
    /// Reads a message of a server. Any bytes may come.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(bytes: &[u8]) -> Result<ServerSays, String> {
        serde_json::from_slice(bytes).map_err(|error| short(&error.to_string()))
    }
}

/// Words of a stranger, made fit to be shown.
pub(super) fn short(text: &str) -> String {
    text.chars().take(200).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
