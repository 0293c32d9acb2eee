//! `--target 0.4:1.9:0.5`, `--moving 0.2:1.2:0.6@2`, `--from walk.bvh@1.5`, `--avoid 0.3:1.2:0.4:0.1`.

use crate::push_argument::vector;
use glam::DVec3;
use sinew::jobs::reach::{Ball, MovingPoint};
use std::path::PathBuf;

const POINT: &str = "write X:Y:Z in metres, such as 0.4:1.9:0.5";

pub(crate) fn point(text: &str) -> Result<DVec3, String> {
    vector(text, "point").ok().filter(|point| point.abs().max_element() <= 1e4).ok_or_else(|| POINT.to_owned())
}

pub(crate) fn moving(text: &str) -> Result<MovingPoint, String> {
    let usage = "write X:Y:Z@T in metres and seconds, such as 0.2:1.4:0.6@2";
    let parsed = text.rsplit_once('@').and_then(|(at, secs)| Some((point(at).ok()?, seconds(secs, 600.0)?)));
    parsed.map(|(at, secs)| MovingPoint { at, secs }).ok_or_else(|| usage.to_owned())
}

pub(crate) fn from(text: &str) -> Result<(PathBuf, f64), String> {
    let parsed = text.rsplit_once('@').and_then(|(path, secs)| Some((path.into(), seconds(secs, 86_400.0)?)));
    parsed.ok_or_else(|| "write CLIP@T with T in seconds, such as walk.bvh@1.5".to_owned())
}

pub(crate) fn ball(text: &str) -> Result<Ball, String> {
    let usage = "write X:Y:Z:R in metres, such as 0.3:1.2:0.4:0.1";
    let parsed = text.rsplit_once(':').and_then(|(at, radius)| Some((point(at).ok()?, radius.parse::<f64>().ok()?)));
    let ball = parsed.filter(|(_, radius)| (1e-3..=100.0).contains(radius));
    ball.map(|(at, radius_m)| Ball { at, radius_m }).ok_or_else(|| usage.to_owned())
}

fn seconds(text: &str, most: f64) -> Option<f64> {
    text.parse().ok().filter(|secs| (0.0..=most).contains(secs))
}
