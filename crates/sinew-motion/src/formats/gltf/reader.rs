//! From bytes to a clip.

use super::animation::{self, NodeTracks};
use super::container::{self, Container};
use super::data::Data;
use super::document::GltfDocument;
use super::rig::{self, Rig};
use super::schema::Root;
use super::track::Interpolation;
use super::tree::Tree;
use super::{animation_list, element, tree, uri, vrm};
use crate::formats::rate::rate_hz;
use crate::formats::{Contents, Document, Parsed};
use crate::{Clip, Error, Limits, Note, Place, Transform};
use std::collections::BTreeMap;
use std::path::Path;

/// Extensions for compressed buffers that we cannot decode.
const PACKED: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
/// Default rate if the keys have none \[Hz\].
pub(super) const DEFAULT_HZ: f64 = 60.0;
/// Maximum number of frames, a constant part and a part for each key: two keys an hour apart would otherwise turn a
/// hundred bytes into a gigabyte.
const FREE_FRAMES: usize = 20_000;
const FRAMES_PER_KEY: usize = 1_000;

/// Reads a `.gltf` or `.glb` file. Buffers in other files are read only from the file's own folder or below it.
///
/// The motion is that of the first animation with keys of the skeleton; see the [module](super) for what becomes of the rest.
///
/// # Errors
/// A file that cannot be read, is not glTF 2.0, exceeds the limits, or is invalid where the motion is; the error names
/// the element (`accessors[3]`) or the byte.
pub fn read(path: &Path, limits: &Limits) -> Result<Parsed, Error> {
    read_chosen(path, None, limits)
}

/// [`read`], of the animation that `animation` names or numbers.
pub(crate) fn read_chosen(path: &Path, animation: Option<&str>, limits: &Limits) -> Result<Parsed, Error> {
    let bytes = uri::read_at_most(path, limits.file_bytes)
        .map_err(|problem| Error::new(Place::File, problem, "check the path and the file").in_file(path))?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    read_slice_chosen(&bytes, Some(folder), animation, limits).map_err(|error| error.in_file(path))
}

/// Reads a glTF file from memory. Without a `folder`, buffers in other files are refused.
///
/// ```
/// use sinew_motion::{Limits, formats::gltf};
///
/// let file = br#"{ "asset": { "version": "2.0" }, "skins": [{ "joints": [0, 1] }], "nodes": [
///     { "name": "hips", "translation": [0, 1, 0], "children": [1] },
///     { "name": "spine", "translation": [0, 0.1, 0] } ] }"#;
/// let parsed = gltf::read_slice(file, None, &Limits::default()).unwrap();
/// assert_eq!(parsed.clip.world(0)[1].translation.y, 1.1);
/// ```
///
/// # Errors
/// As [`read`].
pub fn read_slice(bytes: &[u8], folder: Option<&Path>, limits: &Limits) -> Result<Parsed, Error> {
    read_slice_chosen(bytes, folder, None, limits)
}

/// [`read_slice`], of the animation that `animation` names or numbers.
pub(crate) fn read_slice_chosen(
    bytes: &[u8],
    folder: Option<&Path>,
    animation: Option<&str>,
    limits: &Limits,
) -> Result<Parsed, Error> {
    if bytes.len() as u64 > limits.file_bytes {
        let problem = format!("{} bytes; the maximum is {}", bytes.len(), limits.file_bytes);
        return Err(Error::new(Place::File, problem, "export only the character"));
    }
    let container = container::open(bytes)?;
    let mut root = parse(&container)?;
    let mut notes = Vec::new();
    if container.trailing_bytes > 0 {
        notes.push(Note::new(format!("{} bytes after the end of the GLB are ignored", container.trailing_bytes)));
    }
    let tree = tree::tree(&root)?;
    let bones = vrm::bones(&root, &mut notes);
    root.chosen = animation_list::chosen(&root, &tree, &bones, animation)?;
    let animated = animation::animated(&root)?;
    let joints = tree::joints(&root, &tree, &animated, &bones)?;
    if !joints.contains(&true) {
        let problem = "it has neither a skin nor an animated node, so nothing in it is a skeleton";
        return Err(Error::new(Place::File, problem, "export the armature with the mesh or its animation"));
    }
    let members = rig::members(&root, &tree, &joints, &animated)?;
    let data = Data::new(&root, container.bin, folder, limits);
    let tracks = animation::tracks(&root, &data, &members, &mut notes)?;
    let rig = rig::rig(&root, &tree, &members, &tracks, limits, &mut notes)?;
    let joints = rig.joints.clone();
    let armatures = armatures(&root, &tree, &rig);
    let (clip, start_secs) = sample(rig, &tracks, root.chosen, limits, &mut notes)?;
    if let Some((frame, joint)) = clip.first_non_finite() {
        let problem = format!("frame {frame} is not finite");
        return Err(element(format!("nodes[{}]", joints[joint].node), problem, "export again without broken keys"));
    }
    let folder = folder.map(Path::to_owned);
    let animations = animation_list::list(&root, &data, &members, &clip, limits);
    let parts = vrm::parts(&bones, &joints);
    let world_from_source = vrm::world_from_source(&root);
    let document = GltfDocument {
        bytes: bytes.to_vec(),
        folder,
        joints,
        vrm: vrm::kind(&root),
        animation: root.chosen,
        start_secs,
    };
    Ok(Parsed {
        clip,
        unit_m: Some(1.0),
        world_from_source: Some(world_from_source),
        document: Document::Gltf(Box::new(document)),
        contents: Contents { animations, armatures, parts },
        notes,
    })
}

/// The names of the nodes above the root joints, of each the nearest one that has a name.
fn armatures(root: &Root, tree: &Tree, rig: &Rig) -> Vec<(usize, String)> {
    let mut armatures = Vec::new();
    for (joint, at) in rig.joints.iter().enumerate() {
        if rig.skeleton.joints()[joint].parent.is_some() {
            continue;
        }
        let above = std::iter::successors(tree.parent[at.node], |&node| tree.parent[node]);
        let name = above.filter_map(|node| root.nodes[node].name.as_ref()).find(|name| !name.trim().is_empty());
        armatures.extend(name.map(|name| (joint, name.clone())));
    }
    armatures
}

/// Parses the JSON and refuses what we would misread.
pub(super) fn parse(container: &Container<'_>) -> Result<Root, Error> {
    let root: Root = serde_json::from_slice(container.json).map_err(|error| {
        let place = if container.is_glb { Place::Element("JSON chunk".into()) } else { Place::Line(error.line()) };
        Error::new(place, format!("not valid glTF: {error}"), "export as glTF 2.0")
    })?;
    if !root.asset.version.starts_with("2.") {
        let problem = format!("glTF version {:?}; only version 2.0 is supported", root.asset.version);
        return Err(element("asset.version", problem, "export as glTF 2.0"));
    }
    if let Some(extension) = root.extensions_required.iter().find(|name| PACKED.contains(&name.as_str())) {
        let problem = format!("its buffers are compressed with {extension}");
        return Err(element("extensionsRequired", problem, "export without compression of animations"));
    }
    Ok(root)
}

/// How many whole frames before the first key hold its value: the time of glTF begins at 0 (glTF 2.0, 3.11).
///
/// One frame alone is none: exporters that count frames from 1 put the first key there, and a pause is not meant.
fn held_frames(start_secs: f64, hz: f64) -> f64 {
    // A key within a hundredth of a frame is on it: times are single precision.
    let frames = (start_secs * hz + 0.01).floor();
    if frames > 1.0 { frames } else { 0.0 }
}

/// Samples the tracks at the rate of their keys. Returns the clip and the time of its first frame \[s\].
fn sample(
    mut rig: Rig,
    tracks: &BTreeMap<usize, NodeTracks>,
    chosen: usize,
    limits: &Limits,
    notes: &mut Vec<Note>,
) -> Result<(Clip, f64), Error> {
    let none = NodeTracks::default();
    let of_joint: Vec<&NodeTracks> = rig.joints.iter().map(|joint| tracks.get(&joint.node).unwrap_or(&none)).collect();
    let offsets: Vec<f64> = rig.skeleton.joints().iter().map(|joint| joint.rest.translation.length()).collect();
    // Single precision leaves about 1e-7 of the largest offset as noise: a joint that moves less stands still.
    let still = 1e-5 * offsets.iter().copied().fold(0.0, f64::max);
    let mut moving = Vec::new();
    rig.skeleton.edit(|index, _, rest, _| {
        let (Some(track), scale) = (&of_joint[index].translation, rig.joints[index].offset_scale) else { return };
        if track.spread() * scale.abs().max_element() > still {
            moving.push(index);
        } else {
            let constant = track.key(0).truncate() * scale;
            if (constant - rest.translation).length() > still {
                rest.translation = constant;
            }
        }
    });
    let keyed = || {
        let keyed = of_joint.iter().flat_map(|tracks| [&tracks.rotation, &tracks.translation, &tracks.scale]);
        keyed.flatten()
    };
    let times = || keyed().map(|track| track.times_secs.as_slice());
    let curved = keyed().any(|track| track.interpolation == Interpolation::CubicSpline);
    let start_secs = times().map(|times| times[0]).fold(f64::INFINITY, f64::min);
    let end_secs = times().map(|times| times[times.len() - 1]).fold(f64::NEG_INFINITY, f64::max);
    let is_still = !start_secs.is_finite();
    if is_still {
        notes.push(Note::new("no animation moves the skeleton: the clip is one frame of its rest pose"));
    }
    let hz = rate_hz(times(), curved).unwrap_or(DEFAULT_HZ);
    let (start_secs, length_secs) = if is_still {
        (0.0, 0.0)
    } else {
        let start_secs = start_secs - held_frames(start_secs, hz) / hz;
        (start_secs, end_secs - start_secs)
    };
    // A last key within a hundredth of a frame is on it; beyond that, one more frame holds the last pose.
    let frames = (length_secs * hz - 0.01).ceil().max(0.0) + 1.0;
    let densest = times().map(<[f64]>::len).max().unwrap_or(1);
    let most = limits.frames.min(densest.saturating_mul(FRAMES_PER_KEY).saturating_add(FREE_FRAMES));
    let values = frames * (rig.skeleton.len() * 4 + moving.len() * 3) as f64;
    if frames > most as f64 || values > limits.values as f64 {
        let problem = format!("{length_secs} s at {hz} Hz are more frames than allowed for {densest} keys");
        return Err(element(format!("animations[{chosen}]"), problem, "cut the animation into shorter ones"));
    }
    let rests: Vec<Transform> = rig.skeleton.joints().iter().map(|joint| joint.rest).collect();
    let mut is_moving = vec![false; rests.len()];
    moving.iter().for_each(|&joint| is_moving[joint] = true);
    let mut clip = Clip::new(rig.skeleton, 1.0 / hz, moving);
    let mut locals = rests.clone();
    for frame in 0..frames as usize {
        let time_secs = (start_secs + frame as f64 / hz).min(start_secs + length_secs);
        for (joint, local) in locals.iter_mut().enumerate() {
            if let Some(track) = &of_joint[joint].rotation {
                local.rotation = track.rotation(time_secs);
            }
            if let (Some(track), true) = (&of_joint[joint].translation, is_moving[joint]) {
                local.translation = track.vector(time_secs) * rig.joints[joint].offset_scale;
            }
        }
        clip.push(&locals);
    }
    Ok((clip, start_secs))
}
