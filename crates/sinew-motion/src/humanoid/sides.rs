//! Left and right: assigned to chains found by shape, and checked for chains found by name.

use super::by_name::{Names, SIDES};
use super::by_shape::{Limb, Shape};
use super::draft::Draft;
use super::{Humanoid, Origin, check};
use crate::pose::{leading_axis, sample_poses};
use crate::{Clip, Error, Note, Part, Side, Transform};
use glam::DVec3;

/// Offers the parts of a shape; names, or else geometry, decide the sides of each pair of limbs.
pub(super) fn offer(
    draft: &mut Draft,
    clip: &Clip,
    names: &Names,
    shape: &Shape,
    notes: &mut Vec<Note>,
) -> Result<(), Error> {
    let poses = sample_poses(clip, 64);
    let named = [&shape.legs, &shape.arms].map(|pair| named_left_first(pair, names, draft));
    let mut seen_by = None;
    for ((pair, parts), (named, other)) in [
        (&shape.legs, [Part::LeftUpperLeg, Part::LeftLowerLeg, Part::LeftFoot, Part::LeftToes]),
        (&shape.arms, [Part::LeftUpperArm, Part::LeftLowerArm, Part::LeftHand, Part::LeftShoulder]),
    ]
    .into_iter()
    .zip([
        (named[0], named[1].map(|left_first| (&shape.arms, left_first))),
        (named[1], named[0].map(|left_first| (&shape.legs, left_first))),
    ]) {
        let beside = || other.map(|other| beside_left_first(&poses, pair, other));
        let mut seen = || {
            let (left_first, by) = seen_left_first(clip, shape, &poses, pair)?;
            seen_by = Some(by);
            Some(left_first)
        };
        let Some(left_first) = named.or_else(beside).or_else(&mut seen) else {
            return Err(check::error(
                "left and right cannot be distinguished: its names have no sides, it has no toes and does not travel"
                    .to_owned(),
                clip.skeleton(),
            ));
        };
        for (limb, side) in pair.iter().zip(if left_first { SIDES } else { [Side::Right, Side::Left] }) {
            let is_arm = parts[3] == Part::LeftShoulder;
            let last = if is_arm { Some(limb.base).filter(|&base| base != limb.upper) } else { limb.beyond };
            for (part, joint) in parts.into_iter().zip([Some(limb.upper), Some(limb.lower), limb.end, last]) {
                draft.offer(Draft::sided(part, side), joint, Origin::Shape);
            }
        }
    }
    draft.offer(Part::Hips, Some(shape.hips).filter(|&hips| names.kind(hips).is_none()), Origin::Shape);
    draft.offer(Part::Head, shape.head, Origin::Shape);
    draft.offer(Part::Neck, shape.neck, Origin::Shape);
    notes.extend(seen_by.map(|by| {
        let swap = match by {
            SeenBy::Toes => "where its toes point",
            SeenBy::Travel => "where it travels, and a walk backward swaps them",
        };
        Note::new(format!("left and right were told by {swap}: its names have no sides; ReadOptions::parts names them"))
    }));
    notes.push(Note::new("joint names do not identify all parts: some were guessed from the shape of the skeleton"));
    Ok(())
}

/// By the side markers in the names of a pair, or the parts that its joints are already known to be.
fn named_left_first(pair: &[Limb; 2], names: &Names, draft: &Draft) -> Option<bool> {
    let vote = |limb: &Limb| -> i32 {
        let joints = [Some(limb.base), Some(limb.upper), Some(limb.lower), limb.end];
        let side = |joint: usize| draft.part_of(joint).and_then(Part::side).or(names.name(joint).side);
        joints.into_iter().flatten().filter_map(side).map(|side| if side == Side::Left { 1 } else { -1 }).sum()
    };
    let votes = vote(&pair[0]) - vote(&pair[1]);
    (votes != 0).then_some(votes > 0)
}

/// By the other pair, whose names have sides.
fn beside_left_first(poses: &[Vec<Transform>], pair: &[Limb; 2], (other, left_first): (&[Limb; 2], bool)) -> bool {
    let across =
        |pose: &Vec<Transform>, pair: &[Limb; 2]| pose[pair[0].upper].translation - pose[pair[1].upper].translation;
    let same: f64 = poses.iter().map(|pose| across(pose, pair).dot(across(pose, other))).sum();
    (same >= 0.0) == left_first
}

/// What told left from right where names did not.
#[derive(Clone, Copy)]
enum SeenBy {
    Toes,
    Travel,
}

/// By where they are: left is up × forward.
fn seen_left_first(clip: &Clip, shape: &Shape, poses: &[Vec<Transform>], pair: &[Limb; 2]) -> Option<(bool, SeenBy)> {
    let feet = shape.legs.each_ref().map(|leg| leg.end.unwrap_or(leg.lower));
    let ends = shape.legs.each_ref().map(|leg| leg.beyond);
    let head = shape.head.or(shape.neck)?;
    let (left, by) = left_of(clip, poses, shape.hips, head, feet, ends)?;
    let seen: f64 = poses
        .iter()
        .zip(&left)
        .map(|(pose, left)| left.dot(pose[pair[0].upper].translation - pose[pair[1].upper].translation))
        .sum();
    (seen != 0.0).then_some((seen > 0.0, by))
}

/// The unit vector to the body's left in each pose, from up and the direction of the toes, else of travel; `None` when
/// there are neither.
fn left_of(
    clip: &Clip,
    poses: &[Vec<Transform>],
    hips: usize,
    head: usize,
    feet: [usize; 2],
    toes: [Option<usize>; 2],
) -> Option<(Vec<DVec3>, SeenBy)> {
    let up = leading_axis(
        poses.iter().map(|pose| pose[head].translation - 0.5 * (pose[feet[0]].translation + pose[feet[1]].translation)),
    );
    let level = |vector: DVec3| vector - up * vector.dot(up);
    let toe_direction = |pose: &Vec<Transform>| -> DVec3 {
        feet.iter()
            .zip(toes)
            .map(|(&foot, toes)| {
                let tip = clip.skeleton().joints()[foot].tip.map(|tip| pose[foot].point(tip));
                let end = toes.map(|toes| pose[toes].translation).or(tip);
                end.map_or(DVec3::ZERO, |end| level(end - pose[foot].translation))
            })
            .sum()
    };
    let forward: Vec<DVec3> = poses.iter().map(toe_direction).collect();
    let size = (poses[0][head].translation - poses[0][hips].translation).length();
    if forward.iter().map(|forward| forward.length()).sum::<f64>() > 0.02 * size * poses.len() as f64 {
        let left = forward.into_iter().map(|forward| up.cross(forward).normalize_or_zero());
        return Some((left.collect(), SeenBy::Toes));
    }
    let travel = level(poses[poses.len() - 1][hips].translation - poses[0][hips].translation);
    (travel.length() > size).then(|| (vec![up.cross(travel).normalize(); poses.len()], SeenBy::Travel))
}

/// A note if the parts called left are on the right.
pub(super) fn doubt(humanoid: &Humanoid, clip: &Clip) -> Option<Note> {
    let poses = sample_poses(clip, 64);
    let feet = SIDES.map(|side| humanoid.leg(side)[2]);
    let toes = SIDES.map(|side| humanoid.toes(side));
    if toes.iter().any(Option::is_none) {
        // The tip of a foot may be its sole, and travel may be backward: neither contradicts the names.
        return None;
    }
    let (left, _) = left_of(clip, &poses, humanoid.hips(), humanoid.head(), feet, toes)?;
    let uppers = SIDES.map(|side| humanoid.leg(side)[0]);
    let agree = poses
        .iter()
        .zip(left)
        .filter(|(pose, left)| left.dot(pose[uppers[0]].translation - pose[uppers[1]].translation) > 0.0)
        .count();
    (agree * 4 < poses.len()).then(|| {
        Note::new("the joints called left are on the right of a body that faces where its toes point: is it mirrored?")
    })
}
