//! Ground reaction forces, and the leg torques that produce them.

use super::split::Split;
use super::stance::{Stance, leg, lift};
use crate::reflex::Sense;
use crate::{JointTarget, Wanted};
use glam::{DVec2, DVec3};
use sinew_body::humanoid::{Node, exp, log, swing_twist};

/// The wanted ground reaction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground {
    /// Share of each foot \[1\].
    pub shares: [f64; 2],
    /// Centre of pressure under each foot \[m\].
    pub points: [DVec3; 2],
    /// Force on each foot \[N\].
    pub forces: [DVec3; 2],
    /// The resulting acceleration of the centre of mass \[m/s²\].
    pub acceleration: DVec3,
}

/// Maximum horizontal force \[1 of the weight\]: shoes slip beyond it.
const GRIP: f64 = 0.7;

/// Minimum load of a foot in contact \[1 of the weight\].
const TOUCHING: f64 = 0.05;

/// Share of its stiffness with which a joint that is held by torques keeps its twist while both feet stand \[1\]. A twisted foot creeps: the solver's
/// friction lets a strong spring turn it, and in the wrong direction.
const TWIST_GAIN: f64 = 0.1;

/// Vertical damping, relative to √(g/h) \[1\].
const SLOWING: f64 = 1.0;

impl Ground {
    /// The ground's forces for a centre of pressure and a moment about the centre of mass \[N m\], with a `pair` of forces of the
    /// feet against each other: the left one's \[N\].
    pub fn under(sense: &Sense, stance: &Stance, pressure: DVec2, moment: DVec3, pair: DVec3) -> Ground {
        let (mass, gravity, height) = (sense.body.mass_kg(), sense.gravity_m_s2, stance.height_m);
        let Split { shares, points } = Split::of(stance, pressure);
        let points = [0, 1].map(|side| lift(points[side], stance.feet[side].height_m));
        let reached = points[0] * shares[0] + points[1] * shares[1];
        // (p - c) x F = M with F's upward part the weight, less what slows a body that rises.
        let arm = DVec2::new(reached.x, reached.z) - stance.centre;
        let weight = mass * gravity;
        let slower = sense.character().centre_velocity.y * SLOWING / (gravity * height).sqrt();
        let upward = weight * (1.0 - slower.clamp(-0.3, 0.5));
        let force = DVec2::new(moment.z - arm.x * upward, -moment.x - arm.y * upward) / height;
        let force = force.clamp_length_max(GRIP * weight);
        let whole = DVec3::new(force.x, upward, force.y);
        Ground {
            shares,
            points,
            forces: [whole * shares[0] + pair, whole * shares[1] - pair],
            acceleration: DVec3::new(force.x, 0.0, force.y) / mass,
        }
    }
}

/// Sets the joints of both legs to produce the wanted ground reaction. `strength` fades it in and out, 0 to 1.
pub(super) fn drive(
    sense: &Sense,
    stance: &Stance,
    ground: &Ground,
    load_n: &[f64; 2],
    strength: f64,
    target: &mut Wanted,
) {
    let me = sense.character();
    let weight = sense.body.mass_kg() * sense.gravity_m_s2;
    for side in 0..2 {
        let share = ground.shares[side];
        let force = ground.forces[side];
        // A foot without contact has no ground reaction.
        let held = strength * smooth(share / 0.15) * smooth(load_n[side] / (TOUCHING * weight));
        // A single stance leg keeps the hips' heading.
        let shared = smooth(load_n[1 - side] / (0.2 * weight));
        let twist_gain = 1.0 + (TWIST_GAIN - 1.0) * shared;
        let nodes = leg(side);
        let (ankle, hip) = (me.part(nodes[0]).position, me.part(nodes[2]).position);
        let line = (hip - ankle).try_normalize().unwrap_or(DVec3::Y);
        let mut below = (DVec3::ZERO, DVec3::ZERO);
        for node in nodes {
            let (part, link) = (me.part(node), sense.body.link(node));
            // Weight and inertia of the part itself, which moves like a pendulum about the ground.
            let tilt = ((part.centre.y - stance.ground_m) / stance.height_m).clamp(0.0, 1.0);
            let own = DVec3::new(0.0, -sense.gravity_m_s2, 0.0) - ground.acceleration * tilt;
            below.0 += own * link.mass_kg;
            below.1 += part.centre.cross(own * link.mass_kg);
            let mut torque =
                -((ground.points[side] - part.position).cross(force) + below.1 - part.position.cross(below.0));
            let joint = target.joint_mut(node);
            if node == nodes[0] {
                // Under the actual load of the foot, the centre of pressure is then where it is wanted. (More for more
                // load would throw the body up from its toes.)
                torque *= (load_n[side] / force.y.max(1.0)).clamp(0.5, 1.0);
            }
            if node == nodes[1] {
                let axis = part.rotation * DVec3::X;
                joint.torque += axis * (axis.dot(torque) * held);
                joint.gain = joint.gain.max(held);
            } else {
                let bone = part.rotation * DVec3::Y;
                torque -= bone * bone.dot(torque);
                joint.torque += torque * held;
                joint.gain = joint.gain.max(held);
                let damping = if node == nodes[0] { 0.1 } else { 0.3 };
                // A foot that should stand but is not loaded returns to its last placement, level.
                let astray = match (stance.stands[side], node == nodes[0]) {
                    (false, _) => None,
                    (true, true) => Some(bone.cross(DVec3::Y)),
                    (true, false) => {
                        let print = (stance.feet[side].ankle - hip).try_normalize().unwrap_or(line);
                        Some(print.cross(line))
                    }
                };
                yield_across(sense, node, astray, held, (twist_gain, damping), joint);
            }
        }
    }
}

/// Lets a joint's spring go but for the twist about its bone, so that torques alone act about the other axes as far as
/// the leg is `held` by them. The spring's target follows the joint: it still prevents light parts from chattering
/// within a step. Without a load the spring aims at the pose, or turns the joint by `astray` (world axes). Held, it has
/// these shares of its gain and damping.
fn yield_across(
    sense: &Sense,
    node: Node,
    astray: Option<DVec3>,
    held: f64,
    (gain, damping): (f64, f64),
    joint: &mut JointTarget,
) {
    let Some(parent) = node.parent() else { return };
    let me = sense.character();
    let (above, part) = (me.part(parent), me.part(node));
    let parent_from_world = above.rotation.conjugate();
    let local = (parent_from_world * part.rotation).normalize();
    let (_, _, twist) = swing_twist(joint.rotation.conjugate() * local);
    let bone = local * DVec3::Y;
    let along = bone * -twist;
    let across = match astray {
        Some(turn) => {
            let turn = parent_from_world * turn;
            turn - bone * bone.dot(turn)
        }
        None => log(joint.rotation * local.conjugate()) - along,
    };
    joint.rotation = (exp(along + across * (1.0 - held)) * local).normalize();
    let node_from_world = part.rotation.conjugate();
    let spin = node_from_world * (part.angular_velocity - above.angular_velocity);
    if astray.is_some() {
        // It does not rotate with the parts above it.
        joint.velocity = node_from_world * -above.angular_velocity;
    }
    // Damping acts on the twist alone.
    joint.velocity = joint.velocity.lerp(spin.with_y(joint.velocity.y), held);
    joint.gain *= 1.0 + (gain - 1.0) * held;
    joint.damping *= 1.0 + (damping / gain.sqrt() - 1.0) * held;
}

/// 0 below 0, 1 above 1, smooth between.
pub(super) fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}
