//! Inverse dynamics and mass matrix of the upper body on prescribed hips.
//!
//! The legs do not affect the torques above once the hips' motion is given, so only eleven bodies and the base take
//! part. Joints are spherical: a joint's rate is the full angular velocity of the child relative to the parent, in the
//! child's frame, of which the 24 coordinates are components; the rest is prescribed by the input.

use crate::force::PointForce;
use glam::{DMat3, DQuat, DVec3};
use sinew_body::dynamics::{
    Accelerations, Base, Freedom, Inverse, Link, State, Sym3, Tree, V3, Workspace, crba, inverse, rnea,
};
use sinew_body::humanoid::{Axis, Body, Dof, Node, Pose, UPPER_DOFS, UPPER_NODES, upper_dofs};

/// A vector over the 24 coordinates of the upper body.
pub(crate) type Coordinates24 = [f64; UPPER_DOFS];

/// A matrix over them, row by row.
pub(crate) type Matrix24 = [[f64; UPPER_DOFS]; UPPER_DOFS];

/// The coordinates' axes.
pub(crate) const DOFS: [Dof; UPPER_DOFS] = upper_dofs();

/// The upper bodies above the hips, in order.
pub(crate) const ABOVE: [Node; UPPER_NODES - 1] = {
    let mut above = [Node::Hips; UPPER_NODES - 1];
    let mut at = 0;
    while at < above.len() {
        above[at] = Node::ALL[at + 1];
        at += 1;
    }
    above
};

/// The prescribed motion of the hips.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HipsMotion {
    /// `world_from_hips`.
    pub rotation: DQuat,
    /// Angular velocity, world \[rad/s\].
    pub angular_velocity: DVec3,
    /// Angular acceleration, world \[rad/s²\].
    pub angular_acceleration: DVec3,
    /// Acceleration of the hips' origin, world \[m/s²\].
    pub acceleration: DVec3,
}

/// Motion of the joints in one frame, by [`Node::index`]; the hips' entries are not read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointMotion<'a> {
    /// `parent_from_node`.
    pub local: &'a [DQuat; UPPER_NODES],
    /// Relative angular velocity in the child's frame \[rad/s\].
    pub rate: &'a [DVec3; UPPER_NODES],
    /// Relative angular acceleration in the child's frame \[rad/s²\].
    pub change: &'a [DVec3; UPPER_NODES],
}

/// The upper body as a tree on the hips, with room for one frame's results.
#[derive(Clone, Debug)]
pub(crate) struct UpperBody {
    tree: Tree<f64>,
    /// Acceleration of gravity \[m/s²\], world axes.
    gravity: DVec3,
    centre: [DVec3; UPPER_NODES],
    state: State<f64>,
    workspace: Workspace<f64>,
    out: Inverse<f64>,
}

impl UpperBody {
    pub(crate) fn of(body: &Body, gravity_m_s2: f64) -> UpperBody {
        // Bodies with invalid measures get no mass, so that no body panics.
        let finite = |vector: DVec3| if vector.is_finite() { vector } else { DVec3::ZERO };
        let links = ABOVE.map(|node| {
            let link = body.link(node);
            Link {
                // The base is the hips.
                parent: node.parent().and_then(|parent| parent.index().checked_sub(1)),
                offset: finite(link.offset).into(),
                freedom: Freedom::Turn,
                axes: node.axes().len(),
                mass: finite(DVec3::splat(link.mass_kg)).x.max(0.0),
                centre: finite(link.centre).into(),
                inertia: Sym3::from_lanes(|_| DMat3::from_diagonal(finite(link.inertia).max(DVec3::ZERO))),
            }
        });
        let tree = Tree::new(links.to_vec()).expect("finite links, parents before children");
        let mut state = State::at_rest(&tree);
        for (motion, node) in state.motions.iter_mut().zip(ABOVE) {
            let axis = |axis: &Axis| V3::from(DVec3::AXES[*axis as usize]);
            let mut axes = [V3::ZERO; 3];
            for (to, from) in axes.iter_mut().zip(node.axes()) {
                *to = axis(from);
            }
            motion.set_axes(&axes);
        }
        UpperBody {
            gravity: finite(DVec3::new(0.0, -gravity_m_s2, 0.0)),
            centre: std::array::from_fn(|node| body.link(Node::ALL[node]).centre),
            workspace: Workspace::new(&tree),
            out: Inverse::new(&tree),
            tree,
            state,
        }
    }

    /// Joint torques \[N m\] of the 24 coordinates (EQ1), gravity included, without other forces.
    pub(crate) fn torques(&mut self, hips: &HipsMotion, joints: JointMotion) -> Coordinates24 {
        self.set(joints);
        let base = self.base(hips);
        let mut torques = [0.0; UPPER_DOFS];
        rnea(&self.tree, &base, &self.state, Accelerations::Relative, &[], &mut self.workspace, &mut torques);
        torques
    }

    /// As [`UpperBody::torques`], with the mass matrix; places the bodies for [`UpperBody::load`].
    pub(crate) fn inverse(&mut self, hips: &HipsMotion, joints: JointMotion) {
        self.set(joints);
        let base = self.base(hips);
        inverse(&self.tree, &base, &self.state, &[], &mut self.workspace, &mut self.out);
    }

    /// The torques of the last [`UpperBody::inverse`] \[N m\].
    pub(crate) fn found_torques(&self) -> &Coordinates24 {
        self.out.tau.first_chunk().expect("24 coordinates")
    }

    /// The mass matrix of the last [`UpperBody::inverse`] \[kg m²\].
    pub(crate) fn found_mass(&self) -> &Matrix24 {
        self.out.mass.as_slice().as_chunks().0.first_chunk().expect("24 rows")
    }

    /// The mass matrix in a pose \[kg m²\].
    pub(crate) fn mass(&mut self, pose: &Pose) -> &Matrix24 {
        let locals = locals(pose);
        for (motion, local) in self.state.motions.iter_mut().zip(&locals[1..]) {
            motion.rotation = (*local).into();
        }
        let mut base = Base::at_rest(self.gravity.into());
        base.rotation = pose.world[0].into();
        crba(&self.tree, &base, &self.state, &mut self.workspace, &mut self.out.mass);
        self.found_mass()
    }

    /// The generalised force \[N m\] of forces on the 24 coordinates, Jᵀf of EQ1, on the bodies as placed last. Forces on
    /// the hips and the legs have none.
    pub(crate) fn load(&self, forces: &[PointForce]) -> Coordinates24 {
        let mut load = [0.0; UPPER_DOFS];
        for push in forces.iter().map(PointForce::tamed) {
            let node = push.node.index();
            if node >= UPPER_NODES {
                continue;
            }
            let mut at = node;
            let mut point = None;
            while at > 0 {
                let link = self.workspace.links().link(at - 1);
                let point = *point.get_or_insert_with(|| {
                    link.origin + link.rotation * V3::from(push.point.unwrap_or(self.centre[node]))
                });
                let moment = (point - link.origin).cross(push.force_n.into());
                let about = link.rotation.transpose_times(moment).to_array();
                for dof in self.tree.dofs_of(at - 1) {
                    load[dof] += about[DOFS[dof].axis as usize];
                }
                at = Node::ALL[at].parent().map_or(0, Node::index);
            }
        }
        load
    }

    /// Which coordinates the mass matrix couples.
    pub(crate) fn tree(&self) -> &Tree<f64> {
        &self.tree
    }

    fn base(&self, hips: &HipsMotion) -> Base<f64> {
        Base {
            rotation: hips.rotation.into(),
            angular_velocity: hips.angular_velocity.into(),
            angular_acceleration: hips.angular_acceleration.into(),
            acceleration: hips.acceleration.into(),
            ..Base::at_rest(self.gravity.into())
        }
    }

    fn set(&mut self, joints: JointMotion) {
        for (index, motion) in self.state.motions.iter_mut().enumerate() {
            let node = index + 1;
            motion.rotation = joints.local[node].into();
            motion.velocity = joints.rate[node].into();
            motion.acceleration = joints.change[node].into();
        }
    }
}

/// `parent_from_node` of the upper bodies; the hips': `world_from_hips`.
pub(crate) fn locals(pose: &Pose) -> [DQuat; UPPER_NODES] {
    std::array::from_fn(|node| pose.local(Node::ALL[node]))
}

/// Spreads coordinates over the nodes' rotation vectors.
pub(crate) fn to_vectors(coordinates: &Coordinates24) -> [DVec3; UPPER_NODES] {
    let mut vectors = [DVec3::ZERO; UPPER_NODES];
    for (value, dof) in coordinates.iter().zip(DOFS) {
        vectors[dof.node.index()][dof.axis as usize] = *value;
    }
    vectors
}

/// Picks the coordinates out of the nodes' rotation vectors; components about other axes are dropped.
pub(crate) fn to_coordinates(vectors: &[DVec3; UPPER_NODES]) -> Coordinates24 {
    std::array::from_fn(|dof| vectors[DOFS[dof].node.index()][DOFS[dof].axis as usize])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::{Oracle, OracleHips};
    use proptest::prelude::*;
    use sinew_body::STANDARD_GRAVITY_M_S2;
    use sinew_body::humanoid::exp;

    fn vectors(scale: f64) -> impl Strategy<Value = Vec<DVec3>> {
        let one = -scale..scale;
        proptest::collection::vec((one.clone(), one.clone(), one), UPPER_NODES + 4)
            .prop_map(|all| all.into_iter().map(DVec3::from).collect())
    }

    /// Relative to the largest: rounding of a chain of eight bodies.
    fn agree(ours: &[f64], theirs: &[f64]) -> bool {
        let largest = theirs.iter().fold(1.0, |largest: f64, value| largest.max(value.abs()));
        ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 1e-11 * largest)
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]
        #[test]
        fn torques_mass_and_load_agree_with_plain_vectors(
            turns in vectors(1.5), rates in vectors(8.0), changes in vectors(60.0), forces in vectors(300.0),
        ) {
            let body = Body::standard(63.0, 1.55);
            let locals = Node::ALL.map(|node| if node.is_leg() { DQuat::IDENTITY } else { exp(turns[node.index()]) });
            let pose = Pose::from_locals(DVec3::new(3.0, 1.0, -2.0), &locals);
            let (rate, change) = (std::array::from_fn(|node| rates[node]), std::array::from_fn(|node| changes[node]));
            let [angular_velocity, angular_acceleration, acceleration] = [rates[13], changes[13], changes[14]];
            let hips = HipsMotion { rotation: pose.world[0], angular_velocity, angular_acceleration, acceleration };
            let pushes = [
                PointForce::at_centre(Node::LeftHand, forces[0]),
                PointForce { node: Node::Head, point: Some(turns[0] * 0.1), force_n: forces[1] },
                PointForce::at_centre(Node::LeftFoot, forces[2]),
                PointForce::at_centre(Node::Hips, forces[3]),
            ];

            let oracle = Oracle::of(&body);
            let placement = oracle.place(&pose.world[..UPPER_NODES]);
            let their_hips = OracleHips { angular_velocity, angular_acceleration, acceleration };
            let their_torques = oracle.torques(&placement, &their_hips, &rate, &change);
            let mut their_mass = [[0.0; UPPER_DOFS]; UPPER_DOFS];
            oracle.mass_matrix(&placement, &mut their_mass);

            let mut upper = UpperBody::of(&body, STANDARD_GRAVITY_M_S2);
            let local = super::locals(&pose);
            let joints = JointMotion { local: &local, rate: &rate, change: &change };
            prop_assert!(agree(&upper.torques(&hips, joints), &their_torques));
            upper.inverse(&hips, joints);
            prop_assert!(agree(upper.found_torques(), &their_torques));
            prop_assert!(agree(upper.found_mass().as_flattened(), their_mass.as_flattened()));
            prop_assert!(agree(&upper.load(&pushes), &oracle.load(&placement, &pushes)));
            prop_assert!(agree(upper.mass(&pose).as_flattened(), their_mass.as_flattened()));
        }
    }

    #[test]
    fn the_trees_coordinates_are_the_humanoids() {
        let upper = UpperBody::of(&Body::standard(80.0, 1.7), STANDARD_GRAVITY_M_S2);
        let nodes: Vec<Node> = upper.tree().link_of_dof().iter().map(|&link| ABOVE[link]).collect();
        assert_eq!(nodes, DOFS.map(|dof| dof.node));
        for (motion, node) in upper.state.motions.iter().zip(ABOVE) {
            for (index, &axis) in node.axes().iter().enumerate() {
                let along = motion.axes.transpose().columns[index];
                assert_eq!(DVec3::from(along), DVec3::AXES[axis as usize]);
            }
        }
    }
}
