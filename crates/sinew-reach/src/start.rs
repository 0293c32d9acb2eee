//! The initial pose of a reach, and the decay of its difference from a standing body.

use crate::arm::Carried;
use crate::compose::ARMS;
use crate::feet::Placement;
use crate::frame::{SOFT_M, STRETCHED};
use crate::minimum_jerk::MinimumJerk;
use crate::reacher::Reacher;
use crate::stop::Stop;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, LEGS, Node, Pose, log};

/// The initial pose of a reach, and its velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The pose.
    pub pose: Pose,
    /// The pose a moment before, and the time between \[s\]; `None` for a body at rest.
    pub before: Option<(Pose, f64)>,
}

/// A body standing at a point of the floor with a heading \[rad about +Y from +Z to +X\], its soles on the floor.
pub fn standing(body: &Body, place: DVec3, facing_rad: f64) -> Pose {
    let turn = DQuat::from_rotation_y(facing_rad);
    let mut pose = Pose { hips_position: DVec3::ZERO, world: [turn; Node::COUNT] };
    let at = pose.positions(body);
    let sole = sinew_body::humanoid::Sole::of(body, Node::LeftFoot).ankle_m;
    let ankles = (at[Node::LeftFoot.index()] + at[Node::RightFoot.index()]) * 0.5;
    pose.hips_position = place + DVec3::Y * (sole - ankles.y);
    pose
}

/// Both feet where they are, flat on the floor below the lower of them.
pub(crate) fn flat_feet(pose: &Pose, body: &Body, ankle_m: f64) -> [Placement; 2] {
    let at = pose.positions(body);
    let floor = LEGS.iter().map(|(_, _, foot)| at[foot.index()].y).fold(f64::INFINITY, f64::min) - ankle_m;
    let mut placed = LEGS.map(|(_, _, foot)| {
        let toes = pose.world[foot.index()] * DVec3::Z;
        let ankle = at[foot.index()].with_y(floor + ankle_m);
        Placement { ankle, yaw_rad: libm::atan2(toes.x, toes.z) }
    });
    placed[1].yaw_rad = placed[0].yaw_rad + crate::spine::wrapped(placed[1].yaw_rad - placed[0].yaw_rad);
    placed
}

/// Decay time of the initial pose's difference \[s\]: for a body at rest, and for a moving one.
const SETTLES_SECS: (f64, f64) = (0.5, 0.4);

/// Share of a moving body's carried arms that stays when it stands.
const CARRIED_ON: f64 = 0.35;

impl Reacher {
    /// The initial pose's difference from a standing body, which decays.
    pub(crate) fn begin(&mut self, start: &Start, stop: Option<&Stop>) {
        let body = self.frame.body.clone();
        let plain = self.composed_at(0.0).pose;
        let (own, before) = (start.pose, start.before);
        let lasts = if before.is_some() { SETTLES_SECS.1 } else { SETTLES_SECS.0 };
        let glide_in = |now: DVec3, then: Option<(DVec3, f64)>, lasts: f64| {
            let velocity = then.map_or(DVec3::ZERO, |(then, ago)| (now - then) / ago.max(1e-3));
            MinimumJerk::moving(0.0, now, velocity.clamp_length_max(20.0), DVec3::ZERO, lasts)
        };
        let glide = |now: DVec3, then: Option<(DVec3, f64)>| glide_in(now, then, lasts);
        self.heels.go(0.0, 1.0, 0.0, lasts);
        // A moving body continues a little: it stands where its feet land.
        let turn = |pose: &Pose| log(pose.world[0] * plain.world[0].conjugate());
        let shift = own.hips_position - plain.hips_position;
        let stops_secs = before
            .filter(|_| stop.is_some())
            .map_or(lasts, |(pose, ago)| stops_secs(shift, own.hips_position - pose.hips_position, ago));
        self.hips = [
            glide_in(shift, before.map(|(pose, ago)| (pose.hips_position - plain.hips_position, ago)), stops_secs),
            glide(turn(&own), before.map(|(pose, ago)| (turn(&pose), ago))),
        ];
        for (index, node) in [Node::Chest, Node::Neck, Node::Head].into_iter().enumerate() {
            let left = |pose: &Pose| log(plain.local(node).conjugate() * pose.local(node));
            self.trunk[index] = glide(left(&own), before.map(|(pose, ago)| (left(&pose), ago)));
        }
        if let Some((pose, ago)) = before {
            for side in 0..2 {
                for (index, node) in ARMS[side].into_iter().enumerate() {
                    let (now, then) = (own.local(node), pose.local(node));
                    let velocity = (log(now) - log(then)) / ago.max(1e-3);
                    self.arms[side].carried[index] = Carried::moving(now, velocity, CARRIED_ON, lasts);
                }
            }
        }
        let at = own.positions(&body);
        self.keep_legs(&at);
        let ago_at = before.map(|(pose, ago)| (pose.positions(&body), pose, ago));
        for side in 0..2 {
            let (upper, lower, foot) = LEGS[side];
            let (ankle, sole) = self.feet.foot(side, 0.0);
            let shift = at[foot.index()] - ankle;
            let turned = log(own.world[foot.index()] * sole.conjugate());
            let then = ago_at.map(|(at, pose, ago)| {
                (at[foot.index()] - ankle, log(pose.world[foot.index()] * sole.conjugate()), ago)
            });
            let settles = stop.map_or(lasts, |stop| stop.settles_secs[side]);
            self.feet.rests[side] = (
                glide_in(shift, then.map(|then| (then.0, then.2)), settles),
                glide_in(turned, then.map(|then| (then.1, then.2)), settles),
            );
            // Direction of the knee relative to the toes: the knee's axis is across the leg, and level but for that.
            let line = at[foot.index()] - at[upper.index()];
            let hinge = own.world[lower.index()] * DVec3::X;
            // A bent knee shows its axis better than the lower leg's own.
            let bend = (at[lower.index()] - at[upper.index()]).cross(at[foot.index()] - at[lower.index()]);
            let leg_m = self.frame.values.leg_m;
            let bend = bend * (4.0 / (leg_m * leg_m));
            let hinge = bend * bend.dot(hinge).signum() + hinge * 0.02;
            let across = line.cross(hinge.normalize_or(DVec3::X));
            let yaw = libm::atan2(across.x, across.z);
            let turn = crate::spine::wrapped(yaw - self.now(0.0).foot_yaw[side]);
            let is_level = libm::hypot(across.x, across.z) > 0.3 * line.length();
            self.knees[side] = MinimumJerk::moving(0.0, if is_level { turn } else { 0.0 }, 0.0, 0.0, lasts);
        }
        self.keep_hips(&own);
        self.feet.sink_from(self.hips[0]);
        let composed = self.composed_at(0.0).pose;
        for side in 0..2 {
            let (upper, lower, _) = LEGS[side];
            self.leg_turns[side] = [upper, lower].map(|node| {
                let turn = log((composed.world[node.index()].conjugate() * own.world[node.index()]).normalize());
                MinimumJerk::moving(0.0, turn.y, 0.0, 0.0, lasts)
            });
        }
    }

    /// Legs that are straighter than those of a plan stay so at first.
    fn keep_legs(&mut self, at: &[DVec3; Node::COUNT]) {
        let values = &self.frame.values;
        let longest = LEGS.map(|(upper, _, foot)| (at[foot.index()] - at[upper.index()]).length() / values.leg_m);
        let spare = (1.0 - longest[0].max(longest[1])).max(0.0);
        // The soft clamp takes up to three times its width.
        let share = (spare / (1.0 - STRETCHED + 3.0 * SOFT_M / values.leg_m)).min(1.0).sqrt();
        self.reserve = MinimumJerk::rest(share);
        self.reserve.go(0.0, 1.0, 0.0, UNLOCKS_SECS);
    }

    /// The hips begin exactly where they are, whatever balance and legs would have them do.
    fn keep_hips(&mut self, own: &Pose) {
        let (mut last, mut gain): (f64, f64) = (0.0, 1.0);
        for _ in 0..KEEPS_HIPS {
            let miss = own.hips_position - self.composed_at(0.0).pose.hips_position;
            // Hips that hang on a stretched leg do not sink before what is wanted of them is lower.
            let hangs = miss.y < 0.0 && miss.y < 0.5 * last && last < 0.0;
            gain = if hangs { 2.0 * gain } else { 1.0 };
            last = miss.y;
            let shift = DVec3::new(miss.x, miss.y * gain, miss.z);
            self.hips[0] = self.hips[0].begun_at(self.hips[0].at(0.0) + shift);
        }
    }
}

/// Time in which straight legs give way, so that the knees can bend \[s\].
const UNLOCKS_SECS: f64 = 0.35;

/// Time in which walking hips come to rest \[s\]: by a braking that grows and fades evenly, in twice the time of their way.
fn stops_secs(shift: DVec3, moved: DVec3, ago: f64) -> f64 {
    let velocity = (moved / ago.max(1e-3)).with_y(0.0);
    let speed = velocity.length().max(1e-3);
    (2.0 * -shift.dot(velocity) / (speed * speed)).clamp(SETTLES_SECS.1, 1.0)
}

/// Rounds in which the hips' initial place is found; most leave less than a tenth of the error.
const KEEPS_HIPS: usize = 16;
