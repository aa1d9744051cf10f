//! Global primal-dual active set: the paper's idea (section 4.3) carried to all contacts at once, as a semismooth Newton method.
//!
//! ```text
//! repeat:
//!   sweeps of accelerated NLGS, to find the sets
//!   a few times:
//!     u = W r + q,   τ = r − ρ u                 each contact reads its set from τ, as PDAS does at one contact:
//!     F_c = r_c − C_c(τ_c)                       C: [τ_n]₊, and τ_T brought into the disk of radius μ [τ_n]₊ (eq. 23)
//!     separated: Δr_c = −r_c;  all others: (I − G_c) Δr_c + G_c ρ_c (W Δr)_c = −F_c,   G = ∂C/∂τ
//!     r ← r + Δr                                 sticking: u = 0; sliding: u_n = 0 and r_T along τ_T
//!   keep the best; if it is not good enough, sweep twice as much
//! ```
//!
//! The sparse matrix of the contacts that are not separated is factorised at each step (LU with partial pivoting, by faer); with the right
//! sets a step ends the solve without friction, and converges quadratically with it. Where W is rank deficient on the active set the
//! matrix is singular: W gets a part of its diagonal added in the matrix alone, which leaves the solution as it is (a proximal
//! step) and costs some steps. Where steps lead astray that part is raised, which shortens them.
//!
//! References: Alart & Curnier 1991; Hüeber, Stadler & Wohlmuth 2008. For tight tolerances. Not for millions of contacts, as the factors fill in.

use super::{Work, accelerated, keep};
use crate::block::{Matrix, Vector, axpy, identity, mul, sub};
use crate::cone::part;
use crate::local::LocalSolver;
use crate::{Cone, Delassus, Operator, Status};
use faer::Mat;
use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};

/// More unknowns than that are not factorised.
pub(super) const LARGEST: usize = 300_000;
/// Sweeps before the first steps.
const FIRST_SWEEPS: u64 = 10;
/// Steps from one set of impulses.
const STEPS: usize = 24;
/// How many steps may follow one that was worse than [`SLACK`] allows.
const FREE: u32 = 2;
/// How much worse a step may be and still be kept.
const SLACK: f64 = 1.5;
/// The part of W's diagonal that is added to it in the matrix: at least, at most, and how it rises after failure and falls after success.
const LEAST_PROXIMAL: f64 = 1e-9;
const MOST_PROXIMAL: f64 = 1.0;
const RAISE: f64 = 100.0;
const LOWER: f64 = 0.3;

/// Sweeps and steps in turn, until the judge says stop.
pub(super) fn run<O: Operator<D>, L: LocalSolver, const D: usize>(work: &mut Work<'_, O, D>, local: L) -> Status {
    if work.problem.len() * D > LARGEST {
        return Status::Unsuited;
    }
    let stored = work.problem.operator.stored().into_owned();
    let limit = work.judge.limit;
    let mut sweeps = FIRST_SWEEPS;
    loop {
        work.judge.limit = limit.min(work.judge.sweeps + sweeps);
        let status = accelerated::run(work, local);
        work.judge.limit = limit;
        if status != Status::MaxSweeps || work.judge.sweeps >= limit {
            return status;
        }
        if let Some(status) = steps(work, &stored) {
            return status;
        }
        sweeps *= 2;
    }
}

/// Some steps from the impulses of now; the best of what they lead to is kept.
///
/// A step that worsens the criterion may be followed by [`FREE`] others, as sets that change often make it worse for a while; if none of them
/// helps, all are undone and the next is held back by a larger proximal part.
pub(super) fn steps<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, stored: &Delassus<D>) -> Option<Status> {
    // Velocities that a sweep has claimed are not those of a step.
    work.scratch.claimed.clear();
    work.problem.operator.start(work.r, &mut work.scratch.state);
    let mut accepted = work.judge.weigh(&work.scratch.state, work.r, None);
    let mut best = accepted;
    keep(&mut work.scratch.best, work.r);
    keep(&mut work.scratch.from, work.r);
    let (mut proximal, mut worse) = (LEAST_PROXIMAL, 0);
    for _ in 0..STEPS {
        let error = match step(work, stored, proximal) {
            Ok(()) => work.judge.error,
            Err(Some(status)) => return Some(status),
            Err(None) => f64::NAN,
        };
        if error < best {
            best = error;
            keep(&mut work.scratch.best, work.r);
        }
        if error <= SLACK * accepted {
            (accepted, worse) = (error, 0);
            keep(&mut work.scratch.from, work.r);
            proximal = (proximal * LOWER).max(LEAST_PROXIMAL);
        } else if worse < FREE && error.is_finite() {
            worse += 1;
        } else {
            worse = 0;
            proximal *= RAISE;
            work.r.copy_from_slice(&work.scratch.from);
            work.problem.operator.start(work.r, &mut work.scratch.state);
        }
        if proximal > MOST_PROXIMAL {
            break;
        }
    }
    work.r.copy_from_slice(&work.scratch.best);
    work.judge.error = best;
    None
}

/// r ← r + Δr, and what the judge says of it. The error is how the solve ends, or nothing where no step could be had.
fn step<O: Operator<D>, const D: usize>(
    work: &mut Work<'_, O, D>,
    stored: &Delassus<D>,
    proximal: f64,
) -> Result<(), Option<Status>> {
    let change = newton(work, stored, proximal).ok_or(None)?;
    for (r, change) in work.r.iter_mut().zip(&change) {
        *r = axpy(r, 1.0, change);
    }
    work.problem.operator.start(work.r, &mut work.scratch.state);
    match work.after_step() {
        None => Ok(()),
        Some(Status::NotFinite) => Err(None),
        status => Err(status),
    }
}

/// One contact at τ: −F, I − G and G ρ.
struct Linear<const D: usize> {
    minus_f: Vector<D>,
    fixed: Matrix<D>,
    moving: Matrix<D>,
}

/// Δr, or `None` where the matrix cannot be factorised.
fn newton<O: Operator<D>, const D: usize>(work: &Work<'_, O, D>, stored: &Delassus<D>, proximal: f64) -> Option<Vec<Vector<D>>> {
    let linear: Vec<Linear<D>> = (0..work.problem.len()).map(|c| linearise(work, c)).collect();
    // Separated contacts are known beforehand.
    let mut change: Vec<Vector<D>> = vec![[0.0; D]; linear.len()];
    let mut place = vec![usize::MAX; linear.len()];
    let mut active = Vec::new();
    for (c, contact) in linear.iter().enumerate() {
        if contact.moving == [[0.0; D]; D] {
            change[c] = contact.minus_f;
        } else {
            place[c] = active.len();
            active.push(c);
        }
    }
    let mut entries = Vec::new();
    let mut right = Mat::<f64>::zeros(active.len() * D, 1);
    for (k, &c) in active.iter().enumerate() {
        let Linear { minus_f, fixed, moving } = &linear[c];
        let mut side = *minus_f;
        for (d, block) in stored.row(c) {
            if place[d] == usize::MAX {
                side = sub(&side, &mul(moving, &mul(block, &change[d])));
                continue;
            }
            let mut block = times(moving, &with_proximal(block, if c == d { proximal } else { 0.0 }));
            if c == d {
                block = std::array::from_fn(|i| axpy(&block[i], 1.0, &fixed[i]));
            }
            push(&mut entries, k * D, place[d] * D, &block);
        }
        (0..D).for_each(|i| right[(k * D + i, 0)] = side[i]);
    }
    if !active.is_empty() {
        let n = active.len() * D;
        SparseColMat::try_new_from_triplets(n, n, &entries).ok()?.sp_lu().ok()?.solve_in_place(&mut right);
    }
    for (k, &c) in active.iter().enumerate() {
        change[c] = std::array::from_fn(|i| right[(k * D + i, 0)]);
    }
    change.as_flattened().iter().all(|x| x.is_finite()).then_some(change)
}

/// −F_c, I − G_c and G_c ρ_c at the impulses and the state of now.
fn linearise<O: Operator<D>, const D: usize>(work: &Work<'_, O, D>, c: usize) -> Linear<D> {
    let (u, r) = (work.problem.velocity(&work.scratch.state, c), &work.r[c]);
    let rho = rho(work.problem.cones[c], &work.problem.operator.diagonal(c));
    let tau: Vector<D> = std::array::from_fn(|i| r[i] - rho[i] * u[i]);
    let (image, g) = work.problem.cones[c].project_cylinder(&tau);
    let one = identity::<D>();
    Linear {
        minus_f: sub(&image, r),
        fixed: std::array::from_fn(|i| sub(&one[i], &g[i])),
        moving: std::array::from_fn(|i| std::array::from_fn(|j| g[i][j] * rho[j])),
    }
}

/// ρ of each component: the inverse of the greatest row sum of its part (normal, tangent, rolling) of W_cc.
fn rho<const D: usize>(cone: Cone, w: &Matrix<D>) -> Vector<D> {
    let of = |i: usize| match cone {
        _ if i == 0 => 0,
        Cone::Rolling { .. } => 1 + part::<D>(i),
        _ => 1,
    };
    let size = |p: usize| {
        let row = |i: usize| (0..D).filter(|&j| of(j) == p).map(|j| w[i][j].abs()).sum::<f64>();
        (0..D).filter(|&i| of(i) == p).map(row).fold(0.0, f64::max)
    };
    let largest = (0..3).map(size).fold(0.0, f64::max);
    // A part that cannot move takes the step of another; a contact that cannot, any.
    let usable = |s: f64| if s > 1e-12 * largest { s } else { largest };
    std::array::from_fn(|i| if largest > 0.0 { 1.0 / usable(size(of(i))) } else { 1.0 })
}

/// The block, with the proximal part if it is on the diagonal.
fn with_proximal<const D: usize>(block: &Matrix<D>, part: f64) -> Matrix<D> {
    let mut block = *block;
    if part > 0.0 {
        let mean = (0..D).map(|i| block[i][i]).sum::<f64>() / D as f64;
        (0..D).for_each(|i| block[i][i] += part * if block[i][i] > 0.0 { block[i][i] } else { mean });
    }
    block
}

fn times<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..D).map(|k| a[i][k] * b[k][j]).sum()))
}

fn push<const D: usize>(entries: &mut Vec<Triplet<usize, usize, f64>>, row: usize, column: usize, block: &Matrix<D>) {
    for i in 0..D {
        for j in 0..D {
            if block[i][j] != 0.0 || (row == column && i == j) {
                entries.push(Triplet::new(row + i, column + j, block[i][j]));
            }
        }
    }
}
