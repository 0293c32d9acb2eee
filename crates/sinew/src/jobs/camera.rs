//! Where a picture is taken from, and what it follows.

use glam::DVec3;
use sinew_body::humanoid::{Body, Node, Pose};
use sinew_picture::Camera;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Elevation of a camera that looks across something \[rad\].
const ELEVATION_RAD: f64 = 0.14;

/// A camera that looks across a direction, so that what goes along it is seen in full: of its two sides the one nearer to the azimuth
/// `rather_rad`. A direction without a horizontal part is seen from there.
pub(crate) fn across(direction: DVec3, rather_rad: f64) -> Camera {
    let level = DVec3 { y: 0.0, ..direction };
    let azimuth_rad = if level.length() > 1e-9 * (1.0 + direction.length()) {
        let along = libm::atan2(level.x, level.z);
        let away = |azimuth: &f64| {
            let turn = (azimuth - rather_rad).rem_euclid(TAU);
            turn.min(TAU - turn)
        };
        let (one, other) = (along - FRAC_PI_2, along + FRAC_PI_2);
        if away(&one) <= away(&other) { one } else { other }
    } else {
        rather_rad
    };
    Camera { azimuth_rad: azimuth_rad.rem_euclid(TAU).min(2.0 * PI), elevation_rad: ELEVATION_RAD }
}

/// A path shorter than this is seen by a camera that stands still \[m\].
const STAYS_M: f64 = 1.2;

/// A camera that goes along takes the mean of so long behind and ahead, so that it does not sway with every step \[s\].
const SMOOTH_SECS: f64 = 0.5;

/// What a camera follows of a path at `hz` points a second: its middle where the path is short, else the path, smoothed.
pub(crate) fn follow(path: &[DVec3], hz: f64) -> Vec<DVec3> {
    let Some(&first) = path.first() else { return Vec::new() };
    let (low, high) = path.iter().fold((first, first), |(low, high), &point| (low.min(point), high.max(point)));
    if (high - low).max_element() < STAYS_M {
        return vec![(low + high) / 2.0; path.len()];
    }
    let mut sums = vec![DVec3::ZERO];
    for point in path {
        sums.push(sums[sums.len() - 1] + *point);
    }
    let reach = (SMOOTH_SECS * hz).round().max(0.0) as usize;
    (0..path.len())
        .map(|at| {
            // As far ahead as behind, so that its ends do not lag.
            let reach = reach.min(at).min(path.len() - 1 - at);
            (sums[at + reach + 1] - sums[at - reach]) / (2 * reach + 1) as f64
        })
        .collect()
}

/// How far the joints of a body have moved in every pose since the one before, their mean \[m\].
pub(crate) fn change_m(body: &Body, poses: &[Pose]) -> Vec<f64> {
    let mut before: Option<[DVec3; Node::COUNT]> = None;
    let change = |pose: &Pose| {
        let now = pose.positions(body);
        let moved = before.map_or(0.0, |before| now.iter().zip(before).map(|(now, before)| now.distance(before)).sum());
        before = Some(now);
        moved / Node::COUNT as f64
    };
    poses.iter().map(change).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_stands_still_for_a_body_that_stays_and_goes_evenly_with_one_that_sways_as_it_walks() {
        let path = |speed: f64| -> Vec<DVec3> {
            let sway = |frame: usize| 0.05 * libm::sin(frame as f64 / 60.0 * TAU);
            (0..301).map(|frame| DVec3::new(sway(frame), 0.0, speed * frame as f64 / 60.0)).collect()
        };
        let still = follow(&path(0.1), 60.0);
        assert!(still.iter().all(|point| *point == still[0]));
        let going = follow(&path(1.0), 60.0);
        for pair in going[40..260].windows(2) {
            // A whole period of the sway is averaged.
            assert!((pair[1] - pair[0]).distance(DVec3::Z / 60.0) < 1e-3);
        }
        // At both ends it is where the body is, to the rounding of a mean.
        for end in [0, 300] {
            assert!(going[end].distance(path(1.0)[end]) < 1e-12, "{}", going[end]);
        }
    }

    #[test]
    fn a_push_runs_across_the_picture_whatever_its_direction() {
        for degrees in 0..36 {
            let push = glam::DQuat::from_rotation_y(f64::from(degrees) * 0.175) * DVec3::new(3.0, 1.0, 0.0);
            for rather in [-0.9, 0.0, 2.0] {
                let view = across(push, rather).view();
                let level = DVec3 { y: 0.0, ..push }.normalize();
                assert!(view.right.dot(level).abs() > 0.999_999, "{degrees} {rather}");
            }
        }
        // Pushed sideways, a body that faces +Z is seen from the front.
        assert!(across(DVec3::X, -0.9).view().toward.z > 0.9);
        // Straight down: from where it is wished.
        assert!((across(-DVec3::Y, 1.0).azimuth_rad - 1.0).abs() < 1e-12);
    }
}
