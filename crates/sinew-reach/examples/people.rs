//! People who reach to the floor and high up, beside the method given the same targets and time: a table and a picture.
//! `cargo run -p sinew-reach --example people -- FOLDER_OF_CAPTURES OUT.png`. The test `people.rs` holds the differences down.
//!
//! What it does not do: it says nothing about fingers, and only two of the clips were made for reaching.
#![allow(missing_docs, reason = "an example")]

#[path = "../tests/all/captured/mod.rs"]
mod captured;

use captured::{Compared, compare};
use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_picture::{Camera, Capsule, Figure, Filmstrip, Panel, Plot, Series, Shade, Sheet, Style};
use std::path::Path;

fn figure(body: &Body, pose: &Pose, targets: &[Option<DVec3>; 2]) -> Figure {
    let at = pose.positions(body);
    let mut all: Vec<Capsule> =
        targets.iter().flatten().map(|target| Capsule::ball(*target, 0.04, Shade::Object)).collect();
    for node in Node::ALL {
        let shade = match node.part().side() {
            Some(sinew_motion::Side::Left) => Shade::Left,
            Some(sinew_motion::Side::Right) => Shade::Right,
            None => Shade::Midline,
        };
        let (origin, turn, shape) = (at[node.index()], pose.world[node.index()], body.link(node).shape);
        let (from, to) = (origin + turn * shape.from, origin + turn * shape.to);
        all.push(Capsule::tapered(from, to, shape.from_radius_m, shape.to_radius_m, shade));
    }
    Figure::new(all)
}

fn strip(compared: &Compared, ours: bool) -> Filmstrip {
    let poses = if ours { &compared.ours } else { &compared.theirs };
    let forward = compared.theirs[0].world[0] * DVec3::Z;
    let panels = (0..8).map(|index| {
        let frame = (poses.len() - 1) * index / 7;
        Panel {
            time_secs: frame as f64 / captured::HZ,
            figure: figure(&compared.body, &poses[frame], &compared.targets),
            follow: Some(compared.theirs[0].hips_position),
            ..Panel::default()
        }
    });
    Filmstrip {
        title: format!("{}: {}", compared.name, if ours { "the method" } else { "the person" }),
        panels: panels.collect(),
        camera: Camera::three_quarter().about_heading(forward),
        style: Style { columns: 8, ..Style::default() },
        ..Filmstrip::default()
    }
}

fn plot(compared: &Compared) -> Plot {
    let mut series = Vec::new();
    for (who, poses) in [("person", &compared.theirs), ("method", &compared.ours)] {
        let measured: Vec<captured::Angles> = poses.iter().map(|pose| captured::angles(&compared.body, pose)).collect();
        let line = |value: &dyn Fn(&captured::Angles) -> f64| -> Vec<(f64, f64)> {
            measured.iter().enumerate().map(|(frame, one)| (frame as f64 / captured::HZ, value(one))).collect()
        };
        series.push(Series::new(format!("{who}: trunk"), line(&|one| one.trunk_deg)));
        series.push(Series::new(format!("{who}: knee"), line(&|one| one.knee_deg)));
    }
    Plot {
        title: format!("{}: angles of trunk and knees", compared.name),
        x_label: "time (s)".to_owned(),
        y_label: "angle (°)".to_owned(),
        series,
        ..Plot::default()
    }
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [folder, out] = &args[..] else { panic!("give the folder of captures and a picture to write") };
    let mut pieces = Vec::new();
    println!("{}", captured::HEADER);
    for case in captured::CASES {
        let compared = compare(Path::new(folder), &case).expect("a capture that can be read");
        println!("{}", compared.row());
        pieces.push(strip(&compared, false).into());
        pieces.push(strip(&compared, true).into());
        pieces.push(plot(&compared).into());
        assert!(compared.ours.iter().all(Pose::is_finite));
    }
    let sheet = Sheet { title: "People and the method, same target, same time".to_owned(), pieces, ..Sheet::default() };
    std::fs::write(out, sheet.to_png().expect("a picture")).expect("a file");
}
