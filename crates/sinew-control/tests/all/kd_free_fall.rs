//! Kinematic forces go off, and come on again where the body is.

use crate::performer::{Act, Performer, standing};
use glam::DVec3;
use sinew_body::humanoid::Node;
use sinew_control::tracker::{KdPreset, KdSettings};
use sinew_testkit::mocap;
use sinew_world::CharacterId;

/// How a body moves from now on.
#[derive(Debug, Default)]
struct Motion {
    /// The farthest that a part goes within a step of physics \[m\].
    step_m: f64,
    /// The most that the velocity of hips, chest or head changes within a step \[m/s\].
    jolt_m_s: f64,
    /// How far from the performer's the farthest part is at the end \[m\].
    off_m: f64,
}

const TRUNK: [Node; 3] = [Node::Hips, Node::Chest, Node::Head];

impl Motion {
    fn of(act: &mut Act, secs: f64) -> Motion {
        let mut motion = Motion::default();
        let mut before = act.world.frame().characters[0].parts;
        for _ in 0..steps(secs) {
            act.step();
            let now = act.world.frame().characters[0].parts;
            for node in Node::ALL {
                let (now, before) = (&now[node.index()], &before[node.index()]);
                motion.step_m = motion.step_m.max((now.centre - before.centre).length());
                if TRUNK.contains(&node) {
                    motion.jolt_m_s = motion.jolt_m_s.max((now.velocity - before.velocity).length());
                }
            }
            before = now;
        }
        let wanted = act.performer.centres(act.wanted());
        let off = before.iter().zip(wanted).map(|(part, wanted)| (part.centre - wanted).length());
        motion.off_m = off.fold(0.0, f64::max);
        motion
    }

    /// Nothing pops: no part goes farther than two centimetres within a step, and the trunk's velocity has no steps. (Feet that come
    /// down stop at once, as feet do.)
    fn is_smooth(&self) -> bool {
        self.step_m < 0.02 && self.jolt_m_s < 0.5
    }
}

fn steps(secs: f64) -> usize {
    (secs * 240.0) as usize
}

/// Switches pins off, and after a while on again; how high the hips were then \[m\], and how the body moved from then on.
fn falls(performer: &Performer, off_secs: f64, fade_secs: f64, then_secs: f64) -> (f64, Motion) {
    let mut act = Act::new(performer, KdSettings::default());
    (0..steps(0.5)).for_each(|_| act.step());
    act.tracker.set_pins(false, 0.0);
    for step in 0..steps(off_secs) {
        // A body whose joints are held stands for a while like a statue.
        if step < steps(0.3) {
            act.world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::Z * 60.0, None);
        }
        act.step();
    }
    let height_m = act.world.frame().characters[0].parts[0].position.y;
    act.tracker.set_pins(true, fade_secs);
    (height_m, Motion::of(&mut act, then_secs))
}

#[test]
fn a_body_that_fell_to_the_ground_rises_without_a_pop() {
    let (height_m, motion) = falls(&standing(10.0), 2.0, 1.0, 7.0);
    assert!(height_m < 0.5, "it fell: hips at {height_m} m");
    assert!(motion.is_smooth() && motion.off_m < 0.02, "{motion:?}");
}

#[test]
fn a_body_is_caught_in_mid_air_without_a_pop() {
    for off_secs in [0.1, 0.5, 0.8, 1.1] {
        let (_, motion) = falls(&standing(8.0), off_secs, 0.5, 7.0);
        assert!(motion.is_smooth() && motion.off_m < 0.02, "off for {off_secs} s: {motion:?}");
    }
}

#[test]
fn a_walker_who_went_on_meanwhile_is_met_where_he_is() {
    let Some(folder) = mocap() else { return };
    let walk = Performer::read(&folder.join("accad_bvh/Female1_B03_Walk1.bvh"));
    // Three seconds on the ground put it four metres behind; it makes up for 0.8 of them in a second.
    let (height_m, motion) = falls(&walk, 3.0, 1.0, 14.0);
    assert!(height_m < 0.6, "it fell: hips at {height_m} m");
    // No foot is faster than this walker's own swing and the hurry after the performer, 4.8 m/s.
    assert!(motion.is_smooth(), "{motion:?}");
    // Every part within what a walk is followed with, at its worst.
    assert!(motion.off_m < 0.08, "{motion:?}");
}

#[test]
fn gains_that_hold_nothing_and_come_back_do_not_pop_either() {
    let performer = standing(16.0);
    let mut act = Act::new(&performer, KdSettings::default());
    act.tracker.set_gains(KdPreset::Balloon.gains(), 0.3);
    for step in 0..steps(3.0) {
        if step < steps(1.0) {
            act.world.push_part(CharacterId::first_in(0), Node::Chest, DVec3::Z * 20.0, None);
        }
        act.step();
    }
    let height_m = act.world.frame().characters[0].parts[0].position.y;
    assert!(height_m < performer.pose(0).hips_position.y - 0.1, "it sank: hips at {height_m} m");
    act.tracker.set_gains(KdPreset::Default.gains(), 0.8);
    let motion = Motion::of(&mut act, 8.0);
    assert!(motion.is_smooth() && motion.off_m < 0.02, "{motion:?}");
}

#[test]
fn weights_change_what_an_arm_carries_and_fade() {
    let performer = standing(6.0);
    let mut act = Act::new(&performer, KdSettings::default());
    let arm = [Node::LeftUpperArm, Node::LeftLowerArm, Node::LeftHand];
    let push = |act: &mut Act| {
        let mut most: f64 = 0.0;
        for _ in 0..360 {
            act.world.push_part(CharacterId::first_in(0), Node::LeftHand, DVec3::Z * 10.0, None);
            act.step();
            let hand = act.world.frame().characters[0].part(Node::LeftHand).centre;
            most = most.max((hand - performer.centres(performer.pose(0))[Node::LeftHand.index()]).length());
        }
        most
    };
    let firm = push(&mut act);
    for node in arm {
        act.tracker.set_weight(node, Some(0.0), Some(0.1), 0.2);
    }
    let loose = push(&mut act);
    assert!(loose > 2.0 * firm, "{firm} m, {loose} m");
    assert_eq!(act.tracker.weight(Node::LeftHand).pin, 0.0);
}
