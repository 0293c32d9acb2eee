//! Settings of the world.

use serde::{Deserialize, Serialize};
use sinew_body::STANDARD_GRAVITY_M_S2;

/// Settings of a world, fixed when it is made. A number beyond its range is clamped to it, and one that is NaN or infinite is
/// replaced by its default.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldSettings {
    /// Physics steps a second \[Hz\], 60 to 2000, default 240. Below about 120 stiff joints sag.
    pub physics_hz: f64,
    /// Downward gravity \[m/s²\], −1000 to 1000, default 9.81. The strength of joint limits follows it.
    pub gravity_m_s2: f64,
    /// Sub-steps of the solver in each step, 1 to 64, default 4. Joint gaps shrink with its square, cost grows with it.
    pub solver_iterations: usize,
    /// Sweeps over all joints and contacts in each sub-step, 1 to 64, default 6. Below 6 a standing body's feet jitter by
    /// centimetres a second.
    pub solver_sweeps: usize,
    /// The ground: a plane at height 0 with this friction and bounce; `None` for none. Default [`Surface::FLOOR`].
    pub floor: Option<Surface>,
}

/// Friction and restitution of a surface. Numbers beyond their range are clamped, NaN counts as 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Coefficient of friction \[1\], 0 to 10; between two surfaces √(μ₁ μ₂) counts: on ice everything slides.
    pub friction: f64,
    /// Coefficient of restitution \[1\], 0 to 1; between two surfaces the larger counts.
    pub bounce: f64,
}

impl Default for WorldSettings {
    fn default() -> WorldSettings {
        WorldSettings {
            physics_hz: 240.0,
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            solver_iterations: 4,
            solver_sweeps: 6,
            floor: Some(Surface::FLOOR),
        }
    }
}

impl Surface {
    /// A gym's floor.
    pub const FLOOR: Surface = Surface { friction: 0.9, bounce: 0.0 };
    /// Skin, cloth and rubber soles.
    pub const BODY: Surface = Surface { friction: 0.9, bounce: 0.0 };
}

impl WorldSettings {
    /// Length of a step \[s\].
    pub fn step_secs(&self) -> f64 {
        1.0 / self.physics_hz
    }
}
