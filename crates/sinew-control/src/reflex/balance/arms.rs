//! Arm swing against a fall, and a head that stays upright.

use super::flywheel::{Flywheel, Swing};
use super::legs::smooth;
use crate::Wanted;
use crate::reflex::Sense;
use glam::{DVec2, DVec3};
use sinew_body::humanoid::{Node, exp};
use sinew_snapshot::snapshot;

/// Swings of the arms about the character's left and about its facing.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Arms {
    pitch: Flywheel,
    roll: Flywheel,
}

/// Return frequency of the arms \[rad/s\]: they hang again after a second.
const BACK_RAD_S: f64 = 4.0;

/// Angular acceleration of an arm swing \[rad/s²\].
const THROW_RAD_S2: f64 = 25.0;

/// Distance of the required centre of pressure outside the soles at which arms swing in full \[m\].
const FULL_M: f64 = 0.06;

snapshot!(Arms { pitch, roll });

impl Arms {
    /// Advances by a step. `beyond` is the distance of the required centre of pressure outside the soles \[m\],
    /// `swing_rad` the maximum swing of the arms.
    pub fn step(&mut self, sense: &Sense, beyond: DVec2, swing_rad: f64) {
        let me = sense.character();
        let beyond = DVec3::new(beyond.x, 0.0, beyond.y);
        let go = |wheel: &mut Flywheel, along: f64| {
            let swing = Swing {
                inertia: 1.0,
                moment: THROW_RAD_S2 * along.signum(),
                urgency: smooth((along.abs() - 0.005) / FULL_M),
                room: swing_rad.max(1e-3),
                omega: BACK_RAD_S,
            };
            wheel.step(&swing, sense.step_secs);
        };
        // The body turns forward about its left, and to its left about what lies behind it.
        go(&mut self.pitch, beyond.dot(me.facing));
        go(&mut self.roll, -beyond.dot(me.left()));
    }

    /// Rotates the upper arms: both backward or forward, the outer one up. Hanging arms swing most; others may be in
    /// use.
    pub fn drive(&self, sense: &Sense, strength: f64, target: &mut Wanted) {
        let me = sense.character();
        for (shoulder, arm, side) in
            [(Node::LeftShoulder, Node::LeftUpperArm, 1.0), (Node::RightShoulder, Node::RightUpperArm, -1.0)]
        {
            let above = me.part(shoulder).rotation;
            let joint = target.joint_mut(arm);
            let hanging = smooth(4.0 * (joint.rotation * DVec3::Y).y - 3.0);
            let free = strength * hanging * joint.gain.min(1.0);
            let outer = if self.roll.angle * side > 0.0 { 1.0 } else { 0.0 };
            let turn = me.left() * self.pitch.angle + me.facing * (self.roll.angle * outer);
            let spin = me.left() * self.pitch.speed + me.facing * (self.roll.speed * outer);
            joint.velocity += joint.rotation.conjugate() * (above.conjugate() * spin) * free;
            joint.rotation = (exp(above.conjugate() * turn * free) * joint.rotation).normalize();
        }
    }
}

/// Rotates neck and head back by the chest's deviation from upright; `off` is the rotation that takes it upright (world
/// axes) \[rad\].
pub(super) fn level_head(sense: &Sense, off: DVec3, strength: f64, target: &mut Wanted) {
    let turn = off.clamp_length_max(MAX_HEAD_RAD) * (0.5 * strength);
    for (above, node) in [(Node::Chest, Node::Neck), (Node::Neck, Node::Head)] {
        let parent_from_world = sense.character().part(above).rotation.conjugate();
        let joint = target.joint_mut(node);
        joint.rotation = (exp(parent_from_world * turn) * joint.rotation).normalize();
    }
}

/// Maximum rotation of the head \[rad\].
const MAX_HEAD_RAD: f64 = 0.6;
