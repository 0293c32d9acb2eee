//! What a stage and the program `sinew-script-host` say to each other over the host's standard input and output: a length (four
//! bytes, little-endian) and that many bytes of postcard. For the host program; everybody else uses [`Script`](crate::Script).

use crate::{Limits, Names, ScriptError, Snapshot, StartInfo};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io;

/// Version of the messages; another one is refused by [`WRONG_VERSION`]. Raised by every change of a type that is sent.
pub const VERSION: u32 = 2;
/// The environment variable that tells the host the [`VERSION`] of the program that starts it.
pub const VERSION_VARIABLE: &str = "SINEW_SCRIPT_PROTOCOL";
/// The exit code of a host that was started with another [`VERSION`].
pub const WRONG_VERSION: u8 = 3;
/// Maximum length of a script's text \[bytes\].
pub const MAX_SOURCE: usize = 1 << 20;
/// Maximum length of a message to the child \[bytes\].
pub const MAX_REQUEST: usize = 64 << 20;
/// Maximum length of a message from the child \[bytes\].
pub const MAX_REPLY: usize = 4 << 20;
/// Maximum length of a script's state \[bytes\].
pub const MAX_STATE: usize = 2 << 20;

/// To the child.
#[derive(Debug, Serialize)]
pub enum Request<'a> {
    /// Read the text and make a controller of it.
    Start(&'a StartInfo, Limits),
    /// Do a step.
    Step(&'a Snapshot),
    /// Read another text and go on with a controller of it.
    Reload(&'a str),
    /// Other names from now on: something came or went.
    Names(&'a Names),
    /// Say what the controller's state is.
    Save,
    /// Read a text, make a controller of it, and give it a state that was said.
    Restore(&'a str, &'a [u8]),
}

/// [`Request`], as the child reads it.
#[derive(Debug, Deserialize)]
pub enum Asked {
    /// Read the text and make a controller of it.
    Start(Box<(StartInfo, Limits)>),
    /// Do a step.
    Step(Snapshot),
    /// Read another text and go on with a controller of it.
    Reload(String),
    /// Other names from now on: something came or went.
    Names(Box<Names>),
    /// Say what the controller's state is.
    Save,
    /// Read a text, make a controller of it, and give it a state that was said.
    Restore(String, Vec<u8>),
}

/// From the child.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct Reply {
    /// `Vec<Command>` in JSON, whose tagged form postcard cannot read; empty for none.
    pub commands: Vec<u8>,
    /// Lines that the script printed.
    pub printed: Vec<String>,
    /// An exception that left the script.
    pub error: Option<ScriptError>,
    /// The state that was asked for, in the child's own form.
    pub state: Vec<u8>,
    /// What of the state cannot be had.
    pub lost: Vec<String>,
}

/// A whole message, length and all.
///
/// ```
/// use sinew_script::protocol::{MAX_REPLY, content, length, message};
/// let bytes = message(&"word", MAX_REPLY)?;
/// let head = bytes.first_chunk::<4>().ok_or(std::io::ErrorKind::UnexpectedEof)?;
/// assert_eq!(length(*head, MAX_REPLY)?, bytes.len() - 4);
/// assert_eq!(content::<String>(&bytes[4..])?, "word");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// When the content cannot be written or is longer than `most` bytes.
pub fn message(content: &impl Serialize, most: usize) -> io::Result<Vec<u8>> {
    let bytes = postcard::to_extend(content, vec![0; 4]).map_err(io::Error::other)?;
    let length = bytes.len() - 4;
    if length > most {
        return Err(io::Error::other(format!("a message of {length} bytes is longer than {most}")));
    }
    let mut bytes = bytes;
    // `most` is far below four gibibytes.
    bytes[..4].copy_from_slice(&(length as u32).to_le_bytes());
    Ok(bytes)
}

/// The length that a message begins with \[bytes\].
///
/// # Errors
/// When it is more than `most`.
pub fn length(head: [u8; 4], most: usize) -> io::Result<usize> {
    let length = u32::from_le_bytes(head) as usize;
    if length > most {
        return Err(io::Error::other(format!("a message of {length} bytes is longer than {most}")));
    }
    Ok(length)
}

/// What a message says, without its length.
///
/// # Errors
/// When the bytes are no such content.
pub fn content<T: DeserializeOwned>(bytes: &[u8]) -> io::Result<T> {
    postcard::from_bytes(bytes).map_err(io::Error::other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn message_is_its_length_and_its_content() {
        let bytes = message(&"word", 100).unwrap();
        let head = *bytes.first_chunk::<4>().unwrap();
        assert_eq!(length(head, 100).unwrap(), bytes.len() - 4);
        assert_eq!(content::<String>(&bytes[4..]).unwrap(), "word");
    }

    #[test]
    fn messages_beyond_the_limit_are_refused_at_both_ends() {
        assert!(message(&"a longer word", 8).is_err());
        assert!(length(9u32.to_le_bytes(), 8).is_err());
        assert!(length(u32::MAX.to_le_bytes(), MAX_REQUEST).is_err());
    }

    #[test]
    fn broken_content_is_an_error() {
        assert!(content::<Reply>(&[0xff; 40]).is_err());
        assert!(content::<Reply>(&[]).is_err());
    }
}
