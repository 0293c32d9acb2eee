//! Small dense symmetric solves, without allocation.

/// Solves `matrix x = right` in place for a symmetric positive definite matrix of which the lower triangle is read and
/// overwritten by its Cholesky factor. A pivot that is not positive (rounding on a hopeless scale) is lifted, so that the
/// result is always finite for finite input.
pub(crate) fn cholesky_solve<const N: usize>(matrix: &mut [[f64; N]; N], right: &mut [f64; N], size: usize) {
    for j in 0..size {
        let row_j = matrix[j];
        let mut pivot = row_j[j];
        for value in &row_j[..j] {
            pivot -= value * value;
        }
        let pivot = if pivot > row_j[j].abs() * 1e-14 { pivot.sqrt() } else { row_j[j].abs().sqrt().max(1e-150) };
        let inverse = 1.0 / pivot;
        matrix[j][j] = pivot;
        for row in matrix[j + 1..size].iter_mut() {
            let mut value = row[j];
            for (a, b) in row[..j].iter().zip(&row_j[..j]) {
                value -= a * b;
            }
            row[j] = value * inverse;
        }
    }
    for i in 0..size {
        let mut value = right[i];
        for (a, x) in matrix[i][..i].iter().zip(&right[..i]) {
            value -= a * x;
        }
        right[i] = value / matrix[i][i];
    }
    for i in (0..size).rev() {
        right[i] /= matrix[i][i];
        let value = right[i];
        for j in 0..i {
            right[j] -= matrix[i][j] * value;
        }
    }
}
