//! Messages on a stream: a length prefix, then that many bytes. A length above the maximum is refused.

use super::SessionError;
use quinn::{RecvStream, SendStream};
use serde::Serialize;

/// Sends one message.
pub(super) async fn send_message(to: &mut SendStream, message: &impl Serialize) -> Result<(), SessionError> {
    let text = serde_json::to_vec(message).map_err(|error| SessionError::Malformed(error.to_string()))?;
    let mut bytes = (text.len() as u32).to_le_bytes().to_vec();
    bytes.extend(text);
    to.write_all(&bytes).await.map_err(|error| SessionError::Ended(error.to_string()))
}

/// Receives one message of at most `max_bytes`; `None` when the other side has closed the stream.
pub(super) async fn receive_message(from: &mut RecvStream, max_bytes: usize) -> Result<Option<Vec<u8>>, SessionError> {
    let mut length = [0; 4];
    match from.read_exact(&mut length).await {
        Ok(()) => {}
        Err(quinn::ReadExactError::FinishedEarly(0)) => return Ok(None),
        Err(error) => return Err(SessionError::Ended(error.to_string())),
    }
    let length = u32::from_le_bytes(length) as usize;
    if length > max_bytes {
        return Err(SessionError::Malformed(format!("a message has {length} bytes; the maximum is {max_bytes}")));
    }
    read_bytes(from, length).await.map(Some)
}

/// Reads `length` bytes. Memory grows only as bytes arrive.
pub(super) async fn read_bytes(from: &mut RecvStream, length: usize) -> Result<Vec<u8>, SessionError> {
    let mut bytes = Vec::new();
    while bytes.len() < length {
        let piece = from.read_chunk(length - bytes.len(), true).await;
        match piece.map_err(|error| SessionError::Ended(error.to_string()))? {
            Some(piece) => bytes.extend_from_slice(&piece.bytes),
            None => return Err(SessionError::Malformed("a message is truncated".to_owned())),
        }
    }
    Ok(bytes)
}
