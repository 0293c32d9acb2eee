//! Untrusted OSC: validated before the library decodes it, so that no bytes exhaust stack or memory.

use rosc::{OscMessage, OscPacket, OscType};

/// Maximum size of a datagram \[bytes\]; larger ones are refused. A whole performer has about 2000.
pub const MAX_DATAGRAM_BYTES: usize = 16 << 10;

/// Maximum nesting depth of bundles; senders use one.
const MAX_DEPTH: usize = 4;

/// Maximum number of messages in a datagram: a performer's bones, fingers and blend shapes are below 300.
const MAX_MESSAGES: usize = 1000;

/// Maximum length of an OSC address \[bytes\].
const MAX_ADDRESS: usize = 256;

const BUNDLE: &[u8] = b"#bundle\0";

/// Why a datagram was discarded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Malformed {
    /// It is too large.
    #[error("a datagram of more than {MAX_DATAGRAM_BYTES} bytes; send a performer's bones in smaller bundles")]
    Large,
    /// Bundles are nested too deeply.
    #[error("bundles nested more than {MAX_DEPTH} deep; send one bundle of messages")]
    Deep,
    /// It is truncated, or its sizes do not add up.
    #[error("not valid OSC: sizes do not add up; check that the sender uses VMC")]
    Sizes,
    /// An element is not a valid message.
    #[error("not a valid OSC message; check that the sender uses VMC")]
    Message,
}

/// Passes every message of a datagram to `each`, in order; none if any part of the datagram is invalid.
pub(super) fn read(bytes: &[u8], each: &mut dyn FnMut(&OscMessage)) -> Result<(), Malformed> {
    if bytes.len() > MAX_DATAGRAM_BYTES {
        return Err(Malformed::Large);
    }
    let mut left = MAX_MESSAGES;
    // Two passes, all or nothing: half a bundle would be half a pose.
    element(bytes, 0, &mut left, &mut |_| ())?;
    let mut left = MAX_MESSAGES;
    element(bytes, 0, &mut left, each)
}

fn element(bytes: &[u8], depth: usize, left: &mut usize, each: &mut dyn FnMut(&OscMessage)) -> Result<(), Malformed> {
    let Some(mut rest) = bytes.strip_prefix(BUNDLE) else {
        *left = left.checked_sub(1).ok_or(Malformed::Large)?;
        return message(bytes, each);
    };
    if depth >= MAX_DEPTH {
        return Err(Malformed::Deep);
    }
    // The time tag is not used: VMC has its own time.
    rest = rest.get(8..).ok_or(Malformed::Sizes)?;
    while !rest.is_empty() {
        let (size, after) = rest.split_first_chunk::<4>().ok_or(Malformed::Sizes)?;
        let size = u32::from_be_bytes(*size) as usize;
        if size == 0 || size > after.len() {
            return Err(Malformed::Sizes);
        }
        let (inner, after) = after.split_at(size);
        element(inner, depth + 1, left, each)?;
        rest = after;
    }
    Ok(())
}

fn message(bytes: &[u8], each: &mut dyn FnMut(&OscMessage)) -> Result<(), Malformed> {
    let address = bytes.iter().take(MAX_ADDRESS).position(|&byte| byte == 0).ok_or(Malformed::Message)?;
    if !bytes.starts_with(b"/") {
        return Err(Malformed::Message);
    }
    let tags = bytes.get(address / 4 * 4 + 4..).ok_or(Malformed::Message)?;
    let tags = &tags[..tags.iter().position(|&byte| byte == 0).ok_or(Malformed::Message)?];
    // VMC has no arrays, and arrays in arrays are a tree as deep as the datagram is long.
    if tags.contains(&b'[') || tags.contains(&b']') {
        return Err(Malformed::Deep);
    }
    match rosc::decoder::decode_udp(bytes) {
        Ok((_, OscPacket::Message(message))) => {
            each(&message);
            Ok(())
        }
        _ => Err(Malformed::Message),
    }
}

/// A number of any OSC type as `f64`; NaN if it is not a number.
pub(super) fn number(value: Option<&OscType>) -> f64 {
    match value {
        Some(OscType::Float(value)) => f64::from(*value),
        Some(OscType::Double(value)) => *value,
        Some(OscType::Int(value)) => f64::from(*value),
        Some(OscType::Long(value)) => *value as f64,
        _ => f64::NAN,
    }
}
