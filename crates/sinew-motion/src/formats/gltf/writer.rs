//! A clip as a glTF file of its own.

use super::append::{ARRAY_BUFFER, Append};
use super::capsule::Mesh;
use super::{container, element, keys, rewrite, uri};
use crate::formats::{BodyShape, Document, Format, WriteJob};
use crate::{Clip, Error, Place};
use glam::DMat4;
use serde_json::{Value, json};
use std::io::Write;

/// Writes a clip as `.glb`, or as `.gltf` with its buffer inside.
///
/// A clip that was read from a glTF file becomes that file again: everything in it stays but the rotations (and the
/// translations of moving joints) of the joints that changed, which are replaced in the animation that was read. Nothing
/// changed and the same format means the same bytes. Where frames were cut or the rate changed, scales and what else
/// the animation moves are sampled again with the joints; only the weights of morph targets keep their times. Textures in other files stay named, not copied; buffers in other
/// files go into a `.glb`, and stay named in a `.gltf`.
///
/// Any other clip becomes a new file: one node per joint, one skin, one animation, and a mesh of the `body` shapes.
/// With an empty `body` there is no mesh, which few viewers show. The body's mesh is built in the rest pose; each
/// shape is rigid to its joint, so even a rest pose that looks broken animates right.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use sinew_motion::{Clip, Joint, Limits, Skeleton, Transform};
/// use sinew_motion::formats::{BodyShape, Format, WriteJob, gltf};
///
/// let mut skeleton = Skeleton::new();
/// let hips = skeleton.push(Joint { name: "hips".into(), parent: None, rest: Transform::IDENTITY, tip: None });
/// let mut clip = Clip::new(skeleton, 1.0 / 60.0, vec![hips]);
/// clip.push(&[Transform::new(DQuat::IDENTITY, DVec3::Y)]);
/// clip.push(&[Transform::new(DQuat::from_rotation_y(0.1), DVec3::Y * 1.1)]);
/// let body = [BodyShape { joint: hips, from: DVec3::ZERO, to: DVec3::Y * 0.3, radius_m: 0.1 }];
/// let mut file = Vec::new();
/// gltf::write(&mut file, &WriteJob { clip: &clip, source: None }, Format::Glb, &body).unwrap();
/// let again = gltf::read_slice(&file, None, &Limits::default()).unwrap();
/// assert_eq!(again.clip.frames(), 2);
/// ```
///
/// # Errors
/// The clip is empty, not finite or exceeds single precision, a shape is invalid, `format` is not glTF, the file would
/// exceed 4 GiB, or `out` fails.
pub fn write(out: &mut dyn Write, job: &WriteJob<'_>, format: Format, body: &[BodyShape]) -> Result<(), Error> {
    if !matches!(format, Format::Glb | Format::Gltf | Format::Vrm | Format::Vrma) {
        let problem = format!("the glTF writer is asked for {format}");
        return Err(Error::new(Place::File, problem, "name the output .glb or .gltf"));
    }
    keys::check(job.clip)?;
    let bytes = match &job.source {
        Some(source) => match source.document {
            Document::Gltf(document)
                if rewrite::fits(job.clip, source, document) && fits_kind(document.vrm, format) =>
            {
                let format = if format == Format::Gltf { format } else { Format::Glb };
                rewrite::rewrite(job.clip, source, document, format)?
            }
            _ => write_anew(job.clip, format, body)?,
        },
        None => write_anew(job.clip, format, body)?,
    };
    out.write_all(&bytes)
        .map_err(|error| Error::new(Place::File, error.to_string(), "check the disk and the permissions"))
}

/// Whether a file of this kind of VRM can be written again in a format.
fn fits_kind(kind: Option<Format>, format: Format) -> bool {
    matches!(format, Format::Glb | Format::Gltf) || kind == Some(format)
}

fn write_anew(clip: &Clip, format: Format, body: &[BodyShape]) -> Result<Vec<u8>, Error> {
    match format {
        Format::Vrm => {
            let problem = "a VRM is a character with its licence, and only a .vrm can be written again as one";
            return Err(Error::new(Place::File, problem, "write the motion as .vrma, or the body as .glb"));
        }
        Format::Vrma => {
            let problem = "only a .vrma can be written again as one";
            return Err(Error::new(Place::File, problem, "write .glb"));
        }
        _ => {}
    }
    check_body(clip, body)?;
    let mut append = Append::default();
    let (mut nodes, mut scene) = nodes(clip);
    let mut file = json!({
        "asset": { "version": "2.0", "generator": "sinew" },
        "scene": 0,
    });
    if !clip.skeleton().is_empty() {
        let matrices = inverse_binds(clip, &mut append);
        let joints: Vec<usize> = (0..clip.skeleton().len()).collect();
        file["skins"] = json!([{ "name": "skeleton", "inverseBindMatrices": matrices, "joints": joints }]);
    }
    if !body.is_empty() {
        let (meshes, materials) = mesh(clip, body, &mut append);
        scene.push(nodes.len());
        nodes.push(json!({ "name": "body", "mesh": 0, "skin": 0 }));
        file["meshes"] = meshes;
        file["materials"] = materials;
    }
    if let Some(animation) = animation(clip, &mut append)? {
        file["animations"] = json!([animation]);
    }
    file["scenes"] = json!([{ "nodes": scene }]);
    if scene_is_empty(&file) {
        return Err(Error::new(Place::File, "the clip has no joints", "give it a skeleton"));
    }
    file["nodes"] = Value::Array(nodes);
    with_buffer(file, append, format)
}

/// The matrices that take the world of the rest pose to each joint, as a skin has them.
pub(super) fn inverse_binds(clip: &Clip, append: &mut Append) -> usize {
    let rest = clip.skeleton().rest_world();
    let inverse = rest.iter().map(|world_from_joint| world_from_joint.inverse());
    let matrices = inverse.flat_map(|joint_from_world| {
        DMat4::from_rotation_translation(joint_from_world.rotation, joint_from_world.translation).to_cols_array()
    });
    append.floats("MAT4", &matrices.map(|value| value as f32).collect::<Vec<f32>>(), false, None)
}

/// A file with its accessors, views and buffer.
pub(super) fn with_buffer(mut file: Value, append: Append, format: Format) -> Result<Vec<u8>, Error> {
    file["accessors"] = Value::Array(append.accessors);
    file["bufferViews"] = Value::Array(append.views);
    let mut buffer = json!({ "byteLength": append.bytes.len() });
    if format == Format::Gltf {
        buffer["uri"] = Value::String(uri::to_data_uri(&append.bytes));
        file["buffers"] = json!([buffer]);
        return to_json(&file, true);
    }
    file["buffers"] = json!([buffer]);
    container::join_glb(&to_json(&file, false)?, Some(&append.bytes), &[]).ok_or_else(too_large)
}

fn scene_is_empty(file: &Value) -> bool {
    file["scenes"][0]["nodes"].as_array().is_none_or(Vec::is_empty)
}

pub(super) fn to_json(file: &Value, pretty: bool) -> Result<Vec<u8>, Error> {
    let text = if pretty { serde_json::to_vec_pretty(file) } else { serde_json::to_vec(file) };
    text.map_err(|error| Error::new(Place::File, error.to_string(), "write another format"))
}

pub(super) fn too_large() -> Error {
    Error::new(Place::File, "the file would be larger than the 4 GiB of a GLB", "write a shorter clip")
}

fn check_body(clip: &Clip, body: &[BodyShape]) -> Result<(), Error> {
    for (index, shape) in body.iter().enumerate() {
        let wrong = |problem: String| Err(element(format!("body[{index}]"), problem, "repair the body's shapes"));
        if shape.joint >= clip.skeleton().len() || shape.joint > usize::from(u16::MAX) {
            return wrong(format!("joint {} does not exist", shape.joint));
        }
        let ends_are_fine = shape.from.abs().max_element() < 1e6 && shape.to.abs().max_element() < 1e6;
        if !ends_are_fine || !(1e-6..1e6).contains(&shape.radius_m) {
            return wrong(format!(
                "from {} to {} with radius {} m is not a valid capsule",
                shape.from, shape.to, shape.radius_m
            ));
        }
    }
    Ok(())
}

/// One node per joint, in the joints' order, then the tips of leaves; and the nodes of the scene. Several roots get
/// a common one, which a skin must have.
fn nodes(clip: &Clip) -> (Vec<Value>, Vec<usize>) {
    let joints = clip.skeleton().joints();
    let mut nodes = Vec::with_capacity(joints.len());
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); joints.len()];
    let mut roots = Vec::new();
    for (index, joint) in joints.iter().enumerate() {
        match joint.parent {
            Some(parent) => children[parent].push(index),
            None => roots.push(index),
        }
        let rotation = joint.rest.rotation.normalize().to_array().map(|value| value as f32);
        let translation = joint.rest.translation.as_vec3().to_array();
        nodes.push(json!({ "name": joint.name, "translation": translation, "rotation": rotation }));
    }
    for (index, joint) in joints.iter().enumerate() {
        if let Some(tip) = joint.tip.filter(|_| children[index].is_empty()) {
            children[index].push(nodes.len());
            nodes.push(json!({ "name": format!("{}_tip", joint.name), "translation": tip.as_vec3().to_array() }));
        }
    }
    for (node, children) in nodes.iter_mut().zip(children) {
        if !children.is_empty() {
            node["children"] = json!(children);
        }
    }
    if roots.len() > 1 {
        nodes.push(json!({ "name": "skeleton", "children": roots }));
        roots = vec![nodes.len() - 1];
    }
    (nodes, roots)
}

fn mesh(clip: &Clip, body: &[BodyShape], append: &mut Append) -> (Value, Value) {
    let rest = clip.skeleton().rest_world();
    let mut mesh = Mesh::default();
    for shape in body {
        mesh.push(shape, shape.joint as u16, rest[shape.joint]);
    }
    let meshes = json!([{
        "name": "body",
        "primitives": [{
            "attributes": {
                "POSITION": append.floats("VEC3", &mesh.positions, true, Some(ARRAY_BUFFER)),
                "NORMAL": append.floats("VEC3", &mesh.normals, false, Some(ARRAY_BUFFER)),
                "JOINTS_0": append.joints(&mesh.joints),
                "WEIGHTS_0": append.whole_weights(mesh.joints.len()),
            },
            "indices": append.indices(&mesh.indices),
            "material": 0,
        }],
    }]);
    let materials = json!([{
        "name": "clay",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.62, 0.56, 0.50, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.75,
        },
    }]);
    (meshes, materials)
}

/// Rotations of the joints that are ever out of their rest, and translations of those that move.
fn animation(clip: &Clip, append: &mut Append) -> Result<Option<Value>, Error> {
    let joints = clip.skeleton().joints();
    let turns = |joint: usize| (0..clip.frames()).any(|at| clip.rotation(at, joint) != joints[joint].rest.rotation);
    let times = keys::times(clip, 0.0)?;
    let mut input = None;
    let (mut channels, mut samplers) = (Vec::new(), Vec::new());
    for joint in 0..joints.len() {
        let mut add = |path: &str, shape: &str, values: Vec<f32>| {
            let input = *input.get_or_insert_with(|| append.floats("SCALAR", &times, true, None));
            let output = append.floats(shape, &values, false, None);
            channels.push(json!({ "sampler": samplers.len(), "target": { "node": joint, "path": path } }));
            samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
        };
        if turns(joint) {
            add("rotation", "VEC4", keys::rotations(clip, |frame| clip.rotation(frame, joint)));
        }
        if clip.moving().binary_search(&joint).is_ok() {
            add("translation", "VEC3", keys::translations(clip, |frame| clip.translation(frame, joint)));
        }
    }
    let animation = json!({ "name": "motion", "channels": channels, "samplers": samplers });
    Ok((!samplers.is_empty()).then_some(animation))
}
