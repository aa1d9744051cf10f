//! Of all impulses that do the same to the bodies, those with the least sum of squares (theory (87)).
//!
//! Four points of a face make W singular: impulses move along its null space and no velocity changes. The start of a solve and the way that it takes decide where
//! it ends. A warm start hands them on from step to step, so that what each solve adds in the null space adds up, until two corners carry a whole box and its slipping about them is legal.
//!
//! ```text
//! least ½ Σ ‖r_c‖²/k_c  with  Jᵀ r = y:      r = k J z,   Jᵀ k J z = y      (conjugate gradients over the bodies, scaled by the diagonal)
//! ```
//!
//! Elastic bodies with the stiffness k_c at each contact have this answer in the limit of rigid ones. Contacts have the same, k = 1, and joints are much
//! stiffer: what a joint can carry at no cost must not draw impulses from one corner of a face to another.

use super::MatrixFree;
use super::matrix_free::NONE;
use crate::Cone;
use crate::block::{Vector, axpy};

/// What is left of Jᵀ r = y, relative, that a start may miss.
const ENOUGH: f64 = 1e-9;
/// What of a body's balance may be left where its impulses are to be an equilibrium, from which a solve then starts.
const BALANCED: f64 = 1e-7;
/// More steps are not taken: the start stays as it is.
const STEPS: usize = 200;
/// How much stiffer a joint is than a contact.
const STIFF: f64 = 1e4;
/// How often contacts that cannot follow are left out.
const ROUNDS: usize = 4;

/// How a contact stands before a solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It touches, and its bodies do not move there.
    Rests,
    /// It has a gap that stays as it is while its bodies do not move there: it carries nothing.
    Open,
    /// Its bodies move there.
    Moves,
}

/// Scratch of [`MatrixFree::least_start`].
#[derive(Clone, Debug, Default)]
pub struct Lightest<const D: usize, const N: usize> {
    /// k_c of each component; zero for what does not take part.
    stiffness: Vec<[f64; D]>,
    target: Vec<Vector<D>>,
    /// Bodies of which no equilibrium was found.
    moves: Vec<bool>,
    /// Contacts that were given the impulses of an equilibrium.
    balanced: Vec<bool>,
    z: Vec<[f64; N]>,
    left: Vec<[f64; N]>,
    /// 1 over the diagonal of Jᵀ k J, and the scaled left.
    inverse: Vec<[f64; N]>,
    scaled: Vec<[f64; N]>,
    way: Vec<[f64; N]>,
    image: Vec<[f64; N]>,
}

impl<const D: usize, const N: usize> MatrixFree<D, N> {
    /// Draws the impulses that a solve starts from to the least ones, at contacts that rest: with a `state` (velocities of the operator) to those of an
    /// equilibrium in which the bodies have it, where there is one; then, with a `part`, that part of the way to the least that do the same.
    pub fn least_start(
        &self,
        contacts: (&[Cone], &dyn Fn(usize) -> Standing),
        (state, part): (Option<&[[f64; N]]>, Option<f64>),
        r: &mut [Vector<D>],
        scratch: &mut Lightest<D, N>,
    ) {
        scratch.balanced.clear();
        scratch.balanced.resize(r.len(), false);
        if let Some(state) = state {
            self.balance(contacts, state, r, scratch);
        }
        if let Some(part) = part {
            self.lighten(contacts, part, r, scratch);
        }
    }

    /// Gives the contacts that rest the least impulses that hold their bodies, which then have this `state` (velocities of the operator), where
    /// no contact of bodies that touch moves and all those impulses are within their cones: an answer of the law with which nothing slips. Other contacts keep
    /// theirs.
    fn balance(
        &self,
        (cones, standing): (&[Cone], &dyn Fn(usize) -> Standing),
        state: &[[f64; N]],
        r: &mut [Vector<D>],
        scratch: &mut Lightest<D, N>,
    ) {
        scratch.stiffen(cones, standing);
        scratch.moves.clear();
        scratch.moves.resize(self.bodies(), false);
        for c in (0..r.len()).filter(|&c| standing(c) == Standing::Moves) {
            self.mark(c, &mut scratch.moves);
        }
        self.spread_moves(r.len(), &mut scratch.moves);
        let moves = scratch.moves.iter();
        scratch.left.clear();
        scratch.left.extend(state.iter().zip(moves).map(|(y, &moves)| if moves { [0.0; N] } else { *y }));
        for c in 0..r.len() {
            if self.is_marked(c, &scratch.moves) {
                scratch.stiffness[c] = [0.0; D];
            }
        }
        let size = |y: &[f64; N]| y.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let most = scratch.left.iter().map(size).fold(0.0, f64::max);
        // Where it does not end for all, it may have ended for some.
        self.least(r.len(), scratch);
        let Lightest { left, moves, inverse, .. } = &mut *scratch;
        for (moves, (left, inverse)) in moves.iter_mut().zip(left.iter().zip(inverse.iter())) {
            let touched = inverse.iter().any(|&x| x > 0.0);
            *moves |= touched && !left.iter().all(|x| x.abs() <= BALANCED * most);
        }
        let outside = |c: usize, target: &Vector<D>| match cones[c] {
            Cone::Bilateral { .. } => false,
            cone => !target.iter().all(|x| x.is_finite()) || cone.distance(target) > 0.0,
        };
        for c in 0..r.len() {
            if takes_part(&scratch.stiffness[c]) && outside(c, &scratch.target[c]) {
                self.mark(c, &mut scratch.moves);
            }
        }
        self.spread_moves(r.len(), &mut scratch.moves);
        for c in (0..r.len()).filter(|&c| !self.is_marked(c, &scratch.moves)) {
            // What is open and takes no part has a target of zero.
            (r[c], scratch.balanced[c]) = (scratch.target[c], true);
        }
    }

    /// Marks all bodies that touch a marked one at one of so many contacts.
    fn spread_moves(&self, contacts: usize, moves: &mut [bool]) {
        let mut changed = true;
        while changed {
            changed = false;
            for c in 0..contacts {
                let bodies = self.pair(c).into_iter().filter(|&body| body != NONE);
                let marked = bodies.clone().filter(|&body| moves[body as usize]).count();
                if marked > 0 && marked < bodies.count() {
                    self.mark(c, moves);
                    changed = true;
                }
            }
        }
    }

    fn mark(&self, c: usize, moves: &mut [bool]) {
        self.pair(c).into_iter().filter(|&body| body != NONE).for_each(|body| moves[body as usize] = true);
    }

    fn is_marked(&self, c: usize, moves: &[bool]) -> bool {
        self.pair(c).into_iter().any(|body| body != NONE && moves[body as usize])
    }

    /// Brings the impulses of the contacts that rest a `part` of the way to the least ones that do the same to the bodies. Impulses stay in their cones; contacts whose least impulse is
    /// outside keep theirs. Nothing changes where that cannot be found. What an equilibrium was found for is the least already, and touches nothing else that is free.
    fn lighten(
        &self,
        (cones, standing): (&[Cone], &dyn Fn(usize) -> Standing),
        part: f64,
        r: &mut [Vector<D>],
        scratch: &mut Lightest<D, N>,
    ) {
        scratch.stiffen(cones, standing);
        let balanced = scratch.balanced.iter();
        scratch.stiffness.iter_mut().zip(balanced).filter(|(_, balanced)| **balanced).for_each(|(k, _)| *k = [0.0; D]);
        if !scratch.stiffness.iter().any(takes_part) {
            return;
        }
        for _ in 0..ROUNDS {
            scratch.left.clear();
            scratch.left.resize(self.bodies(), [0.0; N]);
            self.gather(&scratch.stiffness, r, &mut scratch.left);
            if !self.least(r.len(), scratch) {
                return;
            }
            let Lightest { stiffness, target, .. } = scratch;
            let mut fits = true;
            for c in 0..r.len() {
                if takes_part(&stiffness[c]) && cones[c].distance(&target[c]) > 0.0 && !matches!(cones[c], Cone::Bilateral { .. })
                {
                    (stiffness[c], fits) = ([0.0; D], false);
                }
            }
            if fits {
                for c in (0..r.len()).filter(|&c| takes_part(&stiffness[c])) {
                    r[c] = std::array::from_fn(|i| r[c][i] + part * (target[c][i] - r[c][i]));
                }
                return;
            }
        }
    }

    /// Finds the least of `contacts` impulses that do to the bodies what is left; false where conjugate gradients do not end.
    fn least(&self, contacts: usize, scratch: &mut Lightest<D, N>) -> bool {
        let Lightest { stiffness, target, z, left, inverse, scaled, way, image, .. } = scratch;
        for list in [&mut *z, &mut *image, &mut *inverse, &mut *scaled] {
            list.clear();
            list.resize(self.bodies(), [0.0; N]);
        }
        target.clear();
        target.resize(contacts, [0.0; D]);
        self.diagonal(stiffness, inverse);
        scale(left, inverse, scaled);
        way.clone_from(scaled);
        let whole = product(left, scaled);
        let mut rest = whole;
        for _ in 0..STEPS {
            if rest <= ENOUGH * ENOUGH * whole {
                break;
            }
            self.spread(stiffness, way, target);
            image.fill([0.0; N]);
            self.gather(stiffness, target, image);
            let step = rest / product(way, image);
            if !step.is_finite() {
                break;
            }
            add(z, step, way);
            add(left, -step, image);
            scale(left, inverse, scaled);
            let next = product(left, scaled);
            let share = next / rest;
            rest = next;
            way.iter_mut().zip(scaled.iter()).for_each(|(way, scaled)| *way = axpy(scaled, share, way));
        }
        self.spread(stiffness, z, target);
        rest <= ENOUGH * ENOUGH * whole && target.as_flattened().iter().all(|x| x.is_finite())
    }

    /// y ← y + Jᵀ r over the contacts that take part.
    fn gather(&self, stiffness: &[[f64; D]], r: &[Vector<D>], y: &mut [[f64; N]]) {
        for c in (0..r.len()).filter(|&c| takes_part(&stiffness[c])) {
            for (rows, body) in self.rows(c).iter().zip(self.pair(c)).filter(|(_, body)| *body != NONE) {
                let y = &mut y[body as usize];
                (0..D).for_each(|i| *y = axpy(y, r[c][i], &rows[i]));
            }
        }
    }

    /// r = k J z at the contacts that take part.
    fn spread(&self, stiffness: &[[f64; D]], z: &[[f64; N]], r: &mut [Vector<D>]) {
        for c in (0..r.len()).filter(|&c| takes_part(&stiffness[c])) {
            r[c] = [0.0; D];
            for (rows, body) in self.rows(c).iter().zip(self.pair(c)).filter(|(_, body)| *body != NONE) {
                (0..D).for_each(|i| r[c][i] += stiffness[c][i] * crate::block::dot(&rows[i], &z[body as usize]));
            }
        }
    }

    /// 1 over the diagonal of Jᵀ k J, zero where that is.
    fn diagonal(&self, stiffness: &[[f64; D]], inverse: &mut [[f64; N]]) {
        for (c, k) in stiffness.iter().enumerate().filter(|(_, k)| takes_part(k)) {
            for (rows, body) in self.rows(c).iter().zip(self.pair(c)).filter(|(_, body)| *body != NONE) {
                let sum = &mut inverse[body as usize];
                rows.iter().zip(k).for_each(|(row, k)| *sum = std::array::from_fn(|j| sum[j] + k * row[j] * row[j]));
            }
        }
        inverse.as_flattened_mut().iter_mut().filter(|x| **x > 0.0).for_each(|x| *x = 1.0 / *x);
    }
}

impl<const D: usize, const N: usize> Lightest<D, N> {
    /// k_c of the contacts that rest.
    fn stiffen(&mut self, cones: &[Cone], standing: &dyn Fn(usize) -> Standing) {
        let stiff = |c: usize| if matches!(cones[c], Cone::Bilateral { .. }) { STIFF } else { 1.0 };
        let stiffness =
            |c: usize| std::array::from_fn(|i| if standing(c) == Standing::Rests && cones[c].binds(i) { stiff(c) } else { 0.0 });
        self.stiffness.clear();
        self.stiffness.extend((0..cones.len()).map(stiffness));
    }
}

/// True if impulses of a contact of this stiffness may change.
fn takes_part<const D: usize>(stiffness: &[f64; D]) -> bool {
    stiffness.iter().any(|&k| k > 0.0)
}

/// out = a times b, number by number.
fn scale<const N: usize>(a: &[[f64; N]], b: &[[f64; N]], out: &mut [[f64; N]]) {
    let factors = a.as_flattened().iter().zip(b.as_flattened());
    out.as_flattened_mut().iter_mut().zip(factors).for_each(|(out, (a, b))| *out = a * b);
}

fn product<const N: usize>(a: &[[f64; N]], b: &[[f64; N]]) -> f64 {
    a.as_flattened().iter().zip(b.as_flattened()).map(|(a, b)| a * b).sum()
}

/// a ← a + s b.
fn add<const N: usize>(a: &mut [[f64; N]], s: f64, b: &[[f64; N]]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a = axpy(a, s, b));
}
