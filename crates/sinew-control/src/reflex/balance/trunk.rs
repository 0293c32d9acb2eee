//! Hips and trunk: upright at rest, rotated in the direction of the fall when the ankles alone cannot stop it.

use super::BalanceSettings;
use super::flywheel::{FORESIGHT_SECS, Flywheel, Swing};
use super::legs::smooth;
use super::stance::{Stance, leg};
use crate::Wanted;
use crate::reflex::Sense;
use glam::{DQuat, DVec2, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_snapshot::snapshot;

/// The upper body on its hips.
#[derive(Clone, Debug)]
pub(super) struct Trunk {
    /// Moment of inertia of hips, trunk, head and arms about the hip joints \[kg m²\].
    inertia: f64,
    /// Change of the whole body's angular momentum about its centre of mass for a turn of the chest on the hips \[kg m²\].
    chest_inertia: f64,
    /// Sideways bend of the chest, about the facing.
    bend: Flywheel,
}

snapshot!(Trunk { bend } fixed { inertia, chest_inertia });

impl Trunk {
    pub fn of(body: &Body) -> Trunk {
        let positions = Pose::STANDING.positions(body);
        let centre = body.centre_of_mass(&Pose::STANDING).y;
        let (hip, waist) = (positions[Node::LeftUpperLeg.index()].y, positions[Node::Chest.index()].y);
        let (mut inertia, mut chest_inertia) = (0.0, 0.0);
        for node in Node::ALL.into_iter().filter(|node| !node.is_leg()) {
            let link = body.link(node);
            let place = positions[node.index()] + link.centre;
            inertia += link.inertia.x + link.mass_kg * (place.y - hip) * (place.y - hip);
            if node != Node::Hips {
                let lever = (place.y - waist) * (place.y - centre) + place.x * place.x;
                chest_inertia += link.inertia.z + link.mass_kg * lever;
            }
        }
        Trunk { inertia, chest_inertia: chest_inertia.max(0.1 * inertia), bend: Flywheel::default() }
    }

    pub fn reset(&mut self) {
        self.bend = Flywheel::default();
    }

    /// Moment of the ground about the centre of mass \[N m\]. `beyond` is how far the centre of pressure would have to lie outside
    /// the soles, `lifted_m` how high a foot is that should stand \[m\], `wanted_up` the
    /// hips' wanted up axis.
    pub fn moment(
        &mut self,
        sense: &Sense,
        stance: &Stance,
        settings: &BalanceSettings,
        beyond: DVec2,
        lifted_m: f64,
        wanted_up: DVec3,
    ) -> DVec3 {
        let me = sense.character();
        let (facing, left) = (me.facing, me.left());
        let weight = sense.body.mass_kg() * sense.gravity_m_s2;
        let most = settings.trunk_moment * weight * stance.height_m;
        let throw = (DVec3::new(beyond.y, 0.0, -beyond.x) * weight).clamp_length_max(most);
        let urgency = smooth(beyond.length() / 0.02);

        let hips = me.part(Node::Hips);
        let error = (hips.rotation * DVec3::Y).cross(wanted_up);
        let omega = std::f64::consts::TAU * settings.upright_hz;
        let upright = |axis: DVec3| {
            let spin = hips.angular_velocity.dot(axis);
            self.inertia * omega * (omega * error.dot(axis) - 2.0 * settings.upright_damping * spin)
        };

        // Forward and backward the hips rotate on the legs.
        let pitch_throw = throw.dot(left);
        let room = settings.trunk_lean[if pitch_throw > 0.0 { 0 } else { 1 }];
        let lean = (-error.dot(left) + FORESIGHT_SECS * hips.angular_velocity.dot(left)) * pitch_throw.signum();
        let thrown = urgency * (1.0 - smooth(2.0 * lean / room - 1.0));
        let pitch = pitch_throw * thrown + upright(left) * (1.0 - thrown);

        // Sideways the legs hold the hips level as long as both stand, and the chest bends at the waist.
        let swing = Swing {
            inertia: self.chest_inertia,
            moment: throw.dot(facing),
            urgency,
            room: settings.trunk_lean[2],
            omega,
        };
        let roll = self.bend.step(&swing, sense.step_secs) + upright(facing) * smooth(lifted_m / 0.01);
        left * pitch + facing * roll
    }

    /// Bends the chest. Returns the rotation that would take it upright (world axes) \[rad\].
    pub fn drive(&self, sense: &Sense, wanted_up: DVec3, strength: f64, target: &mut Wanted) -> DVec3 {
        let me = sense.character();
        let hips = me.part(Node::Hips).rotation;
        let upright = DQuat::from_rotation_arc(hips * DVec3::Y, wanted_up) * hips;
        let chest = target.joint_mut(Node::Chest);
        let off = (me.part(Node::Chest).rotation * DVec3::Y).cross(upright * chest.rotation * DVec3::Y);
        let axis = hips.conjugate() * me.facing;
        chest.velocity += chest.rotation.conjugate() * axis * (self.bend.speed * strength);
        chest.rotation = (exp(axis * (self.bend.angle * strength)) * chest.rotation).normalize();
        for node in [Node::Chest, Node::Neck, Node::Head] {
            let joint = target.joint_mut(node);
            joint.gain = joint.gain.max(strength);
        }
        off
    }
}

/// The hips' up axis of the wanted pose on level feet.
pub(super) fn wanted_up(stance: &Stance, target: &Wanted) -> DVec3 {
    let mut up = DVec3::ZERO;
    for side in 0..2 {
        if stance.stands[side] {
            let hips_from_foot =
                leg(side).into_iter().rev().fold(DQuat::IDENTITY, |turn, node| turn * target.joint(node).rotation);
            up += stance.feet[side].level * (hips_from_foot.conjugate() * DVec3::Y);
        }
    }
    up.try_normalize().unwrap_or(DVec3::Y)
}
