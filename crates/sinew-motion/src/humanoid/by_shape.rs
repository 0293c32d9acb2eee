//! Limbs, trunk and head by the shape of the tree alone, for joints whose names are unknown.
//!
//! A human body has one topology: at the pelvis two equal chains with two long bones each branch off beside the trunk,
//! at the chest two more beside the neck. Names or the direction of the toes decide which of two equal chains is the
//! left one.

use super::by_name::Names;
use super::draft::{common_ancestor, path};
use super::names::Kind;
use super::people::Scope;
use crate::{Clip, Skeleton};
use glam::DVec3;

/// Four joints of a limb; the end (hand, foot) may be missing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Limb {
    /// The joint where the limb leaves the trunk: a collar bone or hip helper, or the upper joint itself.
    pub base: usize,
    pub upper: usize,
    pub lower: usize,
    pub end: Option<usize>,
    /// The joint after the end, when there is only one.
    pub beyond: Option<usize>,
    /// Lengths of the two long bones, in the clip's unit.
    lengths: [f64; 2],
}

/// The parts found by shape.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    pub hips: usize,
    /// One of the pair, then the other; sides are not known here.
    pub legs: [Limb; 2],
    pub arms: [Limb; 2],
    pub neck: Option<usize>,
    pub head: Option<usize>,
}

/// Two branches that may be a pair of limbs.
struct Pair {
    at: usize,
    limbs: [Limb; 2],
    difference: f64,
}

struct Tree<'a> {
    skeleton: &'a Skeleton,
    children: Vec<Vec<usize>>,
    /// Vector from the parent to the joint, in the parent's frame.
    offsets: Vec<DVec3>,
    /// Longest way from the joint to any end below it.
    reach: Vec<f64>,
}

impl<'a> Tree<'a> {
    fn new(clip: &'a Clip) -> Tree<'a> {
        let skeleton = clip.skeleton();
        let offsets: Vec<DVec3> = (0..skeleton.len())
            .map(|joint| match clip.frames() {
                0 => skeleton.joints()[joint].rest.translation,
                frames => clip.translation(frames / 2, joint),
            })
            .collect();
        let mut children = vec![Vec::new(); skeleton.len()];
        let mut reach: Vec<f64> =
            skeleton.joints().iter().map(|joint| joint.tip.map_or(0.0, |tip| tip.length())).collect();
        for joint in (0..skeleton.len()).rev() {
            if let Some(parent) = skeleton.joints()[joint].parent {
                children[parent].insert(0, joint);
                reach[parent] = reach[parent].max(reach[joint] + offsets[joint].length());
            }
        }
        Tree { skeleton, children, offsets, reach }
    }

    /// The longest chain from a joint down.
    fn chain(&self, from: usize) -> Vec<usize> {
        let mut chain = vec![from];
        let mut at = from;
        let length = |joint: usize| self.offsets[joint].length() + self.reach[joint];
        while let Some(&next) =
            self.children[at].iter().max_by(|&&a, &&b| length(a).total_cmp(&length(b)).then(b.cmp(&a)))
        {
            chain.push(next);
            at = next;
        }
        chain
    }

    /// The branch as a limb: its two longest bones in a row.
    fn limb(&self, base: usize) -> Option<Limb> {
        let chain = self.chain(base);
        let short = self.reach[base] * 1e-3;
        // Joints at one place: the first and the last of them.
        let mut places: Vec<(usize, usize)> = vec![(base, base)];
        let mut lengths: Vec<f64> = Vec::new();
        for &joint in &chain[1..] {
            let length = self.offsets[joint].length();
            match places.last_mut() {
                Some(place) if length <= short => place.1 = joint,
                _ => {
                    places.push((joint, joint));
                    lengths.push(length);
                }
            }
        }
        let tip = chain.last().and_then(|&leaf| self.skeleton.joints()[leaf].tip).map_or(0.0, |tip| tip.length());
        lengths.push(tip);
        // A base where the trunk ends has no bone of its own before it: it is a collar bone or a hip helper. And where two
        // pairs of bones are about as long, the lower one is the limb: collar bones can be long, fingers are not.
        let start = usize::from(self.offsets[base].length() <= short);
        let length = |at: usize| lengths[at] + lengths[at + 1];
        let pairs = start..lengths.len().saturating_sub(1);
        let longest = pairs.clone().map(length).fold(0.0, f64::max);
        let first = pairs.rev().find(|&at| length(at) >= 0.93 * longest)?;
        let two = [lengths[first], lengths[first + 1]];
        if two[0].min(two[1]) < 0.3 * two[0].max(two[1]) {
            return None;
        }
        // The last joint at a place turns the bone that begins there, the first one ends the bone before.
        let end = places.get(first + 2).map(|place| place.0);
        let beyond = end.filter(|&end| self.children[end].len() == 1).map(|end| self.children[end][0]);
        Some(Limb { base, upper: places[first].1, lower: places[first + 1].1, end, beyond, lengths: two })
    }

    /// The most alike pair of branches of a joint.
    fn pair(&self, at: usize, scale: f64) -> Option<Pair> {
        let limbs: Vec<Limb> = self.children[at]
            .iter()
            .filter(|&&child| self.reach[child] > 0.15 * scale)
            .filter_map(|&child| self.limb(child))
            .collect();
        let mut best: Option<Pair> = None;
        for (index, a) in limbs.iter().enumerate() {
            for b in &limbs[index + 1..] {
                let relative = |a: f64, b: f64| (a - b).abs() / a.max(b);
                let difference = relative(a.lengths[0], b.lengths[0])
                    .max(relative(a.lengths[1], b.lengths[1]))
                    .max(0.5 * relative(self.reach[a.base], self.reach[b.base]));
                // Captured people differ by a few per cent between their sides.
                if difference < 0.15 && best.as_ref().is_none_or(|best| difference < best.difference) {
                    best = Some(Pair { at, limbs: [a.clone(), b.clone()], difference });
                }
            }
        }
        best
    }
}

/// Finds the body among the joints of a scope, or says what is missing for one.
pub(super) fn find(clip: &Clip, scope: &Scope, names: &Names) -> Result<Shape, String> {
    let tree = Tree::new(clip);
    let skeleton = clip.skeleton();
    let inside = || (0..skeleton.len()).filter(|&joint| scope.holds(joint));
    let scale = inside().map(|joint| tree.reach[joint]).fold(0.0, f64::max);
    let mut pairs: Vec<Pair> = inside().filter_map(|at| tree.pair(at, scale)).collect();
    if pairs.len() < 2 {
        let found = if pairs.is_empty() { "no pair" } else { "only one pair" };
        return Err(format!(
            "it has {} joints and {found} of equal limbs, where a body has two legs and two arms",
            inside().count()
        ));
    }
    let bones = |pair: &Pair| pair.limbs.iter().flat_map(|limb| limb.lengths).sum::<f64>();
    // No body has more than a few; a hostile tree with many must not take for ever.
    pairs.sort_by(|a, b| bones(b).total_cmp(&bones(a)));
    pairs.truncate(64);
    // Arms hang at a joint below the one with the legs, in a branch that is no leg. The pair with the largest total
    // bone length wins.
    let mut best: Option<(f64, usize, usize)> = None;
    for (at_legs, legs) in pairs.iter().enumerate() {
        for (at_arms, arms) in pairs.iter().enumerate() {
            let inside_leg = legs.limbs.iter().any(|limb| skeleton.is_ancestor(limb.base, arms.at));
            let inside_arm = arms.limbs.iter().any(|limb| skeleton.is_ancestor(limb.base, legs.at));
            if at_legs == at_arms || inside_leg || inside_arm {
                continue;
            }
            let below = skeleton.is_ancestor(legs.at, arms.at);
            let beside = !skeleton.is_ancestor(arms.at, legs.at) && bones(legs) > bones(arms);
            let total = bones(legs) + bones(arms);
            if (below || beside) && best.is_none_or(|(most, ..)| total > most) {
                best = Some((total, at_legs, at_arms));
            }
        }
    }
    let Some((_, legs, arms)) = best else {
        return Err("its limbs do not branch off a trunk as legs and arms do".to_owned());
    };
    let (legs, arms) = (&pairs[legs], &pairs[arms]);
    let hips = common_ancestor(skeleton, legs.at, arms.at)
        .ok_or_else(|| "its legs and arms hang from different roots".to_owned())?;
    // The neck leaves the trunk where the arms do, or further down when the arms hang from a helper.
    let mut trunk = path(skeleton, hips, arms.at);
    trunk.insert(0, hips);
    let taken = |joint: usize| {
        [legs, arms]
            .iter()
            .any(|pair| pair.limbs.iter().any(|limb| limb.base == joint) || skeleton.is_ancestor(joint, pair.at))
    };
    let neck = trunk.iter().skip(1).rev().find_map(|&joint| {
        let branches = tree.children[joint].iter().copied().filter(|&child| !taken(child));
        branches.max_by(|&a, &b| tree.reach[a].total_cmp(&tree.reach[b]).then(b.cmp(&a)))
    });
    let (neck, head) = match neck {
        None => (None, None),
        Some(first) => {
            // A head carries eyes and a jaw: it is the first joint that branches, or the last of the chain that is no face.
            let mut chain = tree.chain(first);
            let faces = chain.iter().position(|&joint| names.kind(joint) == Some(Kind::Other));
            chain.truncate(faces.unwrap_or(chain.len()).max(1));
            let head = chain.iter().copied().find(|&joint| tree.children[joint].len() > 1).or(chain.last().copied());
            (Some(first).filter(|&first| head != Some(first)), head)
        }
    };
    Ok(Shape { hips, legs: legs.limbs.clone(), arms: arms.limbs.clone(), neck, head })
}
