//! W through the bodies: never formed, one contact touches two bodies.

use super::{Add, Delassus, Operator, Root, Visit, colouring};
use crate::block::{Matrix, Vector};
use std::borrow::Cow;

/// In place of a body that impulses do not move.
pub const NONE: u32 = u32::MAX;

/// W = J Jᵀ with J = H* M^{-1/2}, a row of two blocks a contact.
///
/// Weighing by M^{-1/2} makes the two directions of the local-global map the same numbers: the state is y = M^{1/2} (v − v_free), a
/// contact reads J_a y_a + J_b y_b and writes y += Jᵀ Δr, and no mass is looked up in a sweep.
#[derive(Clone, Debug, Default)]
pub struct MatrixFree<const D: usize, const N: usize> {
    bodies: usize,
    contacts: Vec<Contact<D, N>>,
}

/// All that a visit reads of a contact, side by side.
#[derive(Clone, Copy, Debug)]
struct Contact<const D: usize, const N: usize> {
    pair: [u32; 2],
    rows: [[[f64; N]; D]; 2],
    diagonal: Matrix<D>,
}

impl<const D: usize, const N: usize> MatrixFree<D, N> {
    /// Empties it, for `bodies` bodies, keeping the memory.
    pub fn clear(&mut self, bodies: usize) {
        self.bodies = bodies;
        self.contacts.clear();
    }

    /// Adds the contact of `pair` (indices below the number of bodies, or [`NONE`]) with the two blocks of its row of J.
    pub fn push(&mut self, pair: [u32; 2], rows: [[[f64; N]; D]; 2]) {
        debug_assert!(pair.iter().all(|&b| b == NONE || (b as usize) < self.bodies));
        let counts = pair.map(|b| f64::from(u8::from(b != NONE)));
        let block = |i: usize, j: usize| (0..2).map(|side| counts[side] * dot(&rows[side][i], &rows[side][j])).sum();
        let diagonal = std::array::from_fn(|i| std::array::from_fn(|j| block(i, j)));
        self.contacts.push(Contact { pair, rows, diagonal });
    }

    /// How many contacts it has.
    pub fn len(&self) -> usize {
        self.contacts.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.contacts.is_empty()
    }

    /// The contacts of each body, in order.
    pub(super) fn contacts_of_bodies(&self) -> Vec<Vec<u32>> {
        let mut of = vec![Vec::new(); self.bodies];
        for (c, contact) in (0..).zip(&self.contacts) {
            let [a, b] = contact.pair;
            let twice = if a == b { NONE } else { b };
            for body in [a, twice].into_iter().filter(|&body| body != NONE) {
                of[body as usize].push(c);
            }
        }
        of
    }

    /// How many bodies there are.
    pub(super) fn bodies(&self) -> usize {
        self.bodies
    }

    /// The two blocks of a contact's row of J.
    pub(super) fn rows(&self, c: usize) -> &[[[f64; N]; D]; 2] {
        &self.contacts[c].rows
    }

    /// The bodies of a contact, [`NONE`] in place of one that impulses do not move.
    pub(super) fn pair(&self, c: usize) -> [u32; 2] {
        self.contacts[c].pair
    }

    /// The block W_cd, for those who want it stored.
    pub(super) fn block(&self, c: usize, d: usize) -> Option<Matrix<D>> {
        let (one, two) = (&self.contacts[c], &self.contacts[d]);
        let mut sum = [[0.0; D]; D];
        let mut shared = false;
        for (rows, &body) in one.rows.iter().zip(&one.pair) {
            for (others, &other) in two.rows.iter().zip(&two.pair) {
                if body == NONE || body != other {
                    continue;
                }
                shared = true;
                for i in 0..D {
                    for j in 0..D {
                        sum[i][j] += dot(&rows[i], &others[j]);
                    }
                }
            }
        }
        shared.then_some(sum)
    }
}

/// The state of a body, zero for [`NONE`].
#[inline(always)]
fn read<const N: usize>(state: &[[f64; N]], body: u32) -> [f64; N] {
    if body == NONE { [0.0; N] } else { state[body as usize] }
}

/// Rows times the states of the two bodies.
#[inline(always)]
fn relative<const D: usize, const N: usize>(rows: &[[[f64; N]; D]; 2], y: &[[f64; N]; 2]) -> Vector<D> {
    std::array::from_fn(|i| dot(&rows[0][i], &y[0]) + dot(&rows[1][i], &y[1]))
}

/// Writes y + Jᵀ Δr, whole: the next visit reads it in the same pieces, straight from the store buffer.
#[inline(always)]
fn write<const D: usize, const N: usize>(
    state: &mut [[f64; N]],
    body: u32,
    y: &[f64; N],
    rows: &[[f64; N]; D],
    change: &Vector<D>,
) {
    if body != NONE {
        state[body as usize] = std::array::from_fn(|k| {
            let mut sum = y[k];
            for i in 0..D {
                sum += rows[i][k] * change[i];
            }
            sum
        });
    }
}

impl<const D: usize, const N: usize> Operator<D> for MatrixFree<D, N> {
    type State = Vec<[f64; N]>;

    fn start(&self, r: &[Vector<D>], state: &mut Self::State) {
        state.clear();
        state.resize(self.bodies, [0.0; N]);
        for (c, r) in r.iter().enumerate() {
            self.relax(state, c, Add(r));
        }
    }

    #[inline]
    fn diagonal(&self, c: usize) -> Matrix<D> {
        self.contacts[c].diagonal
    }

    #[inline]
    fn apply(&self, state: &Self::State, c: usize) -> Vector<D> {
        let Contact { pair, rows, .. } = &self.contacts[c];
        relative(rows, &[read(state, pair[0]), read(state, pair[1])])
    }

    fn extrapolate(&self, state: &mut Self::State, previous: &Self::State, beta: f64) {
        super::extrapolate(state, previous, beta);
    }

    fn stored(&self) -> Cow<'_, Delassus<D>> {
        Cow::Owned(Delassus::assemble(self))
    }

    fn root(&self) -> Option<Root> {
        let mut entries = Vec::with_capacity(2 * D * N * self.contacts.len());
        for (c, contact) in self.contacts.iter().enumerate() {
            for (&body, rows) in contact.pair.iter().zip(&contact.rows).filter(|(body, _)| **body != NONE) {
                let entry = |(i, k): (usize, usize)| (c * D + i, body as usize * N + k, rows[i][k]);
                entries.extend((0..D * N).map(|place| entry((place / N, place % N))).filter(|(.., x)| *x != 0.0));
            }
        }
        Some(Root { columns: self.bodies * N, entries })
    }

    fn colour(&self, order: &mut [u32]) {
        colouring::sort(self.bodies, self.contacts.iter().map(|contact| contact.pair), order);
    }

    #[inline(always)]
    fn relax(&self, state: &mut Self::State, c: usize, visit: impl Visit<D>) {
        let state = state.as_mut_slice();
        let Contact { pair, rows, diagonal } = &self.contacts[c];
        let y = [read(state, pair[0]), read(state, pair[1])];
        let change = visit.change(diagonal, relative(rows, &y));
        // Looking first pays twice: nothing is written, and the next visit need not wait for it.
        if change != [0.0; D] {
            write(state, pair[0], &y[0], &rows[0], &change);
            write(state, pair[1], &y[1], &rows[1], &change);
        }
    }
}

/// a · b with even and odd terms summed apart: half the additions to wait for, and a shape that processors have registers for.
#[inline(always)]
fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let mut sums = [0.0; 2];
    for k in 0..N {
        sums[k % 2] = if k < 2 { a[k] * b[k] } else { sums[k % 2] + a[k] * b[k] };
    }
    sums[0] + sums[1]
}
