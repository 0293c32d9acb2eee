//! A part of the body that is swung so that the ground pushes back.

use super::legs::smooth;

/// A turn about one axis, planned ahead of the joint that follows it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Flywheel {
    /// How far it is turned \[rad\].
    pub angle: f64,
    /// How fast \[rad/s\].
    pub speed: f64,
}

sinew_snapshot::snapshot!(Flywheel { angle, speed });

/// How a flywheel is swung.
#[derive(Clone, Copy, Debug)]
pub(super) struct Swing {
    /// Moment of inertia \[kg m²\].
    pub inertia: f64,
    /// Wanted moment on it \[N m\].
    pub moment: f64,
    /// How much the moment matters over coming back, 0 to 1.
    pub urgency: f64,
    /// How far it may turn \[rad\].
    pub room: f64,
    /// Frequency with which it comes back \[rad/s\].
    pub omega: f64,
}

/// A turn is slowed down when it would be out of its room after so long \[s\].
pub(super) const FORESIGHT_SECS: f64 = 0.15;

impl Flywheel {
    /// Goes on by a step. Returns the moment that it takes \[N m\].
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
