//! W + ϱ D through the bodies: with W = J Jᵀ,
//!
//! ```text
//! (J Jᵀ + ϱ D)⁻¹ b = (ϱ D)⁻¹ (b − J y),   (I + Jᵀ (ϱ D)⁻¹ J) y = Jᵀ (ϱ D)⁻¹ b     (Woodbury)
//! ```
//!
//! Where bodies have many contacts each, as blocks that stand on faces have, y has far fewer numbers than r, and its matrix couples only bodies that
//! touch.

use super::factors::{System, fits, weights};
use crate::block::Vector;
use crate::{Operator, Problem};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::solvers::{Llt, SymbolicLlt};
use faer::sparse::{SparseColMat, SparseColMatRef, Triplet};
use faer::{ColMut, Side};

/// The matrix with its factors.
pub(super) struct ThroughBodies {
    /// D for each unknown, zero where it stays.
    weights: Vec<f64>,
    /// D^{-1/2} J, without the rows of unknowns that stay, and Jᵀ D⁻¹ J with all of its diagonal.
    rows: SparseColMat<usize, f64>,
    square: SparseColMat<usize, f64>,
    symbolic: SymbolicLlt<usize>,
    factors: Option<(Llt<usize, f64>, f64)>,
}

impl ThroughBodies {
    /// `None` where W is not known through fewer numbers than it has rows, or they are too many.
    pub(super) fn new<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, diagonal: &[f64]) -> Option<Self> {
        let root = problem.operator.root()?;
        let (weights, _) = weights(problem, diagonal);
        if root.columns >= weights.len() {
            return None;
        }
        let weighed = root.entries.iter().filter(|(row, ..)| weights[*row] > 0.0);
        let entries: Vec<_> = weighed.map(|&(row, column, x)| Triplet::new(row, column, x / weights[row].sqrt())).collect();
        let rows = SparseColMat::try_new_from_triplets(weights.len(), root.columns, &entries).ok()?;
        let zeros: Vec<_> = (0..root.columns).map(|k| Triplet::new(k, k, 0.0)).collect();
        let zeros = SparseColMat::try_new_from_triplets(root.columns, root.columns, &zeros).ok()?;
        let square = &(rows.transpose().to_col_major().ok()? * &rows) + &zeros;
        fits(square.symbolic())?;
        let symbolic = SymbolicLlt::try_new(square.symbolic(), Side::Lower).ok()?;
        Some(Self { weights, rows, square, symbolic, factors: None })
    }
}

impl<const D: usize> System<D> for ThroughBodies {
    fn factorise(&mut self, rho: f64) -> bool {
        let value = |k: usize| column(&self.square, k).map(move |(i, x)| x / rho + f64::from(u8::from(i == k)));
        let values: Vec<f64> = (0..self.square.ncols()).flat_map(value).collect();
        let matrix = SparseColMatRef::new(self.square.symbolic(), &values);
        let factors = Llt::try_new_with_symbolic(self.symbolic.clone(), matrix, Side::Lower);
        self.factors = factors.ok().map(|factors| (factors, rho));
        self.factors.is_some()
    }

    fn solve(&self, x: &mut [Vector<D>], r: &[Vector<D>]) {
        let Some((factors, rho)) = &self.factors else { return };
        // b in the units of √D, in which the rows are.
        let b = x.as_flattened_mut();
        b.iter_mut().zip(&self.weights).for_each(|(b, w)| *b = if *w > 0.0 { *b / w.sqrt() } else { 0.0 });
        let along = |k: usize| column(&self.rows, k).map(|(i, a)| a * b[i]).sum::<f64>() / rho;
        let mut y: Vec<f64> = (0..self.rows.ncols()).map(along).collect();
        factors.solve_in_place(ColMut::from_slice_mut(&mut y).as_mat_mut());
        for (k, y) in y.iter().enumerate() {
            column(&self.rows, k).for_each(|(i, a)| b[i] -= a * y);
        }
        for ((b, r), w) in b.iter_mut().zip(r.as_flattened()).zip(&self.weights) {
            *b = if *w > 0.0 { *b / (rho * w.sqrt()) } else { *r };
        }
    }
}

/// Rows and values of a column.
fn column(matrix: &SparseColMat<usize, f64>, k: usize) -> impl Iterator<Item = (usize, f64)> {
    matrix.symbolic().row_idx_of_col_raw(k).iter().copied().zip(matrix.val_of_col(k).iter().copied())
}
