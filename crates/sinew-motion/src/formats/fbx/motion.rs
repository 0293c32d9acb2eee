//! An FBX animation as frames of rigid transforms.

use super::skeleton::Bone;
use super::{at_node, refused, whole};
use crate::formats::AnimationInfo;
use crate::formats::rate::rate_hz;
use crate::{Clip, Error, Joint, Limits, Note, Skeleton, Transform};
use glam::{DMat3, DQuat, DVec3};

/// Rate where neither keys nor the file state one that makes sense \[Hz\].
const DEFAULT_HZ: f64 = 30.0;
/// Rates that a file may state \[Hz\].
const FILE_HZ: std::ops::RangeInclusive<f64> = 1.0..=1000.0;
/// Maximum number of frames: a constant part, and a part for each key.
const FREE_FRAMES: usize = 20_000;
const FRAMES_PER_KEY: usize = 1_000;
/// Joints whose offset varies less than this share of the largest offset stand still in their parents.
const STILL: f64 = 1e-5;

/// Time span and sampling rate of the motion.
struct Span {
    start_secs: f64,
    length_secs: f64,
    hz: f64,
    frames: usize,
}

/// Evaluates an animation stack, or the pose of the file where there is none.
pub(super) fn sample(
    scene: &ufbx::Scene,
    stack: Option<&ufbx::AnimStack>,
    bones: &[Bone],
    memory: ufbx::AllocatorOpts,
    limits: &Limits,
    notes: &mut Vec<Note>,
) -> Result<Clip, Error> {
    let mut posed = Vec::new();
    pose_into(scene, bones, &mut posed)?;
    let rest = bind_pose(scene, bones, &posed).unwrap_or_else(|| posed.clone());
    let span = span(scene, stack, limits)?;
    let mut frames: Vec<Vec<Transform>> = Vec::new();
    match (stack, span.frames) {
        (Some(stack), 2..) => {
            let values = span.frames.saturating_mul(scene.nodes.count.max(bones.len() * 7));
            if values > limits.values {
                let problem = format!("{} frames of {} nodes are more than allowed", span.frames, scene.nodes.count);
                return Err(whole(problem, "export only the character, or shorter animations"));
            }
            for frame in 0..span.frames {
                let time_secs = span.start_secs + (frame as f64 / span.hz).min(span.length_secs);
                let options = ufbx::EvaluateOpts {
                    temp_allocator: ufbx::AllocatorOpts { memory_limit: memory.memory_limit, ..Default::default() },
                    result_allocator: ufbx::AllocatorOpts { memory_limit: memory.memory_limit, ..Default::default() },
                    ..Default::default()
                };
                let posed =
                    ufbx::evaluate_scene(scene, &stack.anim, time_secs, options).map_err(|error| refused(&error))?;
                let mut locals = Vec::with_capacity(bones.len());
                pose_into(&posed, bones, &mut locals)?;
                frames.push(locals);
            }
        }
        _ => {
            notes.push(Note::new("no animation with keys: the clip is one frame of the file's pose"));
            frames.push(posed);
        }
    }
    Ok(clip(bones, rest, &frames, 1.0 / span.hz))
}

/// The clip of these frames; joints whose offsets vary are those that move.
fn clip(bones: &[Bone], mut rest: Vec<Transform>, frames: &[Vec<Transform>], frame_time_secs: f64) -> Clip {
    let size = rest.iter().map(|local| local.translation.length()).fold(0.0, f64::max);
    let mut moving = Vec::new();
    for (joint, rest) in rest.iter_mut().enumerate() {
        let first = frames[0][joint].translation;
        if frames.iter().any(|locals| (locals[joint].translation - first).length() > STILL * size) {
            moving.push(joint);
        } else if (first - rest.translation).length() > STILL * size {
            rest.translation = first;
        }
    }
    let mut skeleton = Skeleton::new();
    for (bone, rest) in bones.iter().zip(rest) {
        skeleton.push(Joint { name: bone.name.clone(), parent: bone.parent, rest, tip: None });
    }
    let mut clip = Clip::new(skeleton, frame_time_secs, moving);
    frames.iter().for_each(|locals| clip.push(locals));
    clip
}

/// `parent_from_joint` of every bone \[m\], from the scene's world transforms.
fn pose_into(scene: &ufbx::Scene, bones: &[Bone], locals: &mut Vec<Transform>) -> Result<(), Error> {
    let mut world: Vec<Transform> = Vec::with_capacity(bones.len());
    for bone in bones {
        let Some(node) = scene.nodes.get(bone.node) else {
            return Err(at_node(&bone.name, "it vanishes during the animation", "export again"));
        };
        let Some(world_from_joint) = rigid(&node.node_to_world) else {
            return Err(at_node(
                &bone.name,
                "its transform is flat or not finite",
                "export again without broken keys and without scales of zero",
            ));
        };
        let local = bone.parent.map_or(world_from_joint, |parent| world[parent].inverse() * world_from_joint);
        locals.push(Transform::new(local.rotation.normalize(), local.translation));
        world.push(world_from_joint);
    }
    Ok(())
}

/// `parent_from_joint` of every bone \[m\] in the bind pose that the file states: the pose in which its mesh was bound, where nodes keep the
/// frame at which it was exported. Bones that no mesh is bound to, and none below them, stay as they are in `rest`; `None` if others
/// are missing.
fn bind_pose(scene: &ufbx::Scene, bones: &[Bone], rest: &[Transform]) -> Option<Vec<Transform>> {
    let bound = |bone: &Bone| {
        let node = scene.nodes.get(bone.node)?;
        let pose = node.bind_pose.as_ref()?;
        rigid(&ufbx::get_bone_pose(pose, node)?.bone_to_world)
    };
    let bound: Vec<Option<Transform>> = bones.iter().map(bound).collect();
    let mut carries: Vec<bool> = bound.iter().map(Option::is_some).collect();
    for (at, bone) in bones.iter().enumerate().rev() {
        if let (true, Some(parent)) = (carries[at], bone.parent) {
            carries[parent] = true;
        }
    }
    let mut world: Vec<Transform> = Vec::with_capacity(bones.len());
    let mut locals = Vec::with_capacity(bones.len());
    for (at, bone) in bones.iter().enumerate() {
        let node = scene.nodes.get(bone.node)?;
        let above = bone.parent.map_or(Transform::IDENTITY, |parent| world[parent]);
        let world_from_joint = match bound[at] {
            Some(bound) => bound,
            None if !carries[at] => above * rest[at],
            // Nodes above the bones are in no bind pose.
            None if node.bone.is_none() => rigid(&node.node_to_world)?,
            None => return None,
        };
        let local = above.inverse() * world_from_joint;
        locals.push(Transform::new(local.rotation.normalize(), local.translation));
        world.push(world_from_joint);
    }
    bound.iter().any(Option::is_some).then_some(locals)
}

/// A matrix without its scale, by Gram-Schmidt.
fn rigid(matrix: &ufbx::Matrix) -> Option<Transform> {
    let x = DVec3::new(matrix.m00, matrix.m10, matrix.m20).try_normalize()?;
    let y = DVec3::new(matrix.m01, matrix.m11, matrix.m21);
    let y = (y - x * x.dot(y)).try_normalize()?;
    let rotation = DQuat::from_mat3(&DMat3::from_cols(x, y, x.cross(y))).normalize();
    let translation = DVec3::new(matrix.m03, matrix.m13, matrix.m23);
    (rotation.is_finite() && translation.is_finite()).then_some(Transform { rotation, translation })
}

/// All animation stacks, with the frames and the rate that their keys make; `clip` is the one that was read.
pub(super) fn list(
    scene: &ufbx::Scene,
    stacks: &[&ufbx::AnimStack],
    chosen: usize,
    clip: &Clip,
    limits: &Limits,
) -> Vec<AnimationInfo> {
    let info = |(index, stack): (usize, &&ufbx::AnimStack)| {
        let (frames, fps) = match index == chosen {
            true => (clip.frames(), clip.fps()),
            false => span(scene, Some(stack), limits).map_or((0, 0.0), |span| (span.frames, span.hz)),
        };
        AnimationInfo { name: stack.element.name.to_string(), frames, fps, is_read: index == chosen }
    };
    stacks.iter().enumerate().map(info).collect()
}

/// Whether a stack has a curve with two keys or more.
pub(super) fn has_keys(stack: &ufbx::AnimStack) -> bool {
    let values = stack.layers.into_iter().flat_map(|layer| &layer.anim_values);
    values.flat_map(|value| value.curves.iter().flatten()).any(|curve| curve.keyframes.count > 1)
}

/// From the first to the last key of the stack, within the times that the stack states.
fn span(scene: &ufbx::Scene, stack: Option<&ufbx::AnimStack>, limits: &Limits) -> Result<Span, Error> {
    let file_hz = scene.settings.frames_per_second;
    let file_hz = if FILE_HZ.contains(&file_hz) { file_hz } else { DEFAULT_HZ };
    let still = Span { start_secs: 0.0, length_secs: 0.0, hz: file_hz, frames: 1 };
    let Some(stack) = stack else { return Ok(still) };
    let mut tracks: Vec<Vec<f64>> = Vec::new();
    for layer in &stack.layers {
        for value in &layer.anim_values {
            for curve in value.curves.iter().flatten() {
                let times: Vec<f64> = curve.keyframes.iter().map(|key| key.time).collect();
                if times.iter().any(|time| !time.is_finite()) {
                    return Err(whole("a key's time is not finite", "export again without broken keys"));
                }
                tracks.push(times);
            }
        }
    }
    tracks.retain(|times| !times.is_empty());
    let first = tracks.iter().map(|times| times[0]).fold(f64::INFINITY, f64::min);
    let last = tracks.iter().map(|times| times[times.len() - 1]).fold(f64::NEG_INFINITY, f64::max);
    if first >= last {
        return Ok(still);
    }
    let (begin, end) = (stack.time_begin.max(first), stack.time_end.min(last));
    let (begin, end) = if begin < end { (begin, end) } else { (first, last) };
    let hz = rate_hz(tracks.iter().map(Vec::as_slice), true).unwrap_or(file_hz);
    let length_secs = end - begin;
    let frames = (length_secs * hz - 0.01).ceil().max(0.0) + 1.0;
    let densest = tracks.iter().map(Vec::len).max().unwrap_or(0);
    let most = limits.frames.min(densest.saturating_mul(FRAMES_PER_KEY).saturating_add(FREE_FRAMES));
    if frames > most as f64 {
        let problem = format!("{length_secs} s at {hz} Hz are more frames than allowed for {densest} keys");
        return Err(whole(problem, "export shorter animations"));
    }
    Ok(Span { start_secs: begin, length_secs, hz, frames: frames as usize })
}
