//! Lemke's method: exact pivoting, for small problems without friction (in any space) or with friction in the plane.
//!
//! ```text
//! find x ≥ 0, y = M x + b ≥ 0, x ⊥ y, with for each contact (the last three where μ > 0)
//!   x:  r_n       β⁺          β⁻          λ            r_t = β⁺ − β⁻,  λ = |u_t| where it slides
//!   y:  u_n       u_t + λ     λ − u_t     μ r_n − β⁺ − β⁻
//! y + z e is raised until it is not negative; z leaves by complementary pivots:
//!   entering:  the complement of what left last
//!   leaving:   what first falls to zero, ties by the lexicographic order, so that no basis comes twice
//! ```
//!
//! M is copositive: the pivots end in a solution or in a ray. Where gaps or restitution are in q a ray need not mean that there
//! is no solution: other covering vectors e are tried, and then it is `Stalled`. The unknowns that are left positive name
//! sticking, sliding and open contacts; their equations are solved once more, with refinement, and so the answer is exact to
//! rounding. In the tableau impulses are multiplied by w_c, so that all is a velocity and no tolerance has a unit.
//!
//! Reference: Lemke 1965; Cottle, Pang & Stone 1992, section 4.4; Anitescu & Potra 1997. The tableau is dense: at most [`LIMIT`]
//! unknowns, with as many pivots as they are and that many squared operations a pivot. It does not use the first guess. Friction
//! in space, rolling, sticking and bilateral constraints are `Unsuited`.

mod tableau;

use super::Work;
use super::steps::{after_step, inverse, scales};
use crate::block::Vector;
use crate::{Cone, Delassus, Operator, Problem, Status};
use faer::Mat;
use faer::linalg::solvers::Solve;
use tableau::Tableau;

/// How many unknowns the dense tableau may have: one a contact without friction, four with it.
const LIMIT: usize = 2000;
/// A pivot below this part of the greatest entry of its column is zero but for rounding.
const ZERO: f64 = 1e-11;
/// Ratios that differ by less than this part are a tie.
const TIE: f64 = 1e-12;
/// What is left of a difference of two numbers that agree to this part is rounding.
const ROUNDING: f64 = 1e-14;
/// From how many covering vectors the pivots are begun, where the earlier ones ended in a ray.
const ATTEMPTS: u32 = 5;
/// How often the final equations are refined.
const REFINEMENTS: usize = 3;

/// Pivots until the end.
pub(super) fn run<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>) -> Status {
    let Some(lcp) = Lcp::new(work.problem) else { return Status::Unsuited };
    for attempt in 0..ATTEMPTS {
        let mut tableau = Tableau::new(&lcp, attempt);
        match pivots(work, &lcp, &mut tableau) {
            End::Solved => return finish(work, &lcp, &tableau),
            End::Ray => {}
            End::Told(status) => return status,
        }
    }
    Status::Stalled
}

/// How the pivots from one covering vector end.
enum End {
    Solved,
    Ray,
    /// The judge has said so.
    Told(Status),
}

fn pivots<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, lcp: &Lcp, tableau: &mut Tableau) -> End {
    let mut entering = tableau.first();
    while let Some(column) = entering {
        let Some(row) = tableau.leaving(column) else { return End::Ray };
        tableau.pivot(row, column);
        entering = tableau.complement(column);
        if entering.is_some() {
            lcp.write(&tableau.values(), work.r);
            if let Some(status) = after_step(work) {
                return End::Told(status);
            }
        }
    }
    End::Solved
}

/// The answer of the last basis.
fn finish<O: Operator<D>, const D: usize>(work: &mut Work<'_, O, D>, lcp: &Lcp, tableau: &Tableau) -> Status {
    lcp.write(&lcp.polished(&tableau.values()), work.r);
    work.problem.operator.start(work.r, &mut work.scratch.state);
    work.after_step().unwrap_or(Status::Stalled)
}

/// The problem of complementarity.
struct Lcp {
    size: usize,
    /// M by rows.
    m: Vec<f64>,
    b: Vec<f64>,
    /// The first unknown of each contact, and whether it has friction.
    contacts: Vec<(usize, bool)>,
    /// What an unknown is multiplied by to be an impulse, for each contact.
    to_impulse: Vec<f64>,
}

impl Lcp {
    /// `None` where the problem is none, or too large.
    fn new<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>) -> Option<Self> {
        let mut size = 0;
        let mut contacts = Vec::with_capacity(problem.len());
        for cone in problem.cones {
            let rough = match cone {
                Cone::Signorini => false,
                Cone::Coulomb(mu) if D == 1 || *mu == 0.0 => false,
                Cone::Coulomb(_) if D == 2 => true,
                _ => return None,
            };
            contacts.push((size, rough));
            size += if rough { 4 } else { 1 };
        }
        if size > LIMIT {
            return None;
        }
        let w = scales(problem);
        let greatest = w.iter().copied().fold(0.0, f64::max);
        // A contact that impulses do not move takes the scale of another.
        let to_impulse = w.iter().map(|&w| inverse(if w > 0.0 { w } else { greatest })).collect();
        let mut lcp = Self { size, m: vec![0.0; size * size], b: vec![0.0; size], contacts, to_impulse };
        lcp.fill(&problem.operator.stored(), problem.q, problem.cones);
        Some(lcp)
    }

    fn fill<const D: usize>(&mut self, w: &Delassus<D>, q: &[Vector<D>], cones: &[Cone]) {
        let size = self.size;
        let signs = |rough: bool| [(0, 0, 1.0), (1, 1, 1.0), (2, 1, -1.0)].into_iter().take(if rough { 3 } else { 1 });
        for (c, &(i, rough)) in self.contacts.iter().enumerate() {
            for (k, part, sign) in signs(rough) {
                self.b[i + k] = sign * q[c][part];
                for (d, block) in w.row(c) {
                    let (j, other) = self.contacts[d];
                    for (l, column, turn) in signs(other) {
                        self.m[(i + k) * size + j + l] += sign * turn * block[part][column] * self.to_impulse[d];
                    }
                }
            }
            if rough {
                let last = (i + 3) * size + i;
                self.m[last..last + 3].copy_from_slice(&[cones[c].friction(), -1.0, -1.0]);
                self.m[(i + 1) * size + i + 3] = 1.0;
                self.m[(i + 2) * size + i + 3] = 1.0;
            }
        }
    }

    /// The impulses of the unknowns `x`.
    fn write<const D: usize>(&self, x: &[f64], r: &mut [Vector<D>]) {
        for ((r, &(i, rough)), scale) in r.iter_mut().zip(&self.contacts).zip(&self.to_impulse) {
            let tangent = if rough { x[i + 1] - x[i + 2] } else { 0.0 };
            *r = std::array::from_fn(|k| [x[i], tangent].get(k).map_or(0.0, |x| x * scale));
        }
    }

    /// The solution of y_A = 0 for the unknowns A that are positive, or `x` where that is singular.
    fn polished(&self, x: &[f64]) -> Vec<f64> {
        let active: Vec<usize> = (0..self.size).filter(|&i| x[i] > 0.0).collect();
        let row = |i: usize| &self.m[i * self.size..(i + 1) * self.size];
        let factors = Mat::from_fn(active.len(), active.len(), |k, l| row(active[k])[active[l]]).partial_piv_lu();
        let mut refined = x.to_vec();
        let mut least = f64::INFINITY;
        let mut now = refined.clone();
        for _ in 0..=REFINEMENTS {
            let y = |i: usize| self.b[i] + row(i).iter().zip(&now).map(|(m, x)| m * x).sum::<f64>();
            let mut change = Mat::from_fn(active.len(), 1, |k, _| -y(active[k]));
            let error = (0..active.len()).map(|k| change[(k, 0)] * change[(k, 0)]).sum::<f64>();
            // Also where it is no number.
            if error < least {
                (least, refined) = (error, now.clone());
            } else {
                break;
            }
            factors.solve_in_place(&mut change);
            for (k, &i) in active.iter().enumerate() {
                now[i] = (now[i] + change[(k, 0)]).max(0.0);
            }
        }
        refined
    }
}
