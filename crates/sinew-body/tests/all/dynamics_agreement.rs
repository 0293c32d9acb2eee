//! Every number by two routes, on random trees with joints of every kind.

use crate::dynamics_common::bodies::{self, Body, Root};
use crate::dynamics_common::random::{self, Random};
use glam::DVec3;
use proptest::prelude::*;
use sinew_body::dynamics::{
    Accelerations, Base, Coordinates, Inverse, Links, MassMatrix, PointForce, State, Tree, V3, Workspace, aba,
    centre_of_mass, crba, inverse, kinematics, kinetic_energy, momentum, point_jacobian, potential_energy, rnea,
    turning_jacobian,
};

/// A body in a random state with two random pushes.
struct Scene {
    tree: Tree<f64>,
    coordinates: Coordinates<f64>,
    base: Base<f64>,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    state: State<f64>,
    forces: Vec<PointForce<f64>>,
    workspace: Workspace<f64>,
}

impl Scene {
    fn new((tree, coordinates): Body, random: &mut Random, base: Base<f64>) -> Scene {
        let q = random::positions(random, &coordinates, 0.9);
        let qd = random.numbers(tree.dofs(), 2.0);
        let qdd = random.numbers(tree.dofs(), 10.0);
        let mut state = State::at_rest(&tree);
        coordinates.set(&tree, &q, &qd, &mut state);
        let mut push = |link| PointForce { link, point: random.vector(1.0).into(), force: random.vector(100.0).into() };
        let forces = vec![push(0), push(tree.links().len() - 1)];
        let workspace = Workspace::new(&tree);
        Scene { tree, coordinates, base, q, qd, qdd, state, forces, workspace }
    }

    fn seeded(seed: u64, links: usize) -> Scene {
        let mut random = Random::new(seed);
        let body = random::tree(&mut random, links);
        let base = random::base(&mut random);
        Scene::new(body, &mut random, base)
    }

    /// As [`Scene::seeded`] with the base at rest, so that energy is what the joints put in.
    fn at_rest(seed: u64, links: usize) -> Scene {
        let mut scene = Scene::seeded(seed, links);
        scene.base = Base { rotation: scene.base.rotation, ..Base::at_rest(scene.base.gravity) };
        scene
    }

    fn rnea(&mut self, accelerations: Option<&[f64]>, forces: &[PointForce<f64>]) -> Vec<f64> {
        let mut tau = vec![0.0; self.tree.dofs()];
        let accelerations = accelerations.map_or(Accelerations::Relative, Accelerations::Coordinates);
        rnea(&self.tree, &self.base, &self.state, accelerations, forces, &mut self.workspace, &mut tau);
        tau
    }

    fn links(&self, q: &[f64]) -> (State<f64>, Links<f64>) {
        let (mut state, mut links) = (State::at_rest(&self.tree), Links::new(&self.tree));
        self.coordinates.set(&self.tree, q, &self.qd, &mut state);
        kinematics(&self.tree, &self.base, &state, &mut links);
        (state, links)
    }

    /// The positions after a time at the present velocities.
    fn moved(&self, rates: &[f64], secs: f64) -> Vec<f64> {
        let mut q = self.q.clone();
        self.coordinates.advance(rates, secs, &mut q);
        q
    }

    fn mass(&mut self) -> MassMatrix<f64> {
        let mut mass = MassMatrix::new(&self.tree);
        crba(&self.tree, &self.base, &self.state, &mut self.workspace, &mut mass);
        mass
    }
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(1.0, |most, number| most.max(number.abs()))
}

/// Equal to rounding: `digits` relative to the largest number around.
fn close(ours: &[f64], theirs: &[f64], digits: f64) -> Result<(), TestCaseError> {
    let scale = largest(theirs);
    for (index, (a, b)) in ours.iter().zip(theirs).enumerate() {
        prop_assert!((a - b).abs() <= digits * scale, "[{}]: {} is not {}", index, a, b);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn columns_of_the_mass_matrix_are_torques_of_unit_accelerations(seed: u64, links in 1_usize..16) {
        let mut scene = Scene::seeded(seed, links);
        let n = scene.tree.dofs();
        let mass = scene.mass();
        let bias = scene.rnea(None, &[]);
        for column in 0..n {
            let mut unit = vec![0.0; n];
            unit[column] = 1.0;
            let tau = scene.rnea(Some(&unit), &[]);
            let difference: Vec<f64> = tau.iter().zip(&bias).map(|(a, b)| a - b).collect();
            // The difference cancels: digits count from the largest torque.
            let digits = 1e-13 * largest(&bias);
            close(mass.row(column), &difference, digits)?;
        }
    }

    #[test]
    fn mass_matrix_is_symmetric_positive_and_zero_between_branches(seed: u64, links in 1_usize..16) {
        let mut scene = Scene::seeded(seed, links);
        let mass = scene.mass();
        let n = scene.tree.dofs();
        for i in 0..n {
            for j in 0..i {
                prop_assert_eq!(mass.at(i, j), mass.at(j, i));
                if !scene.tree.ancestors(i).any(|above| above == j) {
                    prop_assert_eq!(mass.at(i, j), 0.0);
                }
            }
        }
        let mut momentum = vec![0.0; n];
        mass.times(&scene.qd, &mut momentum);
        let twice: f64 = momentum.iter().zip(&scene.qd).map(|(p, v)| p * v).sum();
        prop_assert!(twice > 0.0);
    }

    #[test]
    fn forward_dynamics_undoes_inverse_dynamics(seed: u64, links in 1_usize..16) {
        let mut scene = Scene::seeded(seed, links);
        let (qdd, forces) = (scene.qdd.clone(), scene.forces.clone());
        let tau = scene.rnea(Some(&qdd), &forces);
        let mut second = vec![0.0; tau.len()];
        aba(&scene.tree, &scene.base, &scene.state, &tau, &forces, &mut scene.workspace, &mut second);
        // A light tip on a heavy chain loses up to the condition of M, some 10⁴ here.
        close(&second, &qdd, 1e-8)?;
    }

    #[test]
    fn fused_pass_equals_the_separate_ones(seed: u64, links in 1_usize..16) {
        let mut scene = Scene::seeded(seed, links);
        let forces = scene.forces.clone();
        let mut both = Inverse::new(&scene.tree);
        inverse(&scene.tree, &scene.base, &scene.state, &forces, &mut scene.workspace, &mut both);
        close(&both.tau, &scene.rnea(None, &forces), 1e-13)?;
        close(both.mass.as_slice(), scene.mass().as_slice(), 1e-13)?;
        for (link, load) in both.loads.iter().enumerate() {
            let motion = &scene.state.motions[link];
            let along = (motion.axes * *load).to_array();
            let dofs = scene.tree.dofs_of(link);
            close(&both.tau[dofs.clone()], &along[..dofs.len()], 1e-13)?;
        }
    }

    #[test]
    fn kinetic_energy_is_half_the_mass_matrix_between_the_velocities(seed: u64, links in 1_usize..16) {
        let mut scene = Scene::at_rest(seed, links);
        let mass = scene.mass();
        let mut product = vec![0.0; scene.tree.dofs()];
        mass.times(&scene.qd, &mut product);
        let quadratic: f64 = 0.5 * product.iter().zip(&scene.qd).map(|(p, v)| p * v).sum::<f64>();
        let (_, links) = scene.links(&scene.q);
        close(&[kinetic_energy(&scene.tree, &links)], &[quadratic], 1e-13)?;
    }

    #[test]
    fn jacobian_is_the_derivative_of_the_point(seed: u64, links in 1_usize..16) {
        let scene = Scene::seeded(seed, links);
        let n = scene.tree.dofs();
        let last = scene.tree.links().len() - 1;
        let (state, placed) = scene.links(&scene.q);
        let in_link = V3::new(0.3, -0.2, 0.1);
        let (mut linear, mut angular) = (vec![V3::ZERO; n], vec![V3::ZERO; n]);
        point_jacobian(&scene.tree, &state, &placed, last, placed.point(last, in_link), &mut linear);
        turning_jacobian(&scene.tree, &state, &placed, last, &mut angular);
        for dof in 0..n {
            let mut rates = vec![0.0; n];
            rates[dof] = 1.0;
            // Central differences: error h²/6 · third derivative, and 1e-16 / h of rounding.
            let h = 1e-5;
            let (_, ahead) = scene.links(&scene.moved(&rates, h));
            let (_, behind) = scene.links(&scene.moved(&rates, -h));
            let point = (ahead.point(last, in_link) - behind.point(last, in_link)) * (0.5 / h);
            close(&linear[dof].to_array(), &point.to_array(), 1e-8)?;
            let turn = ahead.link(last).rotation.times_transpose(&behind.link(last).rotation).columns;
            let spin = V3::new(turn[1].z() - turn[2].y(), turn[2].x() - turn[0].z(), turn[0].y() - turn[1].x());
            close(&angular[dof].to_array(), &(spin * (0.25 / h)).to_array(), 1e-8)?;
        }
    }

    #[test]
    fn a_push_enters_by_the_transposed_jacobian(seed: u64, links in 1_usize..16) {
        let mut scene = Scene::seeded(seed, links);
        let n = scene.tree.dofs();
        let forces = scene.forces.clone();
        let mut expected = scene.rnea(None, &[]);
        let (state, placed) = scene.links(&scene.q);
        let mut columns = vec![V3::ZERO; n];
        for push in &forces {
            point_jacobian(&scene.tree, &state, &placed, push.link, push.point, &mut columns);
            for (tau, column) in expected.iter_mut().zip(&columns) {
                *tau -= column.dot(push.force);
            }
        }
        close(&scene.rnea(None, &forces), &expected, 1e-13)?;
    }

    #[test]
    fn power_of_the_torques_is_the_change_of_energy(seed: u64, links in 1_usize..12) {
        let mut scene = Scene::at_rest(seed, links);
        let qdd = scene.qdd.clone();
        let tau = scene.rnea(Some(&qdd), &[]);
        let power: f64 = tau.iter().zip(&scene.qd).map(|(force, rate)| force * rate).sum();
        let energy = |secs: f64| {
            // Along constant q̈: the mean velocity moves q (third order in `secs`, even terms cancel below).
            let mean: Vec<f64> = scene.qd.iter().zip(&qdd).map(|(v, a)| v + 0.5 * secs * a).collect();
            let end: Vec<f64> = scene.qd.iter().zip(&qdd).map(|(v, a)| v + secs * a).collect();
            let (mut state, mut links) = (State::at_rest(&scene.tree), Links::new(&scene.tree));
            scene.coordinates.set(&scene.tree, &scene.moved(&mean, secs), &end, &mut state);
            kinematics(&scene.tree, &scene.base, &state, &mut links);
            kinetic_energy(&scene.tree, &links) + potential_energy(&scene.tree, &scene.base, &links)
        };
        let h = 1e-5;
        let change = (energy(h) - energy(-h)) / (2.0 * h);
        // h² · third derivative of the energy, and its rounding over h: 1e-16 · 10³ J / 1e-5.
        prop_assert!((change - power).abs() < 1e-6 * power.abs().max(1_000.0), "{} is not {}", change, power);
    }

    #[test]
    fn momentum_changes_by_what_the_base_exerts(seed: u64, links in 1_usize..12) {
        let mut scene = Scene::seeded(seed, links);
        scene.base = Base::at_rest(V3::from(DVec3::new(0.0, -9.81, 0.0)));
        let (_, placed) = scene.links(&scene.q);
        let centre = centre_of_mass(&scene.tree, &placed);
        let linear = momentum(&scene.tree, &placed).linear;
        // Momentum is mass times velocity of the centre of mass.
        let h = 1e-5;
        let at = |secs: f64| centre_of_mass(&scene.tree, &scene.links(&scene.moved(&scene.qd, secs)).1);
        let velocity = (at(h) - at(-h)) * (0.5 / h);
        close(&(velocity * scene.tree.mass()).to_array(), &linear.to_array(), 1e-7)?;
        // At q̈ = 0 the base's reaction is what changes the momentum, and carries the weight; about the centre of mass
        // its moment changes the angular momentum.
        let momenta = |secs: f64| momentum(&scene.tree, &scene.links(&scene.moved(&scene.qd, secs)).1);
        let (ahead, behind) = (momenta(h), momenta(-h));
        let weight = scene.base.gravity * scene.tree.mass();
        scene.rnea(None, &[]);
        let reaction = scene.workspace.reaction();
        let change = (ahead.linear - behind.linear) * (0.5 / h);
        close(&(change - weight).to_array(), &reaction.force.to_array(), 1e-6)?;
        let turning = (ahead.angular - behind.angular) * (0.5 / h);
        let moment = reaction.moment_about(centre - placed.reference);
        close(&turning.to_array(), &moment.to_array(), 1e-6)?;
    }
}

#[test]
fn joints_as_chains_and_as_composites_give_the_same_numbers() {
    for rows in [&bodies::CANONICAL, &bodies::PEERS] {
        let mut random = Random::new(7);
        let gravity = V3::from(DVec3::new(0.0, -9.81, 0.0));
        let mut chain = Scene::new(bodies::chain(rows), &mut random, Base::at_rest(gravity));
        let mut composite =
            Scene::new(bodies::composite(rows, Root::Turns, |_| true), &mut random, Base::at_rest(gravity));
        composite.coordinates.set(&composite.tree, &chain.q, &chain.qd, &mut composite.state);
        let qdd = chain.qdd.clone();
        let (a, b) = (chain.rnea(Some(&qdd), &[]), composite.rnea(Some(&qdd), &[]));
        close(&a, &b, 1e-13).expect("the same torques");
        close(chain.mass().as_slice(), composite.mass().as_slice(), 1e-13).expect("the same masses");
    }
}

#[test]
fn upper_body_on_a_prescribed_pelvis_has_the_whole_bodys_torques() {
    let mut random = Random::new(11);
    let gravity = V3::from(DVec3::new(0.0, -9.81, 0.0));
    let rows = &bodies::CANONICAL;
    let mut whole =
        Scene::new(bodies::composite(rows, Root::Quaternion, |_| true), &mut random, Base::at_rest(gravity));
    let qdd = whole.qdd.clone();
    let tau = whole.rnea(Some(&qdd), &[]);
    let mass = whole.mass();
    // The accelerations of the pelvis are left in the workspace by RNEA; velocities come with the kinematics.
    whole.rnea(Some(&qdd), &[]);
    let pelvis = *whole.workspace.links().link(1);
    let origin = whole.workspace.links().origin(1);
    let base = Base {
        rotation: pelvis.rotation,
        origin,
        angular_velocity: pelvis.angular_velocity,
        velocity: V3::ZERO,
        angular_acceleration: pelvis.angular_acceleration,
        acceleration: pelvis.acceleration + gravity,
        gravity,
    };
    let (tree, coordinates) = bodies::composite(rows, Root::Base, bodies::is_upper);
    assert_eq!((tree.links().len(), tree.dofs()), (11, 24));
    // The upper body stands right after the root in the canonical order.
    let mut state = State::at_rest(&tree);
    coordinates.set(&tree, &whole.q[7..31], &whole.qd[6..30], &mut state);
    for motion_and_node in state.motions.iter_mut().enumerate() {
        let (link, motion) = motion_and_node;
        let mut second = [0.0; 3];
        for (slot, dof) in tree.dofs_of(link).enumerate() {
            second[slot] = qdd[6 + dof];
        }
        motion.acceleration += motion.axes.transpose_times(V3::from_array(second));
    }
    let (mut workspace, mut out) = (Workspace::new(&tree), Inverse::new(&tree));
    inverse(&tree, &base, &state, &[], &mut workspace, &mut out);
    close(&out.tau, &tau[6..30], 1e-13).expect("the same torques");
    for row in 0..24 {
        close(out.mass.row(row), &mass.row(6 + row)[6..30], 1e-13).expect("the same block");
    }
}

#[test]
fn a_kilometre_away_the_torques_are_the_same() {
    for root in [Root::Turns, Root::Quaternion] {
        let gravity = V3::from(DVec3::new(0.0, -9.81, 0.0));
        let body = bodies::composite(&bodies::CANONICAL, root, |_| true);
        let mut scene = Scene::new(body, &mut Random::new(3), Base::at_rest(gravity));
        let (qdd, near) = (scene.qdd.clone(), scene.forces.clone());
        let here = scene.rnea(Some(&qdd), &near);
        let mass_here = scene.mass();
        scene.q[0] += 1_000.0;
        scene.q[2] -= 1_000.0;
        scene.coordinates.set(&scene.tree, &scene.q.clone(), &scene.qd.clone(), &mut scene.state);
        let away = V3::new(1_000.0, 0.0, -1_000.0);
        let far: Vec<_> = near.iter().map(|push| PointForce { point: push.point + away, ..*push }).collect();
        let there = scene.rnea(Some(&qdd), &far);
        let most = here.iter().zip(&there).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(most < 1e-8, "{most} N m");
        assert_eq!(mass_here, scene.mass());
    }
}

#[test]
fn a_swinging_chain_keeps_its_energy() {
    let gravity = V3::from(DVec3::new(0.0, -9.81, 0.0));
    let (tree, coordinates) = bodies::composite(&bodies::CANONICAL, Root::Base, bodies::is_upper);
    let base = Base::at_rest(gravity);
    let n = tree.dofs();
    let (mut state, mut links, mut workspace) = (State::at_rest(&tree), Links::new(&tree), Workspace::new(&tree));
    let torque = vec![0.0; n];
    let mut acceleration = |q: &[f64], qd: &[f64], out: &mut [f64]| {
        coordinates.set(&tree, q, qd, &mut state);
        aba(&tree, &base, &state, &torque, &[], &mut workspace, out);
    };
    let (mut q, mut qd) = (vec![0.2; n], vec![0.0; n]);
    let mut energy = |q: &[f64], qd: &[f64]| {
        let mut state = State::at_rest(&tree);
        coordinates.set(&tree, q, qd, &mut state);
        kinematics(&tree, &base, &state, &mut links);
        (kinetic_energy(&tree, &links), potential_energy(&tree, &base, &links))
    };
    let start = energy(&q, &qd);
    let along = |q: &[f64], d: &[f64], h: f64| -> Vec<f64> { q.iter().zip(d).map(|(q, d)| q + h * d).collect() };
    // Runge-Kutta of fourth order; the hands whip at 30 rad/s, so 0.1 ms is a hundredth of a radian at most and the
    // error of a step some (0.003)⁵ of the energy, 3000 of them.
    let h = 1e-4;
    let [mut a1, mut a2, mut a3, mut a4] = [(); 4].map(|()| vec![0.0; n]);
    for _ in 0..3_000 {
        acceleration(&q, &qd, &mut a1);
        let v2 = along(&qd, &a1, h / 2.0);
        acceleration(&along(&q, &qd, h / 2.0), &v2, &mut a2);
        let v3 = along(&qd, &a2, h / 2.0);
        acceleration(&along(&q, &v2, h / 2.0), &v3, &mut a3);
        let v4 = along(&qd, &a3, h);
        acceleration(&along(&q, &v3, h), &v4, &mut a4);
        for i in 0..n {
            q[i] += h / 6.0 * (qd[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
            qd[i] += h / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
        }
    }
    let end = energy(&q, &qd);
    assert!(end.0 > 10.0, "it swings: {} J", end.0);
    assert!((end.0 + end.1 - start.0 - start.1).abs() < 1e-8 * end.0, "{start:?} {end:?}");
}
