//! A body part used as flywheel: its angular acceleration gives a moment of the ground.

use super::legs::smooth;

/// A planned rotation about one axis, which the joint follows.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flywheel {
    /// Angle \[rad\].
    pub angle: f64,
    /// Angular velocity \[rad/s\].
    pub speed: f64,
}

sinew_snapshot::snapshot!(Flywheel { angle, speed });

/// Parameters of a swing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swing {
    /// Moment of inertia \[kg m²\].
    pub inertia: f64,
    /// Wanted moment on it \[N m\].
    pub moment: f64,
    /// Weight of the moment against the return, 0 to 1.
    pub urgency: f64,
    /// Maximum angle \[rad\].
    pub room: f64,
    /// Return frequency \[rad/s\].
    pub omega: f64,
}

/// Look-ahead for braking before the maximum angle \[s\].
pub(super) const FORESIGHT_SECS: f64 = 0.15;

impl Flywheel {
    /// Advances by a step. Returns its moment \[N m\].
    pub fn step(&mut self, swing: &Swing, step_secs: f64) -> f64 {
        let coming = (self.angle + FORESIGHT_SECS * self.speed) * swing.moment.signum();
        let thrown = swing.urgency * (1.0 - smooth(2.0 * coming / swing.room - 1.0));
        let back = -swing.omega * (swing.omega * self.angle + 2.0 * self.speed);
        let acceleration = thrown * swing.moment / swing.inertia + (1.0 - thrown) * back;
        self.speed += acceleration * step_secs;
        self.angle += self.speed * step_secs;
        acceleration * swing.inertia
    }
}
