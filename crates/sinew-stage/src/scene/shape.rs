//! Collision shapes, for props and for parts.

use super::error::Fault;
use super::range::{count, number, vector};
use glam::{DQuat, DVec3};
use schemars::JsonSchema;
use serde::Deserialize;
use sinew_world::{Form, Solid};

/// A named shape, which the command `shape` gives to a part. It has exactly one of these keys.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ShapeSpec {
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
    /// Triangles, without an inside.
    pub mesh: Option<MeshSpec>,
    /// Position of its centre in the part's anatomical frame (x left, y up along the bone, z forward) \[m\].
    pub centre_m: [f64; 3],
    /// Its rotation: about x, then y, then z of the part \[degrees\].
    pub turn_deg: [f64; 3],
}

/// A capsule: a cylinder with round ends.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CapsuleSpec {
    /// Radius \[m\].
    pub radius_m: f64,
    /// Length without the round ends \[m\].
    pub length_m: f64,
    /// Its axis. Default: y.
    #[serde(default)]
    pub axis: AxisName,
}

/// A ring about the y axis, such as a basket's rim.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RingSpec {
    /// From the middle to the middle of the tube \[m\].
    pub radius_m: f64,
    /// Radius of the tube \[m\].
    pub tube_m: f64,
}

/// Triangles.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshSpec {
    /// The corners \[m\].
    pub points_m: Vec<[f64; 3]>,
    /// Three places in `points_m` each, counted from 0.
    pub triangles: Vec<[u32; 3]>,
}

/// An axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs, reason = "an axis")]
pub enum AxisName {
    X,
    #[default]
    Y,
    Z,
}

/// The six ways to state a form, of which one is filled.
pub(super) struct Forms<'a> {
    pub box_m: Option<[f64; 3]>,
    pub ball_radius_m: Option<f64>,
    pub capsule: Option<CapsuleSpec>,
    pub ring: Option<RingSpec>,
    pub hull_m: Option<&'a [[f64; 3]]>,
    pub mesh: Option<&'a MeshSpec>,
}

/// Which key states the form.
const FORMS: &str = "box_m, ball_radius_m, capsule, ring, hull_m, mesh";

impl ShapeSpec {
    /// The shape in the part's frame; `None` without a shape, which does not occur in a validated scene.
    pub fn solid(&self) -> Option<Solid> {
        let (form, turn) = self.forms().form()?;
        Some(Solid { form, centre: self.centre_m.into(), rotation: rotation(self.turn_deg) * turn })
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

    pub(super) fn check(&self, path: [&str; 2]) -> Result<(), Fault> {
        self.forms().check(&path)?;
        if self.mesh.is_some() {
            let problem = "a part moves, and a mesh of triangles has no inside; use hull_m with its corners";
            return Err(Fault::at(&[path[0], path[1], "mesh"], problem));
        }
        vector(&[path[0], path[1], "centre_m"], self.centre_m, 10.0, "metres in the part's frame are expected")?;
        vector(&[path[0], path[1], "turn_deg"], self.turn_deg, 360.0, "degrees are expected")
    }
}

impl Forms<'_> {
    /// The form, and the turn that lays a capsule along its axis.
    pub(super) fn form(&self) -> Option<(Form, DQuat)> {
        let points = |points: &[[f64; 3]]| points.iter().copied().map(DVec3::from).collect();
        let form = if let Some(size) = self.box_m {
            Form::Box { size_m: size.into() }
        } else if let Some(radius_m) = self.ball_radius_m {
            Form::Ball { radius_m }
        } else if let Some(CapsuleSpec { radius_m, length_m, axis }) = self.capsule {
            let along = [DVec3::X, DVec3::Y, DVec3::Z][axis as usize];
            return Some((Form::Capsule { radius_m, length_m }, DQuat::from_rotation_arc(DVec3::Y, along)));
        } else if let Some(RingSpec { radius_m, tube_m }) = self.ring {
            Form::Ring { radius_m, tube_m }
        } else if let Some(hull) = self.hull_m {
            Form::Hull { points_m: points(hull) }
        } else {
            let mesh = self.mesh?;
            Form::Mesh { points_m: points(&mesh.points_m), triangles: mesh.triangles.clone() }
        };
        Some((form, DQuat::IDENTITY))
    }

    /// Checks that there is exactly one shape with valid sizes.
    pub(super) fn check(&self, path: &[&str; 2]) -> Result<(), Fault> {
        let stated = [
            ("box_m", self.box_m.is_some()),
            ("ball_radius_m", self.ball_radius_m.is_some()),
            ("capsule", self.capsule.is_some()),
            ("ring", self.ring.is_some()),
            ("hull_m", self.hull_m.is_some()),
            ("mesh", self.mesh.is_some()),
        ];
        let stated: Vec<&str> = stated.into_iter().filter(|(_, is)| *is).map(|(key, _)| key).collect();
        match stated[..] {
            [_] => {}
            [] => return Err(Fault::at(path, format!("it has no shape; add one of {FORMS}"))),
            [first, second, ..] => {
                let problem = format!("`{first}` is stated already; keep one of the two");
                return Err(Fault::at(&[path[0], path[1], second], problem));
            }
        }
        let size = |keys: &[&str], value: f64| {
            let fault = number(keys, value, SIZES_M, "metres are expected, and a shape has some size");
            fault.map_err(|fault| fault.below(path))
        };
        for edge in self.box_m.into_iter().flatten() {
            size(&["box_m"], edge)?;
        }
        if let Some(radius) = self.ball_radius_m {
            size(&["ball_radius_m"], radius)?;
        }
        if let Some(capsule) = self.capsule {
            size(&["capsule", "radius_m"], capsule.radius_m)?;
            size(&["capsule", "length_m"], capsule.length_m)?;
        }
        if let Some(ring) = self.ring {
            size(&["ring", "radius_m"], ring.radius_m)?;
            size(&["ring", "tube_m"], ring.tube_m)?;
            if ring.tube_m >= ring.radius_m {
                let problem = "the tube is thicker than the ring; tube_m must be below radius_m";
                return Err(Fault::at(&[path[0], path[1], "ring", "tube_m"], problem));
            }
        }
        if let Some(points) = self.hull_m {
            points_check(points, 1_000).map_err(|fault| fault.below(&[path[0], path[1], "hull_m"]))?;
        }
        if let Some(mesh) = self.mesh {
            mesh.check().map_err(|fault| fault.below(&[path[0], path[1], "mesh"]))?;
        }
        Ok(())
    }
}

/// Sizes of shapes \[m\].
const SIZES_M: std::ops::RangeInclusive<f64> = 1e-3..=1e3;

impl MeshSpec {
    fn check(&self) -> Result<(), Fault> {
        points_check(&self.points_m, 20_000).map_err(|fault| fault.below(&["points_m"]))?;
        count(&["triangles"], self.triangles.len(), 40_000)?;
        if self.triangles.is_empty() {
            return Err(Fault::at(&["triangles"], "there are none; list three places in points_m for each"));
        }
        for (index, corners) in self.triangles.iter().enumerate() {
            if let Some(corner) = corners.iter().find(|&&corner| corner as usize >= self.points_m.len()) {
                let most = self.points_m.len().saturating_sub(1);
                let problem = format!("triangle {index} names point {corner}; points_m has 0 to {most}");
                return Err(Fault::at(&["triangles"], problem));
            }
        }
        Ok(())
    }
}

fn points_check(points: &[[f64; 3]], most: usize) -> Result<(), Fault> {
    count::<&str>(&[], points.len(), most)?;
    if points.len() < 3 {
        return Err(Fault::at::<&str>(&[], "fewer than three points; add the missing ones"));
    }
    points.iter().try_for_each(|&point| vector::<&str>(&[], point, *SIZES_M.end(), "metres are expected"))
}

/// The turn about x, then y, then z of what carries it \[degrees\].
pub(super) fn rotation(turn_deg: [f64; 3]) -> DQuat {
    let [x, y, z] = turn_deg.map(f64::to_radians);
    let about = |axis: DVec3, angle: f64| {
        let (sin, cos) = libm::sincos(angle / 2.0);
        DQuat::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos)
    };
    about(DVec3::Z, z) * about(DVec3::Y, y) * about(DVec3::X, x)
}
