//! Limbs, head and hips by the joints' names.

use super::Origin;
use super::draft::Draft;
use super::names::{Kind, Name};
use super::people::Scope;
use crate::{Part, Side, Skeleton};

pub(super) const SIDES: [Side; 2] = [Side::Left, Side::Right];

/// The parsed names of a skeleton, searchable by kind and side.
pub(super) struct Names<'a> {
    skeleton: &'a Skeleton,
    names: Vec<Name>,
    depths: Vec<usize>,
}

impl<'a> Names<'a> {
    /// Of the joints of a scope alone: names of others mean nothing.
    pub fn new(skeleton: &'a Skeleton, scope: &Scope) -> Names<'a> {
        let joints = skeleton.joints();
        let inside: Vec<usize> = (0..joints.len()).filter(|&joint| scope.holds(joint)).collect();
        let texts: Vec<&str> = inside.iter().map(|&joint| joints[joint].name.as_str()).collect();
        let mut depths: Vec<usize> = Vec::with_capacity(joints.len());
        for joint in joints {
            depths.push(joint.parent.map_or(0, |parent| depths[parent] + 1));
        }
        let mut names = vec![Name { side: None, kind: None }; joints.len()];
        inside.into_iter().zip(super::names::read(&texts)).for_each(|(joint, name)| names[joint] = name);
        Names { skeleton, names, depths }
    }

    pub fn name(&self, joint: usize) -> &Name {
        &self.names[joint]
    }

    pub fn kind(&self, joint: usize) -> Option<Kind> {
        self.names[joint].kind
    }

    /// All joints of this kind and side, parents before children.
    pub fn all(&self, kind: Kind, side: Option<Side>) -> impl Iterator<Item = usize> + '_ {
        let wanted = Name { side, kind: Some(kind) };
        self.names.iter().enumerate().filter(move |(_, name)| **name == wanted).map(|(joint, _)| joint)
    }

    /// The joint of this kind and side that stands highest in the tree.
    pub fn first(&self, kind: Kind, side: Option<Side>) -> Option<usize> {
        self.all(kind, side).min_by_key(|&joint| self.depths[joint])
    }

    fn above(&self, upper: Option<usize>, lower: Option<usize>) -> bool {
        matches!((upper, lower), (Some(upper), Some(lower)) if upper != lower && self.skeleton.is_ancestor(upper, lower))
    }
}

/// Offers every limb joint, the head and the neck that the names give.
pub(super) fn offer(draft: &mut Draft, names: &Names) {
    for side in SIDES {
        offer_arm(draft, names, side);
        offer_leg(draft, names, side);
    }
    draft.offer(Part::Head, names.first(Kind::Head, None), Origin::Name);
    draft.offer(Part::Neck, names.first(Kind::Neck, None), Origin::Name);
}

fn offer_arm(draft: &mut Draft, names: &Names, side: Side) {
    let first = |kind| names.first(kind, Some(side));
    let shoulder = first(Kind::Shoulder);
    let arm = first(Kind::Arm);
    let named_upper = first(Kind::UpperArm);
    let named_lower = first(Kind::LowerArm);
    // `UpperArm, Arm`: the second is the lower one. `Arm, ForeArm`: the first is the upper one. `Shoulder, Elbow`: so is it.
    let lower = named_lower.or(if names.above(named_upper, arm) { arm } else { None });
    let upper = named_upper.or([arm, shoulder].into_iter().find(|&upper| names.above(upper, named_lower)).flatten());
    let collar = first(Kind::Collar).or(shoulder).filter(|&collar| names.above(Some(collar), upper));
    let wrist = first(Kind::Wrist);
    let hand = first(Kind::Hand);
    let hand = if hand.is_none() || names.above(wrist, hand) { wrist } else { hand };
    for (part, joint) in
        [(Part::LeftShoulder, collar), (Part::LeftUpperArm, upper), (Part::LeftLowerArm, lower), (Part::LeftHand, hand)]
    {
        draft.offer(Draft::sided(part, side), joint, Origin::Name);
    }
}

/// Offers an arm or a leg without a joint below it as its upper part: for messages on what is missing.
pub(super) fn offer_stumps(draft: &mut Draft, names: &Names) {
    for side in SIDES {
        for (kind, part) in [(Kind::Arm, Part::LeftUpperArm), (Kind::Leg, Part::LeftUpperLeg)] {
            draft.offer(Draft::sided(part, side), names.first(kind, Some(side)), Origin::Name);
        }
    }
}

fn offer_leg(draft: &mut Draft, names: &Names, side: Side) {
    let first = |kind| names.first(kind, Some(side));
    let leg = first(Kind::Leg);
    let named_upper = first(Kind::UpperLeg);
    let named_lower = first(Kind::LowerLeg);
    let hip = first(Kind::Hips);
    let upper = named_upper.or([hip, leg].into_iter().find(|&upper| names.above(upper, named_lower.or(leg))).flatten());
    // `Leg01, Leg02` does not tell which is which: the shape decides.
    let lower = named_lower.or(if names.above(upper, leg) { leg } else { None });
    let ankle = first(Kind::Ankle);
    let below = first(Kind::Foot);
    let pivot = below.is_none() || names.above(ankle, below);
    let foot = if pivot { ankle } else { below };
    let toes = first(Kind::Toes).or(if pivot { below } else { None });
    for (part, joint) in
        [(Part::LeftUpperLeg, upper), (Part::LeftLowerLeg, lower), (Part::LeftFoot, foot), (Part::LeftToes, toes)]
    {
        draft.offer(Draft::sided(part, side), joint, Origin::Name);
    }
}
