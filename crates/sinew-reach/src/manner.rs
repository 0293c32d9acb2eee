//! How one person does it: what varies from seed to seed, beside whether and how to step.

/// The manner of a seed. Each value runs through [`STRATA`] equal parts of its range, in an order of its own, so that as many seeds in a
/// row have as many different manners, whichever the first is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Manner {
    /// The rung of its times, if it has one: see [`Manner::pace`].
    rung: Option<f64>,
    /// Factor on the flexibility of the legs \[1\].
    pub flexibility: f64,
    /// Turn of the elbow outward, about the line from shoulder to hand \[rad\].
    pub swivel_rad: f64,
    /// More of the trunk's twist towards the reaching arm's target, or less \[rad\].
    pub twist_rad: f64,
    /// More of the trunk's swing, or less \[rad\].
    pub swing_rad: f64,
    /// How long the head waits before it turns \[s\].
    pub gaze_secs: f64,
    /// Bow of the hand's path: upward and outward \[1 of the arm's length\].
    pub bow: [f64; 2],
}

sinew_snapshot::snapshot!(Manner { rung, flexibility, swivel_rad, twist_rad, swing_rad, gaze_secs, bow });

/// Into how many parts the range of a value is cut.
const STRATA: u64 = 17;

/// Ratio of a rung of the ladder of times to the one below \[1\].
const SLOWER: f64 = 1.0515;

impl Manner {
    /// What the method does without variation.
    pub const PLAIN: Manner = Manner {
        rung: None,
        flexibility: 1.0,
        swivel_rad: 0.0,
        twist_rad: 0.0,
        swing_rad: 0.0,
        gaze_secs: 0.0,
        bow: [0.0; 2],
    };

    /// The manner of a seed. That of seed 0 is the plain one.
    pub fn of(seed: u64) -> Manner {
        if seed == 0 {
            return Manner::PLAIN;
        }
        let stratum = |factor: u64, first: u64| (seed.wrapping_mul(factor).wrapping_add(first) % STRATA) as f64;
        // From -1 to 1, in the middles of the strata.
        let between = |factor: u64, first: u64| (2.0 * stratum(factor, first) + 1.0) / STRATA as f64 - 1.0;
        Manner {
            rung: Some(stratum(7, 1)),
            flexibility: libm::pow(1.35, between(9, 3)),
            swivel_rad: 0.55 * between(5, 8),
            twist_rad: 0.28 * between(11, 8),
            swing_rad: 0.16 * between(13, 8),
            gaze_secs: 0.1 * (1.0 + between(3, 0)),
            bow: [0.1 * between(9, 8), 0.08 * between(15, 8)],
        }
    }

    /// Factor on all times of a plan that would take so long by itself \[1\], from 0.95 to 2.3.
    ///
    /// Times lie on a ladder whose rungs are 5.15 % apart; each of the strata has every seventeenth. So two manners never take the same time
    /// for a target, whatever steps they choose.
    pub fn pace(&self, natural_secs: f64) -> f64 {
        let Some(rung) = self.rung else { return 1.0 };
        let natural = libm::log(natural_secs.max(1e-3)) / libm::log(SLOWER);
        let least = natural - 1.0;
        let turns = ((least - rung) / STRATA as f64).ceil();
        libm::pow(SLOWER, rung + turns * STRATA as f64 - natural)
    }
}
