//! A scene as a glTF file: a skin for each character, a node with a mesh for each thing.

use super::append::Append;
use super::capsule::Mesh;
use super::writer::{inverse_binds, with_buffer};
use super::{element, keys};
use crate::formats::{Format, JointShape, SceneCharacter, SceneFile, SceneForm, SceneThing};
use crate::{Clip, Error, Place, Transform};
use glam::DQuat;
use serde_json::{Value, json};

/// The bytes of a `.glb`, or of a `.gltf` with its buffer inside.
///
/// A character is an armature, a node of its name above its joints, and a skinned mesh `NAME.body`. A thing is a node of its name; equal things share a mesh, and one that never moves has no animation.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use sinew_motion::Transform;
/// use sinew_motion::formats::{Format, SceneFile, SceneForm, SceneMaterial, SceneThing, gltf};
/// let crate_ = SceneThing {
///     name: "crate".into(),
///     forms: vec![SceneForm::Box { centre: DVec3::ZERO, rotation: DQuat::IDENTITY, size_m: DVec3::ONE }],
///     material: 0,
///     places: vec![Transform::IDENTITY],
/// };
/// let scene = SceneFile {
///     materials: vec![SceneMaterial { name: "wood".into(), rgb: [120, 80, 40] }],
///     things: vec![crate_],
///     frame_time_secs: 1.0 / 60.0,
///     ..SceneFile::default()
/// };
/// assert!(gltf::write_scene(&scene, Format::Glb)?.starts_with(b"glTF"));
/// # Ok::<(), sinew_motion::Error>(())
/// ```
///
/// # Errors
/// A scene with nothing in it, numbers that are not finite or exceed single precision, characters or things of different lengths, a
/// joint or material that does not exist, or a file that would exceed 4 GiB.
pub fn write_scene(scene: &SceneFile, format: Format) -> Result<Vec<u8>, Error> {
    check(scene)?;
    let mut file = Writer::default();
    for character in &scene.characters {
        file.add_character(character)?;
    }
    for thing in &scene.things {
        file.add_thing(thing, scene.frame_time_secs)?;
    }
    let mut json = json!({
        "asset": { "version": "2.0", "generator": "sinew" },
        "scene": 0,
        "scenes": [{ "nodes": file.roots }],
        "nodes": file.nodes,
    });
    let materials = scene.materials.iter().map(|material| {
        let [red, green, blue] = material.rgb.map(linear);
        json!({
            "name": material.name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.75,
            },
        })
    });
    for (key, values) in [
        ("materials", materials.collect()),
        ("meshes", file.meshes.into_iter().map(|(_, mesh)| mesh).collect()),
        ("skins", file.skins),
    ] {
        if !Vec::is_empty(&values) {
            json[key] = Value::Array(values);
        }
    }
    if !file.samplers.is_empty() {
        json["animations"] = json!([{ "name": "motion", "channels": file.channels, "samplers": file.samplers }]);
    }
    with_buffer(json, file.append, format)
}

/// A channel of an sRGB colour as glTF counts it, linear (IEC 61966-2-1).
fn linear(channel: u8) -> f32 {
    let share = f64::from(channel) / 255.0;
    let linear = if share <= 0.04045 { share / 12.92 } else { libm::pow((share + 0.055) / 1.055, 2.4) };
    linear as f32
}

#[derive(Default)]
struct Writer {
    append: Append,
    nodes: Vec<Value>,
    roots: Vec<usize>,
    /// Each with what it was made of, so that equal ones are one.
    meshes: Vec<(Made, Value)>,
    skins: Vec<Value>,
    channels: Vec<Value>,
    samplers: Vec<Value>,
    /// The accessor of the frames' times.
    times: Option<usize>,
}

/// What a mesh was made of.
#[derive(Clone, PartialEq)]
enum Made {
    /// Shapes on joints at rest.
    Skinned(Vec<JointShape>, Vec<Transform>),
    Rigid(Vec<SceneForm>, usize),
}

impl Writer {
    fn add_character(&mut self, character: &SceneCharacter) -> Result<(), Error> {
        let SceneCharacter { name, clip, shapes } = character;
        let joints = clip.skeleton().joints();
        let armature = self.nodes.len();
        self.nodes.push(json!({ "name": name }));
        self.roots.push(armature);
        let first = self.nodes.len();
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); joints.len()];
        let mut tops = Vec::new();
        for (index, joint) in joints.iter().enumerate() {
            match joint.parent {
                Some(parent) => children[parent].push(first + index),
                None => tops.push(first + index),
            }
            self.nodes.push(placed(&joint.name, joint.rest));
        }
        for (index, joint) in joints.iter().enumerate() {
            if let Some(tip) = joint.tip.filter(|_| children[index].is_empty()) {
                children[index].push(self.nodes.len());
                let name = format!("{}_tip", joint.name);
                self.nodes.push(placed(&name, Transform::new(DQuat::IDENTITY, tip)));
            }
        }
        for (index, children) in children.into_iter().enumerate().filter(|(_, children)| !children.is_empty()) {
            self.nodes[first + index]["children"] = json!(children);
        }
        self.nodes[armature]["children"] = json!(tops);
        let all: Vec<usize> = (first..first + joints.len()).collect();
        let matrices = inverse_binds(clip, &mut self.append);
        self.skins.push(json!({ "name": name, "inverseBindMatrices": matrices, "joints": all, "skeleton": armature }));
        if !shapes.is_empty() {
            let mesh = self.mesh(&format!("{name}.body"), Made::Skinned(shapes.clone(), clip.skeleton().rest_world()));
            self.roots.push(self.nodes.len());
            self.nodes.push(json!({ "name": format!("{name}.body"), "mesh": mesh, "skin": self.skins.len() - 1 }));
        }
        for (joint, at) in joints.iter().enumerate() {
            if (0..clip.frames()).any(|frame| clip.rotation(frame, joint) != at.rest.rotation) {
                let values = keys::rotations(clip, |frame| clip.rotation(frame, joint));
                self.animate(first + joint, "rotation", "VEC4", &values, clip)?;
            }
            if clip.moving().binary_search(&joint).is_ok() {
                let values = keys::translations(clip, |frame| clip.translation(frame, joint));
                self.animate(first + joint, "translation", "VEC3", &values, clip)?;
            }
        }
        Ok(())
    }

    fn add_thing(&mut self, thing: &SceneThing, frame_time_secs: f64) -> Result<(), Error> {
        let first = thing.places.first().copied().unwrap_or(Transform::IDENTITY);
        let node = self.nodes.len();
        self.nodes.push(placed(&thing.name, first));
        self.roots.push(node);
        if !thing.forms.is_empty() {
            let mesh = self.mesh(&thing.name, Made::Rigid(thing.forms.clone(), thing.material));
            self.nodes[node]["mesh"] = json!(mesh);
        }
        // As a clip of one joint, so that its keys are made as those of joints are.
        let mut skeleton = crate::Skeleton::new();
        let joint = skeleton.push(crate::Joint { name: thing.name.clone(), parent: None, rest: first, tip: None });
        let mut clip = Clip::new(skeleton, frame_time_secs, vec![joint]);
        thing.places.iter().for_each(|place| clip.push(&[*place]));
        if thing.places.iter().any(|place| place.rotation != first.rotation) {
            let values = keys::rotations(&clip, |frame| clip.rotation(frame, joint));
            self.animate(node, "rotation", "VEC4", &values, &clip)?;
        }
        if thing.places.iter().any(|place| place.translation != first.translation) {
            let values = keys::translations(&clip, |frame| clip.translation(frame, joint));
            self.animate(node, "translation", "VEC3", &values, &clip)?;
        }
        Ok(())
    }

    /// The index of a mesh, made once for all that are equal.
    fn mesh(&mut self, name: &str, made: Made) -> usize {
        if let Some(known) = self.meshes.iter().position(|(known, _)| *known == made) {
            return known;
        }
        let mut primitives = Vec::new();
        match &made {
            Made::Rigid(forms, material) => {
                let mut mesh = Mesh::default();
                forms.iter().for_each(|form| mesh.push_form(form, 0, Transform::IDENTITY));
                primitives.push(mesh.primitive(*material, false, &mut self.append));
            }
            Made::Skinned(shapes, rest) => {
                let mut materials: Vec<usize> = shapes.iter().map(|shape| shape.material).collect();
                materials.sort_unstable();
                materials.dedup();
                for material in materials {
                    let mut mesh = Mesh::default();
                    for shape in shapes.iter().filter(|shape| shape.material == material) {
                        mesh.push_form(&shape.form, shape.joint as u16, rest[shape.joint]);
                    }
                    primitives.push(mesh.primitive(material, true, &mut self.append));
                }
            }
        }
        self.meshes.push((made, json!({ "name": name, "primitives": primitives })));
        self.meshes.len() - 1
    }

    fn animate(&mut self, node: usize, path: &str, shape: &str, values: &[f32], clip: &Clip) -> Result<(), Error> {
        let input = match self.times {
            Some(input) => input,
            None => {
                let times = keys::times(clip, 0.0)?;
                *self.times.insert(self.append.floats("SCALAR", &times, true, None))
            }
        };
        let output = self.append.floats(shape, values, false, None);
        self.channels.push(json!({ "sampler": self.samplers.len(), "target": { "node": node, "path": path } }));
        self.samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
        Ok(())
    }
}

fn placed(name: &str, at: Transform) -> Value {
    let rotation = at.rotation.normalize().to_array().map(|value| value as f32);
    json!({ "name": name, "translation": at.translation.as_vec3().to_array(), "rotation": rotation })
}

fn check(scene: &SceneFile) -> Result<(), Error> {
    if scene.characters.is_empty() && scene.things.is_empty() {
        return Err(Error::new(Place::File, "the scene is empty", "give it a character or a thing"));
    }
    let frames = scene.characters.iter().map(|character| character.clip.frames());
    let frames: Vec<usize> = frames.chain(scene.things.iter().map(|thing| thing.places.len())).collect();
    if frames.iter().any(|count| *count != frames[0] || *count == 0) {
        return Err(Error::new(Place::File, "its parts have different numbers of frames", "give all the same"));
    }
    for SceneCharacter { name, clip, shapes } in &scene.characters {
        keys::check(clip)?;
        for shape in shapes {
            let fits = shape.joint < clip.skeleton().len().min(usize::from(u16::MAX));
            check_form(name, &shape.form, fits && shape.material < scene.materials.len())?;
        }
    }
    for thing in &scene.things {
        let fits = thing.material < scene.materials.len();
        thing.forms.iter().try_for_each(|form| check_form(&thing.name, form, fits))?;
        let is_fine = |place: &Transform| {
            let turn = place.rotation.length_squared();
            place.translation.is_finite()
                && place.translation.abs().max_element() < 1e30
                && turn.is_finite()
                && turn > 1e-6
        };
        if !thing.places.iter().all(is_fine) {
            return Err(element(&*thing.name, "a place is out of range", "repair the motion before it is written"));
        }
    }
    Ok(())
}

fn check_form(name: &str, form: &SceneForm, exists: bool) -> Result<(), Error> {
    let near = |point: &glam::DVec3| point.is_finite() && point.abs().max_element() < 1e6;
    let is_fine = match form {
        SceneForm::Capsule { from, to, radius_m } => near(from) && near(to) && (1e-6..1e6).contains(radius_m),
        SceneForm::Box { centre, rotation, size_m } => {
            let turned = rotation.is_finite() && (rotation.length_squared() - 1.0).abs() < 1e-3;
            near(centre) && turned && near(size_m) && size_m.min_element() > 1e-6
        }
        SceneForm::Triangles { points_m, .. } => points_m.iter().all(near),
    };
    if is_fine && exists {
        return Ok(());
    }
    Err(element(name, "a shape of it is out of range, or its joint or material does not exist", "repair its shapes"))
}
