//! Least squares whose normal matrix is banded: what one frame has to do with its neighbours.
//!
//! Written here because no maintained crate solves banded symmetric systems; a dense or general sparse solver takes a thousand
//! times as long on a clip of ten minutes.

/// A sum of squared terms in unknowns of which each term names only close ones.
pub(super) struct Banded {
    size: usize,
    /// Unknowns that a term may be apart.
    width: usize,
    /// Lower triangle by rows: entry `row * (width + 1) + back` is that of `row` and `row - back`.
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl Banded {
    pub fn new(size: usize, width: usize) -> Banded {
        Banded { size, width, matrix: vec![0.0; size * (width + 1)], right: vec![0.0; size] }
    }

    /// Adds weight · (Σ factor · unknown − target)². Unknowns are named in rising order.
    pub fn add(&mut self, terms: &[(usize, f64)], target: f64, weight: f64) {
        for (place, &(row, factor)) in terms.iter().enumerate() {
            self.right[row] += weight * factor * target;
            for &(column, other) in &terms[..=place] {
                self.matrix[row * (self.width + 1) + (row - column)] += weight * factor * other;
            }
        }
    }

    /// The unknowns at which the sum is least, by a Cholesky factorisation L D Lᵀ in place. Unknowns that no term holds stay 0.
    pub fn solve(mut self) -> Vec<f64> {
        let (width, stride) = (self.width, self.width + 1);
        for row in 0..self.size {
            let first = row.saturating_sub(width);
            for column in first..=row {
                let begin = first.max(column.saturating_sub(width));
                let mut value = self.matrix[row * stride + row - column];
                for at in begin..column {
                    let diagonal = self.matrix[at * stride];
                    value -= self.lower(row, at) * diagonal * self.lower(column, at);
                }
                let diagonal = self.matrix[column * stride];
                self.matrix[row * stride + row - column] = match (row == column, diagonal > 0.0) {
                    (true, _) => value.max(0.0),
                    (false, true) => value / diagonal,
                    (false, false) => 0.0,
                };
            }
        }
        let mut unknowns = std::mem::take(&mut self.right);
        for row in 0..self.size {
            for at in row.saturating_sub(width)..row {
                unknowns[row] -= self.lower(row, at) * unknowns[at];
            }
        }
        for (row, unknown) in unknowns.iter_mut().enumerate() {
            let diagonal = self.matrix[row * stride];
            *unknown = if diagonal > 0.0 { *unknown / diagonal } else { 0.0 };
        }
        for row in (0..self.size).rev() {
            for at in row.saturating_sub(width)..row {
                unknowns[at] -= self.lower(row, at) * unknowns[row];
            }
        }
        unknowns
    }

    fn lower(&self, row: usize, column: usize) -> f64 {
        self.matrix[row * (self.width + 1) + row - column]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_makes_every_derivative_of_the_sum_zero() {
        let size = 40;
        let value = |at: usize| ((at * 7919 % 101) as f64 - 50.0) / 17.0;
        let terms: Vec<_> = (0..200)
            .map(|at: usize| {
                let first = at * 31 % (size - 6);
                let named = [first, first + 1 + at % 3, first + 5];
                let factors = [value(at), value(at + 1), value(at + 2)];
                (named.into_iter().zip(factors).collect::<Vec<_>>(), value(at + 3), 0.1 + (at % 9) as f64)
            })
            .collect();
        let mut sum = Banded::new(size, 5);
        terms.iter().for_each(|(terms, target, weight)| sum.add(terms, *target, *weight));
        let unknowns = sum.solve();
        let mut slope = vec![0.0; size];
        for (terms, target, weight) in &terms {
            let off = terms.iter().map(|&(at, factor)| factor * unknowns[at]).sum::<f64>() - target;
            terms.iter().for_each(|&(at, factor)| slope[at] += weight * off * factor);
        }
        // Rounding of sums of 200 terms of size 10.
        assert!(slope.iter().all(|slope| slope.abs() < 1e-9), "{slope:?}");
    }
}
