//! What came of a reach.

use crate::walk::Step;

/// Why a target is not reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Higher than the stretched body reaches.
    TooHigh,
    /// Lower than the bent body reaches, such as under the floor.
    TooLow,
    /// Farther than can be walked.
    TooFar,
    /// In or too near to the body.
    TooNear,
    /// Both targets are too far from each other for one body.
    TooFarApart,
    /// Something is in the way and no simple way around it was found.
    Blocked,
    /// The paper's single step does not bring it in reach (under `print`).
    OneStep,
    /// No target any more.
    Released,
}

impl Reason {
    /// In words.
    pub const fn text(self) -> &'static str {
        match self {
            Reason::TooHigh => "too high for this body; the hand ends at the nearest point",
            Reason::TooLow => "too low for this body; the hand ends at the nearest point",
            Reason::TooFar => "farther than can be walked; bring the target nearer",
            Reason::TooNear => "too near to the body for the arm to fold; the hand ends at the nearest point",
            Reason::TooFarApart => "the two targets are too far from each other for one body",
            Reason::Blocked => "blocked: an obstacle is in the way, and neither the elbow nor a bowed path clears it",
            Reason::OneStep => "one step does not bring it in reach; without --print more are taken",
            Reason::Released => "released",
        }
    }
}

/// What was decided, and how it ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Why the target is not reached; none when it is.
    pub reason: Option<Reason>,
    /// How far the hand ends from its target \[m\]; of the worse of two.
    pub gap_m: f64,
    /// When the hand arrives \[s\].
    pub arrives_secs: f64,
    /// Which hands reach: left, right.
    pub hands: [bool; 2],
    /// The steps on the way.
    pub steps: Vec<Step>,
    /// θ: twist of the spine \[rad\].
    pub twist_rad: f64,
    /// φ: swing of the spine \[rad\]; below 0 where it leans away from the target.
    pub swing_rad: f64,
    /// How far the hips sink \[m\].
    pub squat_m: f64,
}

impl Outcome {
    /// Whether the hand arrives.
    pub fn is_reached(&self) -> bool {
        self.reason.is_none() && self.hands != [false; 2]
    }
}
