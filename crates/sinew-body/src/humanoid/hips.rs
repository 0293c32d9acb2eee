//! What of a deviation of the hips two planted legs allow.
//!
//! Feet stay where the input has them, so a deviation of the hips changes how far each hip joint is from its ankle, and with
//! it the knee's flexion. Near full stretch that is a square root: a millimetre is several degrees. A leg that the input
//! straightens within a few frames, as before each foot strike, would snap. So a knee's flexion changes by at most a share of
//! the input's own, and the hips take the nearest deviation at which both legs have a length inside that band. It is smooth in
//! the input and in the deviation: as a leg straightens, the hips come round it as round a stilt.

use super::leg::{LegPose, Stretch};
use super::rotation::{exp, log};
use glam::DVec3;
use sinew_snapshot::snapshot;

/// The hips' deviation from an input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HipsDeviation {
    /// Shift of their joint \[m\], world.
    pub shift: DVec3,
    /// Rotation vector \[rad\], world: `world_from_hips` is turned by its [`exp`] about their joint.
    pub turn: DVec3,
}

snapshot!(HipsDeviation { shift, turn });

/// Lever by which a turn is weighed against a shift \[1 of a leg's length\]: about that of a hip joint to the hips' own.
const LEVER: f64 = 0.2;

/// Newton's iterations. Lengths are all but linear over the 5 cm that hips deviate: after four nothing is left.
const ITERATIONS: usize = 4;

impl HipsDeviation {
    /// Whether there is none.
    pub fn is_none(&self) -> bool {
        self.shift == DVec3::ZERO && self.turn == DVec3::ZERO
    }

    /// The nearest deviation at which both legs of the input, whose ankles stay, flex their knees within the band that
    /// keeps them from snapping. `hips` is the input's hips joint \[m\], about which a deviation turns.
    ///
    /// ```
    /// use glam::DVec3;
    /// use sinew_body::humanoid::{HipsDeviation, LegPose};
    ///
    /// let leg = |x: f64| LegPose {
    ///     hip: DVec3::new(x, 0.85, 0.0),
    ///     knee: DVec3::new(x, 0.45, 0.0), // straight
    ///     ankle: DVec3::new(x, 0.05, 0.0),
    ///     knee_axis: DVec3::X,
    /// };
    /// let back = HipsDeviation { shift: DVec3::new(0.0, 0.0, -0.05), turn: DVec3::ZERO };
    /// let held = back.held_by(&[leg(0.1), leg(-0.1)], DVec3::new(0.0, 0.95, 0.0));
    /// assert!(held.shift.z < -0.04 && held.shift.y < 0.0, "round the ankles");
    /// ```
    #[must_use]
    pub fn held_by(&self, legs: &[LegPose; 2], hips: DVec3) -> HipsDeviation {
        if self.is_none() { *self } else { self.held_beside(legs, hips, [DVec3::ZERO; 2]) }
    }

    /// As [`HipsDeviation::held_by`], where something besides the hips moves the hip joints by `beside` \[m\].
    pub(super) fn held_beside(&self, legs: &[LegPose; 2], hips: DVec3, beside: [DVec3; 2]) -> HipsDeviation {
        let line = |side: usize, deviation: &HipsDeviation| {
            let arm = exp(deviation.turn) * (legs[side].hip - hips);
            (hips + deviation.shift + arm + beside[side] - legs[side].ankle, arm)
        };
        let stretches = legs.each_ref().map(Stretch::of);
        let mut held = *self;
        let wanted = [0, 1].map(|side| {
            let length_m = stretches[side].length_m;
            length_m + stretches[side].within(line(side, &held).0.length() - length_m)
        });
        let lever = LEVER * wanted[0].max(wanted[1]);
        let per_lever = 1.0 / (lever * lever).max(1e-12);
        for _ in 0..ITERATIONS {
            // By side: what a leg is too long, and how shift and turn lengthen it.
            let sides = [0, 1].map(|side| {
                let (line, arm) = line(side, &held);
                let length = line.length();
                let along = line / length.max(1e-9);
                (length - wanted[side], along, arm.cross(along))
            });
            let [(left, along_left, about_left), (right, along_right, about_right)] = sides;
            let product = |a: (DVec3, DVec3), b: (DVec3, DVec3)| a.0.dot(b.0) + per_lever * a.1.dot(b.1);
            let a = product((along_left, about_left), (along_left, about_left)) + TINY;
            let b = product((along_left, about_left), (along_right, about_right));
            let d = product((along_right, about_right), (along_right, about_right)) + TINY;
            let determinant = (a * d - b * b).max(TINY);
            let (left, right) = ((d * left - b * right) / determinant, (a * right - b * left) / determinant);
            held.shift -= along_left * left + along_right * right;
            let back = (about_left * left + about_right * right) * -per_lever;
            held.turn = log(exp(back) * exp(held.turn));
        }
        held
    }
}

/// Keeps the two legs' system regular where a leg has no length.
const TINY: f64 = 1e-12;
