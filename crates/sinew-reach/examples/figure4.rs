//! Draws a reach as a filmstrip: `cargo run -p sinew-reach --example figure4 -- out.png x:y:z [left|right] [flexibility] [seed]`,
//! or the eight scenes of the paper's figure 4 into a folder when only that is given. It checks that the hand arrives; it writes no
//! motion (`sinew reach` does).
#![allow(missing_docs, reason = "an example")]

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_picture::{Camera, Capsule, Figure, Filmstrip, Panel, Shade, Style as Look};
use sinew_reach::{Goal, Reacher, Start, Style, standing};

fn figure(body: &Body, pose: &Pose, target: DVec3) -> Figure {
    let at = pose.positions(body);
    let mut all = vec![Capsule::ball(target, 0.045, Shade::Object)];
    for node in Node::ALL {
        let shade = match node.part().side() {
            Some(sinew_motion::Side::Left) => Shade::Left,
            Some(sinew_motion::Side::Right) => Shade::Right,
            None => Shade::Midline,
        };
        let (origin, turn, shape) = (at[node.index()], pose.world[node.index()], body.link(node).shape);
        all.push(Capsule::tapered(
            origin + turn * shape.from,
            origin + turn * shape.to,
            shape.from_radius_m,
            shape.to_radius_m,
            shade,
        ));
    }
    Figure::new(all)
}

fn draw(path: &str, target: DVec3, right: bool, style: &Style) {
    let body = Body::standard(80.0, 1.7);
    let start = Start { pose: standing(&body, DVec3::ZERO, 0.0), before: None };
    let mut reacher = Reacher::new(&body, style, &start).expect("a style in range");
    let goal = if right {
        Goal { right: Some(target), ..Goal::default() }
    } else {
        Goal { left: Some(target), ..Goal::default() }
    };
    let outcome = reacher.reach(&goal).clone();
    let end = reacher.done_secs();
    let panels = (0..12).map(|index| {
        let secs = end * f64::from(index) / 11.0;
        let pose = reacher.pose_at(secs);
        Panel {
            time_secs: secs,
            figure: figure(&body, &pose, target),
            follow: Some(pose.hips_position),
            ..Panel::default()
        }
    });
    let mut camera = Camera::three_quarter();
    if !right {
        camera.azimuth_rad = -camera.azimuth_rad;
    }
    let last = reacher.pose_at(end);
    let node = if right { Node::RightHand } else { Node::LeftHand };
    let hand = last.positions(&body)[node.index()] + last.world[node.index()] * body.link(node).centre;
    let steps: Vec<String> =
        outcome.steps.iter().map(|step| format!("{} {} {:.2}", step.side, step.kind.name(), step.length_m)).collect();
    let words = format!(
        "{target}: error {:.3} mm, {:.2} s, twist {:.0}, swing {:.0}, squat {:.2}, steps {steps:?} {:?}",
        (hand - target).length() * 1e3,
        end,
        outcome.twist_rad.to_degrees(),
        outcome.swing_rad.to_degrees(),
        outcome.squat_m,
        outcome.reason
    );
    println!("{path} {words}");
    let strip = Filmstrip {
        title: path.to_owned(),
        subtitle: words,
        panels: panels.collect(),
        camera,
        style: Look { columns: 12, ..Look::default() },
    };
    std::fs::write(path, strip.to_png().expect("a picture")).expect("a file");
    assert!(outcome.reason.is_some() || (hand - target).length() < 1e-3, "the hand does not arrive");
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let usage = "give a folder, or out.png x:y:z [left|right] [flexibility] [seed]";
    if let [path, target, rest @ ..] = &args[..] {
        let xyz: Vec<f64> = target.split(':').map(|part| part.parse().expect(usage)).collect();
        let right = rest.first().is_none_or(|side| side == "right");
        let flexibility = rest.get(1).map_or(1.0, |text| text.parse().expect(usage));
        let seed = rest.get(2).map_or(0, |text| text.parse().expect(usage));
        let style = Style { flexibility, seed, ..Style::default() };
        return draw(path, DVec3::new(xyz[0], xyz[1], xyz[2]), right, &style);
    }
    let folder = args.first().expect(usage);
    for (name, target, right, flexibility, seed) in [
        ("a_apple_upper_left", [0.65, 1.7, 0.2], false, 1.0, 0),
        ("b_ball_lower_right", [-0.75, 0.55, 0.1], true, 1.0, 0),
        ("c_full_step", [-0.2, 1.1, 0.8], true, 1.0, 0),
        ("d_half_step", [-0.2, 1.1, 0.75], true, 1.0, 3),
        ("e_stoop", [-0.2, 0.3, 0.4], true, 0.5, 0),
        ("f_squat", [-0.2, 0.3, 0.4], true, 2.0, 0),
        ("g_step_squat", [-0.2, 0.2, 0.9], true, 1.3, 0),
        ("h_step_high", [-0.3, 1.85, 0.7], true, 1.0, 0),
    ] {
        let style = Style { flexibility, seed, ..Style::default() };
        draw(&format!("{folder}/{name}.png"), DVec3::from(target), right, &style);
    }
}
