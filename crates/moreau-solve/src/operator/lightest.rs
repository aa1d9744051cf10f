//! Of all impulses that do the same to the bodies, those with the least sum of squares (theory (87)).
//!
//! Four points of a face make W singular: impulses move along its null space and no velocity changes. The start of a solve and the way that it takes decide where
//! it ends. A warm start hands them on from step to step, so that what each solve adds in the null space adds up, until two corners carry a whole box and its slipping about them is legal.
//!
//! ```text
//! least ½ Σ ‖r_c‖²  with  Jᵀ r = y:      r = J z,   Jᵀ J z = y      (conjugate gradients over the bodies)
//! ```
//!
//! Elastic bodies with the same stiffness at each contact have this answer in the limit of rigid ones.

use super::MatrixFree;
use super::matrix_free::NONE;
use crate::Cone;
use crate::block::{Vector, axpy};

/// What is left of Jᵀ r = y, relative, that a start may miss.
const ENOUGH: f64 = 1e-9;
/// More steps are not taken: the start stays as it is.
const STEPS: usize = 200;
/// How often contacts that cannot follow are left out.
const ROUNDS: usize = 4;

/// Scratch of [`MatrixFree::lighten`].
#[derive(Clone, Debug, Default)]
pub struct Lightest<const D: usize, const N: usize> {
    takes_part: Vec<bool>,
    target: Vec<Vector<D>>,
    z: Vec<[f64; N]>,
    left: Vec<[f64; N]>,
    way: Vec<[f64; N]>,
    image: Vec<[f64; N]>,
}

impl<const D: usize, const N: usize> MatrixFree<D, N> {
    /// Brings the impulses of the contacts that `rest` a `part` of the way to the least ones that do the same to the bodies. Impulses stay in their cones; contacts whose least impulse is
    /// outside keep theirs. Nothing changes where that cannot be found.
    pub fn lighten(
        &self,
        (cones, rest): (&[Cone], &dyn Fn(usize) -> bool),
        part: f64,
        r: &mut [Vector<D>],
        scratch: &mut Lightest<D, N>,
    ) {
        scratch.takes_part.clear();
        scratch.takes_part.extend((0..r.len()).map(rest));
        for _ in 0..ROUNDS {
            if !self.least(r, scratch) {
                return;
            }
            let Lightest { takes_part, target, .. } = scratch;
            let mut fits = true;
            for c in 0..r.len() {
                if takes_part[c] && cones[c].distance(&target[c]) > 0.0 && !matches!(cones[c], Cone::Bilateral { .. }) {
                    (takes_part[c], fits) = (false, false);
                }
            }
            if fits {
                for c in (0..r.len()).filter(|&c| takes_part[c]) {
                    r[c] = std::array::from_fn(|i| r[c][i] + part * (target[c][i] - r[c][i]));
                }
                return;
            }
        }
    }

    /// Finds the least impulses of the contacts that take part; false where conjugate gradients do not end.
    fn least(&self, r: &[Vector<D>], scratch: &mut Lightest<D, N>) -> bool {
        let Lightest { takes_part, target, z, left, way, image } = scratch;
        let zero = [0.0; N];
        for list in [&mut *z, &mut *left, &mut *image] {
            list.clear();
            list.resize(self.bodies(), zero);
        }
        target.clear();
        target.resize(r.len(), [0.0; D]);
        self.gather(takes_part, r, left);
        way.clone_from(left);
        let whole = square(left);
        let mut rest = whole;
        for _ in 0..STEPS {
            if rest <= ENOUGH * ENOUGH * whole {
                break;
            }
            self.spread(takes_part, way, target);
            image.fill(zero);
            self.gather(takes_part, target, image);
            let step = rest / product(way, image);
            if !step.is_finite() {
                return false;
            }
            add(z, step, way);
            add(left, -step, image);
            let next = square(left);
            let share = next / rest;
            rest = next;
            way.iter_mut().zip(left.iter()).for_each(|(way, left)| *way = axpy(left, share, way));
        }
        self.spread(takes_part, z, target);
        rest <= ENOUGH * ENOUGH * whole && target.as_flattened().iter().all(|x| x.is_finite())
    }

    /// y ← y + Jᵀ r over the contacts that take part.
    fn gather(&self, takes_part: &[bool], r: &[Vector<D>], y: &mut [[f64; N]]) {
        for c in (0..r.len()).filter(|&c| takes_part[c]) {
            for (rows, body) in self.rows(c).iter().zip(self.pair(c)).filter(|(_, body)| *body != NONE) {
                let y = &mut y[body as usize];
                (0..D).for_each(|i| *y = axpy(y, r[c][i], &rows[i]));
            }
        }
    }

    /// r = J z at the contacts that take part.
    fn spread(&self, takes_part: &[bool], z: &[[f64; N]], r: &mut [Vector<D>]) {
        for c in (0..r.len()).filter(|&c| takes_part[c]) {
            r[c] = [0.0; D];
            for (rows, body) in self.rows(c).iter().zip(self.pair(c)).filter(|(_, body)| *body != NONE) {
                (0..D).for_each(|i| r[c][i] += crate::block::dot(&rows[i], &z[body as usize]));
            }
        }
    }
}

fn product<const N: usize>(a: &[[f64; N]], b: &[[f64; N]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

fn square<const N: usize>(a: &[[f64; N]]) -> f64 {
    product(a, a)
}

/// a ← a + s b.
fn add<const N: usize>(a: &mut [[f64; N]], s: f64, b: &[[f64; N]]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a = axpy(a, s, b));
}
