//! A glTF file written again with another motion.

use super::append::Append;
use super::container::{self, Container};
use super::data::Data;
use super::document::GltfDocument;
use super::schema::Root;
use super::writer::{to_json, too_large};
use super::{companions, element, keys, reader, rig, uri};
use crate::formats::{Format, Source};
use crate::{Clip, Error, Limits};
use serde_json::{Map, Value, json};

const BUG: &str = "read the file again";
/// Views of buffers that a merge of buffers would not find.
const PACKING: &str = "EXT_meshopt_compression";

/// Whether the clip still has the joints of the file.
pub(super) fn fits(clip: &Clip, source: &Source<'_>, document: &GltfDocument) -> bool {
    let (new, old) = (clip.skeleton().joints(), source.clip.skeleton().joints());
    new.len() == old.len()
        && new.len() == document.joints.len()
        && new.iter().zip(old).all(|(new, old)| new.parent == old.parent)
}

/// What has changed for one joint.
#[derive(Clone, Copy, Default)]
struct Change {
    rotation: bool,
    translation: bool,
}

/// The file with the values replaced that differ.
pub(super) fn rewrite(
    clip: &Clip,
    source: &Source<'_>,
    document: &GltfDocument,
    format: Format,
) -> Result<Vec<u8>, Error> {
    let container = container::open(&document.bytes)?;
    let retimed = clip.frame_time_secs() != source.clip.frame_time_secs()
        || clip.frames() != source.clip.frames()
        || !source.rows.iter().copied().eq(0..clip.frames());
    let changes = changes(clip, source);
    let same_format = container.is_glb == (format == Format::Glb);
    if same_format && !retimed && changes.iter().all(|change| !change.rotation && !change.translation) {
        return Ok(document.bytes.clone());
    }
    let mut root = reader::parse(&container)?;
    root.chosen = document.animation;
    let mut file: Map<String, Value> =
        serde_json::from_slice(container.json).map_err(|error| element("JSON", error.to_string(), BUG))?;
    let limits = Limits::default();
    let data = Data::new(&root, container.bin, document.folder.as_deref(), &limits);
    let (mut append, buffers) = buffers(&mut file, &container, &root, &data, format)?;
    append.views_before = root.buffer_views.len();
    append.accessors_before = root.accessors.len();
    let edit = Edit { root: &root, clip, source, document, retimed };
    let times = edit.replace(&mut file, &mut append, &changes)?;
    if let (true, Some(input)) = (retimed, times) {
        let frame_secs = source.clip.frame_time_secs();
        let times: Vec<f64> = source.rows.iter().map(|&row| document.start_secs + row as f64 * frame_secs).collect();
        if times.len() == clip.frames() {
            let joints = document.nodes().collect();
            companions::retime(&mut file, &mut append, &root, &data, &joints, input, &times)?;
        }
    }
    list(&mut file, "bufferViews")?.append(&mut append.views);
    list(&mut file, "accessors")?.append(&mut append.accessors);
    for key in ["bufferViews", "accessors"] {
        if list(&mut file, key)?.is_empty() {
            file.remove(key);
        }
    }
    let pretty = format == Format::Gltf && (container.is_glb || container.json.contains(&b'\n'));
    match buffers {
        Buffers::New if append.bytes.is_empty() => {}
        Buffers::New => list(&mut file, "buffers")?
            .push(json!({ "byteLength": append.bytes.len(), "uri": uri::to_data_uri(&append.bytes) })),
        Buffers::First => {
            let buffers = list(&mut file, "buffers")?;
            if buffers.is_empty() {
                buffers.push(json!({}));
            }
            buffers[0]["byteLength"] = json!(append.bytes.len());
            if format == Format::Gltf {
                buffers[0]["uri"] = Value::String(uri::to_data_uri(&append.bytes));
            }
        }
    }
    let bin = matches!(buffers, Buffers::First).then_some(append.bytes.as_slice());
    let json = to_json(&Value::Object(file), pretty)?;
    match format {
        Format::Glb => container::join_glb(&json, bin, &container.others).ok_or_else(too_large),
        _ => Ok(json),
    }
}

/// Where new data goes.
enum Buffers {
    /// Into the first buffer, which is the binary chunk of a GLB.
    First,
    /// Into a buffer of its own, as a data URI.
    New,
}

/// Decides where new data goes, and makes the first buffer hold all others where a GLB is made of a `.gltf`.
fn buffers(
    file: &mut Map<String, Value>,
    container: &Container<'_>,
    root: &Root,
    data: &Data<'_>,
    format: Format,
) -> Result<(Append, Buffers), Error> {
    let first_is_chunk = container.bin.is_some() && root.buffers.first().is_some_and(|buffer| buffer.uri.is_none());
    if first_is_chunk {
        let bytes = data.buffer(0, "buffers")?.to_vec();
        return Ok((Append { bytes, ..Append::default() }, Buffers::First));
    }
    let packed = list(file, "extensionsUsed")?.iter().any(|name| name == PACKING);
    if list(file, "extensionsUsed")?.is_empty() {
        file.remove("extensionsUsed");
    }
    if format == Format::Gltf || packed {
        return Ok((Append { buffer: root.buffers.len(), ..Append::default() }, Buffers::New));
    }
    let mut bytes = Vec::new();
    let mut starts = Vec::with_capacity(root.buffers.len());
    for index in 0..root.buffers.len() {
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        starts.push(bytes.len() as u64);
        bytes.extend_from_slice(data.buffer(index, "buffers")?);
    }
    for (index, (value, view)) in list(file, "bufferViews")?.iter_mut().zip(&root.buffer_views).enumerate() {
        let Some(start) = starts.get(view.buffer) else {
            return Err(element(format!("bufferViews[{index}]"), "its buffer does not exist", "export the file again"));
        };
        value["buffer"] = json!(0);
        value["byteOffset"] = json!(start.saturating_add(view.byte_offset));
    }
    let buffers = list(file, "buffers")?;
    buffers.clear();
    Ok((Append { bytes, ..Append::default() }, Buffers::First))
}

/// Which joints differ, bit for bit, from the frames that they came from.
fn changes(clip: &Clip, source: &Source<'_>) -> Vec<Change> {
    let mut changes = vec![Change::default(); clip.skeleton().len()];
    for frame in 0..clip.frames() {
        let row = source.rows.get(frame).copied().filter(|&row| row < source.clip.frames());
        for (joint, change) in changes.iter_mut().enumerate() {
            let Some(row) = row else {
                *change = Change { rotation: true, translation: true };
                continue;
            };
            change.rotation |= clip.rotation(frame, joint) != source.clip.rotation(row, joint);
            change.translation |= clip.translation(frame, joint) != source.clip.translation(row, joint);
        }
    }
    changes
}

/// What is to be put into the file.
struct Edit<'a> {
    root: &'a Root,
    clip: &'a Clip,
    source: &'a Source<'a>,
    document: &'a GltfDocument,
    /// Whether the frames or their times differ from the file's.
    retimed: bool,
}

impl Edit<'_> {
    /// Replaces the channels of the joints that changed; of all that have any, where the frames' times changed.
    /// Returns the accessor of the new keys' times, if there are new keys.
    fn replace(
        &self,
        file: &mut Map<String, Value>,
        append: &mut Append,
        changes: &[Change],
    ) -> Result<Option<usize>, Error> {
        let Edit { root, clip, source, document, retimed } = *self;
        let times = keys::times(clip, document.start_secs)?;
        let mut input = None;
        for (joint, (change, at)) in changes.iter().zip(&document.joints).enumerate() {
            let is_root = clip.skeleton().joints()[joint].parent.is_none();
            let local = |frame: usize| source.space.to_source(clip.local(frame, joint), is_root);
            let inverse = at.offset_scale.map(|scale| if scale == 0.0 { 0.0 } else { 1.0 / scale });
            let unscaled = |frame: usize| local(frame).translation * inverse;
            let mut add = |path: &str, shape: &str, values: Vec<f32>, append: &mut Append| -> Result<(), Error> {
                let input = *input.get_or_insert_with(|| append.floats("SCALAR", &times, true, None));
                let output = append.floats(shape, &values, false, None);
                take_matrix_apart(file, root, at.node)?;
                set_channel(file, root.chosen, at.node, path, input, output)
            };
            if change.rotation || retimed && has_channel(root, at.node, "rotation") {
                add("rotation", "VEC4", keys::rotations(clip, |frame| local(frame).rotation), append)?;
            }
            let has_channel = has_channel(root, at.node, "translation");
            if !(change.translation || retimed && has_channel) {
                continue;
            }
            if has_channel || clip.moving().binary_search(&joint).is_ok() {
                add("translation", "VEC3", keys::translations(clip, unscaled), append)?;
            } else {
                take_matrix_apart(file, root, at.node)?;
                if let Some(node) = list(file, "nodes")?.get_mut(at.node) {
                    node["translation"] = json!(unscaled(0).as_vec3().to_array());
                }
            }
        }
        Ok(input)
    }
}

fn has_channel(root: &Root, node: usize, path: &str) -> bool {
    root.animation().is_some_and(|animation| {
        animation.channels.iter().any(|channel| channel.target.node == Some(node) && channel.target.path == path)
    })
}

/// An animated node must not have a matrix (glTF 2.0 section 3.5.3).
fn take_matrix_apart(file: &mut Map<String, Value>, root: &Root, index: usize) -> Result<(), Error> {
    let Some(node) = list(file, "nodes")?.get_mut(index).and_then(Value::as_object_mut) else { return Ok(()) };
    if node.remove("matrix").is_some() {
        let (rest, scale) = rig::local(&root.nodes[index], index, &mut Vec::new())?;
        node.insert("translation".into(), json!(rest.translation.as_vec3().to_array()));
        node.insert("rotation".into(), json!(rest.rotation.to_array().map(|value| value as f32)));
        node.insert("scale".into(), json!(scale.as_vec3().to_array()));
    }
    Ok(())
}

/// Points a channel of an animation at new keys; a sampler that other channels share is left to them.
pub(super) fn set_channel(
    file: &mut Map<String, Value>,
    index: usize,
    node: usize,
    path: &str,
    input: usize,
    output: usize,
) -> Result<(), Error> {
    let animations = list(file, "animations")?;
    if animations.is_empty() {
        animations.push(json!({ "name": "motion", "channels": [], "samplers": [] }));
    }
    let broken = || element(format!("animations[{index}]"), "it is not an animation", BUG);
    let animation = animations.get_mut(index).and_then(Value::as_object_mut).ok_or_else(broken)?;
    let channels = list(animation, "channels")?;
    let is_ours = |channel: &Value| channel["target"]["node"] == json!(node) && channel["target"]["path"] == *path;
    let found = channels.iter().position(is_ours);
    let old_sampler = found.and_then(|channel| channels[channel]["sampler"].as_u64());
    let users = channels.iter().filter(|channel| channel["sampler"].as_u64() == old_sampler).count();
    let samplers = list(animation, "samplers")?;
    let sampler = match old_sampler {
        Some(old) if users == 1 && samplers.get(old as usize).is_some_and(Value::is_object) => old as usize,
        _ => {
            samplers.push(json!({}));
            samplers.len() - 1
        }
    };
    samplers[sampler]["input"] = json!(input);
    samplers[sampler]["output"] = json!(output);
    samplers[sampler]["interpolation"] = json!("LINEAR");
    let channels = list(animation, "channels")?;
    match found {
        Some(channel) => channels[channel]["sampler"] = json!(sampler),
        None => channels.push(json!({ "sampler": sampler, "target": { "node": node, "path": path } })),
    }
    Ok(())
}

/// An array of the file, created if it is missing.
fn list<'a>(of: &'a mut Map<String, Value>, key: &str) -> Result<&'a mut Vec<Value>, Error> {
    let value = of.entry(key).or_insert_with(|| Value::Array(Vec::new()));
    value.as_array_mut().ok_or_else(|| element(key, "it is not an array", BUG))
}
