//! A reach as a picture.

use super::job::Reached;
use crate::jobs::moments::moments;
use crate::jobs::run::{body_figure, custom};
use glam::DVec3;
use sinew_body::humanoid::{Node, Pose};
use sinew_picture::{Camera, Capsule, Filmstrip, Movie, Panel, Plot, Series, Shade, Sheet, Style};
use sinew_world::Form;

/// Panels of a strip.
const PANELS: usize = 12;

/// The strip of a reach, and the speed of its hand.
pub fn sheet(reached: &Reached, title: &str) -> Sheet {
    let followed = followed(reached);
    let shown = moments(&change_m(reached), &[], PANELS);
    let strip = Filmstrip {
        panels: shown.into_iter().map(|frame| panel(reached, frame, &followed)).collect(),
        camera: camera(reached),
        style: style(reached, 6),
        ..Filmstrip::default()
    };
    Sheet {
        title: title.to_owned(),
        subtitle: reached.report.words(),
        pieces: vec![strip.into(), speeds(reached).into()],
        ..Sheet::default()
    }
}

/// The reach as moving pictures, in real time.
pub fn movie(reached: &Reached, title: &str) -> Movie {
    let recording = &reached.recording;
    let last = recording.frames.saturating_sub(1);
    let followed = followed(reached);
    let frame = |index: usize| {
        let secs = index as f64 / f64::from(Movie::FRAMES_PER_SEC);
        ((secs * recording.motion_hz).round() as usize).min(last)
    };
    let frames = Movie::frames_in(recording.time_secs(last));
    Movie {
        title: title.to_owned(),
        panels: (0..frames).map(|index| panel(reached, frame(index), &followed)).collect(),
        camera: camera(reached),
        ..Movie::default()
    }
}

/// The final poses of many variations for the same target, one panel each.
pub fn contact_sheet(all: &[Reached], title: &str) -> Sheet {
    let panels = all.iter().map(|reached| {
        let frame = reached.recording.frames.saturating_sub(1);
        let steps = &reached.report.steps;
        let step = match &steps[..] {
            [] => "no step".to_owned(),
            [one] => format!("{} {} {:.2} m", one.kind, one.foot, one.length_m),
            many => format!("{} steps", many.len()),
        };
        let caption = format!("seed {}: {step}", reached.report.seed);
        Panel { caption, ..panel(reached, frame, &followed(reached)) }
    });
    let strip = Filmstrip {
        panels: panels.collect(),
        camera: all.first().map_or_else(Camera::default, camera),
        style: all.first().map_or_else(Style::default, |reached| style(reached, 5)),
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

fn style(reached: &Reached, columns: usize) -> Style {
    let heights = reached.recording.characters.iter().map(|character| character.body.stature_m());
    Style { columns, body_height_m: heights.fold(0.5, f64::max), ..Style::default() }
}

fn poses(reached: &Reached) -> &[Pose] {
    reached.recording.characters.first().map_or(&[], |character| &character.poses)
}

/// What the camera follows in every frame: it stands still where the body stays about where it is.
fn followed(reached: &Reached) -> Vec<DVec3> {
    let path: Vec<DVec3> = poses(reached).iter().map(|pose| DVec3 { y: 0.0, ..pose.hips_position }).collect();
    crate::jobs::camera::follow(&path, reached.recording.motion_hz)
}

/// How far the joints have moved in every frame since the one before, their mean \[m\].
fn change_m(reached: &Reached) -> Vec<f64> {
    let Some(character) = reached.recording.characters.first() else { return Vec::new() };
    crate::jobs::camera::change_m(&character.body, &character.poses)
}

fn panel(reached: &Reached, frame: usize, followed: &[DVec3]) -> Panel {
    let recording = &reached.recording;
    let follow = followed.get(frame).copied();
    let mut panel = Panel { time_secs: recording.time_secs(frame), follow, ..Panel::default() };
    for character in &recording.characters {
        body_figure(&mut panel.figure, &character.body, &character.poses[frame], character.rgb);
    }
    for prop in &recording.props {
        let Form::Ball { radius_m } = prop.solid.form else { continue };
        let shade = prop.rgb.map_or(Shade::Object, custom);
        panel.objects.capsules.push(Capsule::ball(prop.places[frame].0, radius_m, shade));
    }
    panel
}

fn speeds(reached: &Reached) -> Plot {
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
        unit: " m/s".to_owned(),
        series,
        ..Plot::default()
    }
}
