//! A clip's body as capsules for pictures and files.

use sinew_body::humanoid::{Node, Shape};
use sinew_motion::Transform;
use sinew_motion::formats::BodyShape;
use sinew_picture::{Capsule, Figure, Shade};

/// The body's capsules in the world, for a picture; `world` is the `world_from_joint` of all joints.
pub fn figure(shapes: &[(Node, usize, Shape)], world: &[Transform]) -> Figure {
    let capsules = shapes.iter().map(|(node, joint, shape)| {
        let place = |point| world[*joint].point(point);
        let shade = match node.part().side() {
            Some(sinew_motion::Side::Left) => Shade::Left,
            Some(sinew_motion::Side::Right) => Shade::Right,
            None => Shade::Midline,
        };
        Capsule::tapered(place(shape.from), place(shape.to), shape.from_radius_m, shape.to_radius_m, shade)
    });
    Figure::new(capsules.collect())
}

/// The same for a glTF file.
pub fn body_shapes(shapes: &[(Node, usize, Shape)]) -> Vec<BodyShape> {
    let shape = |(_, joint, shape): &(Node, usize, Shape)| BodyShape {
        joint: *joint,
        from: shape.from,
        to: shape.to,
        radius_m: 0.5 * (shape.from_radius_m + shape.to_radius_m),
    };
    shapes.iter().map(shape).collect()
}
