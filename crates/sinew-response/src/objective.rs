//! The optimisation of one frame (section 4.2).
//!
//! The unknown is y, by how much the deviation from the input grows in this step (24 rotations, \[rad\]); the next pose is the
//! input's next pose turned by deviation plus y. The torque is affine in it, u = A y + u₀ with A = M / dt², so every
//! objective is a linear least-squares row:
//!
//! | row | objective |
//! |---|---|
//! | w1 (δ + y) | EQ3: follow the input |
//! | w2 y / dt | EQ4: damp velocity, relative to the input's |
//! | w3 / dt · Ěᵀ(A y + u₀ − u₋) | EQ5: for a while after a push muscles hold their torque |
//! | wc Êᵀ(A y + u₀ − ū + K(δ + y) + D y / dt) | EQ2: dynamics in the near-unactuated coordinates |

use crate::settings::Weights;
use crate::solve::cholesky_solve;
use crate::upper_body::{Coordinates24, Matrix24};
use sinew_body::humanoid::UPPER_DOFS;

/// What one frame's optimisation is made of.
pub(crate) struct Problem<'a> {
    pub weights: &'a Weights,
    /// Ê, a row each.
    pub dynamic: &'a [Coordinates24],
    pub time_step_secs: f64,
    /// A = M / dt².
    pub torque_per_step: &'a Matrix24,
    /// δ: deviation from the input now \[rad\].
    pub deviation: &'a Coordinates24,
    /// The input's own step, in the coordinates of the deviated joints \[rad\]: what absolute damping acts on.
    pub input_step: &'a Coordinates24,
    /// u₀ \[N m\].
    pub torque: &'a Coordinates24,
    /// The torque that the constraint aims at: ū, or zero.
    pub aim: &'a Coordinates24,
    /// u₋: torque of the frame before.
    pub torque_before: &'a Coordinates24,
    /// w3 now; 0 when no reflex is pending.
    pub reflex: f64,
    /// K \[N m/rad\] and D \[N m s/rad\].
    pub stiffness: &'a Coordinates24,
    pub damping: &'a Coordinates24,
    /// Coordinates held at a given step (joints that have reached their limit), with the step.
    pub held: &'a [Option<f64>; UPPER_DOFS],
}

/// Weight that holds a coordinate at its limit \[1/rad\]: far above every other row, far below what costs digits.
const HOLD: f64 = 1e6;

impl Problem<'_> {
    /// The step y \[rad\] that minimises the objectives.
    pub(crate) fn solve(&self) -> Coordinates24 {
        let mut hessian = [[0.0; UPPER_DOFS]; UPPER_DOFS];
        let mut right = [0.0; UPPER_DOFS];
        self.add_tracking(&mut hessian, &mut right);
        if self.reflex > 0.0 {
            self.add_reflex(&mut hessian, &mut right);
        }
        if self.weights.dynamics.is_finite() {
            self.add_dynamics(&mut hessian, &mut right);
            cholesky_solve(&mut hessian, &mut right, UPPER_DOFS);
            right
        } else {
            self.solve_constrained(&hessian, &right)
        }
    }

    /// What is left of the dynamic constraint after a step \[N m\].
    pub(crate) fn residual(&self, step: &Coordinates24) -> f64 {
        let left = |direction| {
            let (row, value) = self.constraint(direction);
            dot(&row, step) + value
        };
        self.dynamic.iter().map(|direction| left(direction) * left(direction)).sum::<f64>().sqrt()
    }

    fn add_tracking(&self, hessian: &mut Matrix24, right: &mut Coordinates24) {
        let track = self.weights.track * self.weights.track;
        for i in 0..UPPER_DOFS {
            let damp = self.weights.damp[i] / self.time_step_secs;
            let damp = damp * damp;
            hessian[i][i] = track + damp;
            right[i] = -track * self.deviation[i];
            if !self.weights.damps_relative {
                right[i] -= damp * self.input_step[i];
            }
            if let Some(step) = self.held[i] {
                hessian[i][i] += HOLD * HOLD;
                right[i] += HOLD * HOLD * step;
            }
        }
    }

    /// With Ě Ěᵀ = I − Ê Êᵀ.
    fn add_reflex(&self, hessian: &mut Matrix24, right: &mut Coordinates24) {
        let weight = self.reflex / self.time_step_secs;
        let weight = weight * weight;
        let change: Coordinates24 = std::array::from_fn(|i| self.torque[i] - self.torque_before[i]);
        let a = self.torque_per_step;
        for i in 0..UPPER_DOFS {
            for j in 0..=i {
                hessian[i][j] += weight * dot(&a[i], &a[j]);
            }
            right[i] -= weight * dot(&a[i], &change);
        }
        for direction in self.dynamic {
            let row: Coordinates24 = std::array::from_fn(|i| dot(&a[i], direction));
            let value = dot(direction, &change);
            add_row(hessian, right, &row, -weight, value);
        }
    }

    fn add_dynamics(&self, hessian: &mut Matrix24, right: &mut Coordinates24) {
        let weight = self.weights.dynamics * self.weights.dynamics;
        for direction in self.dynamic {
            let (row, value) = self.constraint(direction);
            add_row(hessian, right, &row, weight, value);
        }
    }

    /// The constraint along one direction as `row · y + value` \[N m\].
    fn constraint(&self, direction: &Coordinates24) -> (Coordinates24, f64) {
        let row = std::array::from_fn(|i| {
            dot(&self.torque_per_step[i], direction)
                + (self.stiffness[i] + self.damping[i] / self.time_step_secs) * direction[i]
        });
        let mut value = 0.0;
        for i in 0..UPPER_DOFS {
            value += direction[i] * (self.torque[i] - self.aim[i] + self.stiffness[i] * self.deviation[i]);
        }
        (row, value)
    }

    /// EQ2 as printed, a hard constraint: minimise the rest subject to `row · y + value = 0`, by the Schur complement.
    fn solve_constrained(&self, hessian: &Matrix24, right: &Coordinates24) -> Coordinates24 {
        let k = self.dynamic.len();
        let mut free = *right;
        cholesky_solve(&mut hessian.clone(), &mut free, UPPER_DOFS);
        let mut rows = [[0.0; UPPER_DOFS]; UPPER_DOFS];
        let mut solved = [[0.0; UPPER_DOFS]; UPPER_DOFS];
        let mut multipliers = [0.0; UPPER_DOFS];
        for (index, direction) in self.dynamic.iter().enumerate() {
            let (row, value) = self.constraint(direction);
            rows[index] = row;
            solved[index] = row;
            cholesky_solve(&mut hessian.clone(), &mut solved[index], UPPER_DOFS);
            multipliers[index] = dot(&row, &free) + value;
        }
        let mut schur = [[0.0; UPPER_DOFS]; UPPER_DOFS];
        for i in 0..k {
            for j in 0..k {
                schur[i][j] = dot(&rows[i], &solved[j]);
            }
        }
        cholesky_solve(&mut schur, &mut multipliers, k);
        std::array::from_fn(|i| {
            let correction: f64 = (0..k).map(|index| solved[index][i] * multipliers[index]).sum();
            free[i] - correction
        })
    }
}

fn add_row(hessian: &mut Matrix24, right: &mut Coordinates24, row: &Coordinates24, weight: f64, value: f64) {
    for i in 0..UPPER_DOFS {
        let scaled = weight * row[i];
        for j in 0..=i {
            hessian[i][j] += scaled * row[j];
        }
        right[i] -= scaled * value;
    }
}

pub(crate) fn dot(a: &Coordinates24, b: &Coordinates24) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
