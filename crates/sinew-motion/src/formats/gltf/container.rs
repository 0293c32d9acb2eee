//! The outer shell of a glTF file: JSON text, or a GLB with its chunks.

use crate::{Error, Place};

const MAGIC: &[u8; 4] = b"glTF";
const HEADER_BYTES: usize = 12;
const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

/// Maximum number of JSON values, more than any rig needs; each costs tens of bytes once parsed, so a file of nothing
/// but `[0,0,0,...` must stop here.
const MAX_JSON_VALUES: usize = 2_000_000;
/// Maximum nesting depth; glTF itself nests about ten deep, `extras` may be deeper.
const MAX_JSON_DEPTH: usize = 100;

/// The parts of a glTF file; nothing is copied.
pub(super) struct Container<'a> {
    /// The JSON text.
    pub json: &'a [u8],
    /// The binary chunk, with its padding.
    pub bin: Option<&'a [u8]>,
    /// Chunks of extensions, type and content, in file order.
    pub others: Vec<(u32, &'a [u8])>,
    /// Whether it is a GLB.
    pub is_glb: bool,
    /// Bytes after the end that the GLB states.
    pub trailing_bytes: usize,
}

/// Splits a file and checks that its JSON is small and shallow enough to parse.
pub(super) fn open(bytes: &[u8]) -> Result<Container<'_>, Error> {
    let container = if bytes.starts_with(MAGIC) { open_glb(bytes)? } else { open_text(bytes) };
    let offset = container.json.as_ptr() as usize - bytes.as_ptr() as usize;
    check_json(container.json, offset)?;
    Ok(container)
}

fn open_text(bytes: &[u8]) -> Container<'_> {
    let json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    Container { json, bin: None, others: Vec::new(), is_glb: false, trailing_bytes: 0 }
}

fn open_glb(bytes: &[u8]) -> Result<Container<'_>, Error> {
    let short = |at: usize| {
        Error::new(
            Place::Byte(at as u64),
            format!("the GLB ends at byte {}, before its content does", bytes.len()),
            "the file is truncated: copy or export it again",
        )
    };
    let version = word(bytes, 4).ok_or_else(|| short(4))?;
    if version != 2 {
        return Err(Error::new(
            Place::Byte(4),
            format!("GLB version {version}; only version 2 is supported"),
            "export as glTF 2.0",
        ));
    }
    let length = word(bytes, 8).ok_or_else(|| short(8))? as usize;
    let Some(content) = bytes.get(..length) else { return Err(short(8)) };
    let (mut json, mut bin, mut others) = (None, None, Vec::new());
    let mut at = HEADER_BYTES;
    while at < length {
        let chunk_bytes = word(content, at).ok_or_else(|| short(at))? as usize;
        let kind = word(content, at + 4).ok_or_else(|| short(at + 4))?;
        let chunk = at.checked_add(8 + chunk_bytes).and_then(|end| content.get(at + 8..end));
        let Some(chunk) = chunk else {
            return Err(Error::new(
                Place::Byte(at as u64),
                format!("a chunk says that it has {chunk_bytes} bytes, more than follow"),
                "the file is truncated or damaged: copy or export it again",
            ));
        };
        match kind {
            JSON if json.is_none() && at == HEADER_BYTES => json = Some(chunk),
            BIN if bin.is_none() => bin = Some(chunk),
            _ => others.push((kind, chunk)),
        }
        at += 8 + chunk_bytes;
    }
    let json = json.ok_or_else(|| {
        Error::new(Place::Byte(HEADER_BYTES as u64), "the first chunk is not JSON", "export as glTF 2.0 binary")
    })?;
    Ok(Container { json, bin, others, is_glb: true, trailing_bytes: bytes.len() - length })
}

/// A little-endian word.
fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(word.try_into().ok()?))
}

/// Counts values and nesting in JSON text without parsing it; `offset` is where the text starts in the file.
fn check_json(json: &[u8], offset: usize) -> Result<(), Error> {
    let (mut depth, mut values, mut in_string, mut escaped) = (0_usize, 0_usize, false, false);
    for (at, &byte) in json.iter().enumerate() {
        if in_string {
            match byte {
                _ if escaped => escaped = false,
                b'\\' => escaped = true,
                b'"' => in_string = false,
                _ => {}
            }
            continue;
        }
        match byte {
            b'"' => in_string = true,
            b'[' | b'{' => {
                depth += 1;
                values += 1;
            }
            b']' | b'}' => depth = depth.saturating_sub(1),
            b',' => values += 1,
            _ => {}
        }
        if depth > MAX_JSON_DEPTH || values > MAX_JSON_VALUES {
            let problem = if depth > MAX_JSON_DEPTH {
                format!("the JSON is nested more than {MAX_JSON_DEPTH} deep")
            } else {
                format!("the JSON holds more than {MAX_JSON_VALUES} values")
            };
            return Err(Error::new(Place::Byte((offset + at) as u64), problem, "export only the character"));
        }
    }
    Ok(())
}

/// Assembles a GLB, with its chunks padded as glTF 2.0 section 4.4 requires. `None` if it exceeds 4 GiB.
pub(super) fn join_glb(json: &[u8], bin: Option<&[u8]>, others: &[(u32, &[u8])]) -> Option<Vec<u8>> {
    let chunks =
        [(JSON, json)].into_iter().chain(bin.map(|bin| (BIN, bin))).chain(others.iter().copied()).collect::<Vec<_>>();
    let length = HEADER_BYTES + chunks.iter().map(|(_, chunk)| 8 + chunk.len().next_multiple_of(4)).sum::<usize>();
    let length_word = u32::try_from(length).ok()?;
    let mut glb = Vec::with_capacity(length);
    glb.extend_from_slice(MAGIC);
    glb.extend_from_slice(&2_u32.to_le_bytes());
    glb.extend_from_slice(&length_word.to_le_bytes());
    for (kind, chunk) in chunks {
        let padded = chunk.len().next_multiple_of(4);
        glb.extend_from_slice(&(padded as u32).to_le_bytes());
        glb.extend_from_slice(&kind.to_le_bytes());
        glb.extend_from_slice(chunk);
        let padding = if kind == JSON { b' ' } else { 0 };
        glb.resize(glb.len() + padded - chunk.len(), padding);
    }
    Some(glb)
}
