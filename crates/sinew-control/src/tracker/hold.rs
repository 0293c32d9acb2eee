//! Pins that carry a body along a moving pose.

use super::instant::Instant;
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_world::{CharacterId, Drive, Pin, World};

/// Stiffness of the pins of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Frequency of the spring that holds each part, critically damped \[Hz\]. A displaced part returns within about
    /// half of its period.
    pub frequency_hz: f64,
    /// Maximum acceleration of a part in addition to its weight and to what the pose's own motion requires \[m/s²\].
    pub max_acceleration: f64,
}

/// Motion of the ground under a pose.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GroundMotion {
    /// \[m\]
    pub shift: DVec3,
    /// \[m/s\]
    pub velocity: DVec3,
    /// \[m/s²\]
    pub acceleration: DVec3,
}

/// Holds all parts of a body to a pose that moves from one step of physics to the next.
#[derive(Clone, Debug)]
pub(crate) struct Hold {
    grip: Grip,
    before: Instant,
    now: Instant,
}

sinew_snapshot::snapshot!(Grip { frequency_hz, max_acceleration });
sinew_snapshot::snapshot!(Hold { grip, before, now });

impl Hold {
    /// At rest.
    pub(crate) fn new(grip: Grip, body: &Body, pose: &Pose) -> Hold {
        let now = Instant::of(body, pose);
        Hold { grip, before: now, now }
    }

    /// In another pose, which came from one a step of physics before it.
    pub(crate) fn restart(&mut self, body: &Body, before: &Pose, pose: &Pose) {
        (self.before, self.now) = (Instant::of(body, before), Instant::of(body, pose));
    }

    /// Gives the body the velocities of the pose's motion.
    pub(crate) fn launch(&self, world: &mut World, character: CharacterId) {
        let step_secs = world.settings().step_secs();
        let velocities: [(DVec3, DVec3); Node::COUNT] = std::array::from_fn(|at| {
            let shift = self.now.centres[at] - self.before.centres[at];
            (shift / step_secs, self.before.turn(&self.now, at) / step_secs)
        });
        world.set_velocities(character, &velocities);
    }

    /// Sets the stiffness. Takes effect in the next step.
    pub(crate) fn set_grip(&mut self, grip: Grip) {
        self.grip = grip;
    }

    /// Sets the pins of a character so that it is in `next` at the end of the world's next step.
    pub(crate) fn carry_to(&mut self, next: &Pose, ground: &GroundMotion, world: &mut World, character: CharacterId) {
        let step_secs = world.settings().step_secs();
        let Some(body) = world.body(character) else { return };
        let next = Instant::of(body, next);
        let omega = std::f64::consts::TAU * self.grip.frequency_hz;
        let (stiffness, damping) = (omega * omega, 2.0 * omega);
        // These pins have no feed-forward acceleration: an increased target velocity compensates for it.
        let lead_secs = (1.0 + step_secs * damping + step_secs * step_secs * stiffness)
            / (damping + step_secs * stiffness).max(1e-9);
        // What a pin carries of a part's weight, and what the pose's own motion requires, comes out of its largest force.
        let spare = self.grip.max_acceleration + world.settings().gravity_m_s2.abs();
        let masses = Node::ALL.map(|node| body.link(node).mass_kg);
        let outboard = world.outboard_inertias(character).copied().unwrap_or([0.0; Node::COUNT]);
        let mut spins = [DVec3::ZERO; Node::COUNT];
        for node in Node::ALL {
            let at = node.index();
            let (back, on) = (self.before.turn(&self.now, at), self.now.turn(&next, at));
            let (behind, ahead) =
                (self.now.centres[at] - self.before.centres[at], next.centres[at] - self.now.centres[at]);
            let velocity = (behind + ahead) / (2.0 * step_secs) + ground.velocity;
            let acceleration = (ahead - behind) / (step_secs * step_secs) + ground.acceleration;
            spins[at] = (back + on) / (2.0 * step_secs);
            let pin = Pin {
                position: self.now.joints[at] + ground.shift,
                rotation: self.now.rotations[at],
                velocity: velocity + acceleration * lead_secs,
                angular_velocity: spins[at] + (on - back) / (step_secs * step_secs) * lead_secs,
                stiffness,
                damping,
                turn_stiffness: stiffness,
                turn_damping: damping,
                gravity_share: 1.0,
                max_force_n: masses[at] * (spare + acceleration.length().min(MAX_OWN_ACCELERATION)),
                ..Pin::LOOSE
            };
            world.set_pin(character, node, Some(pin));
            let Some(parent) = node.parent().map(Node::index) else { continue };
            let (rotation, above) = (self.now.rotations[at], self.now.rotations[parent]);
            world.set_drive(
                character,
                node,
                Drive {
                    rotation: (above.conjugate() * rotation).normalize(),
                    velocity: rotation.conjugate() * (spins[at] - spins[parent]),
                    stiffness: outboard[at] * JOINT_STIFFNESS,
                    damping: outboard[at] * JOINT_DAMPING,
                    torque: DVec3::ZERO,
                },
            );
        }
        self.before = self.now;
        self.now = next;
    }
}

/// Largest acceleration that a pose's own motion may require \[m/s²\]: a hand that is hit by a ball. More is a cut.
const MAX_OWN_ACCELERATION: f64 = 1000.0;

/// Joints are nearly limp, with the friction that they have anyway: relative to their outboard inertia \[1/s²\],
/// \[1/s\].
const JOINT_STIFFNESS: f64 = 1.0;
const JOINT_DAMPING: f64 = 2.0;
