//! Messages on a stream: a length, then so many bytes. No more is taken in than is allowed, whatever the length says.

use super::SessionError;
use quinn::{RecvStream, SendStream};
use serde::Serialize;

/// Writes one message.
pub(super) async fn say(to: &mut SendStream, message: &impl Serialize) -> Result<(), SessionError> {
    let text = serde_json::to_vec(message).map_err(|error| SessionError::Malformed(error.to_string()))?;
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text);
    to.write_all(&bytes).await.map_err(|error| SessionError::Ended(error.to_string()))
}

/// Reads one message; `None` when the other side has finished.
pub(super) async fn hear(from: &mut RecvStream, most: usize) -> Result<Option<Vec<u8>>, SessionError> {
    let mut length = [0; 4];
    match from.read_exact(&mut length).await {
        Ok(()) => {}
        Err(quinn::ReadExactError::FinishedEarly(0)) => return Ok(None),
        Err(error) => return Err(SessionError::Ended(error.to_string())),
    }
    let length = u32::from_le_bytes(length) as usize;
    if length > most {
        return Err(SessionError::Malformed(format!("a message has {length} bytes, of {most} allowed")));
    }
    read_bytes(from, length).await.map(Some)
}

/// Reads so many bytes, and takes memory only as they come.
pub(super) async fn read_bytes(from: &mut RecvStream, length: usize) -> Result<Vec<u8>, SessionError> {
    let mut bytes = Vec::new();
    while bytes.len() < length {
        let piece = from.read_chunk(length - bytes.len(), true).await;
        match piece.map_err(|error| SessionError::Ended(error.to_string()))? {
            Some(piece) => bytes.extend_from_slice(&piece.bytes),
            None => return Err(SessionError::Malformed("a message is cut off".to_owned())),
        }
    }
    Ok(bytes)
}
