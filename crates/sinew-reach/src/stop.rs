//! How a body that walks comes to stand: where its feet land, and which of them closes the last step.

use crate::feet::{Feet, Placement};
use crate::legs::StepKind;
use crate::start::Start;
use crate::walk::{Stance, stride};
use crate::{Values, start};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, LEGS};

/// A body slower than this does not walk \[m/s\].
const WALKS_M_S: f64 = 0.35;

/// A foot faster than this swings \[m/s\].
const SWINGS_M_S: f64 = 0.7;

/// Way in which walking hips come to rest, per speed squared \[s²/m\]: they brake at 3/4 of its inverse at most.
const STOPS_S2_M: f64 = 0.165;

/// Least of these ways \[m\], for a leg of 0.85 m.
const STOPS_M: f64 = 0.12;

/// Times within which a swinging foot lands \[s\].
const LANDS_SECS: (f64, f64) = (0.15, 0.42);

/// How long before the other lands the trailing foot begins to lift off \[s\].
const LIFTS_BEFORE_SECS: f64 = 0.12;

/// How far behind the hips a foot stays on the floor \[1 of the leg\].
const BEHIND: f64 = 0.3;

/// Rise of its heel \[rad\], more than it has risen already.
const HEEL_RAD: f64 = 0.35;

/// A plan to come to stand.
#[derive(Debug)]
pub(crate) struct Stop {
    /// Where the feet are planted before the strides.
    pub placed: [Placement; 2],
    /// Time in which each of them is there \[s\].
    pub settles_secs: [f64; 2],
    /// Foot, place and lift-off time \[s\] of each stride.
    strides: Vec<(usize, Placement, f64)>,
}

impl Stop {
    /// The plan of a body; `None` for one that does not walk.
    pub fn of(start: &Start, body: &Body, values: &Values, ankle_m: f64) -> Option<Stop> {
        let (before, ago) = start.before.as_ref()?;
        let ago = ago.max(1e-3);
        let hips = start.pose.hips_position;
        let velocity = ((hips - before.hips_position) / ago).with_y(0.0);
        let speed = velocity.length();
        if !(WALKS_M_S..10.0).contains(&speed) {
            return None;
        }
        let forward = velocity / speed;
        let stops_m = (STOPS_S2_M * speed * speed).clamp(STOPS_M * values.leg_m / 0.85, values.longest_step_m);
        let mut placed = start::flat_feet(&start.pose, body, ankle_m);
        let (at, then) = (start.pose.positions(body), before.positions(body));
        let speeds = LEGS.map(|(_, _, foot)| ((at[foot.index()] - then[foot.index()]) / ago).length());
        let ahead = placed.map(|foot| (foot.ankle - hips).dot(forward));
        let stance = Stance::of(&placed, values);
        let turn = DQuat::from_rotation_y(libm::atan2(forward.x, forward.z));
        let side_m = |side: usize| if side == 0 { 0.5 } else { -0.5 } * stance.breadth_m;
        let landing = |side: usize, foot: &Placement| Placement {
            ankle: (hips + forward * stops_m + turn * DVec3::X * side_m(side)).with_y(foot.ankle.y),
            ..*foot
        };
        let front = usize::from(ahead[1] > ahead[0]);
        let swings = usize::from(speeds[1] > speeds[0]);
        let mut settles_secs = [0.4; 2];
        let mut strides = Vec::with_capacity(2);
        let (lands, closes, from) = if speeds[swings] > SWINGS_M_S {
            // The foot in the air lands as far ahead as stopping takes.
            let to = landing(swings, &placed[swings]);
            let way = (to.ankle - placed[swings].ankle).length();
            placed[swings] = to;
            let lands = (1.9 * way / speeds[swings]).clamp(LANDS_SECS.0, LANDS_SECS.1);
            settles_secs[swings] = lands;
            // A foot that is too far behind lifts off at once.
            let far = (BEHIND * values.leg_m + ahead[1 - swings]) / speed;
            (swings, 1 - swings, (lands - LIFTS_BEFORE_SECS).min(far).max(0.0))
        } else if ahead[front] > stops_m - 0.06 {
            (front, 1 - front, 0.0)
        } else {
            // Too fast for the foot in front: the other goes beyond it first.
            strides.push((1 - front, landing(1 - front, &placed[1 - front]), 0.0));
            (1 - front, front, f64::NAN)
        };
        let landed = strides.last().map_or(placed[lands], |stride| stride.1);
        let beside = turn * DVec3::X * (side_m(closes) - side_m(lands));
        let to = Placement { ankle: landed.ankle + beside, yaw_rad: landed.yaw_rad };
        strides.push((closes, to, from));
        Some(Stop { placed, settles_secs, strides })
    }

    /// Appends its strides: the weight is on its way to the last of them already. Feet that follow a stride rest until it ends.
    pub fn stride(&mut self, feet: &mut Feet, values: &Values) {
        let mut at = feet.last();
        let mut next = 0.0;
        for (side, to, from) in &self.strides {
            let from = if from.is_nan() { next } else { *from };
            next = stride(feet, &mut at, *side, *to, StepKind::Full, from, 1.0, values, None);
            if next > from {
                self.settles_secs[*side] = next;
            }
            if let Some(last) = feet.strides.last_mut() {
                last.bears_secs = BEFORE_SECS;
                last.heel_rad = HEEL_RAD;
            }
        }
        feet.stand_anew();
    }
}

/// Times at which the weight is on its way before a reach begins \[s\].
pub(crate) const BEFORE_SECS: (f64, f64) = (-2.0, -1.0);
