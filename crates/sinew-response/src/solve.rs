//! Small dense symmetric systems of fixed size, without square roots and without allocation.
//!
//! Matrices are laid out so that each inner loop runs over contiguous numbers and nothing depends on the data: the
//! compiler turns the loops into vector instructions, and with lanes for numbers ([`Real`]) several systems are solved
//! side by side.

use sinew_body::dynamics::Real;

/// A pivot is at least this part of the diagonal entry that it came from: one that is not positive (extreme rounding)
/// is raised, so that the result is finite for finite input.
const MIN_PIVOT: f64 = 1e-14;

/// And at least this.
const TINY: f64 = 1e-280;

/// L D Lᵀ of a symmetric positive definite matrix. L is kept twice, so that every loop runs along a row; its diagonal of
/// ones is kept as zeros.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor<S, const N: usize> {
    /// Row j is column j of L.
    columns: [[S; N]; N],
    /// Row i is row i of L.
    rows: [[S; N]; N],
    /// 1 / D.
    inverse: [S; N],
}

impl<S: Real, const N: usize> Factor<S, N> {
    /// Factorises a matrix of which only the entries at and right of the diagonal are read.
    #[inline(always)]
    pub(crate) fn of(matrix: &[[S; N]; N]) -> Factor<S, N> {
        let mut factor = Factor { columns: [[S::ZERO; N]; N], rows: [[S::ZERO; N]; N], inverse: [S::ZERO; N] };
        let mut pivots = [S::ZERO; N];
        if N == 24 {
            // Entries left of the diagonal are skipped by blocks.
            factor.eliminate::<0, 8, 24>(matrix, &mut pivots);
            factor.eliminate::<8, 16, 16>(matrix, &mut pivots);
            factor.eliminate::<16, 24, 8>(matrix, &mut pivots);
        } else {
            factor.eliminate::<0, N, N>(matrix, &mut pivots);
        }
        factor
    }

    /// Columns `FROM` to `TO`, of each the `LENGTH` entries from `FROM` on, which stay in registers while all earlier
    /// columns are taken from them.
    #[inline(always)]
    fn eliminate<const FROM: usize, const TO: usize, const LENGTH: usize>(
        &mut self,
        matrix: &[[S; N]; N],
        pivots: &mut [S; N],
    ) {
        for j in FROM..TO.min(N) {
            let mut column = part::<S, N, LENGTH>(&matrix[j], FROM);
            for m in 0..j {
                let factor = self.rows[j][m] * pivots[m];
                let before = part::<S, N, LENGTH>(&self.columns[m], FROM);
                for (value, &other) in column.iter_mut().zip(&before) {
                    *value -= other * factor;
                }
            }
            let least = (matrix[j][j].abs() * S::splat(MIN_PIVOT)).larger(S::splat(TINY));
            let pivot = column[j - FROM].larger(least);
            let inverse = pivot.recip();
            pivots[j] = pivot;
            self.inverse[j] = inverse;
            for i in j + 1..N {
                let entry = column[i - FROM] * inverse;
                self.columns[j][i] = entry;
                self.rows[i][j] = entry;
            }
        }
    }

    /// 1 / D.
    pub(crate) fn inverse(&self) -> &[S; N] {
        &self.inverse
    }

    /// L⁻¹ times several columns at once, given row by row.
    #[inline(always)]
    pub(crate) fn forward<const K: usize>(&self, right: &mut [[S; K]; N]) {
        for i in 0..N {
            let mut row = right[i];
            for j in 0..i {
                let factor = self.rows[i][j];
                for (value, &known) in row.iter_mut().zip(&right[j]) {
                    *value -= known * factor;
                }
            }
            right[i] = row;
        }
    }

    /// L⁻¹ times a vector.
    #[inline(always)]
    pub(crate) fn forward_one(&self, vector: &mut [S; N]) {
        for (j, column) in self.columns.iter().enumerate() {
            let known = vector[j];
            for (value, &factor) in vector.iter_mut().zip(column) {
                *value -= known * factor;
            }
        }
    }

    /// L⁻ᵀ times a vector.
    #[inline(always)]
    pub(crate) fn backward_one(&self, vector: &mut [S; N]) {
        for (i, row) in self.rows.iter().enumerate().rev() {
            let known = vector[i];
            for (value, &factor) in vector.iter_mut().zip(row) {
                *value -= known * factor;
            }
        }
    }

    /// Solves for one right-hand side, in place.
    #[inline(always)]
    pub(crate) fn solve(&self, right: &mut [S; N]) {
        self.forward_one(right);
        for (value, &inverse) in right.iter_mut().zip(&self.inverse) {
            *value *= inverse;
        }
        self.backward_one(right);
    }
}

/// `LENGTH` entries from `from` on.
#[inline(always)]
pub(crate) fn part<S: Real, const N: usize, const LENGTH: usize>(row: &[S; N], from: usize) -> [S; LENGTH] {
    *row[from..].first_chunk().expect("the blocks lie within the matrix")
}

/// Scalar product, as four sums side by side.
#[inline(always)]
pub(crate) fn dot<S: Real, const N: usize>(a: &[S; N], b: &[S; N]) -> S {
    let mut sums = [S::ZERO; 4];
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    for (a, b) in a.iter().zip(b) {
        for ((sum, &a), &b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    for ((sum, &a), &b) in sums.iter_mut().zip(a_rest).zip(b_rest) {
        *sum += a * b;
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check<const N: usize>() {
        // A matrix of the size and spread of the reflex's: 1 on a Gram matrix of entries up to 100.
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let half = nalgebra::SMatrix::<f64, N, N>::from_fn(|_, _| 10.0 * random());
        let matrix = half * half.transpose() + nalgebra::SMatrix::identity();
        let right = nalgebra::SVector::<f64, N>::from_fn(|_, _| random());
        let theirs = nalgebra::linalg::Cholesky::new(matrix).expect("positive definite").solve(&right);
        let mut ours: [f64; N] = right.into();
        let factor = Factor::of(&std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)])));
        factor.solve(&mut ours);
        for i in 0..N {
            // The condition number is up to 1e5.
            assert!((ours[i] - theirs[i]).abs() < 1e-10, "{N}: {} against {}", ours[i], theirs[i]);
        }
        let mut columns: [[f64; 2]; N] = std::array::from_fn(|i| [right[i], 2.0 * right[i]]);
        factor.forward(&mut columns);
        let mut one: [f64; N] = right.into();
        factor.forward_one(&mut one);
        for i in 0..N {
            assert!((columns[i][0] - one[i]).abs() < 1e-12 && (columns[i][1] - 2.0 * one[i]).abs() < 1e-12);
        }
    }

    #[test]
    fn solutions_agree_with_a_library() {
        check::<4>();
        check::<12>();
        check::<24>();
    }

    #[test]
    fn what_cannot_be_solved_stays_finite() {
        for matrix in [[[0.0; 4]; 4], [[1.0; 4]; 4], [[1e300; 4]; 4], [[-1.0; 4]; 4]] {
            let mut right = [1.0, -2.0, 3.0, 0.0];
            Factor::of(&matrix).solve(&mut right);
            assert!(!right.iter().any(|value| value.is_nan()), "{matrix:?}: {right:?}");
        }
    }

    #[test]
    fn nothing_gives_nothing() {
        let mut right = [0.0; 4];
        Factor::of(&[[2.0, 1.0, 0.0, 0.5], [1.0, 3.0, 0.2, 0.1], [0.0, 0.2, 1.0, 0.0], [0.5, 0.1, 0.0, 4.0]])
            .solve(&mut right);
        assert_eq!(right, [0.0; 4]);
    }
}
