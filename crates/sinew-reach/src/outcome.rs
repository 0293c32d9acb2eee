//! The outcome of a reach.

use crate::walk::Step;

/// Why a target is not reached.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reason {
    /// Higher than the stretched body reaches.
    #[default]
    TooHigh,
    /// Lower than the bent body reaches, such as under the floor.
    TooLow,
    /// Farther than can be walked.
    TooFar,
    /// In or too near to the body.
    TooNear,
    /// Both targets are too far from each other for one body.
    TooFarApart,
    /// An obstacle is in the way and no simple path around it was found.
    Blocked,
    /// The paper's single step does not bring the target in reach (under `print`).
    OneStep,
    /// There is no target any more.
    Released,
}

impl Reason {
    /// As text.
    pub const fn text(self) -> &'static str {
        match self {
            Reason::TooHigh => "too high for this body; the hand ends at the nearest point",
            Reason::TooLow => "too low for this body; the hand ends at the nearest point",
            Reason::TooFar => "farther than can be walked; bring the target nearer",
            Reason::TooNear => "too near to the body for the arm to fold; the hand ends at the nearest point",
            Reason::TooFarApart => "the two targets are too far from each other for one body",
            Reason::Blocked => "blocked: an obstacle is in the way, and neither the elbow nor a bowed path clears it",
            Reason::OneStep => "one step does not bring it in reach; with Style::print off more are taken",
            Reason::Released => "released",
        }
    }
}

/// The plan of a reach, and its result.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Why the target is not reached; `None` if it is.
    pub reason: Option<Reason>,
    /// Whether no body can be there in the time that was asked for ([`Style::time_secs`](crate::Style::time_secs)): it takes the least
    /// that one can, in which it walks at most at a Froude number of a half (2 m/s for a leg of 0.85 m), each foot swings for at least
    /// 0.3 s, the trunk bends twice as fast as by itself, and the hand moves at up to 6 m/s.
    pub is_late: bool,
    /// Final distance of the hand from its target \[m\]; of the worse of two.
    pub gap_m: f64,
    /// Time at which the hand arrives \[s\].
    pub arrives_secs: f64,
    /// Which hands reach: left, right.
    pub hands: [bool; 2],
    /// The steps that are taken.
    pub steps: Vec<Step>,
    /// θ: twist of the spine \[rad\].
    pub twist_rad: f64,
    /// φ: swing of the spine \[rad\]; below 0 where it leans away from the target.
    pub swing_rad: f64,
    /// Squat: how far the hips are lowered \[m\].
    pub squat_m: f64,
}

sinew_snapshot::snapshot!(enum Reason {
    0: TooHigh, 1: TooLow, 2: TooFar, 3: TooNear, 4: TooFarApart, 5: Blocked, 6: OneStep, 7: Released,
});
sinew_snapshot::snapshot!(Outcome {
    reason,
    is_late,
    gap_m,
    arrives_secs,
    hands,
    steps,
    twist_rad,
    swing_rad,
    squat_m
});

impl Outcome {
    /// Whether the hand arrives.
    pub fn is_reached(&self) -> bool {
        self.reason.is_none() && self.hands != [false; 2]
    }
}
