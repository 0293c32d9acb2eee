//! Nearest points on the surface of a prop.

use crate::{CharacterId, Entity, PropId, World};
use glam::DVec3;
use rapier3d_f64::prelude::RigidBodyHandle;
use sinew_body::humanoid::Node;

/// The point of a prop's surface that is nearest to a point of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its position \[m\].
    pub surface: DVec3,
    /// Signed distance from the point to it \[m\]; negative inside the prop. A triangle mesh has no inside.
    pub distance_m: f64,
    /// Unit vector out of the prop there.
    pub outward: DVec3,
}

impl World {
    /// The point of a prop's surface nearest to a point; `None` if the prop does not exist or the point is not finite.
    pub fn nearest_on_prop(&self, prop: PropId, point: DVec3) -> Option<Nearest> {
        self.nearest_on(self.props.get(prop)?.handle, point)
    }

    /// The thing whose surface is nearest to a part's centre of mass and no farther from it than this \[m\]: a prop
    /// that is not a sensor, or another character's part.
    pub fn nearest_to_part(&self, character: CharacterId, node: Node, within_m: f64) -> Option<Entity> {
        let centre = self.frame.character(character)?.part(node).centre;
        let props = self.props.iter().filter(|(_, prop)| !prop.spec.is_sensor);
        let props = props.map(|(id, prop)| (Entity::Prop(id), prop.handle));
        let others = self.characters.iter().filter(|(id, _)| *id != character);
        let parts = others.flat_map(|(id, other)| {
            Node::ALL.into_iter().zip(other.bodies).map(move |(part, handle)| (Entity::Part(id, part), handle))
        });
        let near = props.chain(parts).filter_map(|(thing, handle)| {
            let nearest = self.nearest_on(handle, centre)?;
            (nearest.distance_m <= within_m).then_some((thing, nearest.distance_m))
        });
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(thing, _)| thing)
    }

    fn nearest_on(&self, handle: RigidBodyHandle, point: DVec3) -> Option<Nearest> {
        let body = self.engine.bodies.get(handle)?;
        let collider = self.engine.colliders.get(*body.colliders().first()?)?;
        if !point.is_finite() {
            return None;
        }
        // By the body: a collider follows it only in the next step.
        let place = match collider.position_wrt_parent() {
            Some(own) => *body.position() * *own,
            None => *body.position(),
        };
        let found = collider.shape().project_point(&place, point, false);
        let gap = point - found.point;
        let (distance_m, outward) = if found.is_inside { (-gap.length(), -gap) } else { (gap.length(), gap) };
        let outward = outward.try_normalize().or_else(|| (point - place.translation).try_normalize())?;
        Some(Nearest { surface: found.point, distance_m, outward })
    }
}

#[cfg(test)]
mod tests {
    use crate::{Form, Motion, PropId, PropSpec, Solid, World, WorldSettings};
    use glam::DVec3;

    #[test]
    fn a_box_is_as_near_as_its_faces_and_corners_from_outside_and_inside() {
        let mut world = World::new(WorldSettings::default());
        let solid = Solid::new(Form::Box { size_m: DVec3::new(2.0, 1.0, 1.0) });
        let prop = world.add_prop(PropSpec::new(solid, Motion::Fixed, DVec3::new(5.0, 0.5, 0.0))).expect("a box");
        let beside = world.nearest_on_prop(prop, DVec3::new(3.0, 0.5, 0.2)).expect("a prop");
        assert!((beside.distance_m - 1.0).abs() < 1e-12 && (beside.outward + DVec3::X).length() < 1e-12);
        let corner = world.nearest_on_prop(prop, DVec3::new(9.0, 5.0, 0.5)).expect("a prop");
        assert!((corner.surface - DVec3::new(6.0, 1.0, 0.5)).length() < 1e-12);
        assert!((corner.distance_m - 5.0).abs() < 1e-12);
        let inside = world.nearest_on_prop(prop, DVec3::new(5.0, 0.9, 0.0)).expect("a prop");
        assert!((inside.distance_m + 0.1).abs() < 1e-12 && (inside.outward - DVec3::Y).length() < 1e-12);
        assert_eq!(world.nearest_on_prop(PropId::first_in(1), DVec3::ZERO), None);
    }
}
