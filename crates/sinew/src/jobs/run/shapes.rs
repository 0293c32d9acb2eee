//! Bodies and solids as the shapes of a picture.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_motion::Side;
use sinew_picture::{Capsule, Colour, Cuboid, Figure, Shade};
use sinew_world::{Form, Solid, part_solid, ring_corners};

/// Adds what a character looks like in a pose: tapered limbs, and feet as the boxes that they collide as. With a colour the trunk has
/// it.
pub fn body_figure(figure: &mut Figure, body: &Body, pose: &Pose, rgb: Option<[u8; 3]>) {
    let positions = pose.positions(body);
    for node in Node::ALL {
        let shade = match node.part().side() {
            Some(Side::Left) => Shade::Left,
            Some(Side::Right) => Shade::Right,
            None => rgb.map_or(Shade::Midline, custom),
        };
        let (position, rotation) = (positions[node.index()], pose.world[node.index()]);
        if matches!(node, Node::LeftFoot | Node::RightFoot) {
            add_solid(figure, &part_solid(body, node), (position, rotation), shade);
            continue;
        }
        let link = body.link(node).shape;
        let place = |point: DVec3| position + rotation * point;
        let (from, to) = (place(link.from), place(link.to));
        figure.capsules.push(Capsule::tapered(from, to, link.from_radius_m, link.to_radius_m, shade));
    }
}

/// Adds a solid at a place, `world_from_carrier`: balls, capsules, rings and boxes as they are, a mesh or hull as its edges.
pub(super) fn add_solid(figure: &mut Figure, solid: &Solid, (position, rotation): (DVec3, DQuat), shade: Shade) {
    let place = |point: DVec3| position + rotation * (solid.centre + solid.rotation * point);
    let line = |from: DVec3, to: DVec3, radius_m: f64| Capsule::new(place(from), place(to), radius_m, shade);
    match &solid.form {
        Form::Ball { radius_m } => figure.capsules.push(line(DVec3::ZERO, DVec3::ZERO, *radius_m)),
        Form::Capsule { radius_m, length_m } => {
            let half = DVec3::Y * (length_m / 2.0);
            figure.capsules.push(line(-half, half, *radius_m));
        }
        Form::Ring { radius_m, tube_m } => {
            let corners = ring_corners(*radius_m);
            let piece = |at: usize| line(corners[at], corners[(at + 1) % corners.len()], *tube_m);
            figure.capsules.extend((0..corners.len()).map(piece));
        }
        Form::Box { size_m } => figure.boxes.push(Cuboid {
            centre: place(DVec3::ZERO),
            rotation: rotation * solid.rotation,
            size_m: *size_m,
            shade,
        }),
        Form::Mesh { .. } | Form::Hull { .. } => {
            let place = |point: DVec3| position + rotation * point;
            let edge = |(from, to, radius_m)| Capsule::new(place(from), place(to), radius_m, shade);
            figure.capsules.extend(edges(solid).into_iter().map(edge));
        }
    }
}

/// The edges of a mesh, or lines from the middle of a hull to its points, as capsules in the carrier's frame; nothing of other forms.
pub(super) fn edges(solid: &Solid) -> Vec<(DVec3, DVec3, f64)> {
    let place = |point: DVec3| solid.centre + solid.rotation * point;
    match &solid.form {
        Form::Mesh { points_m, triangles } => {
            let ends = triangles.iter().flat_map(|at| [(at[0], at[1]), (at[1], at[2]), (at[2], at[0])]);
            let point = |at: u32| points_m.get(at as usize).copied().map(place);
            ends.filter_map(|(from, to)| Some((point(from)?, point(to)?, EDGE_M))).collect()
        }
        Form::Hull { points_m } => {
            let middle = place(points_m.iter().sum::<DVec3>() / points_m.len().max(1) as f64);
            points_m.iter().map(|point| (middle, place(*point), EDGE_M)).collect()
        }
        _ => Vec::new(),
    }
}

/// A scene's colour in a picture.
pub(crate) fn custom([red, green, blue]: [u8; 3]) -> Shade {
    Shade::Custom(Colour::hex(u32::from(red) << 16 | u32::from(green) << 8 | u32::from(blue)))
}

/// Half the thickness of a shown edge \[m\].
const EDGE_M: f64 = 0.01;
