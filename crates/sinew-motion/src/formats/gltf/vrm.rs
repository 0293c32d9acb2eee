//! VRM: which node is which bone, as the file itself says.
//!
//! Read are `humanoid.humanBones` of VRM 1.0 (`VRMC_vrm`), VRM Animation 1.0 (`VRMC_vrm_animation`) and VRM 0.x (`VRM`).

use super::rig::JointNode;
use super::schema::Root;
use crate::formats::Format;
use crate::{Note, Part};
use glam::DQuat;
use serde::Deserialize;
use serde_json::Value;

/// The extensions that are looked at. They are kept as they are, so that a wrong one cannot make the reader refuse a motion.
#[derive(Debug, Default, Deserialize)]
pub(super) struct Extensions {
    #[serde(rename = "VRMC_vrm")]
    vrm_1: Option<Value>,
    #[serde(rename = "VRMC_vrm_animation")]
    animation: Option<Value>,
    #[serde(rename = "VRM")]
    vrm_0: Option<Value>,
}

/// The parts that the file's own table gives, with their nodes; each part and each node once.
pub(super) fn bones(root: &Root, notes: &mut Vec<Note>) -> Vec<(Part, usize)> {
    let Extensions { vrm_1, animation, vrm_0 } = &root.extensions;
    let Some(table) = [vrm_1, animation, vrm_0].into_iter().flatten().map(|vrm| &vrm["humanoid"]["humanBones"]).next()
    else {
        return Vec::new();
    };
    let node = |bone: &Value| bone["node"].as_u64();
    let stated: Vec<(&str, Option<u64>)> = match table {
        Value::Object(bones) => bones.iter().map(|(name, bone)| (name.as_str(), node(bone))).collect(),
        Value::Array(bones) => {
            bones.iter().map(|bone| (bone["bone"].as_str().unwrap_or_default(), node(bone))).collect()
        }
        _ => Vec::new(),
    };
    let mut bones: Vec<(Part, usize)> = Vec::new();
    let mut wrong = 0;
    for (name, node) in stated {
        // Fingers, eyes and the jaw are bones of VRM too.
        let Some(part) = Part::ALL.iter().copied().find(|part| part.name() == name) else { continue };
        match node.and_then(|node| usize::try_from(node).ok()).filter(|&node| node < root.nodes.len()) {
            Some(node) if !bones.iter().any(|&(other, at)| other == part || at == node) => bones.push((part, node)),
            _ => wrong += 1,
        }
    }
    if wrong > 0 {
        notes.push(Note::new(format!(
            "{wrong} bones of the VRM table are left out: their nodes are missing or used twice"
        )));
    }
    bones.sort_unstable();
    bones
}

/// The same, as joints of the clip.
pub(super) fn parts(bones: &[(Part, usize)], joints: &[JointNode]) -> Vec<(Part, usize)> {
    let joint = |node: usize| joints.iter().position(|joint| joint.node == node);
    bones.iter().filter_map(|&(part, node)| Some((part, joint(node)?))).collect()
}

/// Which kind of VRM the file is, if it is one.
pub(super) fn kind(root: &Root) -> Option<Format> {
    let Extensions { vrm_1, animation, vrm_0 } = &root.extensions;
    let character = vrm_1.as_ref().or(vrm_0.as_ref()).map(|_| Format::Vrm);
    character.or(animation.as_ref().map(|_| Format::Vrma))
}

/// The turn to our axes: a character of VRM 0.x faces -Z, of all later ones +Z.
pub(super) fn world_from_source(root: &Root) -> DQuat {
    let Extensions { vrm_1, animation, vrm_0 } = &root.extensions;
    let is_turned = vrm_0.is_some() && vrm_1.is_none() && animation.is_none();
    if is_turned { DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0) } else { DQuat::IDENTITY }
}
