//! Props: rigid bodies that characters touch, hold, stand on and are hit by.

use super::error::Fault;
use super::range::{colour, number, rgb, vector};
use super::shape::{CapsuleSpec, Forms, MeshSpec, RingSpec, rotation};
use super::stage::surface_check;
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_control::range;
use sinew_world::{Motion, Solid, Surface};

/// A prop. It has exactly one shape, and exactly one of `mass_kg`, `fixed`, `moving`; a sensor without them is fixed.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PropSpec {
    /// A box's full edge lengths along x, y, z \[m\].
    pub box_m: Option<[f64; 3]>,
    /// A ball's radius \[m\].
    pub ball_radius_m: Option<f64>,
    /// A capsule along an axis.
    pub capsule: Option<CapsuleSpec>,
    /// A ring about the y axis.
    pub ring: Option<RingSpec>,
    /// The convex hull of points \[m\], at least four that do not lie in a plane.
    pub hull_m: Option<Vec<[f64; 3]>>,
    /// A triangle mesh; only for fixed or moving props.
    pub mesh: Option<MeshSpec>,
    /// Its mass \[kg\], 1e-4 to 1e6: it is dynamic.
    pub mass_kg: Option<f64>,
    /// It never moves.
    pub fixed: bool,
    /// Kinematic: it moves as commanded and nothing stops it: a platform.
    pub moving: bool,
    /// Coefficient of friction, 0 to 10; 0.6 when left out.
    pub friction: Option<f64>,
    /// Coefficient of restitution, 0 to 1; 0.2 when left out.
    pub bounce: Option<f64>,
    /// Position of its centre at the start \[m\].
    pub position_m: [f64; 3],
    /// Its rotation at the start: about x, then y, then z of the world \[degrees\].
    pub turn_deg: [f64; 3],
    /// Its velocity at the start \[m/s\].
    pub velocity_m_s: [f64; 3],
    /// Its angular velocity at the start, in the world's axes \[rad/s\].
    pub spin_rad_s: [f64; 3],
    /// A sensor: detects contacts without collision response.
    pub sensor: bool,
    /// Factor on gravity; 1 when left out.
    pub gravity_scale: Option<f64>,
    /// Linear and angular damping \[1/s\].
    pub drag_per_s: f64,
    /// A Python controller that runs from the start, by name.
    pub controller: Option<String>,
    /// Its colour in pictures, `#rrggbb`.
    pub colour: Option<String>,
}

impl PropSpec {
    /// The shape about its origin; `None` without a shape, which does not occur in a validated scene.
    pub fn solid(&self) -> Option<Solid> {
        let (form, rotation) = self.forms().form()?;
        Some(Solid { form, centre: glam::DVec3::ZERO, rotation })
    }

    /// The kind of its motion.
    pub fn motion(&self) -> Motion {
        match self.mass_kg {
            Some(mass_kg) => Motion::Dynamic { mass_kg },
            None if self.moving => Motion::Moving,
            None => Motion::Fixed,
        }
    }

    /// The colour's red, green and blue.
    pub fn rgb(&self) -> Option<[u8; 3]> {
        self.colour.as_deref().and_then(rgb)
    }

    /// Its description for the world; `None` as for [`PropSpec::solid`].
    pub fn in_world(&self) -> Option<sinew_world::PropSpec> {
        let usual = sinew_world::PropSpec::new(self.solid()?, self.motion(), self.position_m.into());
        let surface = Surface {
            friction: self.friction.unwrap_or(usual.surface.friction),
            bounce: self.bounce.unwrap_or(usual.surface.bounce),
        };
        Some(sinew_world::PropSpec {
            surface,
            rotation: rotation(self.turn_deg),
            velocity: self.velocity_m_s.into(),
            spin: self.spin_rad_s.into(),
            is_sensor: self.sensor,
            gravity_scale: self.gravity_scale.unwrap_or(1.0),
            drag_per_s: self.drag_per_s,
            ..usual
        })
    }

    fn forms(&self) -> Forms<'_> {
        Forms {
            box_m: self.box_m,
            ball_radius_m: self.ball_radius_m,
            capsule: self.capsule,
            ring: self.ring,
            hull_m: self.hull_m.as_deref(),
            mesh: self.mesh.as_ref(),
        }
    }

    pub(super) fn check(&self, name: &str) -> Result<(), Fault> {
        let at = |key| ["props", name, key];
        self.forms().check(&["props", name])?;
        match (self.mass_kg, self.fixed, self.moving) {
            (Some(mass), false, false) => {
                number(&at("mass_kg"), mass, 1e-4..=1e6, "kilograms are expected")?;
                if self.mesh.is_some() {
                    let problem = "a mesh of triangles has no inside and cannot be pushed; write fixed = true in place of \
                                   mass_kg, or use hull_m with its corners";
                    return Err(Fault::at(&at("mesh"), problem));
                }
            }
            (None, true, false) | (None, false, true) => {}
            (None, false, false) if self.sensor => {}
            (None, false, false) => {
                let problem = "nothing says how it moves; add mass_kg, or fixed = true, or moving = true";
                return Err(Fault::at(&["props", name], problem));
            }
            (mass, ..) => {
                let (key, other) = if mass.is_some() { ("mass_kg", "fixed or moving") } else { ("moving", "fixed") };
                return Err(Fault::at(&at(key), format!("it is {other} already; keep one of mass_kg, fixed, moving")));
            }
        }
        if self.motion() == Motion::Fixed {
            for (key, value) in [("velocity_m_s", self.velocity_m_s), ("spin_rad_s", self.spin_rad_s)] {
                if value != [0.0; 3] {
                    return Err(Fault::at(
                        &at(key),
                        "it is fixed and cannot move; remove this, or write moving = true",
                    ));
                }
            }
        }
        surface_check(&["props", name], self.friction, self.bounce)?;
        vector(&at("position_m"), self.position_m, range::PLACE_M.max, "metres are expected")?;
        vector(&at("turn_deg"), self.turn_deg, 360.0, "degrees are expected")?;
        vector(&at("velocity_m_s"), self.velocity_m_s, range::VELOCITY_M_S.max, "metres a second are expected")?;
        vector(&at("spin_rad_s"), self.spin_rad_s, 1e3, "radians a second are expected")?;
        number(
            &at("gravity_scale"),
            self.gravity_scale.unwrap_or(1.0),
            range::GRAVITY_SCALE.inclusive(),
            "1 is as on Earth",
        )?;
        number(&at("drag_per_s"), self.drag_per_s, 0.0..=1e3, "0 is a vacuum, 1 halves a speed in 0.7 s")?;
        colour(&at("colour"), self.colour.as_deref())
    }
}
