//! Nodes above the hips that only carry them.

use crate::{Clip, Joint, Skeleton, Transform};
use std::borrow::Cow;

/// The clip without roots that never move and carry one joint that does, or one such root: the `Armature` of Blender, a null or a group. In formats in which
/// readers agree about the root's travel alone, the joint that travels has to be the root.
pub(crate) fn without_helpers(clip: &Clip) -> Cow<'_, Clip> {
    let mut clip = Cow::Borrowed(clip);
    while let Some(lifted) = lifted(&clip) {
        clip = Cow::Owned(lifted);
    }
    clip
}

/// Without the only root, if it is a helper.
fn lifted(clip: &Clip) -> Option<Clip> {
    let joints = clip.skeleton().joints();
    let only = |parent: Option<usize>| {
        let mut below = joints.iter().enumerate().filter(|(_, joint)| joint.parent == parent).map(|(at, _)| at);
        below.next().filter(|_| below.next().is_none())
    };
    let stands = |joint: usize| (1..clip.frames()).all(|frame| clip.local(frame, joint) == clip.local(0, joint));
    let root = only(None).filter(|root| *root == 0 && stands(*root) && clip.frames() > 0)?;
    let child = only(Some(root))?;
    let mut travels = child;
    while clip.moving().binary_search(&travels).is_err() {
        travels = only(Some(travels)).filter(|_| stands(travels))?;
    }
    let above = clip.local(0, root);
    let mut skeleton = Skeleton::new();
    for (at, joint) in joints.iter().enumerate().skip(1) {
        let rest = if at == child { above * joint.rest } else { joint.rest };
        let parent = joint.parent.filter(|_| at != child).map(|parent| parent - 1);
        skeleton.push(Joint { name: joint.name.clone(), parent, rest, tip: joint.tip });
    }
    let moving = clip.moving().iter().filter(|joint| **joint > 0).map(|joint| joint - 1).collect();
    let mut lifted = Clip::new(skeleton, clip.frame_time_secs(), moving);
    let mut locals: Vec<Transform> = Vec::with_capacity(joints.len());
    for frame in 0..clip.frames() {
        locals.clear();
        locals.extend((1..joints.len()).map(|joint| clip.local(frame, joint)));
        locals[child - 1] = above * locals[child - 1];
        lifted.push(&locals);
    }
    Some(lifted)
}
