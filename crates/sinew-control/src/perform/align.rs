//! Alignment of a performer's space with a character's position, heading and size.

use super::{BodyProportions, PerformerSample};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_snapshot::snapshot;
use sinew_world::hips_over_soles_m;

/// The transform from a performer's space to the stage: rotated about the vertical, scaled by the length of the legs,
/// moved so that the performance starts at the character's position. Joint rotations do not change, lengths are the
/// character's.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Alignment {
    turn: DQuat,
    scale: f64,
    /// Point of the performer's floor below the hip joints that maps to `place`.
    origin: DVec3,
    place: DVec3,
    performer_hips_to_legs: DVec3,
    character_hips_to_legs: DVec3,
}

/// The character's side of the alignment.
#[derive(Clone, Debug)]
pub(super) struct Stand {
    pub body: Body,
    /// The point of the floor where the performance begins \[m\].
    pub place: DVec3,
    /// Its heading, from +Z to +X \[rad\].
    pub facing_rad: f64,
}

/// Bounds of the scale between two bodies \[1\]: from a doll of 10 cm to a giant of 20 m.
const SCALES: std::ops::RangeInclusive<f64> = 0.05..=12.0;

snapshot!(Alignment { turn, scale, origin, place, performer_hips_to_legs, character_hips_to_legs });

impl Alignment {
    /// The alignment by the first sample of a performance. Its lower sole is placed on the floor at the character's
    /// position.
    pub fn of(first: &PerformerSample, build: Option<BodyProportions>, stand: &Stand) -> Alignment {
        let body = &stand.body;
        let own = BodyProportions::of(body);
        let pose = first.pose();
        let hips_height = pose.hips_position.y;
        let (scale, performer_hips_to_legs) = match build {
            Some(build) if build.leg_m() > 0.01 => (own.leg_m() / build.leg_m(), build.hips_to_legs_m()),
            // Without known lengths the performer is assumed to stand.
            _ if hips_height > 0.05 => (hips_over_soles_m(body, &Pose::STANDING) / hips_height, own.hips_to_legs_m()),
            _ => (1.0, own.hips_to_legs_m()),
        };
        let forward = pose.world[0] * DVec3::Z + pose.world[Node::Chest.index()] * DVec3::Z;
        let facing = libm::atan2(forward.x, forward.z);
        let legs = pose.hips_position + pose.world[0] * performer_hips_to_legs;
        let mut alignment = Alignment {
            turn: DQuat::from_axis_angle(DVec3::Y, stand.facing_rad - facing),
            scale: scale.clamp(*SCALES.start(), *SCALES.end()),
            origin: DVec3::new(legs.x, 0.0, legs.z),
            place: stand.place,
            performer_hips_to_legs,
            character_hips_to_legs: own.hips_to_legs_m(),
        };
        let there = alignment.pose(first);
        alignment.place.y += hips_over_soles_m(body, &there) - (there.hips_position.y - stand.place.y);
        alignment
    }

    /// A sample as the character's pose on the stage.
    pub fn pose(&self, sample: &PerformerSample) -> Pose {
        let mut pose = sample.pose();
        let legs = pose.hips_position + pose.world[0] * self.performer_hips_to_legs;
        pose.world = pose.world.map(|rotation| (self.turn * rotation).normalize());
        let legs = self.place + self.turn * (legs - self.origin) * self.scale;
        pose.hips_position = legs - pose.world[0] * self.character_hips_to_legs;
        pose
    }

    /// Metres of the character's stage per metre of the performer's space.
    pub fn scale(&self) -> f64 {
        self.scale
    }
}
