//! Several people in one skeleton: each is mapped within a tree of their own.

use super::{BodyHints, Humanoid};
use crate::choice::{choose as choose_named, listed};
use crate::{Clip, Error, Note, Skeleton};

/// The fewest joints that a body is made of: hips, chest, head, two of each arm and three of each leg.
pub(crate) const LEAST_JOINTS: usize = 13;
/// Joints above the hips by which a person can be called too.
const MOST_ABOVE_HIPS: usize = 4;
/// Maximum number of trees that are looked at, so that a hostile skeleton does not take for ever.
const MOST_TREES: usize = 100;

/// The joints in which a body is looked for.
pub(super) struct Scope {
    /// `None` for all joints.
    inside: Option<Vec<bool>>,
}

impl Scope {
    pub fn holds(&self, joint: usize) -> bool {
        self.inside.as_ref().is_none_or(|inside| inside[joint])
    }

    /// A joint and all that hangs from it.
    fn below(skeleton: &Skeleton, root: usize) -> Scope {
        let mut inside = vec![false; skeleton.len()];
        for (joint, at) in skeleton.joints().iter().enumerate() {
            inside[joint] = joint == root || at.parent.is_some_and(|parent| inside[parent]);
        }
        Scope { inside: Some(inside) }
    }
}

/// The joints of the person to map, and a note that names the others.
pub(super) fn choose(clip: &Clip, hints: &BodyHints) -> Result<(Scope, Option<Note>), Error> {
    let everywhere = (Scope { inside: None }, None);
    if !hints.stated.is_empty() {
        // A file that states its bones is about one person.
        return Ok(everywhere);
    }
    let skeleton = clip.skeleton();
    let people = People::new(clip, hints).all();
    let Some(&first) = people.first() else { return Ok(everywhere) };
    let names: Vec<Vec<&str>> = people.iter().map(|&root| names(skeleton, hints, root)).collect();
    let chosen = match &hints.person {
        Some(wanted) => choose_named(("person", "people"), wanted, &names)?,
        None => people.iter().position(|&root| holds_all(skeleton, hints, root)).unwrap_or(0),
    };
    if let [_] = people[..] {
        // Whoever has one root alone keeps all joints: helpers may hang beside the hips.
        let has_one_root = skeleton.joints().iter().filter(|joint| joint.parent.is_none()).count() == 1;
        return Ok(if has_one_root { everywhere } else { (Scope::below(skeleton, first), None) });
    }
    let note = Note::new(format!(
        "{} people: number {}, {:?}, is taken, of {}; ReadOptions::person chooses another",
        people.len(),
        chosen + 1,
        names[chosen][0],
        listed(names.iter().map(|names| names[0]))
    ));
    Ok((Scope::below(skeleton, people[chosen]), Some(note)))
}

/// By which a person can be called, the name for messages first: the armature, the root joint, and what follows that in a single
/// chain.
fn names<'a>(skeleton: &'a Skeleton, hints: &'a BodyHints, root: usize) -> Vec<&'a str> {
    let armature = hints.armatures.iter().find(|(joint, _)| *joint == root).map(|(_, name)| name.as_str());
    let mut names: Vec<&str> = armature.into_iter().chain([skeleton.joints()[root].name.as_str()]).collect();
    let mut at = root;
    for _ in 0..MOST_ABOVE_HIPS {
        let mut children = skeleton.children(at);
        let (Some(only), None) = (children.next(), children.next()) else { break };
        names.push(&skeleton.joints()[only].name);
        at = only;
    }
    names
}

/// Whether all joints that the user names are in this tree.
fn holds_all(skeleton: &Skeleton, hints: &BodyHints, root: usize) -> bool {
    let inside = Scope::below(skeleton, root);
    let joints = skeleton.joints();
    let is_inside = |name: &String| (0..joints.len()).any(|joint| inside.holds(joint) && joints[joint].name == *name);
    hints.parts.iter().all(|(_, name)| is_inside(name))
}

/// The search for people.
struct People<'a> {
    clip: &'a Clip,
    hints: &'a BodyHints,
    /// Children of each joint in whose trees there are joints enough for a body.
    large: Vec<Vec<usize>>,
    roots: Vec<usize>,
    left: usize,
}

impl People<'_> {
    fn new<'a>(clip: &'a Clip, hints: &'a BodyHints) -> People<'a> {
        let joints = clip.skeleton().joints();
        let mut size = vec![1_usize; joints.len()];
        let mut large = vec![Vec::new(); joints.len()];
        let mut roots = Vec::new();
        for joint in (0..joints.len()).rev() {
            let above = match joints[joint].parent {
                Some(parent) => {
                    size[parent] += size[joint];
                    &mut large[parent]
                }
                None => &mut roots,
            };
            if size[joint] >= LEAST_JOINTS {
                above.push(joint);
            }
        }
        large.iter_mut().for_each(|children| children.reverse());
        roots.reverse();
        People { clip, hints, large, roots, left: MOST_TREES }
    }

    /// The root of each person's tree, in the order of the joints. Of a skeleton that cannot hold two, its only root.
    fn all(mut self) -> Vec<usize> {
        let roots = std::mem::take(&mut self.roots);
        if let [only] = roots[..] {
            let people = self.branches(only);
            return if people.len() > 1 { people } else { roots };
        }
        let mut people: Vec<usize> = roots.into_iter().flat_map(|root| self.within(root)).collect();
        people.sort_unstable();
        people
    }

    /// The people in a tree: those of its branches where they hold two or more, else the whole tree if it is a body.
    fn within(&mut self, root: usize) -> Vec<usize> {
        if self.left == 0 {
            return Vec::new();
        }
        self.left -= 1;
        let found = self.branches(root);
        if found.len() > 1 {
            return found;
        }
        let scope = Scope::below(self.clip.skeleton(), root);
        let parts = self.hints.parts.iter().filter(|(_, name)| {
            let joints = self.clip.skeleton().joints();
            (0..joints.len()).any(|joint| scope.holds(joint) && joints[joint].name == *name)
        });
        let hints = BodyHints { parts: parts.cloned().collect(), ..BodyHints::default() };
        let is_body = Humanoid::in_scope(self.clip, &hints, &scope).is_ok();
        if is_body { vec![root] } else { found }
    }

    /// The people in the trees where the tree of a joint first branches.
    fn branches(&mut self, root: usize) -> Vec<usize> {
        let mut at = root;
        while let [only] = self.large[at][..] {
            at = only;
        }
        let branches = std::mem::take(&mut self.large[at]);
        branches.into_iter().flat_map(|branch| self.within(branch)).collect()
    }
}
