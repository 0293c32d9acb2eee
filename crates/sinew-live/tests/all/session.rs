//! Several clients, one stage: over loopback, and over a relay that is bad network.
#![allow(clippy::unwrap_used, reason = "a helper of a test fails as the test does")]

use crate::session_setup::{ServerState, agree, join, replayed, until, watch_until};
use glam::{DQuat, DVec3};
use sinew_body::humanoid::{Body, Node, Pose, exp};
use sinew_control::perform::PerformerSample;
use sinew_control::{Action, Command};
use sinew_live::session::{Client, ConnectionState, LinkConditions, Refusal, Relay, Role, SessionError, Token};
use std::time::Duration;

#[test]
fn late_joiners_have_everybodys_hashes_at_the_same_steps() {
    let state = ServerState::open();
    let red = join(&state.token(Role::Actor), &["red"]).unwrap();
    watch_until(&red, 100);
    let blue = join(&state.token(Role::Actor), &["blue"]).unwrap();
    assert!(blue.welcome().step >= 90 && blue.welcome().seed == 1);
    assert_eq!(blue.scene().characters.len(), 3);
    assert!(red.press("p"));
    watch_until(&red, 300);
    watch_until(&blue, 300);
    let (red, blue) = (red.stats(), blue.stats());
    let done = state.close();
    for stats in [&red, &blue] {
        assert_eq!((stats.frames_that_differ, stats.frames_malformed), (0, 0));
        agree(&stats.hashes, &done.hashes);
    }
    agree(&red.hashes, &blue.hashes);
    assert_eq!(done.applied.len(), 1);
}

#[test]
fn a_command_is_obeyed_in_the_step_after_it_arrives_and_the_take_replays_it() {
    let state = ServerState::open();
    let red = join(&state.token(Role::Actor), &["red"]).unwrap();
    watch_until(&red, 60);
    red.press("p");
    red.command(Command::to("red", Action::Gain { factor: 0.5, part: None }));
    watch_until(&red, 240);
    let done = state.close();
    assert_eq!(done.take.commands.len(), 2);
    for applied in &done.applied {
        // Taken before the step that begins next: between the two looks of a thread at the count one step may have begun.
        assert!(applied.step - applied.arrived_step <= 1, "{applied:?}");
    }
    assert_eq!(replayed(&done.take).hash(), done.take.hash);
}

#[test]
fn an_actor_commands_itself_and_nobody_else_and_the_operator_all() {
    let state = ServerState::open();
    let red = join(&state.token(Role::Actor), &["red"]).unwrap();
    red.command(Command::to("blue", Action::Gain { factor: 0.0, part: None }));
    red.press("b");
    red.press("no such key");
    until("the refusals", || red.stats().rejected.len() == 3);
    let operator = join(&state.token(Role::Operator), &[]).unwrap();
    operator.press("b");
    operator.command(Command::to("blue", Action::Gain { factor: 0.9, part: None }));
    operator.command(Command::stage(Action::Reload { name: "x".into(), text: Some("import os".into()) }));
    until("the operator's refusal", || operator.stats().rejected.len() == 1);
    until("the orders", || state.counts().requests == 2);
    assert_eq!(state.counts().requests_refused, 4);
    let done = state.close();
    let by: Vec<&str> = done.applied.iter().map(|applied| applied.by.as_str()).collect();
    assert_eq!(by, ["operator", "operator"]);
}

#[test]
fn without_the_tokens_secret_or_the_servers_certificate_nobody_joins() {
    let state = ServerState::open();
    let token = state.token(Role::Actor);
    let guessed = Token { secret: [0; 32], ..token.clone() };
    assert_eq!(join(&guessed, &[]).err(), Some(SessionError::Refused(Refusal::Secret)));
    let elsewhere = Token { fingerprint: [0; 32], ..token.clone() };
    assert!(matches!(join(&elsewhere, &[]).err(), Some(SessionError::WrongCertificate { .. })));
    let Err(SessionError::Refused(Refusal::NoActor { known, .. })) = join(&token, &["white"]) else { panic!() };
    assert_eq!(known, "blue, green, red");
    let first = join(&token, &["red"]).unwrap();
    assert!(matches!(join(&token, &["red"]).err(), Some(SessionError::Refused(Refusal::Taken { .. }))));
    drop(first);
    assert!(join(&token, &["red"]).is_ok(), "who leaves makes room");
}

#[test]
fn over_a_bad_network_hashes_agree_and_a_lost_client_comes_back_as_itself() {
    let state = ServerState::open();
    let conditions =
        LinkConditions { delay: Duration::from_millis(40), jitter: Duration::from_millis(15), loss: 0.05, seed: 3 };
    let relay = |seed| {
        Relay::start("127.0.0.1:0".parse().unwrap(), state.server.address(), LinkConditions { seed, ..conditions })
    };
    let (red_way, blue_way) = (relay(3).unwrap(), relay(4).unwrap());
    let via = |relay: &Relay| Token { port: relay.address().port(), ..state.token(Role::Actor) };
    let red = join(&via(&red_way), &["red"]).unwrap();
    let blue = join(&via(&blue_way), &["blue"]).unwrap();
    watch_until(&red, 120);
    // Blue is cut off for longer than a connection lives: like a host that is switched off, and back.
    blue_way.cut(true);
    until("the loss", || blue.state() == ConnectionState::Rejoining);
    let lost = blue.stats().last_step.unwrap();
    assert!(red.state() == ConnectionState::Connected, "red goes on");
    blue_way.cut(false);
    until("blue's return", || blue.state() == ConnectionState::Connected && blue.stats().last_step.unwrap() > lost);
    red.press("p");
    let now = red.stats().last_step.unwrap();
    watch_until(&red, now + 240);
    watch_until(&blue, now + 240);
    // A step is hashed once a second; a busy machine and the loss may have taken the frames of the first few.
    for client in [&red, &blue] {
        until("a frame that is hashed", || client.stats().hashes.keys().any(|&step| step > now));
    }
    let (red, blue) = (red.stats(), blue.stats());
    let done = state.close();
    assert_eq!(blue.rejoined, 1);
    for stats in [&red, &blue] {
        assert_eq!((stats.frames_that_differ, stats.frames_malformed), (0, 0));
        // Two ways of 40 ms, and no less.
        assert!(stats.round_trip_ms >= 80.0, "{}", stats.round_trip_ms);
        agree(&stats.hashes, &done.hashes);
    }
    assert_eq!(done.applied.len(), 1);
}

#[test]
fn what_an_actor_performs_moves_its_character_and_the_take_replays_it() {
    let state = ServerState::open();
    let green = join(&state.token(Role::Actor), &["green"]).unwrap();
    let red = join(&state.token(Role::Actor), &["red"]).unwrap();
    let body = Body::standard(80.0, 1.7);
    let sample = |secs: f64| {
        let mut locals = [DQuat::IDENTITY; Node::COUNT];
        locals[Node::LeftUpperArm.index()] = exp(DVec3::Z * secs.min(1.2));
        PerformerSample::of_pose(secs, &Pose::from_locals(DVec3::Y * 0.9, &locals), &body)
    };
    let arm = |client: &Client, place: usize| {
        let frame = client.next_frame(Duration::from_secs(10)).unwrap();
        frame.characters[place].part(Node::LeftUpperArm).rotation * DVec3::NEG_Y
    };
    for number in 0..150 {
        green.perform(0, sample(f64::from(number) / 60.0));
        // Nobody performs whom it does not play.
        red.perform(0, sample(0.0));
        green.perform(1, sample(0.0));
        std::thread::sleep(Duration::from_micros(16_667));
    }
    let now = green.stats().last_step.unwrap();
    watch_until(&red, now);
    assert!(arm(&red, 1).x > 0.8, "green's arm is up, as red sees it: {}", arm(&red, 1));
    // Green is gone; the others go on, and its character holds what it did.
    drop(green);
    watch_until(&red, now + 120);
    assert!(arm(&red, 1).x > 0.8);
    assert_eq!(red.stats().frames_that_differ, 0);
    let done = state.close();
    let performed = |name: &str| {
        let is_it = |command: &Command| {
            command.character.as_deref() == Some(name) && matches!(command.action, Action::Perform { .. })
        };
        done.take.commands.iter().filter(|stamped| is_it(&stamped.command)).count()
    };
    // A busy machine may lose some on the way.
    assert!(performed("green") > 75, "{}", performed("green"));
    assert_eq!(performed("red"), 0, "it has no live source");
    assert_eq!(replayed(&done.take).hash(), done.take.hash);
}
