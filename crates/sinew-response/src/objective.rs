//! The optimisation of one frame (section 4.2).
//!
//! The unknown is y, by how much the deviation from the input grows in this step (24 rotations, \[rad\]); the next pose is the
//! input's next pose turned by deviation plus y. The torque is affine in it, u = A y + u₀ with A = M / dt², so every
//! objective is a linear least-squares row:
//!
//! | row | objective |
//! |---|---|
//! | w1 (δ + y) | EQ3: follow the input |
//! | w2 (y - c) / dt | EQ4: damp velocity; c is the step that undamped joints would make |
//! | w3 / dt · Ěᵀ(A y + u₀ − u₋) | EQ5: for a while after a push muscles hold their torque |
//! | wc Êᵀ(A y + u₀ − ū + K(δ + y) + D y / dt) | EQ2: dynamics in the near-unactuated coordinates |
//! | w (j y − t) | further objectives of this step, see [`Row`] |
//!
//! Tracking and damping weigh each coordinate by itself, a diagonal B. The k rows of EQ2, Rᵀy + v, are few, so they are
//! met by k multipliers (the Woodbury identity):
//!
//! (Rᵀ B⁻¹ R + 1/wc²) λ = Rᵀ B⁻¹ g + v,   y = B⁻¹ (g − R λ),
//!
//! of which a hard constraint is the case 1/wc² = 0. Only the reflex and further rows couple the coordinates in B; then
//! B = L D Lᵀ, and L⁻¹R takes the place of R.

use crate::solve::{Factor, dot, part};
use sinew_body::dynamics::{Real, Tree};
use sinew_body::humanoid::UPPER_DOFS;
use std::ops::Range;

const N: usize = UPPER_DOFS;

/// One number per coordinate.
pub(crate) type Vector<S> = [S; N];

/// Row by row.
pub(crate) type Matrix<S> = [[S; N]; N];

/// Weight that holds a coordinate at its limit \[1/rad\]: far above every other row, far below what costs digits.
const HOLD: f64 = 1e6;

/// Parameters of the objectives.
#[derive(Clone, Debug)]
pub struct Weighing<S: Real> {
    /// Time step \[s\].
    pub time_step_secs: f64,
    /// w1 \[1/rad\].
    pub track: S,
    /// w2 \[s/rad\].
    pub damp: [S; N],
    /// wc \[1/(N m)\]; infinite for a hard constraint.
    pub dynamics: S,
    /// K \[N m/rad\].
    pub stiffness: [S; N],
    /// D \[N m s/rad\].
    pub damping: [S; N],
}

/// The objectives of one body and basis: the part that is constant over frames.
#[derive(Clone, Debug)]
pub struct Objective<S: Real> {
    k: usize,
    /// Ê: per coordinate its components in the k directions, side by side; zero beyond.
    directions: Matrix<S>,
    /// (K + D / dt) Ê, laid out as `directions`.
    passive: Matrix<S>,
    stiffness: Vector<S>,
    /// w1².
    track: S,
    /// (w2 / dt)².
    damp: Vector<S>,
    /// 1 / B without reflex and holds.
    inverse: Vector<S>,
    /// 1 / wc².
    softness: S,
    time_step_secs: f64,
    coupled: [Coupled; N],
}

/// One frame's quantities.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a, S: Real> {
    /// M \[kg m²\].
    pub mass: &'a [[S; N]; N],
    /// δ: deviation from the input now \[rad\].
    pub deviation: &'a [S; N],
    /// c: the step to which damping draws \[rad\]. Zero damps the deviation's velocity; the input's step taken back damps the
    /// joint's own, as printed; a part of the last step lets it swing.
    pub coast: &'a [S; N],
    /// u₀ \[N m\].
    pub torque: &'a [S; N],
    /// Target torque of the constraint: ū, or zero \[N m\].
    pub aim: &'a [S; N],
    /// u₋, torque of the frame before \[N m\], and w3 now \[s/(N m)\]; while a reflex is pending.
    pub reflex: Option<(&'a [S; N], S)>,
    /// How firmly coordinates are held, and their step \[rad\]: 1 for those of joints that have reached their limit, less for
    /// those that are only drawn to it (times 1e6 it is a weight \[1/rad\], squared), 0 for none.
    pub held: Option<(&'a [S; N], &'a [S; N])>,
    /// Further objectives.
    pub rows: &'a [Row<S>],
}

/// One more objective, ‖weight (direction · y − wanted)‖².
#[derive(Clone, Copy, Debug)]
pub struct Row<S: Real> {
    /// Direction along which the step is measured, in any unit per radian.
    pub direction: [S; N],
    /// The wanted step, in that unit.
    pub wanted: S,
    /// Per that unit.
    pub weight: S,
}

/// The columns in which a row of the mass matrix is not zero: the first ones, and a run further on.
#[derive(Clone, Debug, Default)]
struct Coupled {
    first: usize,
    run: Range<usize>,
}

impl<S: Real> Objective<S> {
    /// For the tree's 24 coordinates; `directions` are the rows of Ê, at most 24.
    ///
    /// # Panics
    /// If the tree has not 24 coordinates.
    pub fn new(tree: &Tree<S>, directions: &[[S; N]], weights: &Weighing<S>) -> Objective<S> {
        assert_eq!(tree.dofs(), N, "the upper body's coordinates");
        let k = directions.len().min(N);
        let per_dt = S::splat(1.0 / weights.time_step_secs);
        let mut transposed = [[S::ZERO; N]; N];
        let mut passive = transposed;
        for (m, direction) in directions.iter().take(k).enumerate() {
            for i in 0..N {
                transposed[i][m] = direction[i];
                passive[i][m] = (weights.stiffness[i] + weights.damping[i] * per_dt) * direction[i];
            }
        }
        let track = weights.track * weights.track;
        let damp = weights.damp.map(|damp| (damp * per_dt) * (damp * per_dt));
        Objective {
            k,
            directions: transposed,
            passive,
            stiffness: weights.stiffness,
            track,
            damp,
            inverse: damp.map(|damp| (track + damp).recip()),
            softness: (weights.dynamics * weights.dynamics).recip(),
            time_step_secs: weights.time_step_secs,
            coupled: coupled(tree),
        }
    }

    /// The step y \[rad\] that minimises the objectives. Exactly zero if no objective requires a step.
    pub fn solve(&self, frame: &Frame<S>) -> [S; N] {
        // The number of rows is known to the compiler, so that a row of R stays in registers.
        match self.k.div_ceil(2) {
            0 => self.solve_with::<0>(frame),
            1 => self.solve_with::<2>(frame),
            2 => self.solve_with::<4>(frame),
            3 => self.solve_with::<6>(frame),
            4 => self.solve_with::<8>(frame),
            5 => self.solve_with::<10>(frame),
            6 => self.solve_with::<12>(frame),
            7 => self.solve_with::<14>(frame),
            8 => self.solve_with::<16>(frame),
            9 => self.solve_with::<18>(frame),
            10 => self.solve_with::<20>(frame),
            11 => self.solve_with::<22>(frame),
            _ => self.solve_with::<24>(frame),
        }
    }

    /// The torque after a step, u₀ + A y \[N m\].
    pub fn torque_after(&self, frame: &Frame<S>, step: &[S; N]) -> [S; N] {
        let moved = self.times_mass(frame.mass, step);
        let per_square = self.per_square();
        std::array::from_fn(|i| frame.torque[i] + moved[i] * per_square)
    }

    /// Residual of the dynamic constraint after a step, by direction \[N m\]; `torque` is [`Self::torque_after`].
    pub fn left(&self, frame: &Frame<S>, step: &[S; N], torque: &[S; N]) -> [S; N] {
        let mut left = [S::ZERO; N];
        for i in 0..N {
            let active = torque[i] - frame.aim[i] + self.stiffness[i] * frame.deviation[i];
            for ((left, &direction), &passive) in left.iter_mut().zip(&self.directions[i]).zip(&self.passive[i]) {
                *left += direction * active + passive * step[i];
            }
        }
        left
    }

    #[inline(always)]
    fn solve_with<const K: usize>(&self, frame: &Frame<S>) -> Vector<S> {
        let mut right = self.tracking(frame);
        let (rows, value) = self.constraint::<K>(frame);
        if frame.reflex.is_some() || !frame.rows.is_empty() {
            return self.solve_coupled(frame, rows, value, right);
        }
        let mut inverse = self.inverse;
        if let Some((held, step)) = frame.held {
            for i in 0..N {
                let hold = held[i] * S::splat(HOLD * HOLD);
                right[i] += hold * step[i];
                inverse[i] = (self.track + self.damp[i] + hold).recip();
            }
        }
        eliminate(&rows, value, &right, &inverse, self.softness)
    }

    /// B with the reflex's rows and further ones.
    #[inline(never)]
    fn solve_coupled<const K: usize>(
        &self,
        frame: &Frame<S>,
        mut rows: [[S; K]; N],
        value: [S; K],
        mut right: Vector<S>,
    ) -> Vector<S> {
        let mut matrix = [[S::ZERO; N]; N];
        if let Some((torque_before, weight)) = frame.reflex {
            self.add_reflex(frame, torque_before, weight, &rows, &mut matrix, &mut right);
        }
        for row in frame.rows {
            let weight = row.weight * row.weight;
            for i in 0..N {
                let factor = row.direction[i] * weight;
                right[i] += factor * row.wanted;
                for (entry, &other) in matrix[i][i..].iter_mut().zip(&row.direction[i..]) {
                    *entry += factor * other;
                }
            }
        }
        for i in 0..N {
            matrix[i][i] += self.track + self.damp[i];
        }
        if let Some((held, step)) = frame.held {
            for i in 0..N {
                let hold = held[i] * S::splat(HOLD * HOLD);
                matrix[i][i] += hold;
                right[i] += hold * step[i];
            }
        }
        let factor = Factor::of(&matrix);
        factor.forward(&mut rows);
        factor.forward_one(&mut right);
        let mut step = eliminate(&rows, value, &right, factor.inverse(), self.softness);
        factor.backward_one(&mut step);
        step
    }

    /// The reflex's rows, Ě Ěᵀ = I − Ê Êᵀ.
    #[inline(always)]
    fn add_reflex<const K: usize>(
        &self,
        frame: &Frame<S>,
        torque_before: &Vector<S>,
        weight: S,
        rows: &[[S; K]; N],
        matrix: &mut Matrix<S>,
        right: &mut Vector<S>,
    ) {
        let per_square = self.per_square();
        let weight = weight * S::splat(1.0 / self.time_step_secs);
        let weight = weight * weight;
        // Ěᵀ of the torque's change.
        let mut change: Vector<S> = std::array::from_fn(|i| frame.torque[i] - torque_before[i]);
        let mut along = [S::ZERO; K];
        for (&change, directions) in change.iter().zip(&self.directions) {
            for (along, &direction) in along.iter_mut().zip(directions) {
                *along += direction * change;
            }
        }
        for (change, directions) in change.iter_mut().zip(&self.directions) {
            for (&along, &direction) in along.iter().zip(directions) {
                *change -= direction * along;
            }
        }
        let pull = self.times_mass(frame.mass, &change);
        for (right, &pull) in right.iter_mut().zip(&pull) {
            *right -= pull * (weight * per_square);
        }
        // A Ê, by direction.
        let mut along = [[S::ZERO; N]; K];
        for i in 0..N {
            for (m, along) in along.iter_mut().enumerate() {
                along[i] = rows[i][m] - self.passive[i][m];
            }
        }
        self.square::<K, 0, 8, 24>(frame.mass, &along, weight, matrix);
        self.square::<K, 8, 16, 16>(frame.mass, &along, weight, matrix);
        self.square::<K, 16, 24, 8>(frame.mass, &along, weight, matrix);
    }

    /// Rows `FROM` to `TO` of w² A (I − Ê Êᵀ) A, of each the `LENGTH` entries from `FROM` on: the matrix is symmetric.
    #[inline(always)]
    fn square<const K: usize, const FROM: usize, const TO: usize, const LENGTH: usize>(
        &self,
        mass: &Matrix<S>,
        along: &[[S; N]; K],
        weight: S,
        matrix: &mut Matrix<S>,
    ) {
        let per_square = self.per_square();
        let (outer, inner) = (weight, weight * per_square * per_square);
        for i in FROM..TO {
            let mut sums = [S::ZERO; LENGTH];
            for j in self.coupled[i].columns() {
                let factor = mass[i][j] * inner;
                for (sum, &other) in sums.iter_mut().zip(&part::<S, N, LENGTH>(&mass[j], FROM)) {
                    *sum += other * factor;
                }
            }
            for along in along {
                let factor = along[i] * outer;
                for (sum, &other) in sums.iter_mut().zip(&part::<S, N, LENGTH>(along, FROM)) {
                    *sum -= other * factor;
                }
            }
            for (entry, &sum) in matrix[i][FROM..].iter_mut().zip(&sums) {
                *entry = sum;
            }
        }
    }

    /// g of tracking and damping.
    #[inline(always)]
    fn tracking(&self, frame: &Frame<S>) -> Vector<S> {
        std::array::from_fn(|i| self.damp[i] * frame.coast[i] - self.track * frame.deviation[i])
    }

    /// R and v: the residual of the constraint is Rᵀ y + v \[N m\].
    #[inline(always)]
    fn constraint<const K: usize>(&self, frame: &Frame<S>) -> ([[S; K]; N], [S; K]) {
        let per_square = self.per_square();
        let mut rows = [[S::ZERO; K]; N];
        let mut value = [S::ZERO; K];
        for (i, row) in rows.iter_mut().enumerate() {
            let mass = &frame.mass[i];
            let mut sums = [S::ZERO; K];
            for j in self.coupled[i].columns() {
                for (sum, &direction) in sums.iter_mut().zip(&self.directions[j]) {
                    *sum += direction * mass[j];
                }
            }
            for ((row, &sum), &passive) in row.iter_mut().zip(&sums).zip(&self.passive[i]) {
                *row = sum * per_square + passive;
            }
            let active = frame.torque[i] - frame.aim[i] + self.stiffness[i] * frame.deviation[i];
            for (value, &direction) in value.iter_mut().zip(&self.directions[i]) {
                *value += direction * active;
            }
        }
        (rows, value)
    }

    /// M times a vector.
    #[inline(always)]
    fn times_mass(&self, mass: &Matrix<S>, vector: &Vector<S>) -> Vector<S> {
        std::array::from_fn(|i| dot(&mass[i], vector))
    }

    fn per_square(&self) -> S {
        S::splat(1.0 / (self.time_step_secs * self.time_step_secs))
    }
}

/// The multipliers' system, and from it B⁻¹ (g − R λ); `inverse` is the diagonal B⁻¹.
#[inline(always)]
fn eliminate<S: Real, const K: usize>(
    rows: &[[S; K]; N],
    value: [S; K],
    right: &Vector<S>,
    inverse: &Vector<S>,
    softness: S,
) -> Vector<S> {
    let free: Vector<S> = std::array::from_fn(|i| right[i] * inverse[i]);
    let weighed: [[S; K]; N] = std::array::from_fn(|i| rows[i].map(|value| value * inverse[i]));
    let mut multipliers = value;
    for (row, &free) in rows.iter().zip(&free) {
        for (multiplier, &value) in multipliers.iter_mut().zip(row) {
            *multiplier += value * free;
        }
    }
    let mut schur = [[S::ZERO; K]; K];
    for (a, schur) in schur.iter_mut().enumerate() {
        let mut sums = [S::ZERO; K];
        for (row, weighed) in rows.iter().zip(&weighed) {
            for (sum, &value) in sums.iter_mut().zip(row) {
                *sum += value * weighed[a];
            }
        }
        sums[a] += softness;
        *schur = sums;
    }
    Factor::of(&schur).solve(&mut multipliers);
    std::array::from_fn(|i| free[i] - dot(&weighed[i], &multipliers))
}

impl Coupled {
    #[inline(always)]
    fn columns(&self) -> impl Iterator<Item = usize> {
        (0..self.first).chain(self.run.clone())
    }
}

/// The mass matrix couples two degrees of freedom if one lies on the other's path to the base.
fn coupled<S: Real>(tree: &Tree<S>) -> [Coupled; N] {
    let meets = |i: usize, j: usize| i == j || tree.ancestors(i.max(j)).any(|above| above == i.min(j));
    std::array::from_fn(|i| {
        let first = (0..N).take_while(|&j| meets(i, j)).count();
        let from = (first..N).find(|&j| meets(i, j)).unwrap_or(N);
        let to = (from..N).rev().find(|&j| meets(i, j)).map_or(from, |last| last + 1);
        Coupled { first, run: from..to }
    })
}
