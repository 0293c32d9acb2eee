//! The hash over all steps of a run, in a form that can be kept.
//!
//! It is XXH3 with 64 bits (Collet, the xxHash specification) over the hashes of the steps. The library that computes XXH3
//! everywhere else keeps the state of a hash that has begun to itself, and a snapshot of a stage needs it; so the part of XXH3 that
//! takes whole words, one after the other, stands here. A test holds it to the library's.

use sinew_snapshot::snapshot;

/// XXH3 of the words so far.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RunHash {
    words: u64,
    accumulators: [u64; LANES],
    /// Stripes of the present block that were taken in.
    stripes: usize,
    /// The words before those in `recent`.
    before: [u64; LANES],
    /// Words that were not taken in yet; the first `waiting` of them.
    recent: [u64; RECENT],
    waiting: usize,
}

snapshot!(RunHash { words, accumulators, stripes, before, recent, waiting }
    valid |hash| hash.stripes < STRIPES_PER_BLOCK && hash.waiting <= RECENT && hash.waiting as u64 <= hash.words);

/// Words in a stripe.
const LANES: usize = 8;
/// Words that wait. Up to 30 words, XXH3 is another function, for which all of them are needed.
const RECENT: usize = 32;
const SHORT: u64 = 30;
const STRIPES_PER_BLOCK: usize = 16;

const PRIME32: [u64; 3] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d];
const PRIME64: [u64; 5] =
    [0x9e37_79b1_85eb_ca87, 0xc2b2_ae3d_27d4_eb4f, 0x1656_67b1_9e37_79f9, 0x85eb_ca77_c2b2_ae63, 0x27d4_eb2f_1656_67c5];

/// The specification's default secret, as little-endian words.
const SECRET: [u64; 24] = [
    0xbe4b_a423_396c_feb8,
    0x1cad_21f7_2c81_017c,
    0xdb97_9083_e96d_d4de,
    0x1f67_b3b7_a4a4_4072,
    0x78e5_c0cc_4ee6_79cb,
    0x2172_ffcc_7dd0_5a82,
    0x8e24_43f7_7446_08b8,
    0x4c26_3a81_e690_35e0,
    0xcb00_c391_bb52_283c,
    0xa32e_531b_8b65_d088,
    0x4ef9_0da2_9748_6471,
    0xd8ac_dea9_46ef_1938,
    0x3f34_9ce3_3f76_faa8,
    0x1d4f_0bc7_c7bb_dcf9,
    0x3159_b4cd_4be0_518a,
    0x6473_78d9_c97e_9fc8,
    0xc3eb_d334_83ac_c5ea,
    0xeb63_13fa_ffa0_81c5,
    0x49da_f0b7_51dd_0d17,
    0x9e68_d429_2655_16d3,
    0xfca1_477d_58be_162b,
    0xce31_d07a_d1b8_f88f,
    0x2804_1695_8f3a_cb45,
    0x7e40_4bbb_cafb_d7af,
];

impl RunHash {
    /// Of no words.
    pub fn new() -> RunHash {
        RunHash {
            words: 0,
            accumulators: [
                PRIME32[2], PRIME64[0], PRIME64[1], PRIME64[2], PRIME64[3], PRIME32[1], PRIME64[4], PRIME32[0],
            ],
            stripes: 0,
            before: [0; LANES],
            recent: [0; RECENT],
            waiting: 0,
        }
    }

    /// Takes the next word in.
    pub fn push(&mut self, word: u64) {
        if self.waiting == RECENT {
            let recent = self.recent;
            for stripe in recent.as_chunks().0 {
                take_in(&mut self.accumulators, &mut self.stripes, stripe);
                self.before = *stripe;
            }
            self.waiting = 0;
        }
        self.recent[self.waiting] = word;
        self.waiting += 1;
        self.words += 1;
    }

    /// The hash of all words so far.
    pub fn digest(&self) -> u64 {
        let waiting = &self.recent[..self.waiting];
        if self.words <= SHORT {
            let mut bytes = [0; 8 * SHORT as usize];
            for (bytes, word) in bytes.as_chunks_mut().0.iter_mut().zip(waiting) {
                *bytes = word.to_le_bytes();
            }
            return xxhash_rust::xxh3::xxh3_64(&bytes[..8 * waiting.len()]);
        }
        let (mut accumulators, mut stripes) = (self.accumulators, self.stripes);
        // The last stripe ends with the last word, whatever it shares with the one before.
        let whole = waiting.len().saturating_sub(1) / LANES;
        for stripe in &waiting.as_chunks().0[..whole] {
            take_in(&mut accumulators, &mut stripes, stripe);
        }
        let last: [u64; LANES] = std::array::from_fn(|lane| match (waiting.len() + lane).checked_sub(LANES) {
            Some(at) => waiting[at],
            None => self.before[waiting.len() + lane],
        });
        accumulate(&mut accumulators, &last, 121);
        let mut hash = self.words.wrapping_mul(8).wrapping_mul(PRIME64[0]);
        for pair in 0..LANES / 2 {
            let [one, other] = [0, 1].map(|lane| accumulators[2 * pair + lane] ^ secret(11 + 16 * pair + 8 * lane));
            let product = u128::from(one) * u128::from(other);
            hash = hash.wrapping_add(product as u64 ^ (product >> 64) as u64);
        }
        hash = (hash ^ (hash >> 37)).wrapping_mul(0x1656_6791_9e37_79f9);
        hash ^ (hash >> 32)
    }
}

/// Eight bytes of the secret, from any byte on.
fn secret(at: usize) -> u64 {
    let (word, bits) = (at / 8, 8 * (at % 8));
    if bits == 0 { SECRET[word] } else { (SECRET[word] >> bits) | (SECRET[word + 1] << (64 - bits)) }
}

fn take_in(accumulators: &mut [u64; LANES], stripes: &mut usize, stripe: &[u64; LANES]) {
    accumulate(accumulators, stripe, 8 * *stripes);
    *stripes += 1;
    if *stripes == STRIPES_PER_BLOCK {
        for (lane, value) in accumulators.iter_mut().enumerate() {
            *value = (*value ^ (*value >> 47) ^ secret(128 + 8 * lane)).wrapping_mul(PRIME32[0]);
        }
        *stripes = 0;
    }
}

fn accumulate(accumulators: &mut [u64; LANES], stripe: &[u64; LANES], secret_at: usize) {
    for (lane, word) in stripe.iter().enumerate() {
        let keyed = word ^ secret(secret_at + 8 * lane);
        accumulators[lane ^ 1] = accumulators[lane ^ 1].wrapping_add(*word);
        accumulators[lane] = accumulators[lane].wrapping_add((keyed & 0xffff_ffff) * (keyed >> 32));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sinew_snapshot::FrameKind;

    #[test]
    fn the_hash_of_a_run_is_the_librarys() {
        let mut ours = RunHash::new();
        let mut theirs = xxhash_rust::xxh3::Xxh3::new();
        // Beyond the short form, several blocks of 128 words, and every place in one.
        for step in 0..1000_u64 {
            assert_eq!(ours.digest(), theirs.digest(), "after {step} words");
            let word = (step + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (step << 40);
            ours.push(word);
            theirs.update(&word.to_le_bytes());
        }
    }

    #[test]
    fn a_hash_that_is_restored_goes_on() {
        let kind = FrameKind { magic: *b"TEST", version: 1 };
        for kept in [0, 1, 29, 30, 31, 32, 33, 64, 128, 129, 500] {
            let (mut one, mut other) = (RunHash::new(), RunHash::new());
            (0..kept).for_each(|word| one.push(word * word));
            kind.restore(&mut other, &kind.save(&one)).unwrap();
            for word in 0..300 {
                one.push(word);
                other.push(word);
                assert_eq!(one.digest(), other.digest());
            }
        }
    }
}
