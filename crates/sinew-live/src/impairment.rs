//! A bad network, made to order: a pure function of a seed, so that a test on a virtual clock and a rehearsal in real time see
//! the same one.

use crate::vmc::VmcFrame;
use glam::{DQuat, DVec3};
use sinew_motion::Part;

/// What the network does to a stream. Shares are probabilities from 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Impairment {
    /// Every datagram is late by so much \[s\].
    pub delay_secs: f64,
    /// And by up to so much more, evenly \[s\].
    pub jitter_secs: f64,
    /// Share that never arrives.
    pub loss: f64,
    /// Share that arrives twice.
    pub duplicate: f64,
    /// Share that is held back by one to three frames.
    pub reorder: f64,
    /// Share that is spoilt.
    pub corrupt: f64,
    /// Where the randomness comes from.
    pub seed: u64,
}

/// How a frame is spoilt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corruption {
    /// A number that is none.
    NonFinite,
    /// A turn that is no rotation.
    NonUnit,
    /// The performer is metres away.
    Jump,
    /// The time stamp is of seconds ago.
    Stale,
    /// The datagram is cut off.
    Cut,
}

/// What becomes of one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fate {
    /// When its copies arrive after they were sent \[s\]; none when it is lost.
    pub arrivals_secs: [Option<f64>; 2],
    /// Whether and how it is spoilt.
    pub corruption: Option<Corruption>,
}

impl Impairment {
    /// What becomes of a frame of this number, in a stream with so much time between frames \[s\].
    ///
    /// ```
    /// use sinew_live::Impairment;
    /// let bad = Impairment { loss: 0.05, seed: 1, ..Impairment::default() };
    /// let lost = (0..10_000).filter(|&number| bad.fate(number, 1.0 / 60.0).arrivals_secs[0].is_none()).count();
    /// assert!((400..600).contains(&lost));
    /// assert_eq!(bad.fate(7, 0.1), bad.fate(7, 0.1), "a pure function");
    /// ```
    pub fn fate(&self, number: u64, interval_secs: f64) -> Fate {
        let mut random = Random::new(self.seed, number);
        // All are drawn whatever happens, so that one share does not change what another one hits.
        let [lost, twice, held, spoilt, held_by, how] = std::array::from_fn(|_| random.unit());
        let ways = [random.unit(), random.unit()].map(|unit| self.delay_secs + self.jitter_secs * unit);
        if lost < self.loss {
            return Fate { arrivals_secs: [None, None], corruption: None };
        }
        let held = if held < self.reorder { (1.0 + (held_by * 3.0).floor()) * interval_secs } else { 0.0 };
        let corruption = (spoilt < self.corrupt).then_some(match (how * 5.0) as u32 {
            0 => Corruption::NonFinite,
            1 => Corruption::NonUnit,
            2 => Corruption::Jump,
            3 => Corruption::Stale,
            _ => Corruption::Cut,
        });
        let second = (twice < self.duplicate).then_some(ways[1] + held);
        Fate { arrivals_secs: [Some(ways[0] + held), second], corruption }
    }
}

impl Corruption {
    /// The spoilt datagram.
    pub fn spoil(self, frame: &VmcFrame) -> Vec<u8> {
        let mut frame = frame.clone();
        match self {
            Corruption::NonFinite => frame.places[Part::Hips as usize].x = f64::NAN,
            Corruption::NonUnit => {
                frame.turns[Part::Chest as usize] = DQuat::from_xyzw(0.7, 0.7, 0.7, 0.7);
            }
            Corruption::Jump => {
                frame.places[Part::Hips as usize] += DVec3::new(4.0, 0.0, 3.0);
            }
            Corruption::Stale => frame.time_secs -= 5.0,
            Corruption::Cut => {
                let mut bytes = frame.to_bytes();
                bytes.truncate(bytes.len() / 2 + 1);
                return bytes;
            }
        }
        frame.to_bytes()
    }
}

/// SplitMix64 (Steele, Lea, Flood 2014), begun anew for every frame.
struct Random(u64);

impl Random {
    fn new(seed: u64, number: u64) -> Random {
        let mut random = Random(seed ^ number.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        random.next();
        random
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// From 0 up to, but not, 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}
