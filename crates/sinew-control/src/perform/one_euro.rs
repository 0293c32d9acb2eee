//! The One-Euro filter (Casiez, Roussel, Vogel 2012): a first-order low-pass whose cut-off rises with speed, so that a
//! body at rest does not jitter and a fast one does not lag.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};
use sinew_snapshot::snapshot;

/// Increase of the cut-off with speed \[Hz per m/s or rad/s\]: at a walk's 1.3 m/s the hips lag by 5 ms.
const BETA: f64 = 20.0;

/// Cut-off of the speed's own low-pass \[Hz\].
const SPEED_HZ: f64 = 5.0;

/// Filters poses at the rate of the physics.
#[derive(Clone, Debug)]
pub(super) struct OneEuro {
    smoothing_hz: f64,
    /// Low-passed velocity of the hips and angular velocities of the joints.
    speeds: [DVec3; 1 + Node::COUNT],
}

snapshot!(OneEuro { speeds } fixed { smoothing_hz });

impl OneEuro {
    pub fn new(smoothing_hz: f64) -> OneEuro {
        OneEuro { smoothing_hz, speeds: [DVec3::ZERO; 1 + Node::COUNT] }
    }

    /// The next filtered pose, from the previous one.
    pub fn next(&mut self, before: &Pose, raw: &Pose, step_secs: f64) -> Pose {
        if self.smoothing_hz <= 0.0 {
            return *raw;
        }
        let mut share = |slot: usize, difference: DVec3| {
            let speed = &mut self.speeds[slot];
            *speed = speed.lerp(difference / step_secs, weight(SPEED_HZ, step_secs));
            weight(self.smoothing_hz + BETA * speed.length(), step_secs)
        };
        let moved = raw.hips_position - before.hips_position;
        let hips_position = before.hips_position + moved * share(0, moved);
        let locals = Node::ALL.map(|node| {
            let from = before.local(node);
            let turned = log((from.conjugate() * raw.local(node)).normalize());
            let turned = turned * share(1 + node.index(), turned);
            normalized(from * exp(turned))
        });
        Pose::from_locals(hips_position, &locals)
    }
}

fn normalized(rotation: DQuat) -> DQuat {
    rotation.normalize()
}

/// Share of the new value of a low-pass of this cut-off.
fn weight(cutoff_hz: f64, step_secs: f64) -> f64 {
    let turned = std::f64::consts::TAU * cutoff_hz * step_secs;
    turned / (1.0 + turned)
}
