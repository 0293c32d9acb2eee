//! Time per call of the dynamics of one humanoid (42 degrees of freedom) and of its upper body (24), on the canonical
//! body and on the peers'; with the feature `lanes` also for several characters side by side, per character.
//!
//! Build both sides for the machine: `RUSTFLAGS="-C target-cpu=native" cargo bench -p sinew-body --features lanes`.
//! Like the peers' programs each call takes another of 64 random states.

#[path = "../tests/all/dynamics_common/mod.rs"]
mod dynamics_common;

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dynamics_common::bodies::{self, Body, Root, Row};
use dynamics_common::random::Random;
use sinew_body::dynamics::{
    Accelerations, Base, Coordinates, Inverse, Joint, Links, M3, MassMatrix, Real, State, Tree, V3, Workspace, aba,
    crba, inverse, kinematics, point_jacobian, rnea,
};

const STATES: usize = 64;

/// A tree with random inputs.
struct Case<S: Real> {
    tree: Tree<S>,
    coordinates: Coordinates<S>,
    base: Base<S>,
    q: Vec<Vec<S>>,
    qd: Vec<Vec<S>>,
    qdd: Vec<Vec<S>>,
    states: Vec<State<S>>,
}

fn joint<S: Real>(joint: &Joint<f64>) -> Joint<S> {
    match joint {
        Joint::Prescribed => Joint::Prescribed,
        Joint::Revolute(axis) => Joint::Revolute(V3::splat((*axis).into())),
        Joint::Prismatic(axis) => Joint::Prismatic(V3::splat((*axis).into())),
        Joint::Turns(letters) => Joint::Turns(letters.clone()),
        Joint::Slides(letters) => Joint::Slides(letters.clone()),
        Joint::Spherical => Joint::Spherical,
    }
}

impl<S: Real> Case<S> {
    fn new((tree, coordinates): &Body) -> Case<S> {
        let mut random = Random::new(1);
        let joints = coordinates.joints().iter().map(joint).collect();
        let tree = Tree::side_by_side(&[tree]).expect("a tree");
        let coordinates = Coordinates::new(&tree, joints).expect("joints");
        let (n, nq) = (tree.dofs(), coordinates.positions());
        let mut base = Base::at_rest(V3::splat(glam::DVec3::new(0.0, -9.81, 0.0)));
        base.rotation = M3::splat(glam::DMat3::from_quat(random.rotation()));
        base.angular_velocity = V3::splat(random.vector(2.0));
        base.angular_acceleration = V3::splat(random.vector(10.0));
        base.acceleration = V3::splat(random.vector(10.0));
        let mut several = |count: usize, scale: f64| -> Vec<Vec<S>> {
            (0..STATES)
                .map(|_| (0..count).map(|_| S::from_lanes(|_| random_in(&mut random, scale))).collect())
                .collect()
        };
        let (mut q, qd, qdd) = (several(nq, 0.8), several(n, 2.0), several(n, 10.0));
        if coordinates.joints().iter().any(|joint| matches!(joint, Joint::Spherical)) {
            for q in &mut q {
                q[3..7].copy_from_slice(&[S::ZERO, S::splat(0.6), S::ZERO, S::splat(0.8)]);
            }
        }
        let state = |i: usize| {
            let mut state = State::at_rest(&tree);
            coordinates.set(&tree, &q[i], &qd[i], &mut state);
            state
        };
        let states = (0..STATES).map(state).collect();
        Case { tree, coordinates, base, q, qd, qdd, states }
    }
}

fn random_in(random: &mut Random, scale: f64) -> f64 {
    random.next() * scale
}

fn calls<S: Real>(criterion: &mut Criterion, name: &str, body: &Body) {
    let Case { tree, coordinates, base, q, qd, qdd, states } = Case::<S>::new(body);
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(S::LANES as u64));
    let mut workspace = Workspace::new(&tree);
    let mut links = Links::new(&tree);
    let mut tau = vec![S::ZERO; tree.dofs()];
    let mut columns = vec![V3::ZERO; tree.dofs()];
    let mut mass = MassMatrix::new(&tree);
    let mut both = Inverse::new(&tree);
    let mut state = states[0].clone();
    let mut i = 0;
    let mut next = move || {
        i = (i + 1) % STATES;
        i
    };
    group.bench_function("coordinates", |b| {
        b.iter(|| {
            let i = next();
            coordinates.set(&tree, &q[i], &qd[i], &mut state);
            black_box(&state);
        });
    });
    group.bench_function("kinematics", |b| {
        b.iter(|| {
            kinematics(&tree, &base, &states[next()], &mut links);
            black_box(&links);
        });
    });
    group.bench_function("rnea", |b| {
        b.iter(|| {
            let i = next();
            rnea(&tree, &base, &states[i], Accelerations::Coordinates(&qdd[i]), &[], &mut workspace, &mut tau);
            black_box(&tau);
        });
    });
    group.bench_function("coordinates+rnea", |b| {
        b.iter(|| {
            let i = next();
            coordinates.set(&tree, &q[i], &qd[i], &mut state);
            rnea(&tree, &base, &state, Accelerations::Coordinates(&qdd[i]), &[], &mut workspace, &mut tau);
            black_box(&tau);
        });
    });
    group.bench_function("crba", |b| {
        b.iter(|| {
            crba(&tree, &base, &states[next()], &mut workspace, &mut mass);
            black_box(&mass);
        });
    });
    group.bench_function("coordinates+crba", |b| {
        b.iter(|| {
            let i = next();
            coordinates.set(&tree, &q[i], &qd[i], &mut state);
            crba(&tree, &base, &state, &mut workspace, &mut mass);
            black_box(&mass);
        });
    });
    group.bench_function("inverse", |b| {
        b.iter(|| {
            inverse(&tree, &base, &states[next()], &[], &mut workspace, &mut both);
            black_box(&both);
        });
    });
    group.bench_function("coordinates+inverse", |b| {
        b.iter(|| {
            let i = next();
            coordinates.set(&tree, &q[i], &qd[i], &mut state);
            inverse(&tree, &base, &state, &[], &mut workspace, &mut both);
            black_box(&both);
        });
    });
    group.bench_function("aba", |b| {
        b.iter(|| {
            let i = next();
            aba(&tree, &base, &states[i], &qdd[i], &[], &mut workspace, &mut tau);
            black_box(&tau);
        });
    });
    group.bench_function("coordinates+aba", |b| {
        b.iter(|| {
            let i = next();
            coordinates.set(&tree, &q[i], &qd[i], &mut state);
            aba(&tree, &base, &state, &qdd[i], &[], &mut workspace, &mut tau);
            black_box(&tau);
        });
    });
    group.bench_function("point_jacobian", |b| {
        let last = tree.links().len() - 1;
        b.iter(|| {
            point_jacobian(&tree, &states[next()], &links, last, V3::ZERO, &mut columns);
            black_box(&columns);
        });
    });
    group.finish();
}

fn bodies_of(rows: &[Row]) -> [(&'static str, Body); 2] {
    [
        ("whole", bodies::composite(rows, Root::Quaternion, |_| true)),
        ("upper", bodies::composite(rows, Root::Base, bodies::is_upper)),
    ]
}

fn dynamics(criterion: &mut Criterion) {
    for (rows, name) in [(&bodies::CANONICAL, "canonical"), (&bodies::PEERS, "peers")] {
        for (part, body) in bodies_of(rows) {
            calls::<f64>(criterion, &format!("{name}/{part}"), &body);
            #[cfg(feature = "lanes")]
            calls::<wide::f64x4>(criterion, &format!("{name}/{part}/x4"), &body);
            #[cfg(feature = "lanes")]
            calls::<wide::f64x8>(criterion, &format!("{name}/{part}/x8"), &body);
        }
        calls::<f64>(criterion, &format!("{name}/whole/hinges"), &bodies::chain(rows));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(std::time::Duration::from_millis(200))
        .measurement_time(std::time::Duration::from_millis(600))
        .sample_size(20)
        .without_plots();
    targets = dynamics
}
criterion_main!(benches);
