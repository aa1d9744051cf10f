//! W through the bodies: never formed, one contact touches two bodies.

use super::Operator;
use crate::block::{Matrix, Vector, dot};

/// In place of a body that impulses do not move.
pub const NONE: u32 = u32::MAX;

/// W = J Jᵀ with J = H* M^{-1/2}, a row of two blocks a contact.
///
/// Weighing by M^{-1/2} makes the two directions of the local-global map the same numbers: the state is y = M^{1/2} (v − v_free), a
/// contact reads J_a y_a + J_b y_b and writes y += Jᵀ Δr, and no mass is looked up in a sweep.
#[derive(Clone, Debug, Default)]
pub struct MatrixFree<const D: usize, const N: usize> {
    bodies: usize,
    pairs: Vec<[u32; 2]>,
    rows: Vec<[[[f64; N]; D]; 2]>,
    diagonal: Vec<Matrix<D>>,
}

impl<const D: usize, const N: usize> MatrixFree<D, N> {
    /// Empties it, for `bodies` bodies, keeping the memory.
    pub fn clear(&mut self, bodies: usize) {
        self.bodies = bodies;
        self.pairs.clear();
        self.rows.clear();
        self.diagonal.clear();
    }

    /// Adds the contact of `pair` (indices below the number of bodies, or [`NONE`]) with the two blocks of its row of J.
    pub fn push(&mut self, pair: [u32; 2], rows: [[[f64; N]; D]; 2]) {
        debug_assert!(pair.iter().all(|&b| b == NONE || (b as usize) < self.bodies));
        let counts = pair.map(|b| f64::from(u8::from(b != NONE)));
        let block = |i: usize, j: usize| (0..2).map(|side| counts[side] * dot(&rows[side][i], &rows[side][j])).sum();
        self.diagonal.push(std::array::from_fn(|i| std::array::from_fn(|j| block(i, j))));
        self.pairs.push(pair);
        self.rows.push(rows);
    }

    /// The two bodies of contact `c`.
    pub fn pair(&self, c: usize) -> [u32; 2] {
        self.pairs[c]
    }

    /// How many contacts it has.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// The block W_cd, for those who want it stored.
    pub(super) fn block(&self, c: usize, d: usize) -> Option<Matrix<D>> {
        let mut sum = [[0.0; D]; D];
        let mut shared = false;
        for (side_c, &body) in self.pairs[c].iter().enumerate() {
            for (side_d, &other) in self.pairs[d].iter().enumerate() {
                if body == NONE || body != other {
                    continue;
                }
                shared = true;
                for i in 0..D {
                    for j in 0..D {
                        sum[i][j] += dot(&self.rows[c][side_c][i], &self.rows[d][side_d][j]);
                    }
                }
            }
        }
        shared.then_some(sum)
    }
}

impl<const D: usize, const N: usize> Operator<D> for MatrixFree<D, N> {
    type State = Vec<[f64; N]>;

    fn start(&self, r: &[Vector<D>], state: &mut Self::State) {
        state.clear();
        state.resize(self.bodies, [0.0; N]);
        for (c, r) in r.iter().enumerate() {
            self.add(state, c, r);
        }
    }

    #[inline]
    fn diagonal(&self, c: usize) -> &Matrix<D> {
        &self.diagonal[c]
    }

    #[inline]
    fn apply(&self, state: &Self::State, c: usize) -> Vector<D> {
        let mut u = [0.0; D];
        for (row, &body) in self.rows[c].iter().zip(&self.pairs[c]) {
            if body != NONE {
                let y = &state[body as usize];
                for i in 0..D {
                    u[i] += dot(&row[i], y);
                }
            }
        }
        u
    }

    #[inline]
    fn add(&self, state: &mut Self::State, c: usize, change: &Vector<D>) {
        for (row, &body) in self.rows[c].iter().zip(&self.pairs[c]) {
            if body != NONE {
                let y = &mut state[body as usize];
                for k in 0..N {
                    for i in 0..D {
                        y[k] += row[i][k] * change[i];
                    }
                }
            }
        }
    }
}
