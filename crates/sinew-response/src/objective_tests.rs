//! The step against the dense least-squares problem as the table in [`crate::objective`] states it, solved by a library.

use crate::objective::{Frame, Matrix, Objective, Row, Vector, Weighing};
use crate::upper_body::{JointMotion, UpperBody, locals};
use glam::DVec3;
use nalgebra::{DMatrix, DVector};
use sinew_body::STANDARD_GRAVITY_M_S2;
use sinew_body::humanoid::{Body, Node, Pose, UPPER_DOFS as N, exp};

/// The data that a frame borrows.
struct Case {
    mass: Matrix<f64>,
    directions: Vec<Vector<f64>>,
    weighing: Weighing<f64>,
    upper: UpperBody,
    deviation: Vector<f64>,
    coast: Vector<f64>,
    torque: Vector<f64>,
    aim: Vector<f64>,
    torque_before: Vector<f64>,
    held: Vector<f64>,
    stops: Vector<f64>,
    rows: Vec<Row<f64>>,
    reflex: f64,
    holds: bool,
}

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

impl Case {
    fn new(seed: u64, k: usize, dynamics: f64, reflex: f64, holds: bool) -> Case {
        let seed = &mut seed.wrapping_add(77);
        let body = Body::standard(80.0, 1.7);
        let mut upper = UpperBody::of(&body, STANDARD_GRAVITY_M_S2);
        let turns: Vec<DVec3> = (0..18).map(|_| DVec3::new(random(seed), random(seed), random(seed))).collect();
        let pose = Pose::from_locals(DVec3::ZERO, &Node::ALL.map(|node| exp(turns[node.index()])));
        let still = [DVec3::ZERO; 12];
        let hips = crate::upper_body::HipsMotion {
            rotation: pose.world[0],
            angular_velocity: DVec3::ZERO,
            angular_acceleration: DVec3::ZERO,
            acceleration: DVec3::ZERO,
        };
        upper.inverse(&hips, JointMotion { local: &locals(&pose), rate: &still, change: &still });
        let square = DMatrix::from_fn(N, N, |_, _| random(seed));
        let orthonormal = square.qr().q();
        let mut vector = |scale: f64| -> Vector<f64> { std::array::from_fn(|_| scale * random(seed)) };
        let passive = vector(3.0).map(f64::abs);
        Case {
            mass: *upper.found_mass(),
            directions: (0..k).map(|m| std::array::from_fn(|i| orthonormal[(i, m)])).collect(),
            weighing: Weighing {
                time_step_secs: 1.0 / 60.0,
                track: 200.0,
                damp: std::array::from_fn(|i| if i < 3 { 30.0 } else { 10.0 }),
                dynamics,
                stiffness: passive.map(|passive| 8.0 * passive),
                damping: passive,
            },
            upper,
            deviation: vector(0.3),
            coast: vector(0.05),
            torque: vector(60.0),
            aim: vector(60.0),
            torque_before: vector(60.0),
            held: vector(1.0).map(|value| f64::from(holds && value > 0.6)),
            rows: Vec::new(),
            stops: vector(0.02),
            reflex,
            holds,
        }
    }

    fn frame(&self) -> Frame<'_, f64> {
        Frame {
            mass: &self.mass,
            deviation: &self.deviation,
            coast: &self.coast,
            torque: &self.torque,
            aim: &self.aim,
            reflex: (self.reflex > 0.0).then_some((&self.torque_before, self.reflex)),
            held: self.holds.then_some((&self.held, &self.stops)),
            rows: &self.rows,
        }
    }

    fn objective(&self) -> Objective<f64> {
        Objective::new(self.upper.tree(), &self.directions, &self.weighing)
    }

    /// By stacking every row of the table, and for a hard constraint by the whole saddle-point matrix.
    fn oracle(&self) -> Vec<f64> {
        let (w, dt) = (&self.weighing, self.weighing.time_step_secs);
        let a = DMatrix::from_fn(N, N, |i, j| self.mass[i][j] / (dt * dt));
        let column = |vector: &Vector<f64>| DVector::from_column_slice(vector);
        let e = DMatrix::from_fn(self.directions.len(), N, |m, i| self.directions[m][i]);
        let mut hessian = DMatrix::zeros(N, N);
        let mut right = DVector::zeros(N);
        for i in 0..N {
            let damp = w.damp[i] / dt;
            let damp = damp * damp;
            let hold = if self.holds { 1e12 * self.held[i] } else { 0.0 };
            hessian[(i, i)] += w.track * w.track + damp + hold;
            right[i] -= w.track * w.track * self.deviation[i];
            right[i] += hold * self.stops[i];
            right[i] += damp * self.coast[i];
        }
        let others = DMatrix::identity(N, N) - e.transpose() * &e;
        let weight = self.reflex / dt;
        let weight = weight * weight;
        hessian += &a * &others * &a * weight;
        right -= &a * &others * (column(&self.torque) - column(&self.torque_before)) * weight;
        let per_angle = DMatrix::from_diagonal(&DVector::from_fn(N, |i, _| w.stiffness[i] + w.damping[i] / dt));
        let rows = &e * (&a + per_angle);
        let springs = column(&w.stiffness).component_mul(&column(&self.deviation));
        let value = &e * (column(&self.torque) - column(&self.aim) + springs);
        for row in &self.rows {
            let direction = column(&row.direction) * row.weight;
            hessian += &direction * direction.transpose();
            right += direction * (row.weight * row.wanted);
        }
        if w.dynamics.is_finite() {
            let weight = w.dynamics * w.dynamics;
            hessian += rows.transpose() * &rows * weight;
            right -= rows.transpose() * &value * weight;
            let solved = hessian.cholesky().expect("positive definite").solve(&right);
            return solved.iter().copied().collect();
        }
        let k = self.directions.len();
        let mut saddle = DMatrix::zeros(N + k, N + k);
        saddle.view_mut((0, 0), (N, N)).copy_from(&hessian);
        saddle.view_mut((N, 0), (k, N)).copy_from(&rows);
        saddle.view_mut((0, N), (N, k)).copy_from(&rows.transpose());
        let mut both = DVector::zeros(N + k);
        both.rows_mut(0, N).copy_from(&right);
        both.rows_mut(N, k).copy_from(&-value);
        let solved = saddle.full_piv_lu().solve(&both).expect("regular");
        solved.iter().take(N).copied().collect()
    }
}

#[test]
fn every_route_to_the_step_agrees_with_the_dense_problem() {
    for k in [0, 1, 2, 5, 10, 13, 24] {
        for (dynamics, reflex, holds) in [
            (6.7, 0.0, false),
            (6.7, 0.0, true),
            (6.7, 1.0 / 30.0, false),
            (6.7, 1.0 / 30.0, true),
            (6.7, 1e-4, false),
            (4.0, 0.01, false),
            (f64::INFINITY, 0.0, false),
            (f64::INFINITY, 1.0 / 30.0, false),
        ] {
            let case = Case::new(k as u64, k, dynamics, reflex, holds);
            let step = case.objective().solve(&case.frame());
            let worst = step.iter().zip(case.oracle()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Steps are up to a radian or so; the dense matrix has a condition number up to 1e6 (1e9 with holds).
            let tolerance = if holds { 1e-7 } else { 1e-9 };
            assert!(worst < tolerance, "k {k}, wc {dynamics}, w3 {reflex}, held {holds}: {worst} rad");
        }
    }
}

#[test]
fn further_rows_are_met_as_in_the_dense_problem() {
    for (dynamics, reflex, holds) in
        [(6.7, 0.0, false), (6.7, 0.0, true), (6.7, 1.0 / 30.0, false), (f64::INFINITY, 1.0 / 30.0, false)]
    {
        let mut case = Case::new(11, 10, dynamics, reflex, holds);
        for at in 0..3 {
            let direction = std::array::from_fn(|i| if i % 3 == at { case.deviation[i] } else { 0.0 });
            case.rows.push(Row { direction, wanted: 0.1 * at as f64 - 0.05, weight: 2000.0 });
        }
        let step = case.objective().solve(&case.frame());
        let worst = step.iter().zip(case.oracle()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // As above.
        let tolerance = if holds { 1e-7 } else { 1e-9 };
        assert!(worst < tolerance, "wc {dynamics}, w3 {reflex}, held {holds}: {worst} rad");
    }
}

#[test]
fn nothing_asked_gives_exactly_no_step() {
    for (dynamics, reflex) in [(6.7, 0.0), (6.7, 0.03), (f64::INFINITY, 0.0), (f64::INFINITY, 0.03)] {
        let mut case = Case::new(3, 10, dynamics, reflex, false);
        case.deviation = [0.0; N];
        case.coast = [0.0; N];
        case.aim = case.torque;
        case.torque_before = case.torque;
        assert_eq!(case.objective().solve(&case.frame()), [0.0; N], "wc {dynamics}, w3 {reflex}");
    }
}

#[test]
fn what_is_left_of_a_hard_constraint_is_nothing_and_of_a_soft_one_is_its_row() {
    let case = Case::new(5, 10, f64::INFINITY, 0.0, false);
    let (objective, frame) = (case.objective(), case.frame());
    let step = objective.solve(&frame);
    let left = objective.left(&frame, &step, &objective.torque_after(&frame, &step));
    // Torques are of the order of 1e2 N m.
    assert!(left.iter().all(|left| left.abs() < 1e-9), "{left:?}");
    let torque = objective.torque_after(&frame, &[0.0; N]);
    assert_eq!(torque, case.torque);
    let left = objective.left(&frame, &[0.0; N], &torque);
    let by_hand: f64 = (0..N)
        .map(|i| {
            case.directions[2][i] * (case.torque[i] - case.aim[i] + case.weighing.stiffness[i] * case.deviation[i])
        })
        .sum();
    assert!((left[2] - by_hand).abs() < 1e-10);
}

#[test]
fn forces_beyond_reason_give_finite_steps() {
    let mut case = Case::new(9, 10, 6.7, 0.03, false);
    for size in [1e20, 1e100, 1e140] {
        case.torque = [size; N];
        let step = case.objective().solve(&case.frame());
        assert!(step.iter().all(|value| value.is_finite()), "{size}: {step:?}");
    }
}
