//! Which nodes are the skeleton.

use super::element;
use super::schema::Root;
use crate::{Error, Part};

const EXPORT_AGAIN: &str = "the file is damaged or its exporter is wrong: export it again";

/// Maximum number of rounds in which skins connected to the first one are searched; each round adds at least one.
const MAX_ROUNDS: usize = 16;

/// The nodes as the strict forest that glTF 2.0 section 3.5.2 demands.
pub(super) struct Tree {
    /// Each node's parent.
    pub parent: Vec<Option<usize>>,
    /// Every node, parents before children, subtrees together.
    pub order: Vec<usize>,
}

/// Checks the node hierarchy: indices in range, one parent at most, no cycle. Uses no recursion.
pub(super) fn tree(root: &Root) -> Result<Tree, Error> {
    let count = root.nodes.len();
    let mut parent = vec![None; count];
    for (index, node) in root.nodes.iter().enumerate() {
        for &child in &node.children {
            let name = || format!("nodes[{index}].children");
            let Some(slot) = parent.get_mut(child) else {
                return Err(element(
                    name(),
                    format!("node {child} does not exist, the file has {count}"),
                    EXPORT_AGAIN,
                ));
            };
            if let Some(other) = slot.replace(index) {
                let problem = format!("node {child} is also a child of node {other}");
                return Err(element(name(), problem, EXPORT_AGAIN));
            }
        }
    }
    let mut order = Vec::with_capacity(count);
    let mut stack: Vec<usize> = (0..count).rev().filter(|&node| parent[node].is_none()).collect();
    while let Some(node) = stack.pop() {
        order.push(node);
        stack.extend(root.nodes[node].children.iter().rev());
    }
    if order.len() < count {
        let mut reached = vec![false; count];
        order.iter().for_each(|&node| reached[node] = true);
        let lost = reached.iter().position(|reached| !reached).unwrap_or(0);
        return Err(element(format!("nodes[{lost}]"), "it is its own ancestor", EXPORT_AGAIN));
    }
    Ok(Tree { parent, order })
}

impl Tree {
    /// For each node whether it or a node above it is one of `some`.
    fn at_or_below(&self, some: &[bool]) -> Vec<bool> {
        let mut below = some.to_vec();
        for &node in &self.order {
            below[node] |= self.parent[node].is_some_and(|parent| below[parent]);
        }
        below
    }

    /// For each node whether it or a node below it is one of `some`.
    pub fn at_or_above(&self, some: &[bool]) -> Vec<bool> {
        let mut above = some.to_vec();
        for &node in self.order.iter().rev() {
            if let (true, Some(parent)) = (above[node], self.parent[node]) {
                above[parent] = true;
            }
        }
        above
    }
}

/// For each node whether it is a joint: of the first skin, and of all skins that share a joint with it or hang from
/// it or carry it (a body exported as several meshes), and of all that are large enough for a body of their own; without any skin, the
/// nodes that `animated` names. What the file calls `bones` are joints in any case.
pub(super) fn joints(root: &Root, tree: &Tree, animated: &[bool], bones: &[(Part, usize)]) -> Result<Vec<bool>, Error> {
    let mut chosen = vec![false; root.nodes.len()];
    for (index, skin) in root.skins.iter().enumerate() {
        if let Some(joint) = skin.joints.iter().find(|&&joint| joint >= root.nodes.len()) {
            let problem = format!("node {joint} does not exist, the file has {}", root.nodes.len());
            return Err(element(format!("skins[{index}].joints"), problem, EXPORT_AGAIN));
        }
    }
    let Some((first, rest)) = root.skins.split_first() else {
        let mut chosen = animated.to_vec();
        bones.iter().for_each(|&(_, bone)| chosen[bone] = true);
        return Ok(chosen);
    };
    first.joints.iter().chain(bones.iter().map(|(_, bone)| bone)).for_each(|&joint| chosen[joint] = true);
    let (others, mut waiting): (Vec<_>, Vec<_>) =
        rest.iter().partition(|skin| skin.joints.len() >= crate::humanoid::LEAST_JOINTS);
    others.iter().flat_map(|skin| &skin.joints).for_each(|&joint| chosen[joint] = true);
    for _ in 0..MAX_ROUNDS {
        let (above, below) = (tree.at_or_above(&chosen), tree.at_or_below(&chosen));
        let before = waiting.len();
        waiting.retain(|skin| {
            let same_body = skin.joints.iter().any(|&joint| above[joint] || below[joint]);
            if same_body {
                skin.joints.iter().for_each(|&joint| chosen[joint] = true);
            }
            !same_body
        });
        if waiting.len() == before {
            break;
        }
    }
    Ok(chosen)
}
