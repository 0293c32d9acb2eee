//! What stands around the bytes of a state: what it is, which version, and a checksum.

use crate::{Reader, Snapshot, SnapshotError, Writer};

/// A kind of snapshot: its magic number and the version of its layout.
///
/// | offset | bytes | content |
/// |---|---|---|
/// | 0 | 4 | magic number |
/// | 4 | 4 | version, `u32` |
/// | 8 | n | the state |
/// | 8 + n | 8 | xxh3 of all bytes before, 64 bits |
///
/// Every changed, lost or added byte is an error. The checksum finds accidents; it does not authenticate: bytes that were forged
/// on purpose are read within the limits of [`Reader`], and may restore a state that no simulation would reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameKind {
    /// What the bytes are of, for people who look at a file: `*b"SNWW"`.
    pub magic: [u8; 4],
    /// Goes up with every change of the layout. Only this version is read.
    pub version: u32,
}

const HEADER: usize = 8;
const CHECKSUM: usize = 8;

impl FrameKind {
    /// The state with magic number, version and checksum.
    pub fn save<T: Snapshot + ?Sized>(self, state: &T) -> Vec<u8> {
        self.save_into(state, Vec::new())
    }

    /// As [`FrameKind::save`], into a buffer whose content is dropped and whose capacity is used.
    pub fn save_into<T: Snapshot + ?Sized>(self, state: &T, buffer: Vec<u8>) -> Vec<u8> {
        let mut to = self.begin(buffer);
        state.save(&mut to);
        FrameKind::finish(to)
    }

    /// A writer with magic number and version in it; the state is written behind them, then [`FrameKind::finish`].
    pub fn begin(self, buffer: Vec<u8>) -> Writer {
        let mut to = Writer::into_buffer(buffer);
        to.bytes(&self.magic);
        to.bytes(&self.version.to_le_bytes());
        to
    }

    /// Appends the checksum.
    pub fn finish(mut to: Writer) -> Vec<u8> {
        let checksum = xxhash_rust::xxh3::xxh3_64(to.as_slice());
        to.bytes(&checksum.to_le_bytes());
        to.into_bytes()
    }

    /// Restores what [`FrameKind::save`] wrote.
    ///
    /// # Errors
    /// Bytes of another kind or version, and bytes that were changed, change nothing. A snapshot that is sound but of something
    /// else may leave `state` partly restored.
    pub fn restore<T: Snapshot + ?Sized>(self, state: &mut T, bytes: &[u8]) -> Result<(), SnapshotError> {
        let mut from = self.open(bytes)?;
        state.restore(&mut from)?;
        from.end()
    }

    /// A reader of the state, after magic number, version and checksum were found right.
    ///
    /// # Errors
    /// When they are not.
    pub fn open(self, bytes: &[u8]) -> Result<Reader<'_>, SnapshotError> {
        if bytes.len() < HEADER + CHECKSUM || !bytes.starts_with(&self.magic) {
            return Err(SnapshotError::NotASnapshot);
        }
        let (content, checksum) = bytes.split_at(bytes.len() - CHECKSUM);
        let mut from = Reader::new(content);
        from.bytes(self.magic.len())?;
        let found = u32::from_le_bytes(from.array()?);
        if found != self.version {
            return Err(SnapshotError::Version { found, expected: self.version });
        }
        if xxhash_rust::xxh3::xxh3_64(content).to_le_bytes() != checksum {
            return Err(SnapshotError::Corrupt);
        }
        Ok(from)
    }
}
