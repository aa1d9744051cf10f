//! W + ϱ D, factorised as it is.
//!
//! All is divided by the greatest w_c, so that the same problem in other units has the same factors to the bit. An unknown that
//! is zero by its law, or that impulses do not move, has a row of its own and stays as it is.

use super::FILL;
use crate::block::Vector;
use crate::{Cone, Operator, Problem};
use faer::linalg::solvers::Solve;
use faer::sparse::linalg::cholesky::factorize_symbolic_cholesky;
use faer::sparse::linalg::solvers::{Llt, Lu, SymbolicLlt, SymbolicLu};
use faer::sparse::{SparseColMat, SymbolicSparseColMatRef, Triplet};
use faer::{ColMut, Side};

/// The asymmetry of W, relative to its greatest entry, that is taken for rounding.
const ROUNDING: f64 = 1e-13;

/// What solves with W + ϱ D.
pub(super) trait System<const D: usize> {
    /// Makes the factors for this ϱ; `false` where there are none.
    fn factorise(&mut self, rho: f64) -> bool;

    /// x ← (W + ϱ D)⁻¹ x; what stays has the impulse of `r`.
    fn solve(&self, x: &mut [Vector<D>], r: &[Vector<D>]);
}

/// D for each unknown, `w` for each contact and zero where it stays, and the greatest of them.
pub(super) fn weights<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, w: &[f64]) -> (Vec<f64>, f64) {
    let greatest = w.iter().copied().fold(0.0, f64::max);
    let frictionless = |c: usize| problem.cones[c] == Cone::Coulomb(0.0);
    let zero = |k: usize| !problem.cones[k / D].binds(k % D) || (!k.is_multiple_of(D) && frictionless(k / D));
    ((0..problem.len() * D).map(|k| if zero(k) { 0.0 } else { w[k / D] }).collect(), greatest)
}

/// `None` where the factor of a matrix of this pattern has too many entries.
pub(super) fn fits(pattern: SymbolicSparseColMatRef<'_, usize>) -> Option<()> {
    let fill = factorize_symbolic_cholesky(pattern, Side::Lower, Default::default(), Default::default()).ok()?.len_val();
    (fill <= FILL).then_some(())
}

/// The matrix with its factors.
pub(super) struct ThroughContacts {
    entries: Vec<Triplet<usize, usize, f64>>,
    /// D for each unknown, zero where it stays.
    weights: Vec<f64>,
    greatest: f64,
    symbolic: Symbolic,
    factors: Option<Factors>,
}

enum Symbolic {
    Symmetric(SymbolicLlt<usize>),
    Any(SymbolicLu<usize>),
}

enum Factors {
    Definite(Llt<usize, f64>),
    Any(Box<Lu<usize, f64>>),
}

impl ThroughContacts {
    /// `None` where the problem is too large.
    pub(super) fn new<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, diagonal: &[f64]) -> Option<Self> {
        let unknowns = problem.len() * D;
        let (weights, greatest) = weights(problem, diagonal);
        let weights: Vec<f64> = weights.into_iter().map(|w| if greatest > 0.0 { w / greatest } else { 0.0 }).collect();
        let mut entries: Vec<_> = (0..unknowns).filter(|&k| weights[k] == 0.0).map(|k| Triplet::new(k, k, 1.0)).collect();
        for (c, d, block) in problem.operator.stored().blocks() {
            for (i, row) in block.iter().enumerate() {
                for (j, &x) in row.iter().enumerate() {
                    let (i, j) = (c * D + i, d * D + j);
                    if weights[i] > 0.0 && weights[j] > 0.0 {
                        entries.push(Triplet::new(i, j, x / greatest));
                    }
                }
            }
        }
        let matrix = SparseColMat::try_new_from_triplets(unknowns, unknowns, &entries).ok()?;
        let pattern = matrix.symbolic();
        fits(pattern)?;
        let symbolic = if symmetric(&matrix) {
            Symbolic::Symmetric(SymbolicLlt::try_new(pattern, Side::Lower).ok()?)
        } else {
            Symbolic::Any(SymbolicLu::try_new(pattern).ok()?)
        };
        Some(Self { entries, weights, greatest, symbolic, factors: None })
    }
}

impl<const D: usize> System<D> for ThroughContacts {
    fn factorise(&mut self, rho: f64) -> bool {
        let n = self.weights.len();
        let shifted = self.entries.iter().map(|e| {
            let shift = if e.row == e.col { rho * self.weights[e.row] } else { 0.0 };
            Triplet::new(e.row, e.col, e.val + shift)
        });
        let Ok(matrix) = SparseColMat::try_new_from_triplets(n, n, &shifted.collect::<Vec<_>>()) else { return false };
        self.factors = match &self.symbolic {
            Symbolic::Symmetric(symbolic) => {
                let factors = Llt::try_new_with_symbolic(symbolic.clone(), matrix.as_ref(), Side::Lower);
                factors.ok().map(Factors::Definite).or_else(|| Some(Factors::Any(Box::new(matrix.sp_lu().ok()?))))
            }
            Symbolic::Any(symbolic) => {
                let factors = Lu::try_new_with_symbolic(symbolic.clone(), matrix.as_ref());
                factors.ok().map(|factors| Factors::Any(Box::new(factors)))
            }
        };
        self.factors.is_some()
    }

    fn solve(&self, x: &mut [Vector<D>], r: &[Vector<D>]) {
        for ((x, r), &weight) in x.as_flattened_mut().iter_mut().zip(r.as_flattened()).zip(&self.weights) {
            *x = if weight > 0.0 { *x / self.greatest } else { *r };
        }
        let side = ColMut::from_slice_mut(x.as_flattened_mut()).as_mat_mut();
        match &self.factors {
            Some(Factors::Definite(factors)) => factors.solve_in_place(side),
            Some(Factors::Any(factors)) => factors.solve_in_place(side),
            None => {}
        }
    }
}

/// Whether the matrix is symmetric but for rounding.
fn symmetric(matrix: &SparseColMat<usize, f64>) -> bool {
    let value = |i: usize, j: usize| matrix.get(i, j).copied().unwrap_or(0.0);
    let entries = || matrix.triplet_iter().map(|e| (e.row, e.col, *e.val));
    let greatest = entries().fold(0.0, |s: f64, (_, _, x)| s.max(x.abs()));
    entries().all(|(i, j, x)| (x - value(j, i)).abs() <= ROUNDING * greatest)
}
