//! Joint springs towards the wanted pose (Shapiro et al. 2007, EQ2 and EQ3).
//!
//! τ = k_s (θ_d − θ) − k_d θ̇ with k_s = k_sj k_sg k_sp: the joint's gain times the global gain times the pose's. EQ2 is printed
//! with (θ − θ_d), the sign of positive feedback. On a ball joint the error is the rotation vector from present to wanted. The
//! world integrates the springs implicitly.

use super::{Gains, JointGain};
use crate::Target;
use sinew_body::humanoid::{Body, Node};
use sinew_world::{Drive, World, outboard_inertias};

/// Follows a target with joint springs; the root is not actuated.
#[derive(Clone, Debug)]
pub struct PdTracker {
    gains: Gains,
    /// k_sg, the character's global gain \[1\].
    pub global_gain: f64,
    /// A factor for each joint on top \[1\].
    pub joint_gain: [f64; Node::COUNT],
}

sinew_snapshot::snapshot!(PdTracker { global_gain, joint_gain } fixed { gains });

impl PdTracker {
    /// For a body, with the spring of each joint by [`Node::index`].
    pub fn new(body: &Body, joints: &[JointGain; Node::COUNT]) -> PdTracker {
        let gains = Gains::of(body, &outboard_inertias(body), joints);
        PdTracker { gains, global_gain: 1.0, joint_gain: [1.0; Node::COUNT] }
    }

    /// The joints' own springs.
    pub fn gains(&self) -> &Gains {
        &self.gains
    }

    /// Hands the target to the joints of a character for the next step.
    pub fn apply(&self, world: &mut World, character: usize, target: &Target) {
        for node in Node::ALL.into_iter().skip(1) {
            let at = node.index();
            let wanted = &target.joints[at];
            let factor = self.global_gain * self.joint_gain[at] * wanted.gain;
            // Damping goes with the root of the stiffness, so that the damping ratio stays.
            let damping = self.gains.damping[at] * factor.max(0.0).sqrt() * wanted.damping;
            world.set_drive(
                character,
                node,
                Drive {
                    rotation: wanted.rotation,
                    velocity: wanted.velocity,
                    stiffness: self.gains.stiffness[at] * factor,
                    damping: damping.max(MIN_DAMPING * self.gains.damping[at]),
                    torque: wanted.torque,
                },
            );
        }
    }
}

/// Share of a joint's damping that is left when its gain is nothing: flesh \[1\].
const MIN_DAMPING: f64 = 0.05;
