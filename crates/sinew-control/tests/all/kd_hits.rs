//! A body that the tracker `kd` holds gives way to a hit of 20 N s and comes back.

use crate::performer;

use crate::performer::{Hit, Performer, standing};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::tracker::KdSettings;
use sinew_testkit::mocap;
use sinew_world::CharacterId;

const UPPER_BODY: [Node; 6] =
    [Node::Chest, Node::Head, Node::RightShoulder, Node::LeftUpperArm, Node::RightLowerArm, Node::LeftHand];

fn gives_way_and_comes_back(name: &str, performer: &Performer, directions: &[DVec3]) {
    for (at, node) in UPPER_BODY.into_iter().enumerate() {
        for &direction in directions {
            let hit = Hit::of(performer, &KdSettings::default(), node, direction * 20.0, 1.0 + 0.13 * at as f64);
            let case = format!("{name}, {} towards {direction}: {hit:?}", node.part());
            assert!(hit.peak_m > 0.05, "{case}");
            assert!(hit.back_secs < 2.0, "{case}");
            // Keeps its feet: a foot in the air goes along a little.
            assert!(hit.feet_m < 0.05 && hit.sunk_m < 0.05, "{case}");
            // The pins take the hit's energy out again, and push as hard as the hit: 200 N.
            assert!(hit.force_n > 100.0 && hit.force_n < 1500.0, "{case}");
        }
    }
}

#[test]
fn a_standing_performer_gives_way_to_a_hit_and_is_back_within_two_seconds() {
    gives_way_and_comes_back("stands", &standing(6.0), &[DVec3::NEG_Z, DVec3::Z, DVec3::NEG_X]);
}

#[test]
fn a_walking_performer_gives_way_to_a_hit_and_is_back_within_two_seconds() {
    let Some(folder) = mocap() else { return };
    let walk = Performer::read(&folder.join("accad_bvh/Female1_B03_Walk1.bvh"));
    gives_way_and_comes_back("walks", &walk, &[DVec3::Z, DVec3::X]);
}

#[test]
fn a_boxing_performer_gives_way_to_a_hit_and_is_back_within_two_seconds() {
    let Some(folder) = mocap() else { return };
    gives_way_and_comes_back("boxes", &Performer::read(&folder.join("cmu_bvh_daz/13_18.bvh")), &[DVec3::NEG_Z]);
}

#[test]
fn a_trunk_that_does_not_yield_is_moved_less() {
    let performer = standing(6.0);
    let rigid = KdSettings { yields: false, ..KdSettings::default() };
    let [soft, hard] = [&KdSettings::default(), &rigid]
        .map(|settings| Hit::of(&performer, settings, Node::Chest, DVec3::Z * 20.0, 1.0));
    assert!(soft.own_m > 1.5 * hard.own_m, "{soft:?} {hard:?}");
}

#[test]
fn a_load_that_grows_is_held_as_firmly_as_without_yielding() {
    use performer::Act;
    let performer = standing(5.0);
    let sags = |yields: bool| {
        let mut act = Act::new(&performer, KdSettings { yields, ..KdSettings::default() });
        for step in 0..720 {
            // Up to 100 N within two seconds.
            let force = DVec3::Z * (f64::from(step) / 4.8).min(100.0);
            act.world.push_part(CharacterId::first_in(0), Node::Chest, force, None);
            act.step();
        }
        let parts = &act.world.frame().characters[0].parts;
        let centres = performer.centres(performer.pose(0));
        (parts[Node::Chest.index()].centre - centres[Node::Chest.index()]).length()
    };
    let (soft, hard) = (sags(true), sags(false));
    assert!(hard > 1e-3 && soft < 1.1 * hard, "{soft} against {hard} m");
}
