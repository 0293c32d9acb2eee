//! Small dense symmetric systems of fixed size, without square roots and without allocation.
//!
//! Matrices are laid out so that each inner loop runs over contiguous numbers and nothing depends on the data: the
//! compiler turns the loops into vector instructions, and with lanes for numbers ([`Real`]) several systems are solved
//! side by side.

use sinew_body::dynamics::Real;

/// A pivot is at least this part of the diagonal entry that it came from: one that is not positive (rounding on a
/// hopeless scale) is lifted, so that the result is finite for finite input.
const LEAST_PIVOT: f64 = 1e-14;

/// And at least this.
const TINY: f64 = 1e-280;

/// L D Lᵀ of a symmetric positive definite matrix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factor<S, const N: usize> {
    /// Row j holds column j of L below its diagonal; the rest is zero.
    columns: [[S; N]; N],
    /// 1 / D.
    inverse: [S; N],
}

impl<S: Real, const N: usize> Factor<S, N> {
    /// Factorises a matrix of which only the entries at and right of the diagonal are read.
    #[inline(always)]
    pub(crate) fn of(matrix: [[S; N]; N]) -> Factor<S, N> {
        let mut factor = Factor { columns: matrix, inverse: [S::ZERO; N] };
        let diagonal: [S; N] = std::array::from_fn(|j| factor.columns[j][j]);
        if N == 24 {
            // What lies left of the diagonal is left out by blocks.
            factor.eliminate::<0, 8, 24>(&diagonal);
            factor.eliminate::<8, 16, 16>(&diagonal);
            factor.eliminate::<16, 24, 8>(&diagonal);
        } else {
            factor.eliminate::<0, N, N>(&diagonal);
        }
        factor
    }

    /// Columns `FROM` to `TO`, of each the `LENGTH` entries from `FROM` on. Each is taken from all later ones at once:
    /// every loop then runs along a row.
    #[inline(always)]
    fn eliminate<const FROM: usize, const TO: usize, const LENGTH: usize>(&mut self, diagonal: &[S; N]) {
        for j in FROM..TO.min(N) {
            let (done, left) = self.columns.split_at_mut(j + 1);
            let column = part::<S, N, LENGTH>(&done[j], FROM);
            let least = (diagonal[j].abs() * S::splat(LEAST_PIVOT)).larger(S::splat(TINY));
            let inverse = column[j - FROM].larger(least).recip();
            let scaled = column.map(|value| value * inverse);
            for (i, row) in left.iter_mut().enumerate() {
                let factor = scaled[j + 1 + i - FROM];
                let mut rest = part::<S, N, LENGTH>(row, FROM);
                for (value, &other) in rest.iter_mut().zip(&column) {
                    *value -= other * factor;
                }
                row[FROM..FROM + LENGTH].copy_from_slice(&rest);
            }
            self.inverse[j] = inverse;
            let row = &mut done[j];
            row[FROM..FROM + LENGTH].copy_from_slice(&scaled);
            row[..=j].fill(S::ZERO);
        }
    }

    /// 1 / D.
    pub(crate) fn inverse(&self) -> &[S; N] {
        &self.inverse
    }

    /// L⁻¹ times several columns at once, given row by row.
    #[inline(always)]
    pub(crate) fn forward<const K: usize>(&self, rows: &mut [[S; K]; N]) {
        for j in 0..N {
            let (done, left) = rows.split_at_mut(j + 1);
            let known = &done[j];
            for (row, &factor) in left.iter_mut().zip(&self.columns[j][j + 1..]) {
                for (value, &known) in row.iter_mut().zip(known) {
                    *value -= known * factor;
                }
            }
        }
    }

    /// L⁻¹ times a vector.
    #[inline(always)]
    pub(crate) fn forward_one(&self, vector: &mut [S; N]) {
        for j in 0..N {
            let known = vector[j];
            for (value, &factor) in vector.iter_mut().zip(&self.columns[j]) {
                *value -= known * factor;
            }
        }
    }

    /// L⁻ᵀ times a vector.
    #[inline(always)]
    pub(crate) fn backward_one(&self, vector: &mut [S; N]) {
        for j in (0..N).rev() {
            let sum = dot(&self.columns[j], vector);
            vector[j] -= sum;
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
        let factor = Factor::of(std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)])));
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
            Factor::of(matrix).solve(&mut right);
            assert!(!right.iter().any(|value| value.is_nan()), "{matrix:?}: {right:?}");
        }
    }

    #[test]
    fn nothing_gives_nothing() {
        let mut right = [0.0; 4];
        Factor::of([[2.0, 1.0, 0.0, 0.5], [1.0, 3.0, 0.2, 0.1], [0.0, 0.2, 1.0, 0.0], [0.5, 0.1, 0.0, 4.0]])
            .solve(&mut right);
        assert_eq!(right, [0.0; 4]);
    }
}
