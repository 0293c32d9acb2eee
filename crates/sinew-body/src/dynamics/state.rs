//! Relative pose and motion of every link.

use super::{M3, Real, Tree, V3};

/// The full motion of one link relative to its parent, including prescribed motion outside its coordinates.
///
/// A joint whose motion is prescribed (*rheonomic*) sets all of it directly: any rotation, any angular velocity and
/// acceleration, and in `axes` the directions on which torque is projected and for which the mass matrix is wanted.
/// A joint described by coordinates is set by [`Coordinates`](super::Coordinates).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<S: Real> {
    /// `parent_from_link`; read when the link turns.
    pub rotation: M3<S>,
    /// Displacement of the link's origin from its offset \[m\], parent axes; read when the link slides.
    pub displacement: V3<S>,
    /// Angular velocity \[rad/s\] of a link that turns, velocity \[m/s\] of one that slides, relative to the parent, in
    /// the link's axes.
    pub velocity: V3<S>,
    /// Relative acceleration \[rad/s² or m/s²\] in the link's axes; where coordinates are used, the part at zero second
    /// derivatives.
    pub acceleration: V3<S>,
    /// The joint's axes in the link's axes **by component**: column k holds component k of axis 0, 1, 2. Axes that
    /// the joint does not have are zero.
    pub axes: M3<S>,
}

impl<S: Real> Motion<S> {
    /// At rest, with x, y, z as the axes.
    pub fn at_rest() -> Motion<S> {
        Motion {
            rotation: M3::identity(),
            displacement: V3::ZERO,
            velocity: V3::ZERO,
            acceleration: V3::ZERO,
            axes: M3::identity(),
        }
    }

    /// Sets the joint's axes, given one by one; the others become zero.
    ///
    /// # Panics
    /// If there are more than three.
    pub fn set_axes(&mut self, axes: &[V3<S>]) {
        assert!(axes.len() <= 3, "a joint has at most three axes");
        let axis = |index: usize| axes.get(index).copied().unwrap_or(V3::ZERO);
        self.axes = M3::new(axis(0), axis(1), axis(2)).transpose();
    }
}

/// The motion of every link relative to its parent, in the order of the tree's links.
#[derive(Clone, Debug, PartialEq)]
pub struct State<S: Real> {
    /// One per link.
    pub motions: Vec<Motion<S>>,
}

impl<S: Real> State<S> {
    /// Every link at rest; a joint of n axes has the first n of x, y, z.
    pub fn at_rest(tree: &Tree<S>) -> State<S> {
        let unit: [V3<S>; 3] = M3::identity().columns;
        let motion = |axes: usize| {
            let mut motion = Motion::at_rest();
            motion.set_axes(&unit[..axes]);
            motion
        };
        State { motions: tree.links().iter().map(|link| motion(link.axes)).collect() }
    }
}
