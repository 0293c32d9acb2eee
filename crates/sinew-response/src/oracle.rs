//! The upper body's dynamics by another route, for tests only: plain vectors and quaternions, one quantity at a time.
//!
//! The legs do not affect the torques above once the hips' motion is given, so only twelve bodies take part. Everything
//! is in world axes about the hips' origin: moments then add without transforms, and a character far from the world's
//! origin keeps its digits. Joints are spherical: a joint's rate is the full angular velocity of the child relative to
//! the parent, in the child's frame, of which the 24 coordinates are components; the rest is prescribed by the input.

use crate::force::PointForce;
use crate::upper_body::{Coordinates24, DOFS, Matrix24};
use glam::{DMat3, DQuat, DVec3};
use sinew_body::STANDARD_GRAVITY_M_S2;
use sinew_body::humanoid::{Axis, Body, Dof, Node, UPPER_DOFS, UPPER_NODES};

/// Parents of the upper nodes.
const PARENT: [usize; UPPER_NODES] = {
    let mut parents = [0; UPPER_NODES];
    let mut node = 1;
    while node < UPPER_NODES {
        if let Some(parent) = Node::ALL[node].parent() {
            parents[node] = parent.index();
        }
        node += 1;
    }
    parents
};

/// The prescribed motion of the hips.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OracleHips {
    /// Angular velocity, world \[rad/s\].
    pub angular_velocity: DVec3,
    /// Angular acceleration, world \[rad/s²\].
    pub angular_acceleration: DVec3,
    /// Acceleration of the hips' origin, world \[m/s²\].
    pub acceleration: DVec3,
}

/// The upper body's constants, laid out for the passes.
#[derive(Clone, Debug)]
pub(crate) struct Oracle {
    offset: [DVec3; UPPER_NODES],
    centre: [DVec3; UPPER_NODES],
    mass: [f64; UPPER_NODES],
    inertia: [DVec3; UPPER_NODES],
}

/// Positions of the bodies in one frame, about the hips' origin.
#[derive(Clone, Debug)]
pub(crate) struct Placement {
    pub world: [DQuat; UPPER_NODES],
    /// Joints \[m\], from the hips' origin.
    pub joint: [DVec3; UPPER_NODES],
}

impl Oracle {
    pub(crate) fn of(body: &Body) -> Oracle {
        let links = std::array::from_fn::<_, UPPER_NODES, _>(|node| *body.link(Node::ALL[node]));
        Oracle {
            offset: links.map(|link| link.offset),
            centre: links.map(|link| link.centre),
            mass: links.map(|link| link.mass_kg),
            inertia: links.map(|link| link.inertia),
        }
    }

    /// Joint positions for given orientations.
    pub(crate) fn place(&self, world: &[DQuat]) -> Placement {
        let mut placement =
            Placement { world: std::array::from_fn(|node| world[node]), joint: [DVec3::ZERO; UPPER_NODES] };
        for node in 1..UPPER_NODES {
            let parent = PARENT[node];
            placement.joint[node] = placement.joint[parent] + placement.world[parent] * self.offset[node];
        }
        placement
    }

    /// Joint torques \[N m\] of the 24 coordinates (EQ1): recursive Newton-Euler, gravity included. `rate` and `change` are
    /// each joint's relative angular velocity and acceleration in the child's frame.
    pub(crate) fn torques(
        &self,
        at: &Placement,
        hips: &OracleHips,
        rate: &[DVec3; UPPER_NODES],
        change: &[DVec3; UPPER_NODES],
    ) -> Coordinates24 {
        let mut angular_velocity = [hips.angular_velocity; UPPER_NODES];
        let mut angular_acceleration = [hips.angular_acceleration; UPPER_NODES];
        let mut acceleration = [hips.acceleration + DVec3::Y * STANDARD_GRAVITY_M_S2; UPPER_NODES];
        let mut force = [DVec3::ZERO; UPPER_NODES];
        // Moments about the hips' origin.
        let mut moment = [DVec3::ZERO; UPPER_NODES];
        for node in 0..UPPER_NODES {
            let turn = at.world[node];
            if node > 0 {
                let parent = PARENT[node];
                let (spin, gain) = (angular_velocity[parent], angular_acceleration[parent]);
                let own = turn * rate[node];
                angular_velocity[node] = spin + own;
                angular_acceleration[node] = gain + turn * change[node] + spin.cross(own);
                let arm = at.joint[node] - at.joint[parent];
                acceleration[node] = acceleration[parent] + gain.cross(arm) + spin.cross(spin.cross(arm));
            }
            let (spin, gain) = (angular_velocity[node], angular_acceleration[node]);
            let arm = turn * self.centre[node];
            let centre_acceleration = acceleration[node] + gain.cross(arm) + spin.cross(spin.cross(arm));
            let own = turned(self.inertia[node], turn);
            force[node] = centre_acceleration * self.mass[node];
            moment[node] = own * gain + spin.cross(own * spin) + (at.joint[node] + arm).cross(force[node]);
        }
        for node in (1..UPPER_NODES).rev() {
            let parent = PARENT[node];
            force[parent] += force[node];
            moment[parent] += moment[node];
        }
        std::array::from_fn(|dof| {
            let Dof { node, axis } = DOFS[dof];
            let node = node.index();
            let about_joint = moment[node] - at.joint[node].cross(force[node]);
            axis_of(at.world[node], axis).dot(about_joint)
        })
    }

    /// The generalised force \[N m\] of forces on the 24 coordinates, Jᵀf of EQ1. Forces on the legs have none.
    pub(crate) fn load(&self, at: &Placement, forces: &[PointForce]) -> Coordinates24 {
        let mut load = [0.0; UPPER_DOFS];
        for push in forces.iter().map(PointForce::tamed) {
            let node = push.node.index();
            if node >= UPPER_NODES {
                continue;
            }
            let point = at.joint[node] + at.world[node] * push.point.unwrap_or(self.centre[node]);
            for (load, dof) in load.iter_mut().zip(DOFS) {
                let ancestor = dof.node.index();
                if is_ancestor(ancestor, node) {
                    let arm = point - at.joint[ancestor];
                    *load += axis_of(at.world[ancestor], dof.axis).dot(arm.cross(push.force_n));
                }
            }
        }
        load
    }

    /// The mass matrix of the 24 coordinates \[kg m²\]: composite bodies.
    pub(crate) fn mass_matrix(&self, at: &Placement, mass: &mut Matrix24) {
        let mut composite = [Inertia::NOTHING; UPPER_NODES];
        for node in 0..UPPER_NODES {
            let centre = at.joint[node] + at.world[node] * self.centre[node];
            composite[node] = Inertia::of(self.mass[node], centre, at.world[node], self.inertia[node]);
        }
        for node in (2..UPPER_NODES).rev() {
            let child = composite[node];
            composite[PARENT[node]].add(&child);
        }
        let axis: [DVec3; UPPER_DOFS] =
            std::array::from_fn(|dof| axis_of(at.world[DOFS[dof].node.index()], DOFS[dof].axis));
        for (i, row) in mass.iter_mut().enumerate() {
            let node = DOFS[i].node.index();
            let body = &composite[node];
            let velocity = at.joint[node].cross(axis[i]);
            let linear = velocity * body.mass + axis[i].cross(body.first);
            let angular = body.second * axis[i] + body.first.cross(velocity);
            for (j, entry) in row.iter_mut().enumerate().take(i + 1) {
                let ancestor = DOFS[j].node.index();
                *entry = if is_ancestor(ancestor, node) {
                    axis[j].dot(angular) + at.joint[ancestor].cross(axis[j]).dot(linear)
                } else {
                    0.0
                };
            }
        }
        for i in 0..UPPER_DOFS {
            for j in 0..i {
                mass[j][i] = mass[i][j];
            }
        }
    }
}

/// The world direction of an axis of a node's frame.
fn axis_of(world_from_node: DQuat, axis: Axis) -> DVec3 {
    let columns = DMat3::from_quat(world_from_node);
    match axis {
        Axis::X => columns.x_axis,
        Axis::Y => columns.y_axis,
        Axis::Z => columns.z_axis,
    }
}

fn is_ancestor(ancestor: usize, node: usize) -> bool {
    let mut at = node;
    while at > ancestor {
        at = PARENT[at];
    }
    at == ancestor
}

/// Mass, first and second moment of one or several bodies about a common origin, world axes: inertias of bodies simply
/// add.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia {
    pub mass: f64,
    /// Mass times centre \[kg m\].
    pub first: DVec3,
    /// Inertia about the origin \[kg m²\].
    pub second: DMat3,
}

impl Inertia {
    pub(crate) const NOTHING: Inertia = Inertia { mass: 0.0, first: DVec3::ZERO, second: DMat3::ZERO };

    /// A body with moments `own` along its axes about its centre.
    pub(crate) fn of(mass: f64, centre: DVec3, world_from_body: DQuat, own: DVec3) -> Inertia {
        let second = turned(own, world_from_body);
        let outer = DMat3::from_cols(centre * centre.x, centre * centre.y, centre * centre.z);
        let shift = DMat3::from_diagonal(DVec3::splat(centre.length_squared())) - outer;
        Inertia { mass, first: centre * mass, second: second + shift * mass }
    }

    pub(crate) fn add(&mut self, other: &Inertia) {
        self.mass += other.mass;
        self.first += other.first;
        self.second += other.second;
    }
}

/// Principal moments in world axes.
pub(crate) fn turned(own: DVec3, world_from_body: DQuat) -> DMat3 {
    let rotation = DMat3::from_quat(world_from_body);
    rotation * DMat3::from_diagonal(own) * rotation.transpose()
}
