//! The state of a stage in few bytes: what differs from the stage as it was built, compressed.

use miniz_oxide::{deflate, inflate};
use sinew_snapshot::{SnapshotError, Writer, snapshot};

/// Bytes of a state in sections, of which each is like the same one of another state of the stage.
#[derive(Default)]
pub(crate) struct Sections {
    bytes: Vec<u8>,
    begins: Vec<usize>,
}

impl Sections {
    pub fn of(written: Writer) -> Sections {
        Sections { begins: written.sections().to_vec(), bytes: written.into_bytes() }
    }

    /// The sections, that before the first mark too.
    fn ranges(begins: &[usize], end: usize) -> impl Iterator<Item = std::ops::Range<usize>> {
        let starts = std::iter::once(0).chain(begins.iter().copied());
        starts.zip(begins.iter().copied().chain(std::iter::once(end))).map(|(start, end)| start..end)
    }

    /// A section by its number; empty for one that is not there.
    fn section(&self, at: usize) -> &[u8] {
        Sections::ranges(&self.begins, self.bytes.len()).nth(at).map_or(&[], |range| &self.bytes[range])
    }
}

/// A state: its difference to others (exclusive or, section by section), compressed with Deflate (RFC 1951).
///
/// Half of the difference is zeros, the rest are numbers that hardly compress. LZ4 was tried: a fifth more bytes.
#[derive(Default)]
pub(crate) struct Packed {
    length: usize,
    begins: Vec<u32>,
    /// Of each section, with which of the bases it is compared; a number without a base is with none.
    bases: Vec<u8>,
    block: Vec<u8>,
}

snapshot!(Packed { length, begins, bases, block });

/// A byte of Deflate stands for at most 1032.
const MAX_RATIO: usize = 1032;

/// As 0 to 9: more takes longer and saves nothing here.
const LEVEL: u8 = 6;

impl Packed {
    pub fn pack(state: &Sections, bases: &[Sections]) -> Packed {
        let mut bytes = state.bytes.clone();
        let ranges = Sections::ranges(&state.begins, bytes.len());
        let bases_of: Vec<u8> = ranges.enumerate().map(|(at, own)| nearest(&bytes[own], at, bases)).collect();
        differ(&mut bytes, &state.begins, &bases_of, bases);
        // No state has 4 GB; a longer one would not be read.
        let begins = state.begins.iter().map(|begin| u32::try_from(*begin).unwrap_or(u32::MAX)).collect();
        Packed { length: bytes.len(), begins, bases: bases_of, block: deflate::compress_to_vec(&bytes, LEVEL) }
    }

    pub fn unpack(&self, bases: &[Sections]) -> Result<Vec<u8>, SnapshotError> {
        let begins: Vec<usize> = self.begins.iter().map(|begin| *begin as usize).collect();
        let is_sound = self.length / MAX_RATIO <= self.block.len()
            && begins.is_sorted()
            && begins.last().is_none_or(|last| *last <= self.length);
        if !is_sound {
            return Err(SnapshotError::invalid("length of the state"));
        }
        let unpacked = inflate::decompress_to_vec_with_limit(&self.block, self.length);
        let mut bytes = unpacked.map_err(|_| SnapshotError::invalid("compressed state"))?;
        if bytes.len() != self.length {
            return Err(SnapshotError::invalid("length of the state"));
        }
        differ(&mut bytes, &begins, &self.bases, bases);
        Ok(bytes)
    }
}

/// The base to which a section is most alike: from which most of its bytes do not differ. Its number, or one beyond all.
fn nearest(own: &[u8], at: usize, bases: &[Sections]) -> u8 {
    let same = |base: &Sections| own.iter().zip(base.section(at)).filter(|(byte, other)| byte == other).count();
    let zeros = own.iter().filter(|byte| **byte == 0).count();
    let counts = bases.iter().map(same).chain(std::iter::once(zeros)).enumerate();
    let best = counts.max_by_key(|(number, count)| (*count, std::cmp::Reverse(*number)));
    best.map_or(u8::MAX, |(number, _)| number as u8)
}

/// Turns a state into its difference, and a difference into the state.
fn differ(bytes: &mut [u8], begins: &[usize], bases_of: &[u8], bases: &[Sections]) {
    for (at, (own, base)) in Sections::ranges(begins, bytes.len()).zip(bases_of).enumerate() {
        let Some(base) = bases.get(usize::from(*base)) else { continue };
        for (byte, other) in bytes[own].iter_mut().zip(base.section(at)) {
            *byte ^= other;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sections(parts: &[&[u8]]) -> Sections {
        let mut to = Writer::new();
        for part in parts {
            to.section();
            to.bytes(part);
        }
        Sections::of(to)
    }

    #[test]
    fn a_state_is_unpacked_to_what_it_was_whatever_grew_or_shrank() {
        let bases = [sections(&[b"one", b"two", &[7; 1000]]), sections(&[b"one", b"other", &[8; 1000]])];
        for state in
            [sections(&[b"one", b"two", &[7; 1000]]), sections(&[b"", b"three", &[7; 2000], b"more"]), sections(&[])]
        {
            let packed = Packed::pack(&state, &bases);
            assert_eq!(packed.unpack(&bases).unwrap(), state.bytes);
        }
        for base in &bases {
            assert!(Packed::pack(base, &bases).block.len() < 20, "what did not change is not stored");
        }
    }

    #[test]
    fn lengths_that_cannot_be_are_an_error() {
        let bases = [sections(&[&[7; 1000]])];
        let pack = || Packed::pack(&bases[0], &bases);
        for wrong in [
            Packed { length: usize::MAX, ..pack() },
            Packed { length: 999, ..pack() },
            Packed { length: 1001, ..pack() },
            Packed { begins: vec![4, 3], ..pack() },
            Packed { begins: vec![1001], ..pack() },
            Packed { block: vec![0xf0; 100], ..pack() },
        ] {
            assert!(wrong.unpack(&bases).is_err());
        }
    }
}
