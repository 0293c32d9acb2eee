//! Ropes: rows of short capsules with ball joints between them.
//!
//! A rope's pieces are ordinary props, `NAME_1` to `NAME_12`: hands hold them, joints connect to them, and they have
//! contacts.

use super::error::Fault;
use super::range::{colour, number, vector};
use super::shape::{AxisName, CapsuleSpec};
use super::{PropSpec, SceneSpec};
use glam::DVec3;
use schemars::JsonSchema;
use serde::Deserialize;

/// A rope, straight at the start. Its ends are free until a joint or a hand holds them.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RopeSpec {
    /// Position of its first end at the start \[m\].
    pub from_m: [f64; 3],
    /// Position of its other end at the start \[m\].
    pub to_m: [f64; 3],
    /// How many pieces it is made of, 2 to 64; 12 when left out. Their props are `NAME_1`, `NAME_2` and so on.
    #[serde(default = "usual_pieces")]
    pub pieces: usize,
    /// Half its thickness \[m\]; 0.015 when left out.
    #[serde(default = "usual_radius")]
    pub radius_m: f64,
    /// Its mass \[kg\]; 0.5 when left out. It stretches if the mass is much less than a hundredth of its load.
    #[serde(default = "usual_mass")]
    pub mass_kg: f64,
    /// Its colour in pictures, `#rrggbb`.
    #[serde(default)]
    pub colour: Option<String>,
}

fn usual_pieces() -> usize {
    12
}

fn usual_radius() -> f64 {
    0.015
}

fn usual_mass() -> f64 {
    0.5
}

/// Damping of a piece's motion by air and fibres \[1/s\].
const DRAG_PER_S: f64 = 1.0;

impl RopeSpec {
    /// A piece's name, counted from 1.
    pub fn piece(rope: &str, number: usize) -> String {
        format!("{rope}_{number}")
    }

    /// Start of the piece of this number, counted from 1; that after the last one is the rope's end \[m\].
    pub fn joint(&self, number: usize) -> DVec3 {
        let (from, to) = (DVec3::from(self.from_m), DVec3::from(self.to_m));
        from + (to - from) * ((number - 1) as f64 / self.pieces as f64)
    }

    /// Pairs of pieces that are connected by additional rope joints: so a pull does not have to propagate joint by
    /// joint, which iterative solvers do slowly.
    pub fn spans(&self) -> Vec<(usize, usize)> {
        let mut spans = Vec::new();
        let mut reach = 2;
        while reach < self.pieces {
            spans.extend((1..=self.pieces - reach).map(|first| (first, first + reach)));
            reach *= 2;
        }
        spans
    }

    fn check(&self, name: &str) -> Result<(), Fault> {
        let at = |key| ["ropes", name, key];
        vector(&at("from_m"), self.from_m, 1e4, "metres are expected")?;
        vector(&at("to_m"), self.to_m, 1e4, "metres are expected")?;
        number(&at("pieces"), self.pieces as f64, 2.0..=64.0, "pieces of two to three times the thickness look round")?;
        number(&at("radius_m"), self.radius_m, 1e-3..=1.0, "metres are expected")?;
        number(&at("mass_kg"), self.mass_kg, 1e-3..=1e4, "kilograms are expected")?;
        let length = (DVec3::from(self.to_m) - DVec3::from(self.from_m)).length();
        if length / (self.pieces as f64) < self.radius_m {
            let problem = "its pieces are shorter than they are thick; write fewer pieces, or its ends farther apart";
            return Err(Fault::at(&at("pieces"), problem));
        }
        colour(&at("colour"), self.colour.as_deref())
    }
}

impl SceneSpec {
    /// Adds the pieces of all ropes to the props.
    pub(super) fn lay_ropes(&mut self) -> Result<(), Fault> {
        super::range::count(&["ropes"], self.ropes.len(), 64)?;
        for (name, rope) in &self.ropes {
            super::range::new_name(&["ropes", name], name)?;
            rope.check(name)?;
            let turn_deg = turned_to(rope.joint(2) - rope.joint(1));
            let length_m = (rope.joint(2) - rope.joint(1)).length();
            for number in 1..=rope.pieces {
                let piece = PropSpec {
                    capsule: Some(CapsuleSpec { radius_m: rope.radius_m, length_m, axis: AxisName::Y }),
                    mass_kg: Some(rope.mass_kg / rope.pieces as f64),
                    position_m: ((rope.joint(number) + rope.joint(number + 1)) / 2.0).into(),
                    turn_deg,
                    drag_per_s: DRAG_PER_S,
                    colour: rope.colour.clone(),
                    ..PropSpec::default()
                };
                if self.props.insert(RopeSpec::piece(name, number), piece).is_some() {
                    let problem = format!("a prop has the name of its piece `{name}_{number}`; rename one of the two");
                    return Err(Fault::at(&["ropes", name], problem));
                }
            }
        }
        Ok(())
    }
}

/// Turns about x, then y, then z that bring the y axis to a direction \[degrees\].
fn turned_to(along: DVec3) -> [f64; 3] {
    let direction = along.try_normalize().unwrap_or(DVec3::Y);
    // About x by θ, then z by φ: y becomes (-sin φ cos θ, cos φ cos θ, sin θ).
    let theta = libm::asin(direction.z.clamp(-1.0, 1.0));
    let phi = libm::atan2(-direction.x, direction.y);
    [theta.to_degrees(), 0.0, phi.to_degrees()]
}
