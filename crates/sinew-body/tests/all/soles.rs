//! Soles lie where the motion has the feet stand, whatever pose the file rests in.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use glam::DVec3;
use sinew_body::humanoid::{Node, Person, Reduction, Sole};
use sinew_body::walk::Walk;
use sinew_motion::{Clip, Humanoid, Part, Side, contacts};

const FEET: [(Side, Node); 2] = [(Side::Left, Node::LeftFoot), (Side::Right, Node::RightFoot)];

/// Per frame and foot the corners of its sole in the world.
fn soles(clip: &Clip) -> Vec<[[DVec3; 4]; 2]> {
    let humanoid = Humanoid::of(clip, &[]).unwrap();
    let reduction = Reduction::new(clip, &humanoid, Walk::default().stature_m, Person::default()).unwrap();
    (0..clip.frames())
        .map(|frame| {
            let pose = reduction.pose(&clip.world(frame));
            FEET.map(|(_, foot)| Sole::world_corners(reduction.body(), &pose, foot))
        })
        .collect()
}

#[test]
fn the_same_walk_with_another_rest_pose_stands_on_the_same_soles() {
    let clip = Walk::default().clip().unwrap();
    let from_rest = soles(&clip);
    for resting in [0, 11, 23, 37, 52] {
        let mut posed = clip.clone();
        let rest: Vec<_> = clip.rotations(resting).to_vec();
        posed.skeleton_mut().edit(|joint, _, transform, _| transform.rotation = rest[joint]);
        assert_eq!(posed.world(7), clip.world(7), "one motion");
        let lowest = |soles: &[[DVec3; 4]; 2]| soles.iter().flatten().map(|corner| corner.y).fold(f64::MAX, f64::min);
        let apart = soles(&posed)
            .iter()
            .zip(&from_rest)
            .map(|(ours, theirs)| (lowest(ours) - lowest(theirs)).abs())
            .fold(0.0, f64::max);
        // Which way the toes point is the rest pose's word: as the foot rolls over another corner that is some millimetres.
        assert!(apart < 5e-3, "resting as in frame {resting}: {apart} m");
    }
}

/// The foot rolls over its sole: level is what it is for a third of its stance, within the lift that counts as down.
#[test]
fn a_sole_is_level_in_the_middle_of_each_stance() {
    let clip = Walk::default().clip().unwrap();
    let humanoid = Humanoid::of(&clip, &[]).unwrap();
    let standing = contacts(&clip, &humanoid);
    let soles = soles(&clip);
    for (foot, (side, _)) in FEET.into_iter().enumerate() {
        for (first, last) in standing.stances(side).into_iter().filter(|(first, last)| last - first > 20) {
            let heights = soles[first + (last - first) * 2 / 5][foot].map(|corner| corner.y);
            let spread =
                heights.iter().fold(f64::MIN, |a, &b| a.max(b)) - heights.iter().fold(f64::MAX, |a, &b| a.min(b));
            assert!(spread < 0.02, "{side:?} {first} to {last}: {heights:?}");
        }
    }
}

/// Captures place the toes of one foot centimetres nearer to the floor than the other's.
#[test]
fn both_soles_stand_on_one_floor_though_the_toes_of_one_foot_are_lower() {
    let clip = Walk::default().clip().unwrap();
    let humanoid = Humanoid::of(&clip, &[]).unwrap();
    let standing = contacts(&clip, &humanoid);
    let lowered = humanoid.joint(Part::LeftToes).unwrap();
    let mut uneven = clip.clone();
    uneven.skeleton_mut().edit(|joint, _, transform, _| {
        if joint == lowered {
            transform.translation.y -= 0.03;
        }
    });
    let soles = soles(&uneven);
    let floor = FEET.map(|(side, foot)| {
        let foot = usize::from(foot == Node::RightFoot);
        let mut stances = standing.stances(side);
        stances.retain(|(first, last)| last - first > 20);
        let level = |&(first, last): &(usize, usize)| soles[first + (last - first) * 2 / 5][foot];
        stances.iter().flat_map(level).map(|corner| corner.y).sum::<f64>() / (4 * stances.len()) as f64
    });
    // From the toes alone they are 4 cm apart; what is left is the instant at which each is looked at.
    assert!((floor[0] - floor[1]).abs() < 5e-3, "{floor:?}");
}
