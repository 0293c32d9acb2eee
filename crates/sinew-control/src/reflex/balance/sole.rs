//! A foot as support.

use super::polygon::{Polygon, flat};
use crate::Wanted;
use glam::{DQuat, DVec2, DVec3};
use sinew_body::humanoid::{Body, LEGS, Node};
use sinew_snapshot::snapshot;
use sinew_world::{BodyState, Form, part_solid};

/// The underside of a foot, in the foot's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sole {
    corners: [DVec3; 4],
    middle: DVec3,
}

/// A sole in the world.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Footing {
    /// Corners of the region for the centre of pressure.
    pub corners: [DVec2; 4],
    /// Resting point of the weight in quiet standing.
    pub rest: DVec2,
    /// Height of the sole \[m\].
    pub height_m: f64,
    /// `world_from_foot` of the flat foot.
    pub level: DQuat,
    /// Position of the ankle \[m\].
    pub ankle: DVec3,
}

snapshot!(Footing { corners, rest, height_m, level, ankle });

impl Sole {
    /// Of a body. `margin_m` is left at all edges; the weight rests at `rest_share` of the length, from the heel.
    pub fn of(body: &Body, foot: Node, margin_m: f64, rest_share: f64) -> Sole {
        let solid = part_solid(body, foot);
        let size = match solid.form {
            Form::Box { size_m } => size_m,
            _ => DVec3::new(0.08, 0.05, 0.22) * (body.stature_m() / 1.7),
        };
        let inner = DVec3::new((0.5 * size.x - margin_m).max(0.0), 0.5 * size.y, (0.5 * size.z - margin_m).max(0.0));
        let corner = |x: f64, z: f64| solid.centre + DVec3::new(x, -1.0, z) * inner;
        Sole {
            corners: [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
            middle: solid.centre + DVec3::new(0.0, -0.5 * size.y, (rest_share - 0.5) * size.z),
        }
    }

    /// Height of the sole relative to the hips in the wanted pose with upright hips \[m\].
    pub fn meant_height_m(&self, body: &Body, target: &Wanted, side: usize) -> f64 {
        let (upper, lower, foot) = LEGS[side];
        let (mut place, mut turn) = (DVec3::ZERO, DQuat::IDENTITY);
        for node in [upper, lower, foot] {
            place += turn * body.link(node).offset;
            turn *= target.joint(node).rotation;
        }
        (place + turn * self.middle).y
    }

    /// Under a foot.
    pub fn under(&self, foot: &BodyState) -> Footing {
        let place = |point: DVec3| foot.position + foot.rotation * point;
        let ahead = foot.rotation * DVec3::Z;
        let level = DQuat::from_axis_angle(DVec3::Y, libm::atan2(ahead.x, ahead.z));
        Footing {
            corners: self.corners.map(|corner| flat(place(corner))),
            rest: flat(place(self.middle)),
            height_m: place(self.middle).y,
            level,
            ankle: foot.position,
        }
    }
}

impl Footing {
    /// The point of the sole nearest to a point.
    pub fn nearest(&self, point: DVec2) -> DVec2 {
        Polygon::hull(&self.corners).nearest(point)
    }
}
