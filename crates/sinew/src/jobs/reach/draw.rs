//! A reach as a picture.

use super::job::Reached;
use crate::jobs::run::{custom, figure};
use glam::DVec3;
use sinew_picture::{Camera, Capsule, Figure, Filmstrip, Panel, Plot, Series, Shade, Sheet, Style};
use sinew_world::Form;

/// Panels of a strip.
const PANELS: usize = 12;

/// The strip of a reach, and the speed of its hand.
pub fn sheet(reached: &Reached, title: &str) -> Sheet {
    let last = reached.recording.frames.saturating_sub(1);
    let shown = (0..PANELS).map(|index| panel(reached, last * index / (PANELS - 1), None));
    let strip = Filmstrip {
        panels: shown.collect(),
        camera: camera(reached),
        style: Style { columns: 6, ..Style::default() },
        ..Filmstrip::default()
    };
    Sheet {
        title: title.to_owned(),
        subtitle: reached.report.words(),
        pieces: vec![strip.into(), speeds(reached).into()],
        ..Sheet::default()
    }
}

/// The final poses of many variations for the same target, one panel each.
pub fn contact_sheet(all: &[Reached], title: &str) -> Sheet {
    let panels = all.iter().map(|reached| {
        let steps = &reached.report.steps;
        let step = match &steps[..] {
            [] => "no step".to_owned(),
            [one] => format!("{} {} {:.2} m", one.kind, one.foot, one.length_m),
            many => format!("{} steps", many.len()),
        };
        panel(
            reached,
            reached.recording.frames.saturating_sub(1),
            Some(format!("seed {}: {step}", reached.report.seed)),
        )
    });
    let strip = Filmstrip {
        panels: panels.collect(),
        camera: all.first().map_or_else(Camera::default, camera),
        style: Style { columns: 5, ..Style::default() },
        ..Filmstrip::default()
    };
    Sheet {
        title: title.to_owned(),
        subtitle: format!("the ends of {} variations", all.len()),
        pieces: vec![strip.into()],
        ..Sheet::default()
    }
}

fn camera(reached: &Reached) -> Camera {
    let forward = DVec3::new(libm::sin(reached.facing_rad), 0.0, libm::cos(reached.facing_rad));
    // From the side of the reaching hand.
    let mut camera = Camera::three_quarter();
    if reached.report.hands == ["left"] {
        camera.azimuth_rad = -camera.azimuth_rad;
    }
    camera.about_heading(forward)
}

fn panel(reached: &Reached, frame: usize, caption: Option<String>) -> Panel {
    let recording = &reached.recording;
    let mut all = Vec::new();
    let mut follow = None;
    for character in &recording.characters {
        let pose = &character.poses[frame];
        all.extend(figure(&character.body, pose, character.rgb));
        follow = Some(pose.hips_position);
    }
    for prop in &recording.props {
        let Form::Ball { radius_m } = prop.solid.form else { continue };
        all.push(Capsule::ball(prop.places[frame].0, radius_m, prop.rgb.map_or(Shade::Object, custom)));
    }
    Panel {
        time_secs: recording.time_secs(frame),
        figure: Figure::new(all),
        follow,
        caption: caption.unwrap_or_default(),
        ..Panel::default()
    }
}

fn speeds(reached: &Reached) -> Plot {
    use sinew_body::humanoid::Node;
    let recording = &reached.recording;
    let mut series = Vec::new();
    for character in &recording.characters {
        for (node, name) in [
            (Node::LeftHand, "left hand"),
            (Node::RightHand, "right hand"),
            (Node::LeftFoot, "left foot"),
            (Node::RightFoot, "right foot"),
            (Node::Hips, "hips"),
        ] {
            let at: Vec<DVec3> =
                character.poses.iter().map(|pose| pose.positions(&character.body)[node.index()]).collect();
            let speed = at.windows(2).enumerate().map(|(frame, pair)| {
                (
                    recording.time_secs(frame) + 0.5 / recording.motion_hz,
                    (pair[1] - pair[0]).length() * recording.motion_hz,
                )
            });
            series.push(Series::new(name, speed.collect()));
        }
    }
    Plot {
        title: "Speed of hands, feet and hips".to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: "speed (m/s)".to_owned(),
        series,
        ..Plot::default()
    }
}
