//! The controller that Shapiro et al. 2007 print dunks.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "tests")]

use glam::DVec3;
use sinew::body::humanoid::Node;
use sinew::jobs::run::{RunJob, run};
use sinew::stage::{CharacterEffect, Scene};
use sinew_testkit::repository;

#[test]
fn the_listing_is_the_one_that_is_printed() {
    let text = std::fs::read_to_string(repository("scenes/controllers/dunk.py")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    // As the appendix prints it, two empty lines included.
    assert_eq!(lines.len(), 19);
    for line in [
        "class DunkController:",
        "        skeleton.setTargetPose(\"PrepareDunk\")",
        "        skeleton.attachLink(\"RightArm\", \"Ball\")",
        "        if skeleton.isLinkAttached(\"RightArm\", \"Ball\") :",
        "            rimPos = getPosition(\"Rim\")",
        "            skeleton.setIKTarget(rimPos)",
        "        if isColliding(\"Ball\", \"Rim\") \\",
        "            or isColliding(skeleton, \"Rim\") :",
        "            skeleton.detachLink(\"RightArm\", \"Ball\")",
        "            skeleton.setTargetPose(\"Landing\")",
    ] {
        assert!(lines.contains(&line), "{line}");
    }
}

#[test]
fn the_ball_is_let_go_at_the_rim_and_drops_through_it_and_the_character_lands_on_its_feet() {
    let scene = Scene::read(&repository("scenes/dunk.toml")).unwrap_or_else(|error| panic!("{error}"));
    let rim = DVec3::from(scene.props["Rim"].position_m);
    let ring = scene.props["Rim"].ring.unwrap();
    let job = RunJob { host: crate::host(), ..RunJob::default() };
    let ran = run(scene, &job, &mut []).unwrap_or_else(|error| panic!("{error}"));

    let when = |effect: CharacterEffect| {
        let player = &ran.recording.characters[0].name;
        let found = ran.report.events.iter().find(|event| event.effect.on(player) == Some(&effect));
        found.unwrap_or_else(|| panic!("no {effect:?} in {:#?}", ran.report.events)).time_secs
    };
    let node = Node::RightHand;
    assert_eq!(when(CharacterEffect::Holds { node, object: "Ball".to_owned() }), 0.0);
    let let_go = when(CharacterEffect::LetsGo { node, objects: vec!["Ball".to_owned()] });
    assert!(when(CharacterEffect::Pose { pose: "Landing".to_owned() }) >= let_go);
    assert!(!ran.report.events.iter().any(|event| event.effect.is_refused()), "{:#?}", ran.report.events);

    let ball = ran.recording.props.iter().find(|prop| prop.name == "Ball").unwrap();
    let places: Vec<DVec3> = ball.places.iter().map(|(place, _)| *place).collect();
    let frame = |secs: f64| (secs * ran.recording.motion_hz).round() as usize;
    // It was let go near the rim: a ball's and a hand's size, and what a frame adds.
    let distance = (places[frame(let_go)] - rim).length();
    assert!(distance < ring.radius_m + 0.25, "{distance}");
    // The first time that its centre sinks below the rim's plane, it is within the ring.
    let below = (1..places.len()).find(|&at| places[at - 1].y > rim.y && places[at].y <= rim.y).unwrap();
    assert!(below >= frame(let_go));
    let (from, to) = (places[below - 1], places[below]);
    let through = from + (to - from) * ((from.y - rim.y) / (from.y - to.y));
    let aside = DVec3::new(through.x - rim.x, 0.0, through.z - rim.z).length();
    assert!(aside < ring.radius_m - ring.tube_m, "{aside} from the middle");
    // And it goes on down.
    assert!(places[below..].iter().take(12).all(|place| place.y <= rim.y));

    let player = &ran.recording.characters[0];
    let end = player.poses.last().unwrap();
    let positions = end.positions(&player.body);
    // Of 1.9 m: hips at 1.15 m, ankles at 0.1 m.
    assert!(positions[Node::Hips.index()].y > 1.0, "{}", positions[0]);
    for foot in [Node::LeftFoot, Node::RightFoot] {
        assert!(positions[foot.index()].y < 0.13, "{}", positions[foot.index()]);
    }
    let up = end.world[Node::Chest.index()] * DVec3::Y;
    assert!(up.y > 0.9, "{up}");
}
