//! Interpolates poses at the motion's rate to poses at the physics rate, without looking ahead.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Node, Pose, exp, log};

/// The interpolation between two motion frames: a cubic that starts with the final velocity of the previous frame.
///
/// A cubic needs the velocity at its end too, before the frame after it is known: it is estimated from the last three
/// poses (the second-order backward difference), so that velocities are continuous and nothing lags.
#[derive(Clone, Debug)]
pub(crate) struct PoseInterpolator {
    from: Pose,
    to: Pose,
    hips: Cubic,
    turns: [Cubic; Node::COUNT],
}

/// A vector that grows from zero: its value at the end, and its slopes at both ends \[per motion frame\].
#[derive(Clone, Copy, Debug, Default)]
struct Cubic {
    value: DVec3,
    slopes: [DVec3; 2],
}

sinew_snapshot::snapshot!(PoseInterpolator { from, to, hips, turns });
sinew_snapshot::snapshot!(Cubic { value, slopes });

impl Cubic {
    fn at(&self, fraction: f64) -> DVec3 {
        let (t, t2, t3) = (fraction, fraction * fraction, fraction * fraction * fraction);
        self.value * (3.0 * t2 - 2.0 * t3) + self.slopes[0] * (t3 - 2.0 * t2 + t) + self.slopes[1] * (t3 - t2)
    }
}

impl PoseInterpolator {
    /// At rest in a pose.
    pub(crate) fn rest(pose: &Pose) -> PoseInterpolator {
        PoseInterpolator { from: *pose, to: *pose, hips: Cubic::default(), turns: [Cubic::default(); Node::COUNT] }
    }

    /// In a pose, moving as from the pose one motion frame before it.
    pub(crate) fn moving(before: &Pose, now: &Pose) -> PoseInterpolator {
        let evenly = |value: DVec3| Cubic { value, slopes: [value; 2] };
        PoseInterpolator {
            from: *before,
            to: *now,
            hips: evenly(now.hips_position - before.hips_position),
            turns: std::array::from_fn(|at| evenly(log(before.world[at].conjugate() * now.world[at]))),
        }
    }

    /// Advances to the pose of the next motion frame.
    pub(crate) fn next(&mut self, to: &Pose) {
        let shift = to.hips_position - self.to.hips_position;
        let before = self.from.hips_position - self.to.hips_position;
        self.hips = Cubic { value: shift, slopes: [self.hips.slopes[1], end_slope(shift, before)] };
        for at in 0..Node::COUNT {
            let here = self.to.world[at].conjugate();
            let turn = log(here * to.world[at]);
            let before = log(here * self.from.world[at]);
            // The slope of a rotation vector is an angular velocity only where the vector is zero, at the start.
            let slope = turned_slope(&self.turns[at]);
            self.turns[at] = Cubic { value: turn, slopes: [slope, end_slope(turn, before)] };
        }
        (self.from, self.to) = (self.to, *to);
    }

    /// The pose at a fraction of the motion frame, 0 to 1.
    pub(crate) fn at(&self, fraction: f64) -> Pose {
        let fraction = fraction.clamp(0.0, 1.0);
        Pose {
            hips_position: self.from.hips_position + self.hips.at(fraction),
            world: std::array::from_fn(|at| turned(self.from.world[at], self.turns[at].at(fraction))),
        }
    }

    /// The pose at the end of the motion frame.
    pub(crate) fn end(&self) -> &Pose {
        &self.to
    }
}

fn turned(rotation: DQuat, turn: DVec3) -> DQuat {
    (rotation * exp(turn)).normalize()
}

/// Slope at the end of the way from 0 to `shift`, when the way before led from `before` to 0.
fn end_slope(shift: DVec3, before: DVec3) -> DVec3 {
    shift * 1.5 + before * 0.5
}

/// The angular velocity at the end of a turn, in the frame of its end \[rad per motion frame\]: the right Jacobian of the
/// exponential, to second order.
fn turned_slope(turn: &Cubic) -> DVec3 {
    let (r, slope) = (turn.value, turn.slopes[1]);
    let cross = r.cross(slope);
    slope - cross * 0.5 + r.cross(cross) * (1.0 / 6.0)
}

/// The pose before one, extrapolated from it and the next.
pub(crate) fn led_to(now: &Pose, next: &Pose) -> Pose {
    let mut pose = *now;
    pose.hips_position += pose.hips_position - next.hips_position;
    for (rotation, next) in pose.world.iter_mut().zip(next.world) {
        *rotation = (*rotation * next.conjugate() * *rotation).normalize();
    }
    pose
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pose in full swing, `at` in motion frames.
    fn swing(at: f64) -> Pose {
        let phase = at / 60.0 * 4.0;
        let locals = Node::ALL.map(|node| {
            let lag = node.index() as f64;
            exp(DVec3::new(libm::sin(phase + lag), 0.3 * libm::cos(phase), 0.5 * libm::sin(2.0 * phase + lag)))
        });
        Pose::from_locals(DVec3::new(libm::sin(phase), 0.9, 1.3 * at / 60.0), &locals)
    }

    #[test]
    fn between_frames_a_smooth_motion_is_met() {
        let mut interpolator = PoseInterpolator::rest(&swing(0.0));
        let mut worst: f64 = 0.0;
        for frame in 1..120 {
            interpolator.next(&swing(f64::from(frame)));
            for step in 1..=4 {
                let fraction = f64::from(step) / 4.0;
                let (ours, theirs) = (interpolator.at(fraction), swing(f64::from(frame - 1) + fraction));
                if frame > 4 {
                    worst = worst.max((ours.hips_position - theirs.hips_position).length());
                    for at in 0..Node::COUNT {
                        worst = worst.max(log(ours.world[at].conjugate() * theirs.world[at]).length());
                    }
                }
            }
        }
        // A third of a degree per radian of swing: third derivatives of 1.5 rad at 4 and 8 rad/s, times (1/60 s)³ / 12.
        assert!(worst < 5e-4, "{worst}");
    }

    #[test]
    fn velocities_have_no_steps_where_frames_meet() {
        let mut interpolator = PoseInterpolator::rest(&swing(0.0));
        let mut last: Option<(DVec3, DVec3)> = None;
        let tiny = 1e-4;
        for frame in 1..60 {
            interpolator.next(&swing(f64::from(frame)));
            let velocity = |from: f64, to: f64| {
                let (a, b) = (interpolator.at(from), interpolator.at(to));
                let hand = Node::LeftHand.index();
                ((b.hips_position - a.hips_position) / tiny, log(b.world[hand] * a.world[hand].conjugate()) / tiny)
            };
            let begins = velocity(0.0, tiny);
            if let Some(ended) = last {
                // Second differences over 1e-4 of a frame, and the Jacobian's third-order term.
                assert!((begins.0 - ended.0).length() < 1e-4, "{frame}");
                assert!((begins.1 - ended.1).length() < 1e-3, "{frame}");
            }
            last = Some(velocity(1.0 - tiny, 1.0));
        }
    }
}
