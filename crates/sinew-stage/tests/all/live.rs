//! A performer's samples, given as commands, move a character.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Person, Pose, Reduction, exp};
use sinew_control::perform::{PerformerSample, Presence};
use sinew_control::{Action, Command};
use sinew_motion::formats::{MotionFile, ReadOptions};
use sinew_motion::resample;
use sinew_stage::{CharacterEffect, Effect, Scene, Stage, sample_walk_bvh};
use sinew_world::{Form, hips_over_soles_m, part_solid};

const SCENE: &str = "format = 1\n[characters.red]\nsource = { live = {} }\ntracker = \"kinematic\"\nfacing_deg = 90\n\
                     position_m = [2, 0, 0]\n[characters.blue]\npose = \"stand\"\n";

fn stage() -> Stage {
    Stage::new(Scene::from_text(SCENE).unwrap(), None).unwrap()
}

/// Somebody of 1.2 m who sways, lifts the left arm and walks to the front.
fn performed(time_secs: f64) -> PerformerSample {
    let body = Body::standard(30.0, 1.2);
    let mut locals = [DQuat::IDENTITY; Node::COUNT];
    locals[Node::Chest.index()] = exp(DVec3::X * 0.2 * libm::sin(3.0 * time_secs));
    locals[Node::LeftUpperArm.index()] = exp(DVec3::Z * time_secs.min(1.0));
    let hips = DVec3::new(5.0, 0.62, 0.4 * time_secs);
    PerformerSample::of_pose(time_secs + 100.0, &Pose::from_locals(hips, &locals), &body)
}

fn perform(stage: &mut Stage, steps: usize) {
    for step in 0..steps {
        perform_one(stage, step);
    }
}

fn perform_one(stage: &mut Stage, step: usize) {
    if step.is_multiple_of(4) {
        let sample = performed(step as f64 / 240.0);
        stage.command(Command::to("red", Action::Perform { sample: Box::new(sample) }));
    }
    stage.step();
}

#[test]
fn a_performer_of_another_size_moves_the_character_from_its_own_place_and_facing() {
    let mut stage = stage();
    perform(&mut stage, 480);
    let red = stage.cast().character("red").unwrap();
    let seen = &stage.frame().characters[red.slot()];
    // It faces +X; the legs are 1.7 / 1.2 as long, and so are the steps. The delay is about a tenth of a second.
    let way = seen.part(Node::Hips).position - DVec3::new(2.0, 0.0, 0.0);
    let wanted = 0.4 * 1.9 * 1.7 / 1.2;
    assert!((way.x - wanted).abs() < 0.05 && way.z.abs() < 0.01, "{way} for {wanted}");
    let arm = seen.part(Node::LeftUpperArm).rotation * DVec3::NEG_Y;
    // The left of who faces +X is -Z; a turn of 1 rad from hanging, on a chest that sways by 0.2 rad at most, 0.1 then.
    assert!((arm - DVec3::new(0.0, -libm::cos(1.0), -libm::sin(1.0))).length() < 0.1, "{arm}");
    let performance = stage.state_of(red).unwrap().performance().unwrap();
    assert_eq!(performance.presence(), Presence::Performing);
    assert_eq!(performance.counters().used, 120);
}

#[test]
fn a_stream_that_ends_is_held_then_the_character_stands_at_ease() {
    let mut stage = stage();
    perform(&mut stage, 240);
    for _ in 0..1200 {
        stage.step();
    }
    let red = stage.cast().character("red").unwrap();
    let told: Vec<&Effect> = stage.events().list().iter().map(|event| &event.effect).collect();
    let does = |presence| Effect::of("red", CharacterEffect::Performer { presence, replaces_understudy: false });
    assert_eq!(told, [&does(Presence::Performing), &does(Presence::Holding), &does(Presence::Relaxed)]);
    let seen = &stage.frame().characters[red.slot()];
    assert!((seen.part(Node::LeftUpperArm).rotation * DVec3::NEG_Y + DVec3::Y).length() < 0.01, "the arm hangs");
    assert_eq!(stage.state_of(red).unwrap().performance().unwrap().presence(), Presence::Relaxed);
}

#[test]
fn a_sample_for_somebody_who_is_not_performed_is_refused_and_changes_nothing() {
    let (mut stage, mut other) = (stage(), stage());
    let sample = Box::new(performed(0.0));
    stage.command(Command::to("blue", Action::Perform { sample }));
    for _ in 0..60 {
        stage.step();
        other.step();
    }
    let Effect::Refused(error) = &stage.events().list()[0].effect else { panic!("it is refused") };
    assert!(error.problem().contains("the character has no performer"), "{error}");
    assert_eq!(stage.hash(), other.hash());
}

#[test]
fn a_performer_may_hand_over_to_a_pose_and_take_over_again() {
    let mut stage = stage();
    perform(&mut stage, 120);
    let red = stage.cast().character("red").unwrap();
    let arm = |stage: &Stage| stage.frame().characters[red.slot()].part(Node::LeftUpperArm).rotation * DVec3::NEG_Y;
    stage.command(Command::to("red", Action::Pose { name: "stand".to_owned() }));
    perform(&mut stage, 480);
    assert!((arm(&stage) + DVec3::Y).length() < 0.01, "the pose has it");
    stage.command(Command::to("red", Action::Live { on: true }));
    perform(&mut stage, 480);
    assert!(arm(&stage).z < -0.5, "the performer has it");
}

#[test]
fn a_performance_replays_to_the_same_bits_from_its_commands() {
    let mut first = stage();
    perform(&mut first, 300);
    let mut again = stage();
    again.prescribe(first.record().to_vec());
    for _ in 0..300 {
        again.step();
    }
    assert_eq!(again.hash(), first.hash());
}

#[test]
fn a_simulated_body_that_loses_its_performer_stands_and_takes_up_again_without_a_pop() {
    let text = SCENE.replace("kinematic", "kd");
    let mut stage = Stage::new(Scene::from_text(&text).unwrap(), None).unwrap();
    let red = stage.cast().character("red").unwrap();
    let (mut lowest, mut farthest) = (f64::INFINITY, 0.0f64);
    let mut before: Option<Vec<DVec3>> = None;
    for step in 0..2400 {
        // Silence from the second to the sixth second.
        if step % 4 == 0 && !(480..1440).contains(&step) {
            let sample = performed(f64::from(step) / 240.0);
            stage.command(Command::to("red", Action::Perform { sample: Box::new(sample) }));
        }
        stage.step();
        let seen = &stage.frame().characters[red.slot()];
        let places: Vec<DVec3> = seen.parts.iter().map(|part| part.position).collect();
        let ways = before.iter().flatten().zip(&places).map(|(a, b)| a.distance(*b));
        farthest = ways.fold(farthest, f64::max);
        lowest = lowest.min(seen.part(Node::Hips).position.y);
        before = Some(places);
    }
    // It performs at 0.6 m/s, and what is blended on top has 0.8 m/s; 2 cm in a step would be 4.8.
    assert!(farthest < 0.02, "{:.1} mm", farthest * 1e3);
    // Its hips stand at 0.93 m.
    assert!(lowest > 0.85, "{lowest}");
    let performance = stage.state_of(red).unwrap().performance().unwrap();
    assert_eq!((performance.presence(), performance.gain()), (Presence::Performing, 1.0));
}

/// The pose of the understudy has both arms up; its controller would keep them there.
const UNDERSTUDIED: &str = "format = 1\n[characters.red]\nsource = { pose = \"up\", live = {} }\ntracker = \"kd\"\n\
                            [poses.up]\njoints.leftUpperArm = [0, 0, 150]\njoints.rightUpperArm = [0, 0, -150]\n";

#[test]
fn an_understudy_acts_until_the_performer_is_heard_and_gives_way_without_a_jump() {
    let mut stage = Stage::new(Scene::from_text(UNDERSTUDIED).unwrap(), None).unwrap();
    for _ in 0..240 {
        stage.step();
    }
    let right_arm = |stage: &Stage| stage.frame().characters[0].part(Node::RightUpperArm).rotation * DVec3::NEG_Y;
    assert!(right_arm(&stage).y > 0.6, "it is up: {}", right_arm(&stage));
    let mut before = stage.frame().characters[0].clone();
    let mut fastest = 0.0_f64;
    for step in 0..600 {
        perform_one(&mut stage, step);
        let now = &stage.frame().characters[0];
        for node in Node::ALL {
            fastest = fastest.max((now.part(node).position - before.part(node).position).length());
        }
        before = now.clone();
    }
    // The arm hangs as the performer's does; on the way nothing moved by more than 2 cm in a step.
    assert!(right_arm(&stage).y < -0.9, "{}", right_arm(&stage));
    assert!(fastest < 0.02, "{fastest}");
    let told: Vec<&Effect> = stage.events().list().iter().map(|event| &event.effect).collect();
    let takes_over = CharacterEffect::Performer { presence: Presence::Performing, replaces_understudy: true };
    assert_eq!(told, [&Effect::of("red", takes_over)]);
}

#[test]
fn who_lets_go_before_the_performer_comes_keeps_the_understudy() {
    let mut stage = Stage::new(Scene::from_text(UNDERSTUDIED).unwrap(), None).unwrap();
    stage.command(Command::to("red", Action::Live { on: false }));
    perform(&mut stage, 480);
    let arm = stage.frame().characters[0].part(Node::RightUpperArm).rotation * DVec3::NEG_Y;
    assert!(arm.y > 0.6, "{arm}");
}

#[test]
fn a_spoilt_first_sample_does_not_place_the_performance() {
    let (mut stage, mut other) = (stage(), stage());
    let mut first = performed(0.0);
    first.hips_um = [8_000_000, 4_600_000, -2_000_000];
    stage.command(Command::to("red", Action::Perform { sample: Box::new(first) }));
    stage.step();
    other.step();
    perform(&mut stage, 480);
    perform(&mut other, 480);
    let hips = |stage: &Stage| stage.frame().characters[1].part(Node::Hips).position;
    assert_eq!(stage.cast().character("red"), Some(sinew_world::CharacterId::first_in(1)));
    // What goes on for ten samples is believed: the way begins eleven samples later, 0.18 s at 0.6 m/s.
    assert!((hips(&stage) - hips(&other)).length() < 0.12, "{} {}", hips(&stage), hips(&other));
    assert!((hips(&stage).y - hips(&other).y).abs() < 1e-3);
}

/// The sample walk as samples of a performer, 60 a second.
fn walked() -> Vec<PerformerSample> {
    let file = MotionFile::from_bvh(&sample_walk_bvh().unwrap(), &ReadOptions::default()).unwrap();
    let person = Person { mass_kg: 80.0, height_m: None };
    let reduction = Reduction::new(&file.clip, file.body_parts().unwrap(), file.stature_m, person).unwrap();
    let clip = resample(&file.clip, 60.0);
    let sample = |frame: usize| {
        let pose = reduction.pose(&clip.world(frame));
        PerformerSample::of_pose(frame as f64 / 60.0, &pose, reduction.body())
    };
    (0..clip.frames()).map(sample).collect()
}

#[test]
fn a_body_whose_performer_walked_into_a_pole_and_fell_silent_stands_beside_it() {
    const POLE_M: f64 = 0.04;
    let scene = format!(
        "format = 1\n[characters.red]\nsource = {{ live = {{}} }}\ntracker = \"kd\"\nposition_m = [0, 0, -0.82]\n\
         [props.pole]\ncapsule = {{ radius_m = {POLE_M}, length_m = 2.9 }}\nposition_m = [0, 1.45, 0]\nfixed = true\n"
    );
    let mut stage = Stage::new(Scene::from_text(&scene).unwrap(), None).unwrap();
    for sample in walked().into_iter().take(180) {
        stage.command(Command::to("red", Action::Perform { sample: Box::new(sample) }));
        (0..4).for_each(|_| stage.step());
    }
    (0..720).for_each(|_| stage.step());
    let red = stage.cast().character("red").unwrap();
    let (body, seen) = (stage.state_of(red).unwrap().body(), &stage.frame().characters[red.slot()]);
    let pose = seen.pose();
    let sole_m = pose.hips_position.y - hips_over_soles_m(body, &pose);
    let head_m = seen.part(Node::Head).position.y;
    println!(
        "three seconds after silence: lowest sole {sole_m:.3} m, head {head_m:.2} m, hips at {}",
        pose.hips_position
    );
    assert!(sole_m < 0.05, "the lowest sole is at {sole_m} m");
    assert!(head_m > 1.3, "the head is at {head_m} m");
    for node in Node::ALL {
        let Form::Capsule { radius_m, length_m } = part_solid(body, node).form else { continue };
        let (solid, part) = (part_solid(body, node), seen.part(node));
        for along in [-0.5, -0.25, 0.0, 0.25, 0.5] {
            let point = part.point(solid.centre + solid.rotation * DVec3::Y * (along * length_m));
            let gap = point.with_y(0.0).length() - radius_m - POLE_M;
            // What a contact's spring gives under a body that leans on it.
            assert!(gap > -0.01, "{node:?} is {gap} m inside the pole");
        }
    }
}
