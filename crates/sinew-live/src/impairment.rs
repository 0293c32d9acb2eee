//! A simulated bad network: a pure function of a seed, so that a test on a virtual clock and a rehearsal in real time
//! see the same losses and delays.

use crate::vmc::VmcFrame;
use glam::{DQuat, DVec3};
use sinew_motion::Part;

/// What the network does to a stream. Shares are probabilities from 0 to 1; the default impairs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Impairment {
    /// Delay of every datagram \[s\].
    pub delay_secs: f64,
    /// Maximum of the additional delay, uniformly distributed from 0 (jitter) \[s\].
    pub jitter_secs: f64,
    /// Share that is lost.
    pub loss: f64,
    /// Share that arrives twice.
    pub duplicate: f64,
    /// Share that is delayed by one to three frames, and so arrives out of order.
    pub reorder: f64,
    /// Share that is corrupted.
    pub corrupt: f64,
    /// Seed of the random generator.
    pub seed: u64,
}

/// How a frame is corrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corruption {
    /// A coordinate is NaN.
    NonFinite,
    /// A quaternion is not normalised.
    NonUnit,
    /// The performer is displaced by 5 m.
    Jump,
    /// The time stamp is 5 s too early.
    Stale,
    /// The datagram is truncated.
    Truncated,
}

/// How one frame is delivered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delivery {
    /// Time from sending to the arrival of each copy \[s\]; both are `None` when it is lost.
    pub arrivals_secs: [Option<f64>; 2],
    /// How it is corrupted, if it is.
    pub corruption: Option<Corruption>,
}

impl Impairment {
    /// How the frame of this number is delivered, in a stream with `interval_secs` between frames \[s\].
    ///
    /// ```
    /// use sinew_live::Impairment;
    /// let bad = Impairment { loss: 0.05, seed: 1, ..Impairment::default() };
    /// let lost = (0..10_000).filter(|&number| bad.delivery(number, 1.0 / 60.0).arrivals_secs[0].is_none()).count();
    /// assert!((400..600).contains(&lost));
    /// assert_eq!(bad.delivery(7, 0.1), bad.delivery(7, 0.1), "a pure function");
    /// ```
    pub fn delivery(&self, number: u64, interval_secs: f64) -> Delivery {
        let mut random = Random::new(self.seed, number);
        // All numbers are always drawn, so that one share does not change which frames another one affects.
        let [lost, twice, held, corrupted, held_by, how] = std::array::from_fn(|_| random.unit());
        let delays = [random.unit(), random.unit()].map(|unit| self.delay_secs + self.jitter_secs * unit);
        if lost < self.loss {
            return Delivery { arrivals_secs: [None, None], corruption: None };
        }
        let held = if held < self.reorder { (1.0 + (held_by * 3.0).floor()) * interval_secs } else { 0.0 };
        let corruption = (corrupted < self.corrupt).then_some(match (how * 5.0) as u32 {
            0 => Corruption::NonFinite,
            1 => Corruption::NonUnit,
            2 => Corruption::Jump,
            3 => Corruption::Stale,
            _ => Corruption::Truncated,
        });
        let second = (twice < self.duplicate).then_some(delays[1] + held);
        Delivery { arrivals_secs: [Some(delays[0] + held), second], corruption }
    }
}

impl Corruption {
    /// The corrupted datagram of a frame.
    pub fn apply(self, frame: &VmcFrame) -> Vec<u8> {
        let mut frame = frame.clone();
        match self {
            Corruption::NonFinite => frame.positions[Part::Hips as usize].x = f64::NAN,
            Corruption::NonUnit => {
                frame.rotations[Part::Chest as usize] = DQuat::from_xyzw(0.7, 0.7, 0.7, 0.7);
            }
            Corruption::Jump => {
                frame.positions[Part::Hips as usize] += DVec3::new(4.0, 0.0, 3.0);
            }
            Corruption::Stale => frame.time_secs -= 5.0,
            Corruption::Truncated => {
                let mut bytes = frame.to_bytes();
                bytes.truncate(bytes.len() / 2 + 1);
                return bytes;
            }
        }
        frame.to_bytes()
    }
}

/// SplitMix64 (Steele, Lea, Flood 2014), seeded anew for every frame.
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

    /// Uniform in [0, 1).
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}
