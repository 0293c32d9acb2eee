//! A recording as a filmstrip.

use super::export::capsules;
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_picture::{Camera, Capsule, Colour, Figure, Filmstrip, Panel, Shade, Sheet, Style};
use sinew_stage::{RecordedCharacter, Recording, Scene};
use sinew_world::{PartShape, part_solid};

/// Panels of a strip when the scene does not say which.
const PANELS: usize = 12;

/// Props farther than this from every character are left out, or a ball that rolls away would make all else small \[m\].
const NEAR_M: f64 = 3.0;

/// What a character looks like in a pose: its collision shapes. With a colour the trunk has it.
pub fn figure(body: &Body, pose: &Pose, rgb: Option<[u8; 3]>) -> Vec<Capsule> {
    let positions = pose.positions(body);
    let mut all = Vec::new();
    for node in Node::ALL {
        let shade = match node.part().side() {
            Some(sinew_motion::Side::Left) => Shade::Left,
            Some(sinew_motion::Side::Right) => Shade::Right,
            None => rgb.map_or(Shade::Midline, custom),
        };
        let (position, rotation) = (positions[node.index()], pose.world[node.index()]);
        let link = body.link(node).shape;
        let feet = matches!(node, Node::LeftFoot | Node::RightFoot);
        if feet {
            for (from, to, radius) in capsules(&part_solid(body, node)) {
                all.push(Capsule::new(position + rotation * from, position + rotation * to, radius, shade));
            }
        } else {
            all.push(Capsule::tapered(
                position + rotation * link.from,
                position + rotation * link.to,
                link.from_radius_m,
                link.to_radius_m,
                shade,
            ));
        }
    }
    all
}

/// Shapes that parts have in place of their own, such as skis.
fn worn(character: &RecordedCharacter, pose: &Pose, frame: usize) -> Vec<Capsule> {
    let positions = pose.positions(&character.body);
    let mut all = Vec::new();
    for node in Node::ALL {
        let PartShape::Other(solid) = character.shape(node, frame) else { continue };
        let (position, rotation) = (positions[node.index()], pose.world[node.index()]);
        for (from, to, radius) in capsules(solid) {
            all.push(Capsule::new(position + rotation * from, position + rotation * to, radius, Shade::Object));
        }
    }
    all
}

/// A scene's colour in a picture.
pub(crate) fn custom([red, green, blue]: [u8; 3]) -> Shade {
    Shade::Custom(Colour::hex(u32::from(red) << 16 | u32::from(green) << 8 | u32::from(blue)))
}

/// From a point to a shape's axis.
fn distance_m(point: DVec3, shape: &Capsule) -> f64 {
    let along = shape.to - shape.from;
    let share = (point - shape.from).dot(along) / along.length_squared().max(1e-12);
    point.distance(shape.from + along * share.clamp(0.0, 1.0))
}

/// The strip of a run.
pub fn sheet(recording: &Recording, scene: &Scene, title: &str, subtitle: &str) -> Sheet {
    let last = recording.frames.saturating_sub(1);
    let times = &scene.camera.times_secs;
    let frames: Vec<usize> = if times.is_empty() {
        (0..PANELS).map(|index| last * index / (PANELS - 1)).collect()
    } else {
        times.iter().map(|secs| ((secs * recording.motion_hz).round() as usize).min(last)).collect()
    };
    let panels = frames.into_iter().map(|frame| panel(recording, frame)).collect();
    let strip = Filmstrip {
        panels,
        camera: Camera { azimuth_rad: scene.camera.from_deg.to_radians(), elevation_rad: 0.2 },
        style: Style { columns: 6, ..Style::default() },
        ..Filmstrip::default()
    };
    Sheet {
        title: title.to_owned(),
        subtitle: subtitle.to_owned(),
        pieces: vec![strip.into()],
        footer: format!(
            "{} characters, {} props; motion at {:.0} Hz",
            recording.characters.len(),
            recording.props.len(),
            recording.motion_hz
        ),
        ..Sheet::default()
    }
}

fn panel(recording: &Recording, frame: usize) -> Panel {
    let mut all = Vec::new();
    let mut middle = DVec3::ZERO;
    for character in &recording.characters {
        let pose = &character.poses[frame];
        middle += pose.hips_position / recording.characters.len() as f64;
        all.extend(figure(&character.body, pose, character.rgb));
        all.extend(worn(character, pose, frame));
    }
    let is_near = |shape: &Capsule| {
        let near = |character: &RecordedCharacter| distance_m(character.poses[frame].hips_position, shape) < NEAR_M;
        recording.characters.is_empty() || recording.characters.iter().any(near)
    };
    for prop in recording.props.iter().filter(|prop| !prop.is_sensor) {
        let (position, rotation): (DVec3, DQuat) = prop.places[frame];
        let shade = prop.rgb.map_or(Shade::Object, custom);
        let placed =
            |(from, to, radius)| Capsule::new(position + rotation * from, position + rotation * to, radius, shade);
        let shapes: Vec<Capsule> = capsules(&prop.solid).into_iter().map(placed).collect();
        if shapes.iter().any(is_near) {
            all.extend(shapes);
        }
    }
    let follow = (!recording.characters.is_empty()).then_some(middle);
    Panel { time_secs: recording.time_secs(frame), figure: Figure::new(all), follow, ..Panel::default() }
}
