//! Time of one response step, per call and as characters per core at 60 Hz.
//!
//! The bare step is what the peers' programs time: inverse dynamics and mass matrix from coordinates, then the
//! optimisation of the 24 coordinates with k = 10, for given weights and torque reference; no limits, hips or feet.
//! `bare/peers/hard` is their problem on their body: the constraint hard, no reflex. `robust` is ours, a penalty with
//! passive springs. The full step is [`Response::step`] on a walking body.
//!
//! Build both sides for the machine: `RUSTFLAGS="-C target-cpu=native" cargo bench -p sinew-response`.

#[path = "../../sinew-body/tests/all/dynamics_common/mod.rs"]
mod dynamics_common;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use dynamics_common::bodies::{self, Body as DynamicBody, Root};
use dynamics_common::random::Random;
use glam::{DMat3, DVec3};
use sinew_body::dynamics::{Base, Coordinates, Inverse, Joint, M3, Real, State, Tree, V3, Workspace, inverse};
use sinew_body::humanoid::{Body, Node, Pose, UPPER_DOFS, exp};
use sinew_response::bench::{Frame, Objective, Weighing};
use sinew_response::{Basis, PointForce, Response, Settings};

const STATES: usize = 64;
const K: usize = 10;
const DT: f64 = 1.0 / 60.0;

/// Which objectives.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// The constraint hard, damping absolute: the peers' problem.
    Hard,
    /// A penalty, passive springs.
    Robust,
    /// The same with a reflex pending.
    Reflex,
}

type Numbers<S> = [S; UPPER_DOFS];

/// A character with random inputs.
struct Case<S: Real> {
    tree: Tree<S>,
    coordinates: Coordinates<S>,
    base: Base<S>,
    objective: Objective<S>,
    q: Vec<Numbers<S>>,
    rate: Vec<Numbers<S>>,
    deviation: Vec<Numbers<S>>,
    coast: Vec<Numbers<S>>,
    aim: Vec<Numbers<S>>,
}

impl<S: Real> Case<S> {
    fn new((tree, coordinates): &DynamicBody, kind: Kind) -> Case<S> {
        let mut random = Random::new(1);
        let joint = |joint: &Joint<f64>| match joint {
            Joint::Turns(letters) => Joint::Turns(letters.clone()),
            other => panic!("the upper body has no {other:?}"),
        };
        let joints = coordinates.joints().iter().map(joint).collect();
        let tree = Tree::side_by_side(&[tree]).expect("a tree");
        let coordinates = Coordinates::new(&tree, joints).expect("joints");
        let mut base = Base::at_rest(V3::splat(DVec3::new(0.0, -9.81, 0.0)));
        base.rotation = M3::splat(DMat3::from_quat(random.rotation()));
        base.angular_velocity = V3::splat(random.vector(2.0));
        base.angular_acceleration = V3::splat(random.vector(10.0));
        base.acceleration = V3::splat(random.vector(10.0));
        let passive = if kind == Kind::Hard { 0.0 } else { 8.0 };
        let weighing = Weighing {
            time_step_secs: DT,
            track: S::splat(200.0),
            damp: std::array::from_fn(|dof| S::splat(if dof < 3 { 30.0 } else { 10.0 })),
            dynamics: S::splat(if kind == Kind::Hard { f64::INFINITY } else { 6.7 }),
            stiffness: [S::splat(passive * passive * 0.1); UPPER_DOFS],
            damping: [S::splat(2.0 * passive * 0.1); UPPER_DOFS],
        };
        let objective = Objective::new(&tree, &directions(&mut random), &weighing);
        let mut several = |scale: f64| -> Vec<Numbers<S>> {
            (0..STATES).map(|_| std::array::from_fn(|_| S::from_lanes(|_| random.next() * scale))).collect()
        };
        let (q, rate) = (several(0.8), several(2.0));
        let (deviation, coast, aim) = (several(0.05), several(0.03), several(20.0));
        Case { tree, coordinates, base, objective, q, rate, deviation, coast, aim }
    }

    fn frame<'a>(&'a self, i: usize, out: &'a Inverse<S>, kind: Kind) -> Frame<'a, S> {
        Frame {
            mass: out.mass.as_slice().as_chunks().0.first_chunk().expect("24 rows"),
            deviation: &self.deviation[i],
            coast: &self.coast[i],
            torque: out.tau.first_chunk().expect("24 torques"),
            aim: &self.aim[i],
            reflex: (kind == Kind::Reflex).then_some((&self.aim[i], S::splat(1.0 / 30.0))),
            held: None,
            rows: &[],
        }
    }
}

/// Orthonormal rows (Gram, Schmidt).
fn directions<S: Real>(random: &mut Random) -> Vec<Numbers<S>> {
    let mut rows: Vec<nalgebra::SVector<f64, UPPER_DOFS>> = Vec::new();
    while rows.len() < K {
        let mut row = nalgebra::SVector::from_fn(|_, _| random.next());
        for other in &rows {
            row -= *other * other.dot(&row);
        }
        if row.norm() > 0.1 {
            rows.push(row.normalize());
        }
    }
    rows.iter().map(|row| std::array::from_fn(|dof| S::splat(row[dof]))).collect()
}

fn bare<S: Real>(criterion: &mut Criterion, name: &str, body: &DynamicBody, kind: Kind) {
    let case = Case::<S>::new(body, kind);
    let mut workspace = Workspace::new(&case.tree);
    let mut out = Inverse::new(&case.tree);
    let mut state = State::at_rest(&case.tree);
    let dynamics = |i: usize, state: &mut State<S>, workspace: &mut Workspace<S>, out: &mut Inverse<S>| {
        case.coordinates.set(&case.tree, &case.q[i], &case.rate[i], state);
        inverse(&case.tree, &case.base, state, &[], workspace, out);
    };
    dynamics(0, &mut state, &mut workspace, &mut out);
    let mut i = 0;
    let mut next = || {
        i = (i + 1) % STATES;
        i
    };
    timed(criterion, name, S::LANES, || {
        let i = next();
        dynamics(i, &mut state, &mut workspace, &mut out);
        black_box(case.objective.solve(&case.frame(i, &out, kind)));
    });
    timed(criterion, &format!("{name}: optimisation"), S::LANES, || {
        black_box(case.objective.solve(&case.frame(next(), &out, kind)));
    });
    // What was timed is right: a hard constraint is met.
    if kind == Kind::Hard {
        dynamics(7, &mut state, &mut workspace, &mut out);
        let frame = case.frame(7, &out, kind);
        let y = case.objective.solve(&frame);
        let left = case.objective.left(&frame, &y, &case.objective.torque_after(&frame, &y));
        let worst = left.iter().flat_map(|left| (0..S::LANES).map(|lane| left.lane(lane).abs())).fold(0.0, f64::max);
        assert!(worst < 1e-9, "{name}: {worst} N m are left");
    }
}

/// One criterion benchmark, and the figures as the peers' programs find them: the median of 61 batches of 0.15 ms, which
/// a busy machine disturbs least.
fn timed(criterion: &mut Criterion, name: &str, characters: usize, mut call: impl FnMut()) {
    let mut ran = false;
    criterion.bench_function(name, |bencher| {
        ran = true;
        bencher.iter(&mut call);
    });
    if !ran {
        return;
    }
    let mut batch = |calls: u32| {
        let start = Instant::now();
        for _ in 0..calls {
            call();
        }
        start.elapsed().as_secs_f64() / f64::from(calls)
    };
    let once = (0..20).map(|_| batch(10)).fold(f64::INFINITY, f64::min);
    let calls = (150e-6 / once).ceil().clamp(1.0, 1e6) as u32;
    let mut batches: Vec<f64> = (0..61).map(|_| batch(calls)).collect();
    batches.sort_by(f64::total_cmp);
    let (median, least) = (batches[30] * 1e9, batches[0] * 1e9);
    let per = median / characters as f64;
    println!(
        "{name}: {median:.0} ns per call (least {least:.0}), {per:.0} ns per character, {:.0} characters per core at 60 Hz",
        1e9 / (60.0 * per)
    );
}

fn bare_steps(criterion: &mut Criterion) {
    let upper = |rows| bodies::composite(rows, Root::Base, bodies::is_upper);
    let (peers, canonical) = (upper(&bodies::PEERS), upper(&bodies::CANONICAL));
    bare::<f64>(criterion, "bare/peers/hard", &peers, Kind::Hard);
    bare::<f64>(criterion, "bare/peers/robust", &peers, Kind::Robust);
    bare::<f64>(criterion, "bare/peers/robust, reflex on", &peers, Kind::Reflex);
    bare::<f64>(criterion, "bare/canonical/hard", &canonical, Kind::Hard);
    bare::<f64>(criterion, "bare/canonical/robust", &canonical, Kind::Robust);
    bare::<f64>(criterion, "bare/canonical/robust, reflex on", &canonical, Kind::Reflex);
    bare::<wide::f64x8>(criterion, "bare/peers/hard, eight in a register", &peers, Kind::Hard);
    bare::<wide::f64x8>(criterion, "bare/peers/robust, eight in a register", &peers, Kind::Robust);
    bare::<wide::f64x8>(criterion, "bare/peers/robust, reflex on, eight in a register", &peers, Kind::Reflex);
}

/// Something like a walk: every joint swings at a stride a second.
fn walk() -> Vec<Pose> {
    (0..60)
        .map(|frame| {
            let phase = f64::from(frame) / 60.0 * std::f64::consts::TAU;
            let locals = Node::ALL.map(|node| {
                let lag = node.index() as f64;
                let swing = if node == Node::Hips { 0.05 } else { 0.25 };
                let (a, b) = (libm::sin(phase + lag), libm::sin(phase + 2.0 * lag));
                exp(DVec3::new(swing * a, 0.1 * swing * b, 0.2 * swing * a))
            });
            Pose::from_locals(DVec3::new(0.0, 0.9 + 0.02 * libm::sin(2.0 * phase), 0.0), &locals)
        })
        .collect()
}

fn full_steps(criterion: &mut Criterion) {
    let body = Body::standard(80.0, 1.7);
    let walk = walk();
    let settings = Settings::default();
    let basis = Basis::of_motion(&body, &walk, &settings).expect("a walk");
    let mut response = Response::new(body, basis, settings, &walk[0]);
    let push = PointForce::at_centre(Node::LeftHand, DVec3::new(20.0, 0.0, -100.0));
    let mut frame = 0;
    // A second of it every two: between pushes the reflex fades and the body comes back.
    let mut step = |period: usize, pushed: usize| {
        frame += 1;
        let forces = if frame % period < pushed { &[push][..] } else { &[] };
        black_box(response.step(&walk[frame % walk.len()], forces));
    };
    timed(criterion, "full/undisturbed", 1, || step(1, 0));
    timed(criterion, "full/pushed for 0.1 s every 2 s", 1, || step(120, 6));
    timed(criterion, "full/pushed all the time", 1, || step(1, 1));
    timed(criterion, "full/reflex all the time: pushed for 0.1 s every 0.2 s", 1, || step(12, 6));
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .sample_size(20)
        .without_plots();
    targets = bare_steps, full_steps
}
criterion_main!(benches);
