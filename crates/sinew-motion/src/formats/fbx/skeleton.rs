//! Which nodes of an FBX scene are the skeleton.

use super::{at_node, whole};
use crate::{Error, Limits};

/// A joint as the scene has it.
pub(super) struct Bone {
    pub name: String,
    /// Index among the joints; parents stand before children.
    pub parent: Option<usize>,
    /// Index among the scene's nodes, the same in every evaluated scene.
    pub node: usize,
}

/// The scene's bones and the nodes above them, without ufbx's own root; where there are no bones, the nodes that a stack
/// animates.
pub(super) fn rig(scene: &ufbx::Scene, stack: Option<&ufbx::AnimStack>, limits: &Limits) -> Result<Vec<Bone>, Error> {
    let mut member = vec![false; scene.nodes.count];
    for (slot, node) in member.iter_mut().zip(&scene.nodes) {
        *slot = node.bone.is_some();
    }
    if !member.contains(&true) {
        mark_animated(stack, &mut member);
    }
    // ufbx sorts nodes by depth, so going backwards meets children before parents.
    for index in (0..scene.nodes.count).rev() {
        if let (true, Some(parent)) = (member[index], &scene.nodes[index].parent) {
            member[parent.element.typed_id as usize] = true;
        }
    }
    let count = scene.nodes.into_iter().filter(|node| is_joint(node, &member)).count();
    if count == 0 {
        return Err(whole("it has neither bones nor animated nodes", "export the armature with its animation"));
    }
    if count > limits.joints {
        let problem = format!("{count} joints, the maximum is {}", limits.joints);
        return Err(whole(problem, "export only the character"));
    }
    let mut bones: Vec<Bone> = Vec::with_capacity(count);
    let mut stack: Vec<(&ufbx::Node, Option<usize>, usize)> = vec![(&scene.root_node, None, 0)];
    while let Some((node, parent, depth)) = stack.pop() {
        let index = node.element.typed_id as usize;
        if !member.get(index).is_some_and(|member| *member) {
            continue;
        }
        let mut at = parent;
        if is_joint(node, &member) {
            at = Some(bones.len());
            let name = match node.element.name.trim() {
                "" => format!("node_{index}"),
                _ => node.element.name.to_string(),
            };
            if name.len() > limits.name_bytes {
                let problem = format!("a name of {} bytes, the maximum is {}", name.len(), limits.name_bytes);
                return Err(whole(problem, "shorten the names of the joints"));
            }
            if depth > limits.depth {
                let problem = format!("joints nest deeper than the maximum of {}", limits.depth);
                return Err(at_node(&name, problem, "export only the character"));
            }
            bones.push(Bone { name, parent, node: index });
        }
        let children: &[_] = node.children.as_ref();
        stack.extend(children.iter().rev().map(|child| (child.as_ref(), at, depth + 1)));
    }
    Ok(bones)
}

fn is_joint(node: &ufbx::Node, member: &[bool]) -> bool {
    member.get(node.element.typed_id as usize).is_some_and(|member| *member) && !node.is_root
}

fn mark_animated(stack: Option<&ufbx::AnimStack>, member: &mut [bool]) {
    let Some(stack) = stack else { return };
    for layer in &stack.layers {
        for property in &layer.anim_props {
            let element: &ufbx::Element = &property.element;
            if element.type_ == ufbx::ElementType::Node
                && let Some(slot) = member.get_mut(element.typed_id as usize)
            {
                *slot = true;
            }
        }
    }
}
