//! What drives a body is kept: restored, it goes on to the same bits.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use crate::pushed::{Place, Push, STRIDE, Standing};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Limb, Node, Pose, exp};
use sinew_control::Wanted;
use sinew_control::graph::{Graph, GraphPlayer};
use sinew_control::ik::Reach;
use sinew_control::perform::{LiveSettings, LiveSource, PerformerSample};
use sinew_control::pose::{KeyPose, PosePlayer, read_poses, resolve_poses};
use sinew_control::reflex::{Balance, BalanceSettings, Reflex, Sense};
use sinew_control::source::Source as _;
use sinew_snapshot::{FrameKind, Snapshot};
use sinew_world::{CharacterId, Frame};
use std::collections::BTreeMap;

const KIND: FrameKind = FrameKind { magic: *b"TEST", version: 1 };
const STEP_SECS: f64 = 1.0 / 240.0;

/// Steps `first` through all frames and keeps it at some; a fresh one restored from each goes on to the same bits.
fn goes_on<T: Snapshot, Out: PartialEq>(fresh: impl Fn() -> T, frames: usize, step: impl Fn(&mut T, usize) -> Out) {
    let mut first = fresh();
    let (mut kept, mut all) = (Vec::new(), Vec::new());
    for frame in 0..frames {
        if frame % (frames / 7) == 3 {
            kept.push((frame, KIND.save(&first)));
        }
        all.push(step(&mut first, frame));
    }
    assert!(kept.len() >= 7);
    for (at, bytes) in kept {
        let mut other = fresh();
        KIND.restore(&mut other, &bytes).unwrap();
        assert!(KIND.save(&other) == bytes, "kept at frame {at}");
        for frame in at..frames {
            assert!(step(&mut other, frame) == all[frame], "kept at frame {at}, differs at {frame}");
        }
        assert!(KIND.save(&other) == KIND.save(&first), "kept at frame {at}");
    }
}

/// What a target asks for, bit by bit.
fn bits(target: &Wanted) -> Vec<u64> {
    let joint = |at: usize| {
        let joint = &target.joints[at];
        let vectors = joint.velocity.to_array().into_iter().chain(joint.torque.to_array());
        vectors.chain(joint.rotation.to_array()).chain([joint.gain, joint.damping])
    };
    (0..Node::COUNT).flat_map(joint).map(f64::to_bits).collect()
}

/// The world's frames while a standing body is pushed.
fn pushed_frames() -> Vec<Frame> {
    let mut standing = Standing::new(Body::standard(80.0, 1.7), STRIDE, BalanceSettings::default());
    let push = Push { azimuth_deg: 30.0, impulse_n_s: 30.0, for_secs: 0.1, place: Place::Centre };
    let step = |_| {
        standing.step(Some(&push));
        standing.world.frame().clone()
    };
    (0..240 * 3).map(step).collect()
}

#[test]
fn the_balance_reflex_that_is_restored_goes_on_to_the_same_bits() {
    let frames = pushed_frames();
    let standing = Standing::new(Body::standard(80.0, 1.7), STRIDE, BalanceSettings::default());
    goes_on(
        || Box::new(Balance::new(&standing.body, BalanceSettings::default())) as Box<dyn Reflex>,
        frames.len(),
        |reflex, at| {
            let mut target = standing.wanted.clone();
            let gains = standing.tracker.gains();
            let (frame, body) = (&frames[at], &standing.body);
            reflex.step(
                &Sense { frame, own: CharacterId::first_in(0), body, gains, step_secs: STEP_SECS, gravity_m_s2: 9.81 },
                &mut target,
            );
            bits(&target)
        },
    );
}

#[test]
fn key_poses_graphs_and_limbs_that_reach_are_restored_to_the_same_bits() {
    let frames = pushed_frames();
    let body = Body::standard(80.0, 1.7);
    let text = "[poses.bent]\njoints.rightUpperLeg = [-30, 0, 0]\nblend_secs = 0.4\n[poses.arms]\nfollow_velocity = true\n\
                joints.leftUpperArm = [0, 0, 60]\ngain = 0.5\n[graphs.g]\nstart = 'a'\n\
                states.a = { pose = 'bent', to = [{ state = 'b', after_secs = 0.37 }] }\n\
                states.b = { pose = 'arms', to = [{ state = 'a', after_secs = 0.21 }] }";
    let file = read_poses(text, "poses.toml").unwrap_or_else(|error| panic!("{error}"));
    let poses = resolve_poses(&file.poses, &body).unwrap();
    let graph = Graph::new(&file.graphs["g"], &poses, &BTreeMap::new()).unwrap();
    goes_on(
        || (GraphPlayer::new(&graph, STEP_SECS), PosePlayer::new(&KeyPose::STAND)),
        frames.len(),
        |(graph_player, player), at| {
            if graph_player.step(&graph, &frames[at], CharacterId::first_in(0), &[""; 0]).is_some() || at == 0 {
                player.aim(graph_player.pose(&graph));
            }
            match at {
                100 => player.ik.reach(Limb::LeftArm, Reach::own(&body, Limb::LeftArm, DVec3::new(0.4, 1.2, 0.4))),
                400 => player.ik.release_all(),
                500 => player.match_body(&frames[at].characters[0]),
                _ => {}
            }
            let mut target = Wanted::STANDING;
            player.write(&frames[at], CharacterId::first_in(0), &body, STEP_SECS, &mut target);
            (bits(&target), graph_player.state_name(&graph).to_owned())
        },
    );
}

/// A performer who waves, seen at 60 Hz: samples come late, twice, out of order, wrong or not at all.
fn samples() -> Vec<(usize, PerformerSample)> {
    let body = Body::standard(60.0, 1.5);
    let mut samples = Vec::new();
    for frame in 0..150_u32 {
        if (70..100).contains(&frame) || frame % 11 == 5 {
            continue;
        }
        let secs = f64::from(frame) / 60.0;
        let mut locals = [DQuat::IDENTITY; Node::COUNT];
        locals[Node::LeftUpperArm.index()] = exp(DVec3::Z * libm::sin(3.0 * secs));
        let mut sample = PerformerSample::of_pose(secs + 5.0, &Pose::from_locals(DVec3::Y * 0.8, &locals), &body);
        sample.number = Some(u64::from(frame));
        if frame % 17 == 3 {
            sample.hips_um[0] += 3_000_000;
        }
        let late = [0, 1, 0, 7, 0, 2, 30][frame as usize % 7];
        samples.push((frame as usize * 4 + late, sample.clone()));
        if frame % 13 == 0 {
            samples.push((frame as usize * 4 + late + 2, sample));
        }
    }
    samples
}

#[test]
fn a_live_performer_that_is_restored_goes_on_to_the_same_bits() {
    let (body, samples) = (Body::standard(80.0, 1.7), samples());
    goes_on(
        || LiveSource::new(&body, DVec3::ZERO, 0.3, &Pose::STANDING, LiveSettings::default()),
        720,
        |source, at| {
            let now = at as f64 * STEP_SECS;
            samples.iter().filter(|(when, _)| *when == at).for_each(|(_, sample)| source.receive(sample, now));
            let presence = source.advance(now, STEP_SECS);
            let mut target = Wanted::STANDING;
            source.wanted(now + STEP_SECS, &mut target);
            source.firmness(&mut target);
            (bits(&target), presence, source.counters(), source.delay_secs().to_bits())
        },
    );
}
