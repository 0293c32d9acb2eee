//! Scratch memory, so that no call allocates.

use super::aba::{Articulated, Elimination};
use super::{Axes, Inertia, Links, Real, Tree, Wrench};

/// Scratch memory of the algorithms, made once per tree. Its contents between calls are meaningless, except
/// [`Workspace::links`] and [`Workspace::reaction`].
#[derive(Clone, Debug)]
pub struct Workspace<S: Real> {
    pub(super) links: Links<S>,
    pub(super) wrenches: Vec<Wrench<S>>,
    pub(super) inertias: Vec<Inertia<S>>,
    pub(super) axes: Vec<Axes<S>>,
    pub(super) articulated: Vec<Articulated<S>>,
    pub(super) eliminations: Vec<Elimination<S>>,
}

impl<S: Real> Workspace<S> {
    /// Allocates the scratch memory for a tree.
    pub fn new(tree: &Tree<S>) -> Workspace<S> {
        let slots = tree.nodes.len() + 1;
        Workspace {
            links: Links::new(tree),
            wrenches: vec![Wrench::ZERO; slots],
            inertias: vec![Inertia::ZERO; slots],
            axes: vec![Axes::ZERO; slots],
            articulated: vec![Articulated::default(); slots],
            eliminations: vec![Elimination::default(); tree.dofs()],
        }
    }

    /// The links as the last call placed them: rotations and origins after every algorithm, accelerations after
    /// [`rnea`](super::rnea()), [`inverse`](super::inverse()) and [`aba`](super::aba()); velocities of origins never.
    pub fn links(&self) -> &Links<S> {
        &self.links
    }

    /// What the base exerted on the tree in the last [`rnea`](super::rnea()) or [`inverse`](super::inverse()): force
    /// \[N\] and moment \[N m\] about the reference point, world axes.
    pub fn reaction(&self) -> Wrench<S> {
        self.wrenches[0]
    }

    pub(super) fn check(&self, tree: &Tree<S>) {
        assert!(
            self.wrenches.len() == tree.nodes.len() + 1 && self.eliminations.len() == tree.dofs(),
            "the workspace was made for another tree"
        );
    }
}
