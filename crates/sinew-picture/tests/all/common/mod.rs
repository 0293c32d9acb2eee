//! A hand-made walker, so that pictures can be judged without any motion file.
#![allow(dead_code, reason = "each test and example uses its part of it")]

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use sinew_picture::{Arrow, Capsule, Figure, Panel, Shade};

/// Walking speed \[m/s\].
pub const SPEED: f64 = 1.2;

/// How a push bends the walker: 0 not at all, 1 at its strongest.
pub fn yielding(time_secs: f64) -> f64 {
    let since = time_secs - 0.8;
    if since <= 0.0 { 0.0 } else { (since / 0.15).min(1.0) * libm::exp(-(since - 0.15).max(0.0) * 2.2) }
}

/// The pelvis at a time \[m\].
pub fn hips(time_secs: f64, bent: f64) -> DVec3 {
    let phase = TAU * time_secs / 1.1;
    DVec3::new(-0.10 * bent, 0.93 + 0.02 * libm::cos(2.0 * phase) - 0.04 * bent, SPEED * time_secs)
}

/// The walker at a time, facing +Z; `bent` from 0 to 1 leans it to its right and throws its left arm.
pub fn walker(time_secs: f64, bent: f64) -> Figure {
    let phase = TAU * time_secs / 1.1;
    let hips = hips(time_secs, bent);
    let swing =
        |angle: f64, aside: f64| DVec3::new(libm::sin(aside), -libm::cos(angle) * libm::cos(aside), libm::sin(angle));
    let lean = DVec3::new(-0.45 * bent, 1.0, 0.04 - 0.25 * bent).normalize();
    let (chest, neck) = (hips + lean * 0.30, hips + lean * 0.52);
    let head = neck + (lean + DVec3::new(0.0, 0.0, 0.15)).normalize() * 0.20;
    let mut capsules = vec![
        Capsule::tapered(hips, hips + lean * 0.12, 0.125, 0.115, Shade::Midline),
        Capsule::tapered(hips + lean * 0.12, chest, 0.115, 0.135, Shade::Midline),
        Capsule::tapered(chest, hips + lean * 0.42, 0.135, 0.10, Shade::Midline),
        Capsule::new(neck - lean * 0.05, neck + lean * 0.06, 0.052, Shade::Midline),
        Capsule::tapered(head, head - lean * 0.07 + DVec3::Z * 0.02, 0.098, 0.075, Shade::Midline),
    ];
    for (side, shade, turn) in [(1.0, Shade::Left, 0.0), (-1.0, Shade::Right, PI)] {
        let step = phase + turn;
        let hip = hips + DVec3::X * side * 0.09 - DVec3::Y * 0.04;
        let knee = hip + swing(0.42 * libm::sin(step), 0.03 * side).normalize() * 0.42;
        let bend = 0.12 + 0.85 * libm::pow(0.5 + 0.5 * libm::cos(step - 0.2), 2.0);
        let ankle = knee + swing(0.42 * libm::sin(step) - bend, 0.0) * 0.41;
        let toe_drop = 0.35 * libm::cos(step).max(-0.2) + 0.12;
        let ball = ankle + DVec3::new(0.015 * side, -0.045 - 0.08 * toe_drop, 0.14);
        capsules.push(Capsule::tapered(hip, knee, 0.088, 0.058, shade));
        capsules.push(Capsule::tapered(knee, ankle, 0.060, 0.040, shade));
        capsules.push(Capsule::tapered(ankle - DVec3::Y * 0.02 - DVec3::Z * 0.03, ball, 0.040, 0.032, shade));
        capsules.push(Capsule::tapered(ball, ball + DVec3::Z * 0.07, 0.032, 0.024, shade));
        let thrown = if side > 0.0 { bent } else { 0.35 * bent };
        let shoulder = hips + lean * 0.46 + DVec3::X * side * 0.18;
        let arm = swing(-0.45 * libm::sin(step) - 0.9 * thrown, side * (0.12 + 0.9 * thrown)).normalize();
        let elbow = shoulder + arm * 0.29;
        let fore = swing(0.35 - 0.35 * libm::sin(step) - 0.5 * thrown, side * (0.05 + 1.1 * thrown)).normalize();
        let wrist = elbow + fore * 0.25;
        capsules.push(Capsule::tapered(hips + lean * 0.44, shoulder, 0.07, 0.062, Shade::Midline));
        capsules.push(Capsule::tapered(shoulder, elbow, 0.056, 0.042, shade));
        capsules.push(Capsule::tapered(elbow, wrist, 0.043, 0.030, shade));
        capsules.push(Capsule::tapered(wrist, wrist + fore * 0.10, 0.036, 0.026, shade));
    }
    Figure::new(capsules)
}

/// A panel of the pushed walker beside the one that was not pushed.
pub fn panel(time_secs: f64) -> Panel {
    let bent = yielding(time_secs);
    let pushed = (0.8..0.95).contains(&(time_secs + 1e-9));
    let chest = hips(time_secs, bent) + DVec3::new(0.1, 0.36, 0.05);
    Panel {
        time_secs,
        figure: walker(time_secs, bent),
        ghost: Some(walker(time_secs, 0.0)),
        arrows: if pushed {
            vec![Arrow { at: chest, force_n: DVec3::new(-150.0, 0.0, -120.0), label: String::new() }]
        } else {
            Vec::new()
        },
        follow: Some(hips(time_secs, bent)),
        caption: if pushed { "push on the chest".to_owned() } else { String::new() },
        ..Panel::default()
    }
}
