//! Anderson's mixing: the combination of the last changes of the impulses after which a sweep would change least.
//!
//! With f_k = z_k − y_k, what sweep k changed, and the differences Δf_j, Δz_j of the last sweeps, γ minimises ‖f_k − Σ γ_j Δf_j‖ and
//! the next sweep starts at z_k − Σ γ_j Δz_j. In the norm of the diagonal of W, so that it does not depend on units.
//!
//! For smooth problems it is GMRES; contacts that open or slip break it. It is therefore only proposed where it promises much, and with friction
//! only in small problems: in large ones (2 020 sliding contacts of a wall of grains) it was seen to stall where momentum alone ends.

use crate::block::solve_definite;
use crate::{Cone, Operator, Problem};

/// How many differences are mixed.
const DEPTH: usize = 5;
/// A mix is proposed where it would leave at most this part of the change.
const PROMISE: f64 = 0.2;
/// How many unknowns a problem with friction may have.
const SMALL: usize = 256;

/// The last changes, with what is known of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mixing {
    /// √W_ii of each component.
    weights: Vec<f64>,
    /// The last f and its differences, weighted; the differences of z, plain.
    f: Vec<f64>,
    f_steps: [Vec<f64>; DEPTH],
    z_steps: [Vec<f64>; DEPTH],
    /// Δf_i·Δf_j and Δf_j·f.
    gram: [[f64; DEPTH]; DEPTH],
    along: [f64; DEPTH],
    /// How many differences there are, and where the next one goes.
    count: usize,
    next: usize,
    fresh: bool,
    /// ‖f‖².
    change: f64,
    /// Whether mixes are proposed at all.
    active: bool,
}

/// The change f of a sweep beside the way z⁺ − z from sweep to sweep.
pub(super) struct Way {
    pub change: f64,
    pub length: f64,
    pub change_along_way: f64,
}

impl Mixing {
    /// Forgets all, for another problem.
    pub(super) fn begin<O: Operator<D>, const D: usize>(&mut self, problem: &Problem<'_, O, D>) {
        self.weights.clear();
        for c in 0..problem.len() {
            let w = problem.operator.diagonal(c);
            self.weights.extend((0..D).map(|i| w[i][i].max(0.0).sqrt()));
        }
        for steps in [&mut self.f_steps, &mut self.z_steps] {
            steps.iter_mut().for_each(|step| step.resize(problem.len() * D, 0.0));
        }
        self.f.resize(problem.len() * D, 0.0);
        self.active = problem.len() * D <= SMALL
            || problem.cones.iter().all(|&cone| matches!(cone, Cone::Signorini | Cone::Bilateral { .. }));
        (self.count, self.next, self.fresh) = (0, 0, true);
        self.gram = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
        self.along = [0.0; DEPTH];
    }

    /// Takes in a sweep from `y` to `z`, after one that had ended at `previous`.
    pub(super) fn push(&mut self, z: &[f64], y: &[f64], previous: &[f64]) -> Way {
        let (slot, n) = (self.next, self.f.len());
        let (z, y, previous, w, f) = (&z[..n], &y[..n], &previous[..n], &self.weights[..n], &mut self.f[..n]);
        let (f_step, z_step) = (&mut self.f_steps[slot][..n], &mut self.z_steps[slot][..n]);
        for i in 0..n {
            let changed = w[i] * (z[i] - y[i]);
            z_step[i] = z[i] - previous[i];
            f_step[i] = changed - f[i];
            f[i] = changed;
        }
        let products = |i: usize| [f[i] * f[i], (w[i] * z_step[i]) * (w[i] * z_step[i]), f[i] * (w[i] * z_step[i])];
        let [change, length, inner] = sums(n, products);
        self.change = change;
        let way = Way { change: change.sqrt(), length: length.sqrt(), change_along_way: inner };
        // The first difference is against nothing.
        if self.active && !std::mem::take(&mut self.fresh) {
            self.learn(slot);
        }
        way
    }

    /// Brings the products up to date with the difference in `slot`.
    fn learn(&mut self, slot: usize) {
        self.count = (self.count + 1).min(DEPTH);
        self.next = (slot + 1) % DEPTH;
        for j in 0..self.count {
            let product = dot(&self.f_steps[slot], &self.f_steps[j]);
            (self.gram[slot][j], self.gram[j][slot]) = (product, product);
            self.along[j] += product;
        }
        self.along[slot] = dot(&self.f_steps[slot], &self.f);
    }

    /// Writes the mixed point to `y` if that promises much.
    pub(super) fn propose(&mut self, y: &mut [f64], z: &[f64]) -> bool {
        if self.count == 0 {
            return false;
        }
        let largest = (0..self.count).map(|j| self.gram[j][j]).fold(0.0, f64::max);
        let mut gram = self.gram;
        (0..self.count).for_each(|j| gram[j][j] += 1e-12 * largest);
        let Some(gamma) = solve_definite(&gram, &self.along) else { return false };
        let left = self.change - (0..self.count).map(|j| gamma[j] * self.along[j]).sum::<f64>();
        if left.is_nan() || left > PROMISE * PROMISE * self.change {
            return false;
        }
        y.copy_from_slice(z);
        for (step, gamma) in self.z_steps.iter().zip(gamma).take(self.count) {
            y.iter_mut().zip(step).for_each(|(y, step)| *y -= gamma * step);
        }
        true
    }

    /// y = z + β (z − z₋).
    pub(super) fn ahead(&self, y: &mut [f64], z: &[f64], beta: f64) {
        // The way just gone is in the slot before the next, or in the next where nothing was learned from it.
        let slot = if self.count > 0 { (self.next + DEPTH - 1) % DEPTH } else { self.next };
        for ((y, z), step) in y.iter_mut().zip(z).zip(&self.z_steps[slot]) {
            *y = z + beta * step;
        }
    }
}

/// a · b.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let b = &b[..a.len()];
    sums(a.len(), |i| [a[i] * b[i]])[0]
}

/// Σ_i terms(i) for i < n, in four lanes: one addition need not wait for the last.
#[inline(always)]
fn sums<const K: usize>(n: usize, terms: impl Fn(usize) -> [f64; K]) -> [f64; K] {
    let mut lanes = [[0.0; 4]; K];
    let whole = n / 4 * 4;
    for i in (0..whole).step_by(4) {
        for lane in 0..4 {
            let terms = terms(i + lane);
            for k in 0..K {
                lanes[k][lane] += terms[k];
            }
        }
    }
    for i in whole..n {
        let terms = terms(i);
        for k in 0..K {
            lanes[k][i - whole] += terms[k];
        }
    }
    lanes.map(|lane| (lane[0] + lane[1]) + (lane[2] + lane[3]))
}
