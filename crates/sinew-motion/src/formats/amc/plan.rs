//! Which bones a new skeleton needs.

use crate::formats::text::Baked;
use crate::{Clip, Error, Place};
use glam::DVec3;
use std::collections::BTreeSet;

/// A bone to write.
pub(super) struct Planned {
    /// Unique, one word.
    pub(super) name: String,
    /// Index of its parent among the planned bones; the root, first of all, has none.
    pub(super) parent: Option<usize>,
    /// The clip's joint at its start; `None` for a bone that only leads to one.
    pub(super) joint: Option<usize>,
    /// From its start to its end \[m\].
    pub(super) span: DVec3,
    /// Whether its joint moves in its parent.
    pub(super) moves: bool,
}

/// The bones of a clip, parents first. An ASF bone starts where its parent ends, so a joint whose children hang at
/// several places gets a bone of length zero, and a bone without `dof` leads to each child that is elsewhere.
pub(super) fn plan(clip: &Clip, baked: &Baked) -> Result<Vec<Planned>, Error> {
    if baked.roots().len() != 1 {
        let problem = format!("the motion has {} roots, an ASF skeleton one", baked.roots().len());
        return Err(Error::new(Place::File, problem, "write it as BVH or GLB"));
    }
    let mut names = BTreeSet::from(["root".to_owned(), "begin".to_owned(), "end".to_owned()]);
    let mut bones: Vec<Planned> = Vec::new();
    let mut bone_of = vec![0; clip.skeleton().len()];
    for (joint, depth) in baked.depth_first() {
        let moves = depth == 0 || clip.moving().binary_search(&joint).is_ok();
        let span = if depth == 0 { DVec3::ZERO } else { span(baked, joint) };
        let Some(above) = clip.skeleton().joints()[joint].parent else {
            bones.push(Planned { name: "root".to_owned(), parent: None, joint: Some(joint), span, moves });
            continue;
        };
        let own = &clip.skeleton().joints()[joint].name;
        let mut parent = bone_of[above];
        let lead = baked.offset(joint) - bones[parent].span;
        if lead != DVec3::ZERO {
            let name = unique(&mut names, &format!("to_{own}"));
            bones.push(Planned { name, parent: Some(parent), joint: None, span: lead, moves: false });
            parent = bones.len() - 1;
        }
        let name = unique(&mut names, own);
        bone_of[joint] = bones.len();
        bones.push(Planned { name, parent: Some(parent), joint: Some(joint), span, moves });
    }
    Ok(bones)
}

/// Where a joint's bone ends: at its children if all hang at one place, at its tip if it has none, else at its start.
fn span(baked: &Baked, joint: usize) -> DVec3 {
    match baked.children(joint) {
        [] => baked.tip(joint).unwrap_or(DVec3::ZERO),
        [first, others @ ..] => {
            let end = baked.offset(*first);
            if others.iter().all(|&other| baked.offset(other) == end) { end } else { DVec3::ZERO }
        }
    }
}

/// The name as one word that is no keyword, no number and no other bone's name.
fn unique(names: &mut BTreeSet<String>, wanted: &str) -> String {
    let safe = |letter: char| {
        if letter.is_whitespace() || letter.is_control() || matches!(letter, '#' | ':' | '(') { '_' } else { letter }
    };
    let mut base: String = wanted.chars().map(safe).collect();
    if base.is_empty() || base.starts_with(|letter: char| letter.is_ascii_digit()) {
        base.insert(0, '_');
    }
    let mut name = base.clone();
    let mut count = 2;
    while !names.insert(name.clone()) {
        name = format!("{base}_{count}");
        count += 1;
    }
    name
}
