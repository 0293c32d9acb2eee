//! What planted feet carry: the support of each stance, and how the weight moves from one to the next.

use crate::feet::{Feet, Placement, Stride};
use crate::frame::{SOFT_M, STRETCHED};
use crate::minimum_jerk::{arc, eased};
use crate::sink::sinks;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Sole};
use sinew_snapshot::snapshot;

/// Support of two planted feet: a disc for the centre of mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Support {
    /// Its middle, on the floor \[m\].
    pub centre: DVec3,
    /// Position of the centre of mass at rest, a little behind the middle \[m\].
    pub rest: DVec3,
    /// Radius of the largest disc about the middle inside the soles' hull \[m\].
    pub radius_m: f64,
    /// Heading of the pelvis: the mean of the feet \[rad\].
    pub yaw_rad: f64,
    /// How much lower the hips are than in standing with parallel feet, because these are apart \[m\].
    pub dip_m: f64,
}

snapshot!(Support { centre, rest, radius_m, yaw_rad, dip_m });

/// Length of a leg that is as straight as plans allow, and distance of the hip joints \[m\].
pub(crate) fn legs_m(body: &Body) -> (f64, f64) {
    let length = |node: Node| body.link(node).offset.length();
    let leg = length(Node::LeftLowerLeg) + length(Node::LeftFoot);
    let hips = body.link(Node::LeftUpperLeg).offset.x - body.link(Node::RightUpperLeg).offset.x;
    (STRETCHED * leg - SOFT_M, hips)
}

impl Feet {
    /// The support of a pair of planted feet.
    pub fn support_of(&self, feet: &[Placement; 2]) -> Support {
        self.bearing(feet, false)
    }

    /// The support flat, and on the toes.
    pub(crate) fn supports_of(&self, feet: &[Placement; 2]) -> [Support; 2] {
        [self.bearing(feet, false), self.bearing(feet, true)]
    }

    /// The support of whole soles, or from the balls forward.
    fn bearing(&self, feet: &[Placement; 2], on_toes: bool) -> Support {
        let soles = self.soles.map(|sole| Sole { heel_m: if on_toes { sole.ball_m() } else { sole.heel_m }, ..sole });
        let middle = |side: usize, along: f64| {
            let sole = &soles[side];
            let place = &feet[side];
            place.ankle + DQuat::from_rotation_y(place.yaw_rad) * DVec3::new(sole.middle_m, -sole.ankle_m, along)
        };
        let along = |side: usize, share: f64| {
            let sole = &soles[side];
            sole.heel_m + share * (sole.toes_m - sole.heel_m)
        };
        let mean = |share: f64| (middle(0, along(0, share)) + middle(1, along(1, share))) * 0.5;
        let centre = mean(if on_toes { 0.5 } else { 0.42 });
        let corners = [0, 1].map(|side| {
            let place = &feet[side];
            let turn = DQuat::from_rotation_y(place.yaw_rad);
            soles[side].corners().map(|corner| place.ankle + turn * corner)
        });
        let yaw_rad = feet[0].yaw_rad + 0.5 * (feet[1].yaw_rad - feet[0].yaw_rad);
        let (leg_m, hips_m) = self.legs_m;
        let apart = DQuat::from_rotation_y(-yaw_rad) * (feet[0].ankle - feet[1].ankle);
        let half = 0.5 * libm::hypot(apart.x - hips_m, apart.z);
        let dip_m = SPARES * (leg_m - (leg_m * leg_m - half * half).max(0.25 * leg_m * leg_m).sqrt());
        Support { centre, rest: mean(0.30), radius_m: inner_radius(&corners, centre).max(0.02), yaw_rad, dip_m }
    }

    /// The support at a time \[s\], flat: interpolated from stance to stance during strides.
    pub fn support(&self, secs: f64) -> Support {
        self.supports(secs)[0]
    }

    /// The support at a time \[s\], flat and on the toes.
    pub(crate) fn supports(&self, secs: f64) -> [Support; 2] {
        let mut total = self.stances[0];
        let mut stands = self.planted;
        for (index, stride) in self.strides.iter().enumerate() {
            stands[stride.side] = stride.to;
            let (from, to) = if self.linear { (stride.start_secs, stride.lands_secs()) } else { stride.bears_secs };
            let share = (secs - from) / (to - from).max(1e-3);
            if share <= 0.0 {
                continue;
            }
            let go = if self.linear { share.min(1.0) } else { eased(share) };
            // The weight shifts only partly over the standing foot: a step is a controlled fall.
            let (before, after) = (&self.stances[index][0], &self.stances[index + 1][0]);
            let across = DQuat::from_rotation_y(before.yaw_rad) * DVec3::X;
            let over = (stands[1 - stride.side].ankle - before.centre).dot(across);
            let most = MOST_SWAY * self.legs_m.1;
            let over = across * over.clamp(-most, most);
            // Across the way, too: along it the hips go evenly.
            let way = after.centre - before.centre;
            let over = over - way * (over.dot(way) / (way.length_squared() + EVEN_M * EVEN_M));
            let swings = ((secs - stride.start_secs) / stride.for_secs).clamp(0.0, 1.0);
            let sway = over * (SWAY * arc(swings));
            for on in 0..2 {
                let (now, next) = (&self.stances[index][on], &self.stances[index + 1][on]);
                let total = &mut total[on];
                total.centre += (next.centre - now.centre) * go + sway;
                total.rest += (next.rest - now.rest) * go + sway;
                total.radius_m += (next.radius_m - now.radius_m) * go;
                total.yaw_rad += (next.yaw_rad - now.yaw_rad) * go;
            }
        }
        let dip_m = self.dip_m(secs);
        total.iter_mut().for_each(|support| support.dip_m = dip_m);
        total
    }

    /// How far the body is carried by its own motion at a time \[s\], 0 to 1: its weight need not lie over what stands.
    pub(crate) fn walks(&self, secs: f64) -> f64 {
        if self.linear {
            return 0.0;
        }
        let passed = |from: f64, to: f64| eased((secs - from) / (to - from).max(1e-3));
        let of = |index: usize, stride: &Stride| {
            let next = self.strides.get(index + 1).filter(|next| next.bears_secs.0 < next.start_secs);
            let ends = match next {
                Some(next) => passed(next.start_secs, next.middle_secs()),
                None => passed(stride.start_secs, stride.bears_secs.1),
            };
            passed(stride.start_secs, stride.middle_secs()) - ends
        };
        self.strides.iter().enumerate().map(|(index, stride)| of(index, stride)).sum::<f64>().clamp(0.0, 1.0)
    }

    /// Rise of a foot's heel in a walk \[rad\]: before it lifts off from behind, and until it has swung forward.
    pub(crate) fn heel_off_rad(&self, side: usize, secs: f64) -> f64 {
        if self.linear {
            return 0.0;
        }
        let passed = |from: f64, to: f64| eased((secs - from) / (to - from));
        let of = |stride: &Stride| {
            let (start, lasts) = (stride.start_secs, stride.for_secs);
            let (begins, rises) = if stride.stops() {
                (0.0, PUSHES_OFF_SECS.max(start))
            } else {
                ((start - PUSHES * lasts).max(stride.bears_secs.0.min(start)), 0.6 * lasts)
            };
            let rises = passed(begins, begins + rises);
            stride.heel_rad * rises * (1.0 - passed(start + 0.15 * lasts, start + 0.9 * lasts))
        };
        self.strides.iter().filter(|stride| stride.side == side).map(of).sum()
    }

    /// How much lower the hips are at a time \[s\] because feet are apart \[m\]: most when a foot lands, not at all in the middle of a
    /// stride, when the hips pass over the standing foot.
    fn dip_m(&self, secs: f64) -> f64 {
        let passed = |from: f64, to: f64| eased((secs - from) / (to - from).max(1e-3));
        let mut dip = self.stances[0][0].dip_m;
        if let Some(first) = self.strides.first() {
            dip *= 1.0 - passed(first.start_secs, first.middle_secs());
        }
        for (index, stride) in self.strides.iter().enumerate() {
            let (middle, lands) = (stride.middle_secs(), stride.lands_secs());
            let rises = self.strides.get(index + 1).map_or(0.0, |next| {
                let from = lands.max(next.start_secs);
                passed(from, next.middle_secs().max(from) + RISES * next.for_secs)
            });
            dip += self.stances[index + 1][0].dip_m * (passed(middle, lands) - rises);
            dip += stride.sinks_m * sinks(stride, secs);
        }
        dip
    }
}

/// Time in which the heel of who stops rises \[s\].
const PUSHES_OFF_SECS: f64 = 0.22;

/// How much lower hips over feet that are apart are than straight legs would have them \[1\].
const SPARES: f64 = 1.2;

/// How long after the middle of a stride the hips still rise from the landing before it \[1 of the stride's time\].
const RISES: f64 = 0.15;

/// Time before lift-off in which a heel rises \[1 of the stride's time\].
const PUSHES: f64 = 0.4;

/// Most by which what stands counts as aside, for the sway [1 of the distance of the hip joints].
const MOST_SWAY: f64 = 0.6;

/// Length of a shift of the weight from which on it is a way \[m\].
const EVEN_M: f64 = 0.05;

/// Share of the weight shift over the standing foot in a step \[1\].
const SWAY: f64 = 0.35;

/// Distance of a point inside the hull of the soles, on the floor \[m\].
fn inner_radius(soles: &[[DVec3; 4]; 2], point: DVec3) -> f64 {
    // The hull of two convex shapes: its support in every direction is the larger of theirs.
    let mut least = f64::INFINITY;
    for index in 0..48 {
        let (sin, cos) = libm::sincos(f64::from(index) * (std::f64::consts::PI / 24.0));
        let out = DVec3::new(sin, 0.0, cos);
        let reach = soles.iter().flatten().map(|corner| (*corner - point).dot(out)).fold(f64::NEG_INFINITY, f64::max);
        least = least.min(reach);
    }
    least
}
