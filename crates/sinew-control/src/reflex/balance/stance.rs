//! The stance: which feet stand, and the motion of the centre of mass over them.

use super::polygon::{Polygon, flat};
use super::sole::{Footing, Sole};
use crate::Wanted;
use crate::reflex::Sense;
use glam::{DVec2, DVec3};
use sinew_body::humanoid::{LEGS, Node};
use sinew_world::{CharacterId, Entity};

/// Height above the lower foot at which a foot counts as lifted, whatever the pose wants \[m\].
const LIFTED_M: f64 = 0.12;

/// Wanted height above the other foot at which a foot is not meant to stand \[m\].
const MEANT_LIFTED_M: f64 = 0.05;

/// Time over which loads are smoothed \[s\].
const LOAD_SECS: f64 = 0.015;

/// Smoothing time of the contact estimate \[s\].
const BEARING_SECS: f64 = 0.1;

/// The stance of a character in one step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stance {
    pub feet: [Footing; 2],
    /// Which feet stand.
    pub stands: [bool; 2],
    pub polygon: Polygon,
    /// Resting point of the weight in quiet standing.
    pub rest: DVec2,
    /// Height of the ground \[m\].
    pub ground_m: f64,
    /// Height of the centre of mass over it \[m\].
    pub height_m: f64,
    /// Centre of mass over the ground \[m\].
    pub centre: DVec2,
    /// The capture point, over which the centre of mass would come to rest: c + v / ω \[m\].
    pub capture: DVec2,
}

impl Stance {
    /// `bearing` is the contact estimate of each foot, 0 to 1.
    pub fn of(sense: &Sense, feet: &[Footing; 2], bearing: &[f64; 2], ground_velocity: DVec2) -> Stance {
        let me = sense.character();
        let stands = bearing.map(|bearing| bearing > 0.5);
        let (mut points, mut count) = ([DVec2::ZERO; 8], 0);
        let (mut rest, mut ground, mut total) = (DVec2::ZERO, 0.0, 0.0);
        for side in 0..2 {
            if stands[side] {
                points[count..count + 4].copy_from_slice(&feet[side].corners);
                count += 4;
            }
            rest += feet[side].rest * bearing[side];
            ground += feet[side].height_m * bearing[side];
            total += bearing[side];
        }
        let (rest, ground_m) = (rest / total.max(1e-6), ground / total.max(1e-6));
        let height_m = (me.centre_of_mass.y - ground_m).max(0.1 * sense.body.stature_m());
        let omega = (sense.gravity_m_s2 / height_m).sqrt();
        let centre = flat(me.centre_of_mass);
        Stance {
            feet: *feet,
            stands,
            polygon: Polygon::hull(&points[..count]),
            rest,
            ground_m,
            height_m,
            centre,
            capture: centre + (flat(me.centre_velocity) - ground_velocity) / omega,
        }
    }
}

/// Smooths the upward forces on both feet \[N\].
pub(super) fn follow_loads(sense: &Sense, load_n: &mut [f64; 2]) {
    let mut now = [0.0; 2];
    for contact in &sense.frame.contacts {
        for side in 0..2 {
            let foot = Entity::Part(sense.own, LEGS[side].2);
            if contact.b == foot && !is_own(contact.a, sense.own) {
                now[side] += contact.impulse.y / sense.step_secs;
            } else if contact.a == foot && !is_own(contact.b, sense.own) {
                now[side] -= contact.impulse.y / sense.step_secs;
            }
        }
    }
    for side in 0..2 {
        load_n[side] += (now[side].max(0.0) - load_n[side]) * sense.step_secs / (LOAD_SECS + sense.step_secs);
    }
}

/// Which feet stand: those that the pose wants on the ground, or that carry weight, and that are near the ground.
pub(super) fn follow_bearing(
    sense: &Sense,
    soles: &[Sole; 2],
    load_n: &[f64; 2],
    target: &Wanted,
    bearing: &mut Option<[f64; 2]>,
) -> [f64; 2] {
    let me = sense.character();
    let weight = sense.body.mass_kg() * sense.gravity_m_s2;
    let meant = [0, 1].map(|side| soles[side].meant_height_m(sense.body, target, side));
    let is = [0, 1].map(|side| soles[side].under(me.part(LEGS[side].2)).height_m);
    let goal = [0, 1].map(|side| {
        let meant = meant[side] < meant[1 - side] + MEANT_LIFTED_M;
        let near = is[side] < is[1 - side] + LIFTED_M;
        if near && (meant || load_n[side] > 0.1 * weight) { 1.0 } else { 0.0 }
    });
    let bearing = bearing.get_or_insert(goal);
    for side in 0..2 {
        bearing[side] += (goal[side] - bearing[side]) * sense.step_secs / (BEARING_SECS + sense.step_secs);
    }
    *bearing
}

fn is_own(entity: Entity, own: CharacterId) -> bool {
    matches!(entity, Entity::Part(character, _) if character == own)
}

/// Back into the world.
pub(super) fn lift(point: DVec2, height_m: f64) -> DVec3 {
    DVec3::new(point.x, height_m, point.y)
}

/// The nodes of a leg from the foot up, with the parts below each.
pub(super) fn leg(side: usize) -> [Node; 3] {
    let (upper, lower, foot) = LEGS[side];
    [foot, lower, upper]
}
