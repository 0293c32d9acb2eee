//! Filters and resampling, against what their equations say.

use glam::{DQuat, DVec3};
use sinew_motion::{Clip, Joint, LowPass, LowPassStream, PoseStream, Skeleton, Transform, filter, resample};
use std::f64::consts::{PI, TAU};

fn sine(hz: f64, fps: f64, samples: usize) -> Vec<[f64; 1]> {
    (0..samples).map(|at| [libm::sin(TAU * hz * at as f64 / fps)]).collect()
}

/// Amplitude and phase \[rad\] of a signal at a frequency, over the middle of it and whole periods.
fn response(signal: &[[f64; 1]], hz: f64, fps: f64) -> (f64, f64) {
    let period = (fps / hz).round() as usize;
    let range = 10 * period..30 * period;
    let (mut real, mut imaginary) = (0.0, 0.0);
    for at in range.clone() {
        let angle = TAU * hz * at as f64 / fps;
        real += signal[at][0] * libm::sin(angle);
        imaginary += signal[at][0] * libm::cos(angle);
    }
    let scale = 2.0 / range.len() as f64;
    ((real * real + imaginary * imaginary).sqrt() * scale, libm::atan2(imaginary, real))
}

#[test]
fn one_pass_halves_the_power_at_the_cutoff_and_lags() {
    let (hz, fps) = (6.0, 120.0);
    let mut stream = LowPassStream::new(LowPass::new(hz, fps));
    let passed: Vec<[f64; 1]> = sine(hz, fps, 1000).into_iter().map(|value| stream.step(value)).collect();
    let (gain, phase) = response(&passed, hz, fps);
    assert!((gain - 0.5_f64.sqrt()).abs() < 1e-6, "{gain}");
    // A second-order Butterworth lags by a right angle at its cut-off.
    assert!((phase + PI / 2.0).abs() < 1e-6, "{phase}");
}

#[test]
fn two_passes_halve_the_amplitude_at_the_cutoff_and_do_not_lag() {
    for (hz, gain) in [(6.0, 0.5), (1.0, 1.0 / (1.0 + libm::pow(1.0 / 6.0, 4.0)))] {
        let fps = 120.0;
        let mut signal = sine(hz, fps, (40.0 * fps / hz) as usize);
        LowPass::new(6.0, fps).zero_phase(&mut signal);
        let (measured, phase) = response(&signal, hz, fps);
        // Away from the cut-off the bilinear transform bends frequencies by less than 1 %.
        assert!((measured - gain).abs() < if hz == 6.0 { 1e-6 } else { 1e-4 }, "{hz} Hz: {measured}, not {gain}");
        assert!(phase.abs() < 1e-6, "{hz} Hz: {phase}");
    }
}

#[test]
fn a_constant_keeps_its_bits_and_a_ramp_stays_a_ramp() {
    let pass = LowPass::new(6.0, 60.0);
    let mut constant = vec![[0.1, -3.7e5]; 77];
    pass.zero_phase(&mut constant);
    assert!(constant.iter().all(|value| *value == [0.1, -3.7e5]));
    let mut live = LowPassStream::new(pass);
    assert!((0..50).all(|_| live.step([0.1]) == [0.1]));
    let rotation = DQuat::from_rotation_y(0.3) * DQuat::from_rotation_x(1.1);
    let mut rotations = vec![rotation; 30];
    pass.zero_phase_rotations(&mut rotations);
    // A unit quaternion is one to the last bit or is made one.
    assert!(rotations.iter().all(|other| other.angle_between(rotation) < 1e-7 && *other == rotations[0]));
    let mut ramp: Vec<[f64; 1]> = (0..200).map(|at| [0.01 * f64::from(at)]).collect();
    pass.zero_phase(&mut ramp);
    for (at, value) in ramp.iter().enumerate() {
        // What the filter has not forgotten at the ends of the padding (three periods of the cut-off).
        assert!((value[0] - 0.01 * at as f64).abs() < 1e-6, "{at}: {}", value[0]);
    }
}

#[test]
fn signs_of_quaternions_do_not_matter() {
    let pass = LowPass::new(6.0, 60.0);
    let plain: Vec<DQuat> = (0..90).map(|at| DQuat::from_rotation_z(0.08 * f64::from(at))).collect();
    let mut flipped: Vec<DQuat> = plain.iter().enumerate().map(|(at, &q)| if at % 3 == 0 { -q } else { q }).collect();
    let mut once = plain.clone();
    pass.zero_phase_rotations(&mut once);
    pass.zero_phase_rotations(&mut flipped);
    let mut live = PoseStream::new(pass, 1);
    let mut live_flipped = PoseStream::new(pass, 1);
    for at in 0..90 {
        assert!(once[at].angle_between(flipped[at]) < 1e-7, "{at}");
        let step = |stream: &mut PoseStream, rotation: DQuat| {
            let mut pose = [Transform::new(rotation, DVec3::ZERO)];
            stream.step(&mut pose);
            pose[0].rotation
        };
        let sign = if at % 3 == 0 { -1.0 } else { 1.0 };
        let (a, b) = (step(&mut live, plain[at]), step(&mut live_flipped, plain[at] * sign));
        assert!(a.angle_between(b) < 1e-7, "{at}");
        // At 4.8 rad/s the live filter lags by its group delay of 37 ms: 0.18 rad.
        assert!(at < 40 || (a.angle_between(plain[at]) - 0.18).abs() < 0.01, "{at}: {}", a.angle_between(plain[at]));
    }
}

#[test]
fn a_cutoff_above_half_the_rate_changes_nothing_and_bad_ones_do_no_harm() {
    for (cutoff, fps) in [(6.0, 10.0), (0.0, 60.0), (-1.0, 60.0), (f64::NAN, 60.0), (6.0, f64::INFINITY)] {
        let mut signal = sine(1.0, 60.0, 50);
        let before = signal.clone();
        LowPass::new(cutoff, fps).zero_phase(&mut signal);
        assert_eq!(signal, before);
    }
    LowPass::new(6.0, 60.0).zero_phase::<3>(&mut []);
    LowPass::new(6.0, 60.0).zero_phase_rotations(&mut [DQuat::IDENTITY]);
}

/// A body of one joint that turns and moves.
fn swing(fps: f64, frames: usize) -> Clip {
    let mut skeleton = Skeleton::new();
    skeleton.push(Joint { name: "hips".into(), parent: None, rest: Transform::IDENTITY, tip: None });
    let mut clip = Clip::new(skeleton, 1.0 / fps, vec![0]);
    for frame in 0..frames {
        let time = frame as f64 / fps;
        let sign = if frame % 2 == 0 { 1.0 } else { -1.0 };
        let rotation = DQuat::from_rotation_x(libm::sin(3.0 * time)) * sign;
        clip.push(&[Transform::new(rotation, DVec3::new(time, libm::sin(2.0 * time), 0.0))]);
    }
    clip
}

#[test]
fn coincident_frames_keep_their_bits_at_any_ratio() {
    for (from, to, source_step, target_step) in [
        (30.0, 60.0, 1, 2),
        (120.0, 60.0, 2, 1),
        (100.0, 60.0, 5, 3),
        (24.0, 60.0, 2, 5),
        (120.0048, 60.0, 2, 1),
        (30.003, 60.0, 1, 2),
    ] {
        let clip = swing(from, 301);
        let resampled = resample(&clip, to);
        assert_eq!(resampled.fps(), 1.0 / (1.0 / to));
        for step in 0..300 / source_step {
            let (source, target) = (step * source_step, step * target_step);
            assert_eq!(resampled.local(target, 0), clip.local(source, 0), "{from} to {to}, frame {target}");
        }
        assert_eq!(resampled.frames(), 300 * target_step / source_step + 1, "{from} to {to}");
    }
}

#[test]
fn frames_between_follow_the_motion_and_its_speed() {
    let clip = swing(30.0, 91);
    let resampled = resample(&clip, 240.0);
    let fine = swing(240.0, 721);
    for frame in 8..700 {
        let (was, now) = (fine.local(frame, 0), resampled.local(frame, 0));
        // The cubic errs by the third derivative times the cube of 1/30 s: 27 / 30³ / 16 for the turn.
        assert!(was.translation.distance(now.translation) < 1e-4, "{frame}");
        assert!(was.rotation.angle_between(now.rotation) < 1e-4, "{frame}");
        let speed = |clip: &Clip| clip.rotation(frame, 0).angle_between(clip.rotation(frame + 1, 0)) * 240.0;
        assert!((speed(&fine) - speed(&resampled)).abs() < 0.02, "{frame}: {} {}", speed(&fine), speed(&resampled));
    }
}

#[test]
fn a_constant_velocity_stays_constant_up_to_both_ends() {
    for (from, to) in [(30.0, 60.0), (30.0, 240.0), (120.0, 100.0), (24.0, 60.0), (60.0, 59.94)] {
        let mut clip = swing(from, 0);
        let place = |secs: f64| DVec3::new(1.5, -0.2, 0.7) * secs;
        let turn = |secs: f64| DQuat::from_rotation_z(0.4) * DQuat::from_rotation_y(2.0 * secs);
        for frame in 0..20 {
            let secs = f64::from(frame) / from;
            clip.push(&[Transform::new(turn(secs), place(secs))]);
        }
        let resampled = resample(&clip, to);
        for frame in 0..resampled.frames() {
            let (secs, local) = (frame as f64 / to, resampled.local(frame, 0));
            // Rounding; on a chord of 5 degrees a cubic of quaternions strays by a few microradians.
            assert!(local.translation.distance(place(secs)) < 1e-12, "{from} to {to}, frame {frame}");
            assert!(local.rotation.angle_between(turn(secs)) < 1e-5, "{from} to {to}, frame {frame}");
        }
    }
}

#[test]
fn two_frames_are_a_line() {
    let mut clip = swing(30.0, 0);
    for secs in [0.0, 1.0 / 30.0] {
        clip.push(&[Transform::new(DQuat::from_rotation_y(secs), DVec3::X * secs)]);
    }
    let resampled = resample(&clip, 120.0);
    for frame in 0..5 {
        let secs = frame as f64 / 120.0;
        assert!((resampled.local(frame, 0).translation.x - secs).abs() < 1e-12);
        // On a chord of two degrees a cubic of quaternions strays by a microradian.
        assert!(resampled.local(frame, 0).rotation.angle_between(DQuat::from_rotation_y(secs)) < 1e-5);
    }
}

#[test]
fn odd_rates_empty_clips_and_single_frames_are_no_trouble() {
    assert_eq!(resample(&swing(30.0, 0), 60.0).frames(), 0);
    assert_eq!(resample(&swing(30.0, 1), 60.0).frames(), 1);
    let odd = resample(&swing(30.0, 31), 59.94);
    assert_eq!((odd.frames(), odd.first_non_finite()), (60, None));
    assert_eq!(filter(&swing(30.0, 0), 6.0).frames(), 0);
    assert_eq!(filter(&swing(30.0, 1), 6.0), swing(30.0, 1));
}

#[test]
fn a_large_turn_takes_the_shorter_way() {
    let mut clip = swing(30.0, 0);
    for degrees in [0.0_f64, 0.0, 350.0, 350.0] {
        clip.push(&[Transform::new(DQuat::from_rotation_y(degrees.to_radians()), DVec3::ZERO)]);
    }
    let middle = resample(&clip, 60.0).rotation(3, 0);
    assert!(middle.angle_between(DQuat::from_rotation_y((-5.0_f64).to_radians())) < 1e-9);
}
