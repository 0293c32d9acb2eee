//! EQ1 to EQ9 of the paper, each against its closed form written out here again.
#![allow(clippy::disallowed_methods, reason = "tests may use the platform's mathematics")]

use glam::DVec3;
use sinew_body::humanoid::{Body, exp};
use sinew_reach::{
    HandPath, MinimumJerk, PRINTED_RATIO, PRINTED_SPEED_M_S, Style, Values, ground_direction, root_shift, step_length,
    swing_axis, swing_shares, twist_shares,
};

fn values() -> Values {
    Values::of(&Body::standard(80.0, 1.7), &Style::default())
}

/// A few ways of a hand.
fn ways() -> [(DVec3, DVec3); 3] {
    [
        (DVec3::ZERO, DVec3::new(0.3, 0.4, 0.5)),
        (DVec3::new(-0.2, 0.8, 0.1), DVec3::new(0.1, 1.9, 0.4)),
        (DVec3::new(1.0, 0.0, 0.0), DVec3::new(1.0, 0.01, 0.0)),
    ]
}

#[test]
fn eq1_the_start_velocity_points_along_the_way_at_the_start_speed() {
    for (from, to) in ways() {
        let path = HandPath::new(from, to, 0.2, 0.8);
        let expected = 0.2 * (to - from) / (to - from).length();
        assert!((path.velocity - expected).length() < 1e-15, "{}", path.velocity);
        assert!((path.velocity_at(0.0) - expected).length() < 1e-15);
    }
}

#[test]
fn eq2_the_deceleration_stops_the_hand_in_the_last_part() {
    for (from, to) in ways() {
        let path = HandPath::new(from, to, 0.3, 0.7);
        let expected = -path.velocity / (path.total_secs * (1.0 - 0.7));
        assert!((path.deceleration - expected).length() < 1e-12);
        assert!(path.velocity_at(path.total_secs).length() < 1e-12, "it still moves at the end");
    }
}

#[test]
fn eq3_the_displacement_is_the_start_velocity_for_the_whole_time_less_what_braking_takes() {
    for (from, to) in ways() {
        let path = HandPath::new(from, to, PRINTED_SPEED_M_S, PRINTED_RATIO);
        let braking = path.total_secs * (1.0 - PRINTED_RATIO);
        let way = path.velocity * path.total_secs + 0.5 * path.deceleration * braking * braking;
        assert!((way - (to - from)).length() < 1e-12);
        assert!((path.at(path.total_secs) - to).length() < 1e-12);
        // Algorithm 1's own loop, in steps of a tenth of a millisecond, comes to the same place but for its Euler steps: half a
        // step at the start speed.
        let (mut place, mut secs, dt) = (from, 0.0, 1e-4);
        while secs < path.total_secs {
            let velocity = if secs < path.total_secs * PRINTED_RATIO {
                path.velocity
            } else {
                path.velocity + path.deceleration * (secs - path.total_secs * PRINTED_RATIO)
            };
            place += velocity * dt;
            secs += dt;
        }
        assert!((place - to).length() < PRINTED_SPEED_M_S * dt, "{}", (place - to).length());
    }
}

#[test]
fn eq4_the_total_time_is_twice_the_way_over_speed_and_ratio() {
    let path = HandPath::new(DVec3::ZERO, DVec3::X * 0.8, PRINTED_SPEED_M_S, PRINTED_RATIO);
    assert!((path.total_secs - 2.0 * 0.8 / (0.2 * 1.8)).abs() < 1e-12);
    // Said of it elsewhere: 0.8 m takes 4.4 s.
    assert!((path.total_secs - 4.4).abs() < 0.05);
}

#[test]
fn eq5_three_joints_share_the_twist_equally() {
    for twist in [-1.2, -0.1, 0.0, 0.7, 1.5] {
        let [sacral, lumbar, thoracic] = twist_shares(twist);
        assert!((sacral + lumbar + thoracic - twist).abs() < 1e-15);
        assert_eq!((sacral, lumbar), (lumbar, thoracic));
    }
    let [a, b, c] = swing_shares(DVec3::X, 1.0 / 3.0);
    assert!((a - b).length() < 1e-15 && (b - c).length() < 1e-15, "thirds of a swing under print");
}

#[test]
fn eq6_the_ground_direction_is_the_projection_over_its_length() {
    for d in [DVec3::new(0.3, -0.8, 0.4), DVec3::new(-1.0, 2.0, 0.01)] {
        let expected = DVec3::new(d.x, 0.0, d.z) / (d.x * d.x + d.z * d.z).sqrt();
        assert!((ground_direction(d).unwrap() - expected).length() < 1e-15);
    }
    assert_eq!(ground_direction(DVec3::Y), None);
}

#[test]
fn eq7_the_swing_axis_is_d_cross_y_turned_so_that_the_trunk_leans_towards_the_target() {
    for d in [DVec3::new(0.3, -0.8, 0.4), DVec3::new(-1.0, 0.2, 0.1), DVec3::new(0.0, -1.0, -0.4)] {
        let axis = swing_axis(d, 0.0);
        let printed = d.cross(DVec3::Y).normalize();
        assert!((axis + printed).length() < 1e-12, "the printed axis leans away; ours is its opposite");
        // A trunk that stands up, swung by 30 degrees, has its top on the target's side.
        let top = exp(axis * 0.5) * DVec3::Y;
        assert!(top.dot(ground_direction(d).unwrap()) > 0.4);
    }
    // Straight below: forward, whichever way the body faces.
    let facing = 0.7_f64;
    let top = exp(swing_axis(-DVec3::Y, facing) * 0.5) * DVec3::Y;
    assert!(top.dot(DVec3::new(facing.sin(), 0.0, facing.cos())) > 0.4);
}

#[test]
fn eq8_the_root_goes_back_by_k_phi_as_the_trunk_bends_and_forward_as_it_leans_away() {
    let values = values();
    assert!((values.shift_per_swing() - values.most_root_shift_m / 120.0_f64.to_radians()).abs() < 1e-15);
    // The paper's own figure: 0.1 m at 120 degrees for an adult.
    assert!((values.most_root_shift_m - 0.1).abs() < 1e-3, "{}", values.most_root_shift_m);
    let d = DVec3::new(0.3, -0.8, 0.4);
    let toward = ground_direction(d).unwrap();
    for angle in [-0.4, 0.2, 1.0, 2.0] {
        let shift = root_shift(swing_axis(d, 0.0) * angle, &values);
        assert!((shift - toward * (-values.shift_per_swing() * angle)).length() < 1e-12);
    }
}

#[test]
fn eq9_the_step_length_blends_the_shortest_and_the_longest() {
    let values = values();
    let (near, far) = (values.convenient_m, values.maximal_m);
    let (short, long) = (values.shortest_step_m, values.longest_step_m);
    assert_eq!(step_length(near, 0.4, &values), short);
    assert_eq!(step_length(0.1, 0.4, &values), short);
    assert_eq!(step_length(far, 0.4, &values), long);
    assert_eq!(step_length(9.0, 0.4, &values), long);
    for share in [0.1, 0.5, 0.9] {
        for p in [0.02, 0.3, 0.5, 0.98] {
            let d = near + share * (far - near);
            let (a, b) = ((d - near).abs() * p, (d - far).abs() * (1.0 - p));
            let expected = (long * a + short * b) / (a + b);
            let length = step_length(d, p, &values);
            assert!((length - expected).abs() < 1e-15);
            assert!((short..=long).contains(&length));
        }
    }
    // The usual step of the paper lies between the two for an adult.
    assert!((values.usual_step_m - 0.433).abs() < 2e-3, "{}", values.usual_step_m);
    assert!((short..long).contains(&values.usual_step_m));
}

#[test]
fn an_early_glide_is_fastest_after_a_third_of_its_time_and_knows_its_velocity_and_acceleration() {
    let mut share = MinimumJerk::rest(0.0);
    share.go_early(0.0, 1.0, 0.5, 2.0);
    let (h, mut fastest) = (1e-4, (0.0, 0.0));
    for index in 0..=500 {
        let secs = f64::from(index) * 0.005;
        let [before, at, after] = [secs - h, secs, secs + h].map(|secs| share.at(secs));
        // Central differences: their error is the third and fourth derivative, at most some hundreds, times h².
        assert!(((after - before) / (2.0 * h) - share.velocity(secs)).abs() < 1e-5, "{secs}");
        assert!(((after - 2.0 * at + before) / (h * h) - share.acceleration(secs)).abs() < 0.02, "{secs}");
        if share.velocity(secs) > fastest.0 {
            fastest = (share.velocity(secs), secs);
        }
    }
    // By its formula: with v the share of the time that is left, v^1.5 = 3.5 / 6.5 at the peak, which is 45 v^3.5 (3 / 6.5)².
    let left = (3.5_f64 / 6.5).powf(1.0 / 1.5);
    assert!((fastest.1 - (0.5 + 2.0 * (1.0 - left))).abs() < 0.005, "{fastest:?}");
    assert!((fastest.0 - 45.0 * left.powf(3.5) * (3.0_f64 / 6.5).powi(2) / 2.0).abs() < 1e-3, "{fastest:?}");
    // Sent elsewhere on its way it goes on as it was.
    let (value, velocity, acceleration) = (share.at(1.2), share.velocity(1.2), share.acceleration(1.2));
    share.go(1.2, 0.0, 0.0, 1.0);
    assert!((share.at(1.2) - value).abs() < 1e-15);
    assert!((share.velocity(1.2) - velocity).abs() < 1e-12 && (share.acceleration(1.2) - acceleration).abs() < 1e-12);
}
