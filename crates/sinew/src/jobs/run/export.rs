//! A recording as clips, scenes and tables.

use super::shapes::edges;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_motion::formats::{JointShape, SceneCharacter, SceneFile, SceneForm, SceneMaterial, SceneThing};
use sinew_motion::{Clip, Joint, Side, Skeleton, Transform};
use sinew_stage::{RecordedCharacter, Recording};
use sinew_world::{Form, Solid, hips_over_soles_m, part_solid, ring_corners};
use std::fmt::Write;

/// One character's motion as a clip of the 18 bodies, joints named as VRM bones.
pub fn character_clip(recording: &Recording, character: &RecordedCharacter) -> Clip {
    clip(recording, character, "")
}

/// One character as a scene of its own, joints named as VRM bones.
pub fn character_scene(recording: &Recording, character: &RecordedCharacter) -> SceneFile {
    let mut scene = SceneFile { frame_time_secs: 1.0 / recording.motion_hz, ..SceneFile::default() };
    add_character(&mut scene, recording, character, "");
    scene
}

/// All characters and props, each with its name and colour; joints as `left:hips`.
pub fn scene_file(recording: &Recording) -> SceneFile {
    let mut scene = SceneFile { frame_time_secs: 1.0 / recording.motion_hz, ..SceneFile::default() };
    for character in &recording.characters {
        add_character(&mut scene, recording, character, &format!("{}:", character.name));
    }
    for prop in recording.props.iter().filter(|prop| !prop.is_sensor) {
        let (name, rgb) = match prop.rgb {
            Some(rgb) => (prop.name.as_str(), rgb),
            None => ("prop", PROP),
        };
        let material = material(&mut scene, name, rgb);
        scene.things.push(SceneThing {
            name: prop.name.clone(),
            forms: forms(&prop.solid),
            material,
            places: prop.places.iter().map(|(position, rotation)| Transform::new(*rotation, *position)).collect(),
        });
    }
    scene
}

/// Colours of what the scene gives none: trunk, left limbs, right limbs, props. Those of pictures.
const TRUNK: [u8; 3] = [0xe4, 0xdb, 0xcf];
const LEFT: [u8; 3] = [0x4c, 0x93, 0xd6];
const RIGHT: [u8; 3] = [0xf0, 0x95, 0x3a];
const PROP: [u8; 3] = [0x7d, 0xb4, 0x8c];

/// The index of a material, added where it is not there yet.
fn material(scene: &mut SceneFile, name: &str, rgb: [u8; 3]) -> usize {
    let same = |known: &SceneMaterial| known.name == name && known.rgb == rgb;
    scene.materials.iter().position(same).unwrap_or_else(|| {
        scene.materials.push(SceneMaterial { name: name.to_owned(), rgb });
        scene.materials.len() - 1
    })
}

fn add_character(scene: &mut SceneFile, recording: &Recording, character: &RecordedCharacter, prefix: &str) {
    let trunk = match character.rgb {
        Some(rgb) => material(scene, &character.name, rgb),
        None => material(scene, "body", TRUNK),
    };
    let (left, right) = (material(scene, "left limbs", LEFT), material(scene, "right limbs", RIGHT));
    let mut shapes = Vec::new();
    for node in Node::ALL {
        let material = match node.part().side() {
            Some(Side::Left) => left,
            Some(Side::Right) => right,
            None => trunk,
        };
        let forms = forms(&part_solid(&character.body, node));
        shapes.extend(forms.into_iter().map(|form| JointShape { joint: node.index(), form, material }));
    }
    scene.characters.push(SceneCharacter {
        name: character.name.clone(),
        clip: clip(recording, character, prefix),
        shapes,
    });
}

/// A solid as the shapes of a file.
fn forms(solid: &Solid) -> Vec<SceneForm> {
    let place = |point: DVec3| solid.centre + solid.rotation * point;
    let line =
        |from: DVec3, to: DVec3, radius_m: f64| SceneForm::Capsule { from: place(from), to: place(to), radius_m };
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
        Form::Box { size_m } => {
            vec![SceneForm::Box { centre: solid.centre, rotation: solid.rotation.normalize(), size_m: *size_m }]
        }
        Form::Mesh { points_m, triangles } => vec![SceneForm::Triangles {
            points_m: points_m.iter().map(|point| place(*point)).collect(),
            triangles: triangles.clone(),
        }],
        Form::Hull { .. } => {
            edges(solid).into_iter().map(|(from, to, radius_m)| SceneForm::Capsule { from, to, radius_m }).collect()
        }
    }
}

fn clip(recording: &Recording, character: &RecordedCharacter, prefix: &str) -> Clip {
    let mut skeleton = Skeleton::new();
    for node in Node::ALL {
        let link = character.body.link(node);
        let leaf = !Node::ALL.iter().any(|other| other.parent() == Some(node));
        let rest = match node.parent() {
            Some(_) => link.offset,
            // Standing on the floor.
            None => DVec3::Y * hips_over_soles_m(&character.body, &Pose::STANDING),
        };
        skeleton.push(Joint {
            name: format!("{prefix}{}", node.part().name()),
            parent: node.parent().map(Node::index),
            rest: Transform::new(DQuat::IDENTITY, rest),
            tip: leaf.then_some(link.tip),
        });
    }
    let mut clip = Clip::new(skeleton, 1.0 / recording.motion_hz, vec![0]);
    for pose in &character.poses {
        clip.push(&locals(&character.body, pose));
    }
    clip
}

fn locals(body: &Body, pose: &Pose) -> [Transform; Node::COUNT] {
    Node::ALL.map(|node| match node.parent() {
        Some(_) => Transform::new(pose.local(node).normalize(), body.link(node).offset),
        None => Transform::new(pose.local(node).normalize(), pose.hips_position),
    })
}

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
