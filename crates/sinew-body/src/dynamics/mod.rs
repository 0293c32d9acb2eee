//! Kinematics and dynamics of one articulated body, by Featherstone's methods.
//!
//! A body is a [`Tree`] of links. A [`State`] says how each link is placed and moves relative to its parent, either
//! set directly (a captured motion) or from coordinates ([`Coordinates`]). From these:
//!
//! | question | function |
//! |---|---|
//! | where is every link, how does it move | [`kinematics()`] |
//! | what torques does this motion take | [`rnea()`] |
//! | the joint-space inertia matrix | [`crba()`] |
//! | both at once, for a prescribed motion | [`inverse()`] |
//! | what motion do these torques make | [`aba()`] |
//! | how does a point move with the coordinates | [`point_jacobian`], [`turning_jacobian`] |
//! | sums over the body | [`centre_of_mass`], [`momentum`], [`kinetic_energy`], [`potential_energy`] |
//!
//! **One frame.** Every vector is in world axes, every moment about one common point, the origin of the first link
//! that has mass. Then inertias, wrenches and momenta of different links add as they are, and none of the 6 × 6
//! transforms of the textbook is needed; links are placed once and all algorithms share them.
//!
//! **Two levels.** The algorithms know only full relative motions: rotation, angular velocity, angular acceleration,
//! and up to three axes that torque is projected on. So a joint may follow any prescribed rotation while only some
//! directions of it are coordinates. Joint types live in [`Coordinates`] alone.
//!
//! **Lanes.** Everything is generic over [`Real`]: `f64`, or several characters side by side. Products are rounded
//! before they are added (no fused multiply-add: it gains about a tenth, and then the bits would depend on the machine).
//!
//! A pendulum, whose torque has a closed form:
//!
//! ```
//! use sinew_body::dynamics::*;
//! let rod = Link { axes: 1, mass: 1.3, centre: V3::new(0.0, -0.4, 0.0),
//!                  inertia: Sym3::new(0.02, 0.003, 0.02, 0.0, 0.0, 0.0), ..Link::default() };
//! let tree = Tree::new(vec![rod])?;
//! let joints = Coordinates::new(&tree, vec![Joint::Turns(vec![Letter::Z])])?;
//! let (mut state, mut workspace) = (State::at_rest(&tree), Workspace::new(&tree));
//! let base = Base::at_rest(V3::new(0.0, -9.81, 0.0));
//!
//! let (q, qd, qdd) = (0.7, -1.1, 2.3);
//! joints.set(&tree, &[q], &[qd], &mut state);
//! let mut tau = [0.0];
//! rnea(&tree, &base, &state, Accelerations::Coordinates(&[qdd]), &[], &mut workspace, &mut tau);
//! let inertia = 0.02 + 1.3 * 0.4 * 0.4;
//! assert!((tau[0] - (inertia * qdd + 1.3 * 9.81 * 0.4 * q.sin())).abs() < 1e-12);
//!
//! let mut mass = MassMatrix::new(&tree);
//! crba(&tree, &base, &state, &mut workspace, &mut mass);
//! assert!((mass.at(0, 0) - inertia).abs() < 1e-12);
//!
//! let mut second = [0.0];
//! aba(&tree, &base, &state, &tau, &[], &mut workspace, &mut second);
//! assert!((second[0] - qdd).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! No function allocates. `R. Featherstone, Rigid Body Dynamics Algorithms, Springer 2008` is cited by section.

mod aba;
mod axes;
mod base;
mod coordinates;
mod crba;
mod energy;
mod inertia;
mod inverse;
mod jacobian;
mod kinematics;
#[cfg(feature = "lanes")]
mod lanes;
mod m3;
mod mass_matrix;
mod real;
mod rnea;
mod state;
mod sym3;
mod tree;
mod trig;
mod triple;
mod v3;
mod workspace;
mod wrench;

pub use aba::aba;
pub use axes::Axes;
pub use base::Base;
pub use coordinates::{Coordinates, CoordinatesError, Joint, Letter};
pub use crba::crba;
pub use energy::{Momentum, centre_of_mass, kinetic_energy, momentum, potential_energy};
pub use inertia::Inertia;
pub use inverse::{Inverse, inverse};
pub use jacobian::{point_jacobian, turning_jacobian};
pub use kinematics::{Links, Placed, kinematics};
pub use m3::M3;
pub use mass_matrix::MassMatrix;
pub use real::Real;
pub use rnea::{Accelerations, rnea};
pub use state::{Motion, State};
pub use sym3::Sym3;
pub use tree::{Freedom, Link, Tree, TreeError};
pub use v3::V3;
pub use workspace::Workspace;
pub use wrench::{PointForce, Wrench};
