//! Which of a file's animations is read, and what the others are.

use super::data::Data;
use super::schema::{Animation, Root};
use super::tree::{self, Tree};
use crate::choice::choose;
use crate::formats::AnimationInfo;
use crate::formats::rate::rate_hz;
use crate::{Clip, Error, Limits, Part};
use std::collections::BTreeMap;

/// Maximum number of animations of which keys are looked at only to list them.
const MOST_LISTED: usize = 1000;

/// Index of the animation to read: the one that `wanted` tells, else the first with two keys or more of the skeleton, else the
/// first with as many of anything, else the first.
pub(super) fn chosen(root: &Root, tree: &Tree, bones: &[(Part, usize)], wanted: Option<&str>) -> Result<usize, Error> {
    if let Some(wanted) = wanted {
        let names: Vec<Vec<&str>> =
            root.animations.iter().map(|animation| vec![animation.name.as_deref().unwrap_or_default()]).collect();
        return choose(("animation", "animations"), wanted, &names);
    }
    let first_of = |nodes: &[bool]| {
        let moves =
            |animation: &Animation| channels(animation, nodes).any(|sampler| keys(root, animation, sampler) > 1);
        root.animations.iter().position(moves)
    };
    let skeleton = match root.skins.is_empty() {
        true => None,
        false => Some(tree.at_or_above(&tree::joints(root, tree, &[], bones)?)),
    };
    let of_skeleton = skeleton.and_then(|nodes| first_of(&nodes));
    Ok(of_skeleton.or_else(|| first_of(&vec![true; root.nodes.len()])).unwrap_or(0))
}

/// All animations, with the frames and the rate that their keys of the `members` make; `clip` is the one that was read.
pub(super) fn list(root: &Root, data: &Data<'_>, members: &[bool], clip: &Clip, limits: &Limits) -> Vec<AnimationInfo> {
    let mut known = BTreeMap::new();
    let mut info = |(index, animation): (usize, &Animation)| {
        let (frames, fps) = match index {
            _ if index == root.chosen => (clip.frames(), clip.fps()),
            0..MOST_LISTED => frames(data, members, animation, &mut known, limits).unwrap_or((0, 0.0)),
            _ => (0, 0.0),
        };
        let name = animation.name.clone().unwrap_or_default();
        AnimationInfo { name, frames, fps, is_read: index == root.chosen }
    };
    root.animations.iter().enumerate().map(&mut info).collect()
}

/// Frames and rate of an animation's keys; `None` where they cannot be read.
fn frames(
    data: &Data<'_>,
    members: &[bool],
    animation: &Animation,
    known: &mut BTreeMap<usize, Option<Vec<f64>>>,
    limits: &Limits,
) -> Option<(usize, f64)> {
    let samplers: Vec<_> = channels(animation, members).filter_map(|sampler| animation.samplers.get(sampler)).collect();
    for sampler in &samplers {
        known.entry(sampler.input).or_insert_with(|| {
            let times = data.floats(sampler.input, "SCALAR", false, "samplers").ok()?;
            Some(times.into_iter().map(f64::from).collect::<Vec<_>>()).filter(|times| !times.is_empty())
        });
    }
    let times: Vec<&[f64]> = samplers
        .iter()
        .map(|sampler| known.get(&sampler.input).and_then(|times| times.as_deref()))
        .collect::<Option<_>>()?;
    let curved = samplers.iter().any(|sampler| sampler.interpolation.as_deref() == Some("CUBICSPLINE"));
    let hz = rate_hz(times.iter().copied(), curved).unwrap_or(super::reader::DEFAULT_HZ);
    let first = times.iter().map(|times| times[0]).fold(f64::INFINITY, f64::min);
    let last = times.iter().map(|times| times[times.len() - 1]).fold(f64::NEG_INFINITY, f64::max);
    let frames = if first < last { ((last - first) * hz - 0.01).ceil() + 1.0 } else { 1.0 };
    (frames <= limits.frames as f64).then_some((frames as usize, hz))
}

/// Samplers of the channels that move one of these nodes.
fn channels<'a>(animation: &'a Animation, nodes: &'a [bool]) -> impl Iterator<Item = usize> + 'a {
    let moves = |path: &str| matches!(path, "translation" | "rotation" | "scale");
    let is_one = |node: usize| nodes.get(node).copied().unwrap_or(false);
    let channels = animation.channels.iter();
    let ours = channels.filter(move |channel| moves(&channel.target.path) && channel.target.node.is_some_and(is_one));
    ours.map(|channel| channel.sampler)
}

fn keys(root: &Root, animation: &Animation, sampler: usize) -> u64 {
    let input = animation.samplers.get(sampler).and_then(|sampler| root.accessors.get(sampler.input));
    input.map_or(0, |accessor| accessor.count)
}
