//! Joint types: from coordinates and their derivatives to relative motions.

use super::trig::sin_cos_all;
use super::{Freedom, M3, Motion, Real, State, Tree, V3};

/// One of the axes of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Letter {
    X,
    Y,
    Z,
}

/// The type of a joint: the meaning of its coordinates.
#[derive(Clone, Debug, PartialEq)]
pub enum Joint<S: Real> {
    /// No coordinates: the motion is set by hand, or never changes.
    Prescribed,
    /// A turn \[rad\] about a unit axis, the same in the parent's and the link's axes.
    Revolute(V3<S>),
    /// A displacement \[m\] along a unit axis.
    Prismatic(V3<S>),
    /// One to three turns \[rad\], each about an axis of the frame that the turns before it have made: R = R₁ R₂ R₃
    /// (intrinsic Euler angles). Two are a universal joint.
    Turns(Vec<Letter>),
    /// One to three displacements \[m\] along axes of the parent.
    Slides(Vec<Letter>),
    /// Any rotation: four coordinates, the unit quaternion `parent_from_link` as x, y, z, w; three velocities, the
    /// angular velocity in the link's axes \[rad/s\].
    Spherical,
}

impl<S: Real> Joint<S> {
    fn freedom(&self) -> Option<(Freedom, usize)> {
        match self {
            Joint::Prescribed => None,
            Joint::Revolute(_) => Some((Freedom::Turn, 1)),
            Joint::Prismatic(_) => Some((Freedom::Slide, 1)),
            Joint::Turns(letters) => Some((Freedom::Turn, letters.len())),
            Joint::Slides(letters) => Some((Freedom::Slide, letters.len())),
            Joint::Spherical => Some((Freedom::Turn, 3)),
        }
    }

    fn positions(&self) -> usize {
        match self {
            Joint::Spherical => 4,
            other => other.freedom().map_or(0, |(_, axes)| axes),
        }
    }
}

/// A joint that does not match its link.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CoordinatesError {
    /// Not one joint per link.
    #[error("{joints} joints for {links} links; give one per link, `Prescribed` for those without coordinates")]
    Count {
        /// Joints given.
        joints: usize,
        /// Links in the tree.
        links: usize,
    },
    /// Another kind or another number of axes than the link's.
    #[error("the joint of link {link} does not fit its freedom and number of axes; make them agree")]
    Misfit {
        /// The link.
        link: usize,
    },
}

/// The joints of a tree, one per link. Positions q and velocities q̇ stand in the order of the links; q has four
/// numbers for a spherical joint where q̇ has three.
///
/// ```
/// use sinew_body::dynamics::*;
/// let slide = Link { freedom: Freedom::Slide, axes: 3, ..Link::default() };
/// let body = Link { parent: Some(0), axes: 3, mass: 1.0, ..Link::default() };
/// let tree = Tree::new(vec![slide, body])?;
/// let free = vec![Joint::Slides(vec![Letter::X, Letter::Y, Letter::Z]), Joint::Spherical];
/// let coordinates = Coordinates::new(&tree, free)?;
/// assert_eq!((coordinates.positions(), tree.dofs()), (7, 6));
/// let mut state = State::at_rest(&tree);
/// coordinates.set(&tree, &[1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0], &[0.0; 6], &mut state);
/// assert_eq!(state.motions[0].displacement, V3::new(1.0, 2.0, 3.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinates<S: Real> {
    joints: Vec<Joint<S>>,
    positions: usize,
    velocities: usize,
}

/// Number of angles whose sines are computed together; more coordinates are processed in batches.
const TOGETHER: usize = 64;

impl<S: Real> Coordinates<S> {
    /// Assigns joints to a tree.
    ///
    /// # Errors
    /// The number of joints is wrong, or a joint's kind or number of axes is not its link's.
    pub fn new(tree: &Tree<S>, joints: Vec<Joint<S>>) -> Result<Coordinates<S>, CoordinatesError> {
        if joints.len() != tree.links().len() {
            return Err(CoordinatesError::Count { joints: joints.len(), links: tree.links().len() });
        }
        for (link, (joint, of)) in joints.iter().zip(tree.links()).enumerate() {
            if joint.freedom().is_some_and(|freedom| freedom != (of.freedom, of.axes)) {
                return Err(CoordinatesError::Misfit { link });
            }
        }
        let positions = joints.iter().map(Joint::positions).sum();
        let velocities = tree.dofs();
        Ok(Coordinates { joints, positions, velocities })
    }

    /// Length of q.
    pub fn positions(&self) -> usize {
        self.positions
    }

    /// The joints, one per link.
    pub fn joints(&self) -> &[Joint<S>] {
        &self.joints
    }

    /// Sets rotations, displacements, velocities and axes of a state from q and q̇, and its accelerations to those at
    /// q̈ = 0. Joints without coordinates are left as they are.
    ///
    /// # Panics
    /// If the lengths do not match.
    pub fn set(&self, tree: &Tree<S>, q: &[S], velocities: &[S], state: &mut State<S>) {
        assert!(q.len() == self.positions && velocities.len() == self.velocities, "one number per coordinate");
        assert!(
            state.motions.len() == self.joints.len() && tree.nodes.len() == self.joints.len(),
            "one motion per joint"
        );
        let (mut sines, mut cosines) = ([S::ZERO; TOGETHER], [S::ZERO; TOGETHER]);
        let (mut from, mut to, mut at) = (0, 0, 0);
        for ((joint, node), motion) in self.joints.iter().zip(&tree.nodes).zip(&mut state.motions) {
            let positions = joint.positions();
            if at + positions > to {
                (from, to) = (at, q.len().min(at + TOGETHER));
                let count = to - from;
                sin_cos_all(&q[from..to], &mut sines[..count], &mut cosines[..count]);
            }
            let (sine, cosine) = (&sines[at - from..], &cosines[at - from..]);
            let (q, rate) = (&q[at..at + positions], &velocities[node.first_dof..node.first_dof + node.axes]);
            match joint {
                Joint::Prescribed => {}
                Joint::Revolute(axis) => {
                    motion.rotation = M3::turn(*axis, sine[0], cosine[0]);
                    along_one(motion, *axis, rate[0]);
                }
                Joint::Prismatic(axis) => {
                    motion.displacement = *axis * q[0];
                    along_one(motion, *axis, rate[0]);
                }
                Joint::Turns(letters) => set_turns(letters, sine, cosine, rate, motion),
                Joint::Slides(letters) => {
                    let unit: [V3<S>; 3] = M3::identity().columns;
                    let mut axes = [V3::ZERO; 3];
                    (motion.displacement, motion.velocity) = (V3::ZERO, V3::ZERO);
                    for (index, &letter) in letters.iter().enumerate() {
                        axes[index] = unit[letter as usize];
                        motion.displacement = motion.displacement.plus(axes[index], q[index]);
                        motion.velocity = motion.velocity.plus(axes[index], rate[index]);
                    }
                    motion.acceleration = V3::ZERO;
                    motion.set_axes(&axes);
                }
                Joint::Spherical => {
                    motion.rotation = M3::from_quaternion([q[0], q[1], q[2], q[3]]);
                    motion.velocity = V3::new(rate[0], rate[1], rate[2]);
                    motion.acceleration = V3::ZERO;
                    motion.axes = M3::identity();
                }
            }
            at += positions;
        }
    }

    /// Integrates q at constant velocities for a time \[s\]; quaternions stay normalised.
    ///
    /// # Panics
    /// If the lengths do not match.
    pub fn advance(&self, velocities: &[S], secs: S, q: &mut [S]) {
        assert!(q.len() == self.positions && velocities.len() == self.velocities, "one number per coordinate");
        let (mut at, mut dof) = (0, 0);
        for joint in &self.joints {
            let axes = joint.freedom().map_or(0, |(_, axes)| axes);
            let positions = joint.positions();
            let (q, rate) = (&mut q[at..at + positions], &velocities[dof..dof + axes]);
            if matches!(joint, Joint::Spherical) {
                turn_quaternion(q, V3::new(rate[0], rate[1], rate[2]) * secs);
            } else {
                for (q, &rate) in q.iter_mut().zip(rate) {
                    *q += rate * secs;
                }
            }
            (at, dof) = (at + positions, dof + axes);
        }
    }
}

fn along_one<S: Real>(motion: &mut Motion<S>, axis: V3<S>, rate: S) {
    motion.velocity = axis * rate;
    motion.acceleration = V3::ZERO;
    motion.set_axes(&[axis]);
}

/// Builds R = R₁ R₂ R₃ from its last turn. While it grows, its rows (kept as the columns of its transpose) are the
/// frame's axes seen from the link, so the next turn's axis is one of them. A turn that is carried by later ones
/// changes direction in the link's axes: Ṡ q̇ is the sum of vᵢ × Σ_{j>i} vⱼ, vᵢ the velocity about axis i.
#[inline(always)]
fn set_turns<S: Real>(letters: &[Letter], sine: &[S], cosine: &[S], rate: &[S], motion: &mut Motion<S>) {
    let mut rows = M3::identity();
    let mut axes = [V3::ZERO; 3];
    let (mut velocity, mut acceleration) = (V3::ZERO, V3::ZERO);
    for (index, letter) in letters.iter().enumerate().rev() {
        let (s, c) = (sine[index], cosine[index]);
        let [x, y, z] = rows.columns;
        let axis = match letter {
            Letter::X => {
                (rows.columns[1], rows.columns[2]) = ((y * c).minus(z, s), (y * s).plus(z, c));
                x
            }
            Letter::Y => {
                (rows.columns[2], rows.columns[0]) = ((z * c).minus(x, s), (z * s).plus(x, c));
                y
            }
            Letter::Z => {
                (rows.columns[0], rows.columns[1]) = ((x * c).minus(y, s), (x * s).plus(y, c));
                z
            }
        };
        axes[index] = axis;
        let about = axis * rate[index];
        acceleration += about.cross(velocity);
        velocity += about;
    }
    motion.rotation = rows.transpose();
    motion.velocity = velocity;
    motion.acceleration = acceleration;
    motion.axes = M3 { columns: axes }.transpose();
}

/// q ← q exp(rotation/2), the rotation vector \[rad\] in the link's axes.
fn turn_quaternion<S: Real>(q: &mut [S], rotation: V3<S>) {
    for lane in 0..S::LANES {
        let get = |index: usize| q[index].lane(lane);
        let turned =
            glam::DQuat::from_xyzw(get(0), get(1), get(2), get(3)) * glam::DQuat::from_scaled_axis(rotation.lane(lane));
        let turned = turned.normalize().to_array();
        for (index, value) in turned.into_iter().enumerate() {
            let old = q[index];
            q[index] = S::from_lanes(|other| if other == lane { value } else { old.lane(other) });
        }
    }
}
