//! The leg in closed form, and the height of the hips that it allows.

use crate::compose::Now;
use crate::frame::{Frame, SOFT_M, STRETCHED};
use crate::heel::Heel;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Limb, Pose, exp};

const LEG_LIMBS: [Limb; 2] = [Limb::LeftLeg, Limb::RightLeg];

/// A foot: its ankle \[m\] and `world_from_foot`.
pub(crate) type Foot = (DVec3, DQuat);

/// A leg solved for its foot.
struct Bent {
    /// From the hip joint to knee and ankle \[m\].
    knee: DVec3,
    ankle: DVec3,
    /// The knee's axis, to the left.
    hinge: DVec3,
}

impl Frame {
    /// Wanted height, lowered to what the legs can reach \[m\].
    pub fn hips_height(&self, now: &Now, feet: &[Foot; 2], hips: DQuat, hips_at: DVec3) -> f64 {
        let risen = self.rises_m(Heel::tiptoe(now.tiptoe));
        // Near its full length a leg's knee turns as the square root of what it is shorter by.
        let reserve = now.reserve * now.reserve;
        let soft = SOFT_M * reserve;
        let short = (1.0 - STRETCHED) * reserve * self.values.leg_m;
        let standing = self.straight_m - short - soft - now.support[0].dip_m;
        let wanted = now.support[0].centre.y + self.ankle_m + standing - now.squat + risen + now.hips_shift.y;
        let longest = self.values.leg_m - short;
        let mut sum = 0.0;
        let least = [0, 1].map(|side| {
            let joint = hips * self.body.link(LEG_LIMBS[side].nodes()[0]).offset;
            let ankle = feet[side].0;
            let away = DVec3::new(hips_at.x + joint.x - ankle.x, 0.0, hips_at.z + joint.z - ankle.z).length_squared();
            ankle.y + (longest * longest - away).max(0.01 * longest * longest).sqrt() - joint.y
        });
        let lowest = wanted.min(least[0]).min(least[1]);
        if soft < 1e-14 {
            return lowest;
        }
        for value in [wanted, least[0], least[1]] {
            sum += libm::exp(-(value - lowest) / soft);
        }
        lowest - soft * libm::log(sum)
    }

    /// Rise of an ankle on its toes \[m\].
    fn rises_m(&self, pitch_rad: f64) -> f64 {
        let toe = self.toes[0];
        let (sin, cos) = libm::sincos(pitch_rad);
        toe.y * (1.0 - cos) + toe.z * sin
    }

    /// The heel of a foot on the floor, under hips at a place.
    pub fn heel(&self, side: usize, now: &Now, hips: (DVec3, DQuat)) -> Heel {
        let (ankle, sole) = now.feet[side];
        let Some(leg) = self.bent(side, now, ankle, hips) else { return Heel::default() };
        let shank = sole.conjugate() * (leg.knee - leg.ankle);
        Heel::of(libm::atan2(shank.z, shank.y), now.heels * (1.0 - now.walks), now.tiptoe).and(now.heel_off[side])
    }

    /// A leg by the law of cosines, its knee over the toes. Unlike an arm it is exact up to its full length: the hips
    /// are kept within it.
    pub fn place_leg(&self, side: usize, now: &Now, foot: Foot, hips: (DVec3, DQuat), pose: &mut Pose) {
        let [upper, lower, end] = LEG_LIMBS[side].nodes();
        pose.world[end.index()] = foot.1;
        let Some(leg) = self.bent(side, now, foot.0, hips) else { return };
        let (thigh, shank) = (self.body.link(lower).offset, self.body.link(end).offset);
        pose.world[upper.index()] =
            along(leg.knee, leg.hinge) * along(thigh, DVec3::X).conjugate() * exp(DVec3::Y * now.leg_turn[side][0]);
        pose.world[lower.index()] = along(leg.ankle - leg.knee, leg.hinge)
            * along(shank, DVec3::X).conjugate()
            * exp(DVec3::Y * now.leg_turn[side][1]);
    }

    fn bent(&self, side: usize, now: &Now, ankle: DVec3, hips: (DVec3, DQuat)) -> Option<Bent> {
        let [upper, lower, end] = LEG_LIMBS[side].nodes();
        let joint = hips.0 + hips.1 * self.body.link(upper).offset;
        let (thigh_m, shank_m) = (self.body.link(lower).offset.length(), self.body.link(end).offset.length());
        let way = ankle - joint;
        let (yaw_sin, yaw_cos) = libm::sincos(now.foot_yaw[side] + now.knee_turn[side]);
        let left = DVec3::new(yaw_cos, 0.0, -yaw_sin);
        let length = way.length().clamp((thigh_m - shank_m).abs() + 1e-6, thigh_m + shank_m);
        let line = way.try_normalize()?;
        let hinge = (left - line * left.dot(line)).try_normalize()?;
        let cosine = (thigh_m * thigh_m + length * length - shank_m * shank_m) / (2.0 * thigh_m * length);
        // The knee goes to the front of the line: about the hinge, which points left.
        let knee = exp(hinge * -libm::acos(cosine.clamp(-1.0, 1.0))) * line * thigh_m;
        Some(Bent { knee, ankle: line * length, hinge })
    }
}

/// The frame of a bone: its −Y along it, its X as near to the hinge as that allows.
fn along(bone: DVec3, hinge: DVec3) -> DQuat {
    let y = -bone.normalize_or(-DVec3::Y);
    let x = (hinge - y * hinge.dot(y)).normalize_or(DVec3::X);
    DQuat::from_mat3(&glam::DMat3::from_cols(x, y, x.cross(y))).normalize()
}
