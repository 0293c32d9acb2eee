//! Hips, spine, chest, neck and head by what hangs from them.

use super::Origin;
use super::by_name::{Names, SIDES};
use super::check;
use super::draft::{Draft, common_ancestor, path};
use super::names::Kind;
use crate::{Error, Part, Skeleton};

/// The chains of the midline.
pub(super) struct Trunk {
    pub spine_chain: Vec<usize>,
    pub neck_chain: Vec<usize>,
}

/// Finds the trunk between limbs and head that are known, and puts its parts into the draft.
pub(super) fn find(draft: &mut Draft, skeleton: &Skeleton, names: &Names) -> Result<Trunk, Error> {
    let both = |part| Some((draft.joint(part)?, draft.joint(Part::mirrored(part))?));
    let apart = |what: &str| check::error(format!("{what} hang from different roots"), skeleton);
    let (Some(arms), Some(legs)) = (both(Part::LeftUpperArm), both(Part::LeftUpperLeg)) else {
        return Err(check::error("upper arms or upper legs are missing".to_owned(), skeleton));
    };
    let top = draft.joint(Part::Head).or(draft.joint(Part::Neck));
    let top = top.ok_or_else(|| check::error("neither head nor neck can be found".to_owned(), skeleton))?;
    let above_legs = common_ancestor(skeleton, legs.0, legs.1).ok_or_else(|| apart("the legs"))?;
    let above_arms = common_ancestor(skeleton, arms.0, arms.1).ok_or_else(|| apart("the arms"))?;
    let mut chest = common_ancestor(skeleton, above_arms, top).ok_or_else(|| apart("arms and head"))?;
    // 3ds Max hangs the arms from the neck; the joint below it still is the chest.
    if names.kind(chest) == Some(Kind::Neck) {
        chest = skeleton.joints()[chest].parent.unwrap_or(chest);
    }
    if let Some(joint) = draft.joint(Part::UpperChest).or(draft.joint(Part::Chest)) {
        chest = joint;
    }
    find_hips(draft, skeleton, names, above_legs, chest)?;
    let Some(hips) = draft.joint(Part::Hips) else {
        return Err(check::error("the hips cannot be found".to_owned(), skeleton));
    };
    let spine_chain = path(skeleton, hips, chest);
    if spine_chain.is_empty() {
        let problem =
            format!("the trunk has no joint between the hips {:?} and the arms", skeleton.joints()[hips].name);
        return Err(check::error(problem, skeleton));
    }
    offer_spine(draft, names, &spine_chain, chest);
    let neck_chain = find_neck(draft, skeleton, names, chest, top);
    Ok(Trunk { spine_chain, neck_chain })
}

/// The hips: the lowest joint so named (or the root) that is above both legs and the chest; else where they meet.
fn find_hips(
    draft: &mut Draft,
    skeleton: &Skeleton,
    names: &Names,
    above_legs: usize,
    chest: usize,
) -> Result<(), Error> {
    let meeting = common_ancestor(skeleton, above_legs, chest)
        .ok_or_else(|| check::error("legs and trunk hang from different roots".to_owned(), skeleton))?;
    // A joint that is the chest and above the legs too would leave no trunk.
    let carries = |joint: &usize| *joint != chest && skeleton.is_ancestor(*joint, meeting);
    let named = names.all(Kind::Hips, None).filter(carries).last();
    // With legs and spine on one unnamed joint, a root above it is a placement in the world, not a pelvis.
    let root = names.all(Kind::Root, None).filter(|joint| *joint == meeting).last();
    draft.offer(Part::Hips, named.or(root), Origin::Name);
    draft.offer(Part::Hips, Some(meeting).filter(carries), Origin::Shape);
    Ok(())
}

fn offer_spine(draft: &mut Draft, names: &Names, chain: &[usize], chest: usize) {
    let origin = |joint: usize| match names.kind(joint) {
        Some(Kind::Trunk | Kind::UpperChest) => Origin::Name,
        _ => Origin::Shape,
    };
    if names.kind(chest) == Some(Kind::UpperChest) && chain.len() > 1 {
        draft.offer(Part::UpperChest, Some(chest), Origin::Name);
        let below = chain.len() - 2;
        draft.offer(Part::Chest, Some(chain[below]).filter(|_| chain.len() > 2), origin(chain[below]));
    } else {
        draft.offer(Part::Chest, Some(chest), origin(chest));
    }
    draft.offer(Part::Spine, Some(chain[0]).filter(|&spine| spine != chest), origin(chain[0]));
}

/// The chain from above the chest to the head, and neck and head in it.
fn find_neck(draft: &mut Draft, skeleton: &Skeleton, names: &Names, chest: usize, top: usize) -> Vec<usize> {
    let mut chain = path(skeleton, chest, top);
    if draft.joint(Part::Head).is_none() {
        // Only a neck is named: what continues it in a single chain belongs to it, and its last joint is the head.
        let mut at = top;
        while let Some(next) =
            Some(at).filter(|&at| skeleton.children(at).count() == 1).and_then(|at| skeleton.children(at).next())
        {
            if names.kind(next) == Some(Kind::Other) || chain.len() > skeleton.len() {
                break;
            }
            chain.push(next);
            at = next;
        }
        if chain.len() > 1 {
            draft.offer(Part::Head, chain.last().copied(), Origin::Shape);
        }
    }
    let head = draft.joint(Part::Head);
    let below_head = chain.iter().copied().filter(|&joint| head != Some(joint));
    let first = below_head.clone().find(|&joint| names.kind(joint) == Some(Kind::Neck)).or(below_head.clone().next());
    if let Some(first) = first {
        if !matches!(draft.origin(Part::Neck), Some(Origin::Override | Origin::Stated)) {
            let origin = if names.kind(first) == Some(Kind::Neck) { Origin::Name } else { Origin::Shape };
            draft.drop_part(Part::Neck);
            draft.offer(Part::Neck, Some(first), origin);
        }
    } else if head.is_some() && draft.origin(Part::Neck) == Some(Origin::Name) {
        // A neck that is not between chest and head.
        draft.drop_part(Part::Neck);
    }
    // A collar bone is the joint between chest and upper arm, whatever the rig calls it.
    for side in SIDES {
        let Some(upper) = draft.on(Part::LeftUpperArm, side) else { continue };
        let between = path(skeleton, chest, upper);
        let part = Draft::sided(Part::LeftShoulder, side);
        let candidate = between.iter().rev().skip(1).find(|&&joint| names.kind(joint) != Some(Kind::Neck)).copied();
        draft.offer(part, candidate, Origin::Shape);
    }
    chain
}
