//! The channels of one animation, checked.

use super::data::Data;
use super::element;
use super::schema::Root;
use super::track::{Interpolation, Track};
use crate::{Error, Note};
use std::collections::BTreeMap;
use std::rc::Rc;

const EXPORT_AGAIN: &str = "the file is damaged or its exporter is wrong: export it again";

/// A rotation key whose length is farther from 1 than this is invalid. Exporters with quantised keys are within a
/// hundredth.
const UNIT_TOLERANCE: f64 = 0.05;

/// What moves one node.
#[derive(Debug, Default)]
pub(super) struct NodeTracks {
    pub translation: Option<Track>,
    pub rotation: Option<Track>,
    pub scale: Option<Track>,
}

/// Which nodes the animation that is read moves; checks the channels' indices.
pub(super) fn animated(root: &Root) -> Result<Vec<bool>, Error> {
    let mut animated = vec![false; root.nodes.len()];
    let Some(animation) = root.animation() else { return Ok(animated) };
    for (index, channel) in animation.channels.iter().enumerate() {
        let name = || root.animation_element("channels", index);
        if channel.sampler >= animation.samplers.len() {
            let problem = format!("sampler {} does not exist", channel.sampler);
            return Err(element(name(), problem, EXPORT_AGAIN));
        }
        let Some(node) = channel.target.node else { continue };
        let Some(slot) = animated.get_mut(node) else {
            return Err(element(name(), format!("node {node} does not exist"), EXPORT_AGAIN));
        };
        *slot |= matches!(channel.target.path.as_str(), "translation" | "rotation" | "scale");
    }
    Ok(animated)
}

/// Reads that animation's channels for the nodes that `wanted` names.
pub(super) fn tracks(
    root: &Root,
    data: &Data<'_>,
    wanted: &[bool],
    notes: &mut Vec<Note>,
) -> Result<BTreeMap<usize, NodeTracks>, Error> {
    let mut tracks: BTreeMap<usize, NodeTracks> = BTreeMap::new();
    let Some(animation) = root.animation() else { return Ok(tracks) };
    let mut inputs = BTreeMap::new();
    let mut elsewhere = 0;
    for (index, channel) in animation.channels.iter().enumerate() {
        let name = root.animation_element("channels", index);
        let Some(node) = channel.target.node else { continue };
        if !wanted[node] {
            elsewhere += 1;
            continue;
        }
        let entry = tracks.entry(node).or_default();
        let (slot, shape) = match channel.target.path.as_str() {
            "translation" => (&mut entry.translation, "VEC3"),
            "rotation" => (&mut entry.rotation, "VEC4"),
            "scale" => (&mut entry.scale, "VEC3"),
            _ => continue,
        };
        if slot.is_some() {
            let problem = format!("node {node} has two channels for its {}", channel.target.path);
            return Err(element(name, problem, EXPORT_AGAIN));
        }
        *slot = Some(track(root, data, channel.sampler, shape, &mut inputs)?);
    }
    if elsewhere > 0 {
        notes.push(Note::new(format!("{elsewhere} channels move nodes that are not joints and are left out")));
    }
    Ok(tracks)
}

fn track(
    root: &Root,
    data: &Data<'_>,
    index: usize,
    shape: &str,
    inputs: &mut BTreeMap<usize, Rc<Vec<f64>>>,
) -> Result<Track, Error> {
    let sampler = &root.animations[root.chosen].samplers[index];
    let name = root.animation_element("samplers", index);
    let interpolation = match sampler.interpolation.as_deref() {
        None | Some("LINEAR") => Interpolation::Linear,
        Some("STEP") => Interpolation::Step,
        Some("CUBICSPLINE") => Interpolation::CubicSpline,
        Some(other) => {
            let problem = format!("interpolation {other:?} is not one of LINEAR, STEP, CUBICSPLINE");
            return Err(element(name, problem, EXPORT_AGAIN));
        }
    };
    let times_secs = match inputs.get(&sampler.input) {
        Some(times) => Rc::clone(times),
        None => {
            let user = format!("{name}.input");
            let times = data.floats(sampler.input, "SCALAR", false, &user)?;
            if let Some(at) = times.windows(2).position(|pair| pair[0] >= pair[1]) {
                let problem =
                    format!("key {} is at {} s, not after the key before it at {} s", at + 1, times[at + 1], times[at]);
                return Err(element(user, problem, "export again: keys must ascend in time"));
            }
            let times = Rc::new(times.into_iter().map(f64::from).collect::<Vec<_>>());
            inputs.insert(sampler.input, Rc::clone(&times));
            times
        }
    };
    let user = format!("{name}.output");
    let width = if shape == "VEC4" { 4 } else { 3 };
    let values = data.floats(sampler.output, shape, shape == "VEC4", &user)?;
    let rows_per_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
    let (rows, needed) = (values.len() / width, times_secs.len() * rows_per_key);
    if rows != needed {
        let problem = format!("{rows} values for {} keys, where {needed} are needed", times_secs.len());
        return Err(element(user, problem, EXPORT_AGAIN));
    }
    let track = Track { times_secs, values, width, interpolation };
    if width == 4 {
        let far = |key: &usize| (track.key(*key).length() - 1.0).abs() > UNIT_TOLERANCE;
        if let Some(key) = (0..track.times_secs.len()).find(far) {
            let problem = format!("the rotation of key {key} has length {}, not 1", track.key(key).length());
            return Err(element(user, problem, "export again with unit quaternions"));
        }
    }
    Ok(track)
}
