//! The `[stage]` and `[camera]` tables.

use super::error::Fault;
use super::range::{count, number};
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_body::STANDARD_GRAVITY_M_S2;
use sinew_world::{Surface, WorldSettings};

/// Rates, gravity, floor: settings of the whole scene.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StageSpec {
    /// Physics steps a second \[Hz\], a multiple of `motion_hz`, 60 to 2000.
    pub physics_hz: u32,
    /// Wanted poses and written frames a second \[Hz\], 10 to 240.
    pub motion_hz: u32,
    /// Downward gravity \[m/s²\], 0 to 1000.
    pub gravity_m_s2: f64,
    /// Seed of all random choices.
    pub seed: u64,
    /// Default duration of a run \[s\], up to 3600.
    pub duration_secs: f64,
    /// Sub-steps of the solver in each physics step, 1 to 64: more make joints stiffer and cost more.
    pub solver_iterations: u32,
    /// The ground at height 0, or `false` for none.
    pub floor: FloorSpec,
    /// Files with more `[poses.NAME]` and `[graphs.NAME]`, relative to the scene's folder.
    pub pose_files: Vec<String>,
}

/// The ground.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected `false` for no floor, `true`, or `{ friction = 0.9, bounce = 0.0 }`")]
pub enum FloorSpec {
    /// `false` for none, `true` for the default one.
    Is(bool),
    /// Its friction and restitution.
    Surface(FloorSurface),
}

/// Friction and restitution of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct FloorSurface {
    /// Coefficient of friction, 0 to 10; between two surfaces the root of their product counts.
    pub friction: f64,
    /// Coefficient of restitution, 0 to 1; between two surfaces the larger counts.
    pub bounce: f64,
}

/// When and from where pictures are taken.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CameraSpec {
    /// Azimuth of the camera \[degrees about +Y from +Z to +X\]: 0 looks at the faces of characters that face +Z. Left out,
    /// the camera looks across the strongest push or hit, or else across the way that characters go.
    pub from_deg: Option<f64>,
    /// When pictures are taken \[s\]; when most happens if left out.
    pub times_secs: Vec<f64>,
}

impl Default for StageSpec {
    fn default() -> StageSpec {
        StageSpec {
            physics_hz: 240,
            motion_hz: 60,
            gravity_m_s2: STANDARD_GRAVITY_M_S2,
            seed: 1,
            duration_secs: 4.0,
            solver_iterations: 4,
            floor: FloorSpec::Is(true),
            pose_files: Vec::new(),
        }
    }
}

impl Default for FloorSurface {
    fn default() -> FloorSurface {
        FloorSurface { friction: Surface::FLOOR.friction, bounce: Surface::FLOOR.bounce }
    }
}

impl StageSpec {
    /// Settings of the world.
    pub fn world_settings(&self) -> WorldSettings {
        let floor = match self.floor {
            FloorSpec::Is(false) => None,
            FloorSpec::Is(true) => Some(Surface::FLOOR),
            FloorSpec::Surface(FloorSurface { friction, bounce }) => Some(Surface { friction, bounce }),
        };
        WorldSettings {
            physics_hz: f64::from(self.physics_hz),
            gravity_m_s2: self.gravity_m_s2,
            solver_iterations: self.solver_iterations as usize,
            floor,
            ..WorldSettings::default()
        }
    }

    /// Physics steps in each motion step.
    pub fn steps_per_frame(&self) -> u32 {
        self.physics_hz / self.motion_hz
    }

    pub(super) fn check(&self) -> Result<(), Fault> {
        let at = |key| ["stage", key];
        number(&at("physics_hz"), f64::from(self.physics_hz), 60.0..=2000.0, "steps a second are expected")?;
        number(&at("motion_hz"), f64::from(self.motion_hz), 10.0..=240.0, "frames a second are expected")?;
        if !self.physics_hz.is_multiple_of(self.motion_hz) {
            let problem = format!(
                "{} is no multiple of motion_hz = {}; write a multiple, such as {}",
                self.physics_hz,
                self.motion_hz,
                self.motion_hz * 4
            );
            return Err(Fault::at(&at("physics_hz"), problem));
        }
        number(
            &at("gravity_m_s2"),
            self.gravity_m_s2,
            0.0..=1000.0,
            "downward gravity in m/s² is expected, 9.81 on Earth",
        )?;
        number(&at("duration_secs"), self.duration_secs, 1e-3..=MAX_SECS, "seconds are expected")?;
        number(&at("solver_iterations"), f64::from(self.solver_iterations), 1.0..=64.0, "4 is usual")?;
        count(&at("pose_files"), self.pose_files.len(), 100)?;
        if let FloorSpec::Surface(surface) = self.floor {
            surface_check(&["stage", "floor"], Some(surface.friction), Some(surface.bounce))?;
        }
        Ok(())
    }
}

impl CameraSpec {
    pub(super) fn check(&self) -> Result<(), Fault> {
        if let Some(from_deg) = self.from_deg {
            number(&["camera", "from_deg"], from_deg, -360.0..=360.0, "degrees are expected")?;
        }
        count(&["camera", "times_secs"], self.times_secs.len(), 100)?;
        self.times_secs
            .iter()
            .try_for_each(|&time| number(&["camera", "times_secs"], time, 0.0..=MAX_SECS, "seconds are expected"))
    }
}

/// Maximum duration of a run \[s\].
pub(super) const MAX_SECS: f64 = 3600.0;

/// Checks friction and restitution.
pub(super) fn surface_check<S: ToString>(path: &[S], friction: Option<f64>, bounce: Option<f64>) -> Result<(), Fault> {
    let check = |key: &str, value: Option<f64>, most: f64, hint: &str| match value {
        Some(value) => number::<&str>(&[key], value, 0.0..=most, hint).map_err(|fault| fault.below(path)),
        None => Ok(()),
    };
    check("friction", friction, 10.0, "rubber has about 1, ice 0.05")?;
    check("bounce", bounce, 1.0, "0 does not bounce, 1 loses nothing")
}
