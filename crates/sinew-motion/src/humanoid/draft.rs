//! A partial mapping.

use super::Origin;
use crate::{Part, Side, Skeleton};

/// Which joint is which part, as far as it is known.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    parts: [Option<(usize, Origin)>; Part::COUNT],
}

impl Draft {
    pub fn new() -> Draft {
        Draft { parts: [None; Part::COUNT] }
    }

    pub fn joint(&self, part: Part) -> Option<usize> {
        self.parts[part as usize].map(|(joint, _)| joint)
    }

    pub fn origin(&self, part: Part) -> Option<Origin> {
        self.parts[part as usize].map(|(_, origin)| origin)
    }

    pub fn part_of(&self, joint: usize) -> Option<Part> {
        Part::ALL.iter().copied().find(|&part| self.joint(part) == Some(joint))
    }

    /// Sets a part unless the user or a better source has set it, or the joint is another part already.
    pub fn offer(&mut self, part: Part, joint: Option<usize>, origin: Origin) {
        if let Some(joint) = joint
            && self.joint(part).is_none()
            && self.part_of(joint).is_none()
        {
            self.parts[part as usize] = Some((joint, origin));
        }
    }

    /// Sets a part, taking the joint away from any other.
    pub fn force(&mut self, part: Part, joint: usize, origin: Origin) {
        if let Some(other) = self.part_of(joint) {
            self.parts[other as usize] = None;
        }
        self.parts[part as usize] = Some((joint, origin));
    }

    pub fn drop_part(&mut self, part: Part) {
        self.parts[part as usize] = None;
    }

    /// The part that `left` names, on this side.
    pub fn sided(left: Part, side: Side) -> Part {
        if side == Side::Left { left } else { left.mirrored() }
    }

    pub fn on(&self, left: Part, side: Side) -> Option<usize> {
        self.joint(Draft::sided(left, side))
    }
}

/// The lowest joint that is above both or one of them; `None` when they stand in different trees.
pub(super) fn common_ancestor(skeleton: &Skeleton, a: usize, b: usize) -> Option<usize> {
    let mut at = Some(a);
    while let Some(joint) = at {
        if skeleton.is_ancestor(joint, b) {
            return Some(joint);
        }
        at = skeleton.joints()[joint].parent;
    }
    None
}

/// The joints from below `above` down to and including `below`; empty when `above` is not above it.
pub(super) fn path(skeleton: &Skeleton, above: usize, below: usize) -> Vec<usize> {
    let mut path = Vec::new();
    let mut at = Some(below);
    while let Some(joint) = at {
        if joint == above {
            path.reverse();
            return path;
        }
        path.push(joint);
        at = skeleton.joints()[joint].parent;
    }
    Vec::new()
}
