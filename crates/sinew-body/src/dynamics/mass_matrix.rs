//! The joint-space inertia matrix.

use super::{Real, Tree};

/// The symmetric matrix M of T = ½ q̇ᵀ M q̇, dense, both triangles filled.
///
/// Degrees of freedom on different branches are not coupled: those entries are zero from the start and are never
/// written, see [`Tree::parent_of_dof`].
#[derive(Clone, Debug, PartialEq)]
pub struct MassMatrix<S: Real> {
    dofs: usize,
    /// Row-major, dofs × dofs.
    entries: Vec<S>,
}

impl<S: Real> MassMatrix<S> {
    /// The zero matrix of a tree's degrees of freedom.
    pub fn new(tree: &Tree<S>) -> MassMatrix<S> {
        let dofs = tree.dofs();
        MassMatrix { dofs, entries: vec![S::ZERO; dofs * dofs] }
    }

    /// Rows, and columns.
    pub fn dofs(&self) -> usize {
        self.dofs
    }

    /// One entry \[kg m², kg m or kg, as the two coordinates are\].
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> S {
        self.entries[row * self.dofs + column]
    }

    /// One row.
    pub fn row(&self, row: usize) -> &[S] {
        &self.entries[row * self.dofs..(row + 1) * self.dofs]
    }

    /// All entries, row by row.
    pub fn as_slice(&self) -> &[S] {
        &self.entries
    }

    /// Product with a vector of one number per degree of freedom.
    ///
    /// # Panics
    /// If the lengths differ.
    pub fn times(&self, vector: &[S], product: &mut [S]) {
        assert!(vector.len() == self.dofs && product.len() == self.dofs, "one number per degree of freedom");
        for (row, product) in product.iter_mut().enumerate() {
            *product = self.row(row).iter().zip(vector).fold(S::ZERO, |sum, (&m, &v)| sum + m * v);
        }
    }

    /// Writes the first `axes` (1 to 3) of the entries side by side, and their mirror images.
    #[inline(always)]
    pub(super) fn set(&mut self, row: usize, first_column: usize, entries: [S; 3], axes: usize) {
        // Unrolled: a loop would become a call of `memcpy` for at most three numbers.
        let mut put = |column: usize, entry: S| {
            self.entries[row * self.dofs + column] = entry;
            self.entries[column * self.dofs + row] = entry;
        };
        put(first_column, entries[0]);
        if axes > 1 {
            put(first_column + 1, entries[1]);
        }
        if axes > 2 {
            put(first_column + 2, entries[2]);
        }
    }
}
