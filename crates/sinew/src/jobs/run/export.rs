//! A recording as clips and tables.

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_motion::formats::BodyShape;
use sinew_motion::{Clip, Joint, Skeleton, Transform};
use sinew_stage::{RecordedCharacter, Recording};
use sinew_world::{Form, Solid, part_solid, ring_corners};
use std::fmt::Write;

/// One character's motion as a clip of the 18 bodies, joints named as VRM bones.
pub fn character_clip(recording: &Recording, character: &RecordedCharacter) -> Clip {
    let mut skeleton = Skeleton::new();
    push_character(&mut skeleton, character, "");
    let mut clip = Clip::new(skeleton, 1.0 / recording.motion_hz, vec![0]);
    for pose in &character.poses {
        clip.push(&locals(&character.body, pose));
    }
    clip
}

/// All characters and props in one clip, names as `left:hips`, and what each looks like.
pub fn scene_clip(recording: &Recording) -> (Clip, Vec<BodyShape>) {
    let mut skeleton = Skeleton::new();
    let (mut moving, mut shapes) = (Vec::new(), Vec::new());
    for character in &recording.characters {
        let first = push_character(&mut skeleton, character, &format!("{}:", character.name));
        moving.push(first);
        shapes.extend(body_shapes(&character.body, first));
    }
    for prop in &recording.props {
        let (position, rotation) = prop.places.first().copied().unwrap_or((DVec3::ZERO, DQuat::IDENTITY));
        let rest = Transform::new(rotation, position);
        let joint = skeleton.push(Joint { name: prop.name.clone(), parent: None, rest, tip: None });
        moving.push(joint);
        if !prop.is_sensor {
            shapes.extend(capsules(&prop.solid).into_iter().map(|(from, to, radius_m)| BodyShape {
                joint,
                from,
                to,
                radius_m,
            }));
        }
    }
    let mut clip = Clip::new(skeleton, 1.0 / recording.motion_hz, moving);
    for frame in 0..recording.frames {
        let mut all = Vec::new();
        for character in &recording.characters {
            all.extend(locals(&character.body, &character.poses[frame]));
        }
        all.extend(recording.props.iter().map(|prop| {
            let (position, rotation) = prop.places[frame];
            Transform::new(rotation, position)
        }));
        clip.push(&all);
    }
    (clip, shapes)
}

/// The capsules of a body, its hips being joint `first` of the clip.
pub fn body_shapes(body: &Body, first: usize) -> Vec<BodyShape> {
    let shapes = Node::ALL.into_iter().flat_map(|node| {
        capsules(&part_solid(body, node)).into_iter().map(move |(from, to, radius_m)| BodyShape {
            joint: first + node.index(),
            from,
            to,
            radius_m,
        })
    });
    shapes.collect()
}

fn push_character(skeleton: &mut Skeleton, character: &RecordedCharacter, prefix: &str) -> usize {
    let first = skeleton.len();
    for node in Node::ALL {
        let link = character.body.link(node);
        let leaf = !Node::ALL.iter().any(|other| other.parent() == Some(node));
        let rest = match node.parent() {
            Some(_) => Transform::new(DQuat::IDENTITY, link.offset),
            None => character.poses.first().map_or(Transform::IDENTITY, |pose| {
                Transform::new(DQuat::IDENTITY, DVec3::new(0.0, pose.hips_position.y, 0.0))
            }),
        };
        skeleton.push(Joint {
            name: format!("{prefix}{}", node.part().name()),
            parent: node.parent().map(|parent| first + parent.index()),
            rest,
            tip: leaf.then_some(link.tip),
        });
    }
    first
}

fn locals(body: &Body, pose: &Pose) -> [Transform; Node::COUNT] {
    Node::ALL.map(|node| match node.parent() {
        Some(_) => Transform::new(pose.local(node).normalize(), body.link(node).offset),
        None => Transform::new(pose.local(node).normalize(), pose.hips_position),
    })
}

/// A solid as capsules: exact for balls, capsules and rings; a box as bars over its faces.
pub fn capsules(solid: &Solid) -> Vec<(DVec3, DVec3, f64)> {
    let place = |point: DVec3| solid.centre + solid.rotation * point;
    let line = |from: DVec3, to: DVec3, radius: f64| (place(from), place(to), radius);
    match &solid.form {
        Form::Ball { radius_m } => vec![line(DVec3::ZERO, DVec3::ZERO, *radius_m)],
        Form::Capsule { radius_m, length_m } => {
            let half = DVec3::Y * (length_m / 2.0);
            vec![line(-half, half, *radius_m)]
        }
        Form::Ring { radius_m, tube_m } => {
            let corners = ring_corners(*radius_m);
            (0..corners.len()).map(|at| line(corners[at], corners[(at + 1) % corners.len()], *tube_m)).collect()
        }
        Form::Box { size_m } => boxed(*size_m).into_iter().map(|(from, to, radius)| line(from, to, radius)).collect(),
        Form::Mesh { points_m, triangles } => {
            let edges = triangles.iter().take(MAX_EDGES / 3).flat_map(|corners| {
                [(0, 1), (1, 2), (2, 0)].map(|(from, to)| (corners[from] as usize, corners[to] as usize))
            });
            let edge = |(from, to): (usize, usize)| Some(line(*points_m.get(from)?, *points_m.get(to)?, EDGE_M));
            edges.filter_map(edge).collect()
        }
        Form::Hull { points_m } => {
            let middle = points_m.iter().sum::<DVec3>() / points_m.len().max(1) as f64;
            points_m.iter().take(MAX_EDGES).map(|point| line(middle, *point, EDGE_M)).collect()
        }
    }
}

/// Edges of a mesh that are shown.
const MAX_EDGES: usize = 600;

/// Half the thickness of a shown edge \[m\].
const EDGE_M: f64 = 0.01;

/// A box as bars side by side over its faces; a plate as one layer of bars.
fn boxed(size: DVec3) -> Vec<(DVec3, DVec3, f64)> {
    let radius = (size.min_element() / 2.0).min(size.max_element() * EDGE_SHARE);
    let reach = (size / 2.0 - radius).max(DVec3::ZERO).to_array();
    let unit = |axis: usize| DVec3::AXES[axis];
    let mut bars = Vec::new();
    for normal in 0..3 {
        let (one, other) = ((normal + 1) % 3, (normal + 2) % 3);
        let (long, across) = if reach[one] >= reach[other] { (one, other) } else { (other, one) };
        if reach[normal] > 0.0 && (reach[one] == 0.0 || reach[other] == 0.0) {
            // A plate's or a stick's narrow side: its broad ones show all of it.
            continue;
        }
        let sides: &[f64] = if reach[normal] == 0.0 { &[0.0] } else { &[-1.0, 1.0] };
        // A radius apart, so that the surface looks closed.
        let gaps = ((2.0 * reach[across] / radius).ceil() as usize).clamp(usize::from(reach[across] > 0.0), 60);
        for side in sides {
            for bar in 0..=gaps {
                let at = if gaps == 0 { 0.0 } else { 2.0 * bar as f64 / gaps as f64 - 1.0 };
                let middle = unit(normal) * (side * reach[normal]) + unit(across) * (at * reach[across]);
                bars.push((middle - unit(long) * reach[long], middle + unit(long) * reach[long], radius));
            }
        }
        if reach[normal] == 0.0 {
            break;
        }
    }
    bars
}

/// Rounding of a shown box's edges, relative to its longest edge \[1\].
const EDGE_SHARE: f64 = 0.06;

/// A recording as a table: time, then place and rotation of every body, one row a frame; of one character alone when `only` names
/// it.
pub fn csv(recording: &Recording, only: Option<&str>) -> String {
    let characters = || recording.characters.iter().filter(|one| only.is_none_or(|name| one.name == name));
    let props = || recording.props.iter().filter(|_| only.is_none());
    let mut text = String::from("time_s");
    let mut head = |name: &str| {
        for column in ["x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"] {
            let _ = write!(text, ",{name}.{column}");
        }
    };
    for character in characters() {
        for node in Node::ALL {
            head(&format!("{}.{}", character.name, node.part().name()));
        }
    }
    for prop in props() {
        head(&prop.name);
    }
    text.push('\n');
    for frame in 0..recording.frames {
        let _ = write!(text, "{:.6}", recording.time_secs(frame));
        let mut body = |position: DVec3, rotation: DQuat| {
            for value in position.to_array().into_iter().chain(rotation.to_array()) {
                let _ = write!(text, ",{value:.9}");
            }
        };
        for character in characters() {
            let pose = &character.poses[frame];
            let positions = pose.positions(&character.body);
            for node in Node::ALL {
                body(positions[node.index()], pose.world[node.index()]);
            }
        }
        for prop in props() {
            let (position, rotation) = prop.places[frame];
            body(position, rotation);
        }
        text.push('\n');
    }
    text
}
