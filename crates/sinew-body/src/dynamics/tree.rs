//! The constant part of a body: topology, joint positions, masses and inertias.

use super::{Real, Sym3, V3};

/// How a link moves relative to its parent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Freedom {
    /// It turns about its origin.
    #[default]
    Turn,
    /// Its origin moves; its axes stay parallel to the parent's.
    Slide,
}

/// One rigid body with the joint to its parent.
///
/// A joint has at most three axes. A free root is two links: a massless one that slides, and the body that turns on it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Link<S: Real> {
    /// Index of the parent, smaller than the link's own; `None` if the parent is the base.
    pub parent: Option<usize>,
    /// Position of the joint, and of the link's origin at zero displacement, in the parent's frame \[m\].
    pub offset: V3<S>,
    /// Turn or slide.
    pub freedom: Freedom,
    /// How many coordinates the joint has, 0 to 3. It may move in other ways too, if that motion is prescribed.
    pub axes: usize,
    /// Mass \[kg\], not negative.
    pub mass: S,
    /// Centre of mass in the link's frame \[m\].
    pub centre: V3<S>,
    /// Rotational inertia about the centre of mass in the link's axes \[kg m²\].
    pub inertia: Sym3<S>,
}

/// Why links do not form a valid tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TreeError {
    /// No links, or too many.
    #[error("a tree has 1 to {max} links, not {0}; merge links that do not move", max = Tree::<f64>::MAX_LINKS)]
    Size(usize),
    /// A parent that does not stand before its child.
    #[error("link {link} hangs from link {parent}, which stands after it; put parents before children")]
    Order {
        /// The link.
        link: usize,
        /// Its parent.
        parent: usize,
    },
    /// Too many axes.
    #[error("link {link} has {axes} axes; a joint has at most 3, split it in two links")]
    Axes {
        /// The link.
        link: usize,
        /// Its axes.
        axes: usize,
    },
    /// A number that is not finite, or a negative mass.
    #[error("link {link}: {what}; check the body's measures")]
    Number {
        /// The link.
        link: usize,
        /// The problem.
        what: &'static str,
    },
    /// Trees that are to be stepped side by side differ in more than their measures.
    #[error("the trees differ in links, parents or axes; only bodies of one build can be stepped side by side")]
    Mixed,
}

/// Per-link data of the algorithms. Slot 0 of every per-link array is the base, slot i + 1 is link i.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node<S: Real> {
    pub parent_slot: usize,
    pub first_dof: usize,
    pub axes: usize,
    pub freedom: Freedom,
    pub mass: S,
    pub offset: V3<S>,
    pub centre: V3<S>,
    /// ∫x xᵀ dm about the centre of mass, link axes.
    pub second: Sym3<S>,
}

/// A tree of links, built once. Degrees of freedom are counted link by link, axis by axis.
///
/// ```
/// use sinew_body::dynamics::{Link, Sym3, Tree, V3};
/// let rod = Link { axes: 1, mass: 1.3, centre: V3::new(0.0, -0.4, 0.0),
///                  inertia: Sym3::new(0.02, 0.003, 0.02, 0.0, 0.0, 0.0), ..Link::default() };
/// let tree = Tree::new(vec![rod])?;
/// assert_eq!(tree.dofs(), 1);
/// # Ok::<(), sinew_body::dynamics::TreeError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tree<S: Real> {
    links: Vec<Link<S>>,
    pub(super) nodes: Vec<Node<S>>,
    /// The links from the base to the one whose origin is the common reference point, and not further.
    pub(super) path_to_reference: Vec<usize>,
    parent_of_dof: Vec<Option<usize>>,
    link_of_dof: Vec<usize>,
}

impl<S: Real> Tree<S> {
    /// Maximum number of links.
    pub const MAX_LINKS: usize = 1_000;

    /// Builds a tree from checked links.
    ///
    /// # Errors
    /// A parent does not precede its child, a joint has more than three axes, or a number is invalid.
    pub fn new(links: Vec<Link<S>>) -> Result<Tree<S>, TreeError> {
        if links.is_empty() || links.len() > Self::MAX_LINKS {
            return Err(TreeError::Size(links.len()));
        }
        let mut nodes = Vec::with_capacity(links.len());
        let mut link_of_dof = Vec::new();
        let mut parent_of_dof = Vec::new();
        // Per link the last degree of freedom that moves it.
        let mut last_dof: Vec<Option<usize>> = Vec::with_capacity(links.len());
        for (index, link) in links.iter().enumerate() {
            check(index, link)?;
            let first_dof = link_of_dof.len();
            let mut above = link.parent.and_then(|parent| last_dof[parent]);
            for _ in 0..link.axes {
                parent_of_dof.push(above);
                above = Some(link_of_dof.len());
                link_of_dof.push(index);
            }
            last_dof.push(above);
            nodes.push(Node {
                parent_slot: link.parent.map_or(0, |parent| parent + 1),
                first_dof,
                axes: link.axes,
                freedom: link.freedom,
                mass: link.mass,
                offset: link.offset,
                centre: link.centre,
                second: second_moment(&link.inertia),
            });
        }
        let path_to_reference = path_to_first_mass(&links);
        Ok(Tree { links, nodes, path_to_reference, parent_of_dof, link_of_dof })
    }

    /// Trees of one build but different measures, one per lane. Lanes beyond the last tree repeat it.
    ///
    /// # Errors
    /// No trees, or trees that differ in links, parents, freedoms or axes.
    pub fn side_by_side(trees: &[&Tree<f64>]) -> Result<Tree<S>, TreeError> {
        let Some(first) = trees.first() else { return Err(TreeError::Size(0)) };
        let build = |tree: &Tree<f64>| -> Vec<_> {
            tree.links.iter().map(|link| (link.parent, link.freedom, link.axes, link.mass > 0.0)).collect()
        };
        if trees.iter().any(|tree| build(tree) != build(first)) {
            return Err(TreeError::Mixed);
        }
        let of = |lane: usize, index: usize| -> &Link<f64> { &trees[lane.min(trees.len() - 1)].links[index] };
        let link = |index: usize| Link {
            parent: first.links[index].parent,
            freedom: first.links[index].freedom,
            axes: first.links[index].axes,
            offset: V3::from_lanes(|lane| of(lane, index).offset.into()),
            mass: S::from_lanes(|lane| of(lane, index).mass),
            centre: V3::from_lanes(|lane| of(lane, index).centre.into()),
            inertia: Sym3::from_lanes(|lane| of(lane, index).inertia.lane(0)),
        };
        Tree::new((0..first.links.len()).map(link).collect())
    }

    /// The links, parents before children.
    pub fn links(&self) -> &[Link<S>] {
        &self.links
    }

    /// How many degrees of freedom there are.
    pub fn dofs(&self) -> usize {
        self.link_of_dof.len()
    }

    /// The degrees of freedom of a link, as indices.
    pub fn dofs_of(&self, link: usize) -> std::ops::Range<usize> {
        let node = &self.nodes[link];
        node.first_dof..node.first_dof + node.axes
    }

    /// The link that each degree of freedom moves.
    pub fn link_of_dof(&self) -> &[usize] {
        &self.link_of_dof
    }

    /// For each degree of freedom the next one on the way to the base, `None` at its end (the expanded parent array of
    /// Featherstone 2008, 6.4). The mass matrix couples a degree of freedom only with those on its way to the base
    /// and those that have it on theirs; everything else in it is zero.
    pub fn parent_of_dof(&self) -> &[Option<usize>] {
        &self.parent_of_dof
    }

    /// The degrees of freedom on the way from one to the base, nearest first, itself not included.
    pub fn ancestors(&self, dof: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(self.parent_of_dof[dof], |&above| self.parent_of_dof[above])
    }

    /// Sum of the links' masses \[kg\].
    pub fn mass(&self) -> S {
        self.links.iter().fold(S::ZERO, |sum, link| sum + link.mass)
    }
}

/// tr(I)/2 · 1 − I.
fn second_moment<S: Real>(inertia: &Sym3<S>) -> Sym3<S> {
    let half = inertia.trace() * S::splat(0.5);
    let [x, y, z] = inertia.columns();
    Sym3::new(half - x.x(), half - y.y(), half - z.z(), -x.y(), -y.z(), -z.x())
}

fn path_to_first_mass<S: Real>(links: &[Link<S>]) -> Vec<usize> {
    let heavy = |link: &Link<S>| (0..S::LANES).any(|lane| link.mass.lane(lane) > 0.0);
    let first = links.iter().position(heavy).unwrap_or(0);
    let mut path: Vec<usize> = std::iter::successors(Some(first), |&link| links[link].parent).collect();
    path.reverse();
    path
}

fn check<S: Real>(index: usize, link: &Link<S>) -> Result<(), TreeError> {
    if let Some(parent) = link.parent.filter(|&parent| parent >= index) {
        return Err(TreeError::Order { link: index, parent });
    }
    if link.axes > 3 {
        return Err(TreeError::Axes { link: index, axes: link.axes });
    }
    let bad = |what| Err(TreeError::Number { link: index, what });
    for lane in 0..S::LANES {
        let (mass, inertia) = (link.mass.lane(lane), link.inertia.lane(lane));
        if !(mass.is_finite() && mass >= 0.0) {
            return bad("the mass is negative or not finite");
        }
        if !(link.offset.lane(lane).is_finite() && link.centre.lane(lane).is_finite() && inertia.is_finite()) {
            return bad("a length or an inertia is not finite");
        }
        if inertia.x_axis.x < 0.0 || inertia.y_axis.y < 0.0 || inertia.z_axis.z < 0.0 {
            return bad("a moment of inertia is negative");
        }
    }
    Ok(())
}
