//! Joint springs towards the wanted pose (Shapiro et al. 2007, EQ2 and EQ3).
//!
//! τ = k_s (θ_d − θ) − k_d θ̇ with k_s = k_sj k_sg k_sp: the joint's gain times the global gain times the pose's. EQ2 is printed
//! with (θ − θ_d), the sign of positive feedback. On a ball joint the error is the rotation vector from present to wanted. The
//! world integrates the springs implicitly.

use super::{Gains, Honours, JointGain, Tracker, TrackerKind, TrackerStart, Wants};
use crate::Wanted;
use sinew_body::humanoid::{Body, Node};
use sinew_world::{CharacterId, Drive, World, outboard_inertias};

/// Follows a target with joint springs; the root is not actuated.
#[derive(Clone, Debug)]
pub struct PdTracker {
    gains: Gains,
}

sinew_snapshot::snapshot!(PdTracker {} fixed { gains });

impl PdTracker {
    /// For a body in a world of this downward gravity \[m/s²\], with the spring of each joint by [`Node::index`].
    ///
    /// ```
    /// use sinew_body::humanoid::{Body, Node};
    /// use sinew_control::tracker::{JointGain, PdTracker};
    ///
    /// let body = Body::standard(80.0, 1.7);
    /// let on_earth = PdTracker::new(&body, &[JointGain::DEFAULT; Node::COUNT], 9.81);
    /// let on_the_moon = PdTracker::new(&body, &[JointGain::DEFAULT; Node::COUNT], 1.62);
    /// let ankle = Node::LeftFoot.index();
    /// assert!(on_the_moon.gains().stiffness[ankle] < 0.2 * on_earth.gains().stiffness[ankle], "it has less to carry");
    /// ```
    pub fn new(body: &Body, joints: &[JointGain; Node::COUNT], gravity_m_s2: f64) -> PdTracker {
        PdTracker::with(Gains::of(body, &outboard_inertias(body), joints, gravity_m_s2))
    }

    /// With stiffness and damping of every joint.
    pub fn with(gains: Gains) -> PdTracker {
        PdTracker { gains }
    }

    /// The joints' own springs.
    pub fn gains(&self) -> &Gains {
        &self.gains
    }

    /// See [`Tracker::honours`].
    pub const HONOURS: Honours = Honours { gains: true, torques: true, springs: true };
}

impl Tracker for PdTracker {
    fn cloned(&self) -> Box<dyn Tracker> {
        Box::new(self.clone())
    }

    fn kind(&self) -> TrackerKind {
        TrackerKind::Pd
    }

    fn honours(&self) -> Honours {
        PdTracker::HONOURS
    }

    fn wants(&self) -> Wants {
        Wants::Joints
    }

    fn start(&mut self, _: &TrackerStart, _: &mut World, _: CharacterId) {}

    fn follow(&mut self, wanted: &Wanted, world: &mut World, character: CharacterId) {
        for node in Node::ALL.into_iter().skip(1) {
            let at = node.index();
            let wanted = &wanted.joints[at];
            let factor = wanted.gain;
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

    /// The springs stay until another tracker changes them.
    fn release(&mut self, _: &mut World, _: CharacterId) {}
}

/// Remaining share of a joint's damping at gain 0, as of flesh \[1\].
const MIN_DAMPING: f64 = 0.05;
