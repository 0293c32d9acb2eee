//! Nodes as a rigid skeleton: scales are multiplied into the offsets of the nodes below.

use super::animation::NodeTracks;
use super::element;
use super::schema::{Node, Root};
use super::tree::Tree;
use crate::{Error, Joint, Limits, Note, Skeleton, Transform};
use glam::{DMat3, DQuat, DVec3};
use std::collections::BTreeMap;

const EXPORT_AGAIN: &str = "the file is damaged or its exporter is wrong: export it again";
/// Lengths of rotations farther from 1 are an error.
const UNIT_TOLERANCE: f64 = 0.05;
/// Parts of a scale that differ by less are rounding.
const SAME_SCALE: f64 = 1e-3;
/// A node that turns or moves less than this does nothing.
const NO_TRANSFORM: f64 = 1e-9;

/// One joint as the file has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct JointNode {
    /// Index of the node.
    pub node: usize,
    /// What the node's translations are multiplied by to be rigid offsets: the scales above it, per axis of its
    /// parent.
    pub offset_scale: DVec3,
}

/// The skeleton and where it came from.
pub(super) struct Rig {
    pub skeleton: Skeleton,
    /// One per joint.
    pub joints: Vec<JointNode>,
}

/// Which nodes the skeleton is made of: the joints, and of the nodes above them those that turn, move or are
/// animated. A node that only scales is folded into what it scales.
pub(super) fn members(root: &Root, tree: &Tree, joints: &[bool], animated: &[bool]) -> Result<Vec<bool>, Error> {
    let mut members = tree.at_or_above(joints);
    for (index, member) in members.iter_mut().enumerate() {
        if *member && !joints[index] && !animated[index] {
            let (local, _) = local(&root.nodes[index], index, &mut Vec::new())?;
            let turn = DVec3::new(local.rotation.x, local.rotation.y, local.rotation.z).length();
            *member = turn > NO_TRANSFORM || local.translation.length() > NO_TRANSFORM;
        }
    }
    Ok(members)
}

/// Builds the skeleton of the `members`.
pub(super) fn rig(
    root: &Root,
    tree: &Tree,
    members: &[bool],
    tracks: &BTreeMap<usize, NodeTracks>,
    limits: &Limits,
    notes: &mut Vec<Note>,
) -> Result<Rig, Error> {
    let count = members.iter().filter(|member| **member).count();
    if count > limits.joints {
        let problem = format!("{count} joints; the maximum is {}", limits.joints);
        return Err(element("skins[0].joints", problem, "export only the character"));
    }
    let above = tree.at_or_above(members);
    let mut rig = Rig { skeleton: Skeleton::new(), joints: Vec::with_capacity(count) };
    // Per node: the joint it is or hangs from, the depth of that, and the scale that its children's offsets get.
    let mut joint_at = vec![None; root.nodes.len()];
    let mut depth_at = vec![0_usize; root.nodes.len()];
    let mut scale_at = vec![DVec3::ONE; root.nodes.len()];
    let mut scaled = 0;
    for &index in tree.order.iter().filter(|&&index| above[index]) {
        let node = &root.nodes[index];
        let (rigid, mut scale) = local(node, index, notes)?;
        if let Some(track) = tracks.get(&index).and_then(|tracks| tracks.scale.as_ref()) {
            if track.spread() <= SAME_SCALE * track.key(0).length() {
                scale = track.key(0).truncate();
            } else {
                notes.push(Note::new(format!("the animated scale of {} is left out", joint_name(node, index))));
            }
        }
        let parent = tree.parent[index];
        let offset_scale = parent.map_or(DVec3::ONE, |parent| scale_at[parent]);
        joint_at[index] = parent.and_then(|parent| joint_at[parent]);
        depth_at[index] = parent.map_or(0, |parent| depth_at[parent]);
        if (scale - DVec3::ONE).abs().max_element() > SAME_SCALE {
            scaled += 1;
        }
        scale_at[index] = if members[index] {
            // Below a rotation only a uniform scale stays diagonal.
            scale * uniform(offset_scale)
        } else {
            scale * offset_scale
        };
        let size = scale_at[index].abs();
        if size.max_element() - size.min_element() > SAME_SCALE * size.max_element() {
            notes.push(Note::new(format!("{} is scaled unevenly, its limbs may be off", joint_name(node, index))));
        } else if scale_at[index].min_element() < 0.0 && scale_at[index].max_element() > 0.0 {
            // All three axes negative is a point reflection, which commutes with every rotation: that is exact.
            notes.push(Note::new(format!("{} is mirrored, its limbs may be off", joint_name(node, index))));
        }
        if !members[index] {
            continue;
        }
        depth_at[index] += 1;
        if depth_at[index] > limits.depth {
            let problem = format!("joints nest deeper than the maximum of {}", limits.depth);
            return Err(element(format!("nodes[{index}]"), problem, "export only the character"));
        }
        let name = joint_name(node, index);
        if name.len() > limits.name_bytes {
            let problem = format!("a name of {} bytes; the maximum is {}", name.len(), limits.name_bytes);
            return Err(element(format!("nodes[{index}].name"), problem, "shorten the name"));
        }
        let rest = Transform::new(rigid.rotation, rigid.translation * offset_scale);
        let tip = tip(root, index, members, scale_at[index]);
        joint_at[index] = Some(rig.skeleton.push(Joint { name, parent: joint_at[index], rest, tip }));
        rig.joints.push(JointNode { node: index, offset_scale });
    }
    if scaled > 0 {
        notes
            .push(Note::new(format!("the scales of {scaled} nodes are multiplied into the offsets of their children")));
    }
    Ok(rig)
}

/// The file's name of a node, or one made from its index.
pub(super) fn joint_name(node: &Node, index: usize) -> String {
    match &node.name {
        Some(name) if !name.trim().is_empty() => name.clone(),
        _ => format!("node_{index}"),
    }
}

/// Where the bone of a leaf joint ends: at its only child, when that is a bare node.
fn tip(root: &Root, index: usize, members: &[bool], scale: DVec3) -> Option<DVec3> {
    let [child] = root.nodes[index].children[..] else { return None };
    let end = &root.nodes[child];
    if members[child] || !end.children.is_empty() || end.mesh.is_some() || end.camera.is_some() {
        return None;
    }
    let tip = DVec3::from(end.translation?) * scale;
    (tip.is_finite() && tip != DVec3::ZERO).then_some(tip)
}

fn uniform(scale: DVec3) -> DVec3 {
    if scale.x == scale.y && scale.y == scale.z {
        return scale;
    }
    DVec3::splat(libm::cbrt((scale.x * scale.y * scale.z).abs()))
}

/// A node's transform, decomposed into `parent_from_node` without scale, and scale.
pub(super) fn local(node: &Node, index: usize, notes: &mut Vec<Note>) -> Result<(Transform, DVec3), Error> {
    let name = |field: &str| format!("nodes[{index}].{field}");
    if let Some(matrix) = node.matrix {
        return from_matrix(&matrix, index, notes);
    }
    let translation = DVec3::from(node.translation.unwrap_or_default());
    let scale = DVec3::from(node.scale.unwrap_or([1.0; 3]));
    let rotation = DQuat::from_array(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    // glTF numbers are single precision: larger ones count as infinite.
    let is_wild = |vector: DVec3| !vector.is_finite() || vector.abs().max_element() > f64::from(f32::MAX);
    if is_wild(translation) {
        return Err(element(name("translation"), format!("{translation} is out of range"), EXPORT_AGAIN));
    }
    if is_wild(scale) {
        return Err(element(name("scale"), format!("{scale} is out of range"), EXPORT_AGAIN));
    }
    let length = rotation.length();
    if !length.is_finite() || (length - 1.0).abs() > UNIT_TOLERANCE {
        let problem = format!("the rotation has length {length}, not 1");
        return Err(element(name("rotation"), problem, "export again with unit quaternions"));
    }
    Ok((Transform::new(rotation.normalize(), translation), scale))
}

/// Rotation, translation and scale of a matrix, by Gram-Schmidt; a mirror image becomes a negative z scale,
/// which is exact for what hangs directly below.
fn from_matrix(matrix: &[f64; 16], index: usize, notes: &mut Vec<Note>) -> Result<(Transform, DVec3), Error> {
    let wrong = |problem: &str| {
        Err(element(format!("nodes[{index}].matrix"), problem, "export the node's translation, rotation and scale"))
    };
    if matrix.iter().any(|value| !value.is_finite() || value.abs() > f64::from(f32::MAX)) {
        return wrong("it holds numbers that are out of range");
    }
    let last_row = [matrix[3], matrix[7], matrix[11], matrix[15] - 1.0];
    if last_row.iter().any(|value| value.abs() > 1e-4) {
        return wrong("its last row is not 0 0 0 1");
    }
    let column = |at: usize| DVec3::new(matrix[at], matrix[at + 1], matrix[at + 2]);
    let (a, b, c) = (column(0), column(4), column(8));
    let Some(x) = a.try_normalize() else { return wrong("it is flat") };
    let Some(y) = (b - x * x.dot(b)).try_normalize() else { return wrong("it is flat") };
    let z = x.cross(y);
    let depth = z.dot(c);
    if depth == 0.0 {
        return wrong("it is flat");
    }
    let scale = DVec3::new(a.length(), y.dot(b), depth);
    let shear = x.dot(b).abs().max(x.dot(c).abs()).max(y.dot(c).abs());
    if shear > SAME_SCALE * scale.abs().max_element() {
        notes.push(Note::new(format!("the matrix of nodes[{index}] is sheared, which is left out")));
    }
    let rotation = DQuat::from_mat3(&DMat3::from_cols(x, y, z)).normalize();
    let rigid = Transform::new(rotation, column(12));
    if !rigid.rotation.is_finite() || !scale.is_finite() {
        return wrong("it cannot be decomposed");
    }
    Ok((rigid, scale))
}
