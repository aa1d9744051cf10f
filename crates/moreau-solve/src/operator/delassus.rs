//! W stored by rows of blocks: for problems that come without bodies, and to check the matrix-free operator.

use super::{MatrixFree, Operator};
use crate::block::{Matrix, Vector, mul};

/// W in compressed rows of D×D blocks.
#[derive(Clone, Debug, Default)]
pub struct Delassus<const D: usize> {
    starts: Vec<usize>,
    columns: Vec<usize>,
    blocks: Vec<Matrix<D>>,
    diagonal: Vec<Matrix<D>>,
}

impl<const D: usize> Delassus<D> {
    /// From all blocks, `blocks[c][d]` = W_cd; a missing diagonal block counts as zero.
    pub fn dense(blocks: &[Vec<Matrix<D>>]) -> Self {
        Self::from_blocks(blocks.len(), |c, d| blocks[c].get(d).copied())
    }

    /// The same operator as `other`, stored.
    pub fn assemble<const N: usize>(other: &MatrixFree<D, N>) -> Self {
        Self::from_blocks(other.len(), |c, d| other.block(c, d))
    }

    fn from_blocks(contacts: usize, block: impl Fn(usize, usize) -> Option<Matrix<D>>) -> Self {
        let mut stored = Self { starts: vec![0], ..Self::default() };
        for c in 0..contacts {
            for d in 0..contacts {
                if let Some(w) = block(c, d) {
                    stored.columns.push(d);
                    stored.blocks.push(w);
                }
            }
            stored.starts.push(stored.columns.len());
            stored.diagonal.push(block(c, c).unwrap_or([[0.0; D]; D]));
        }
        stored
    }
}

impl<const D: usize> Operator<D> for Delassus<D> {
    type State = Vec<Vector<D>>;

    fn start(&self, r: &[Vector<D>], state: &mut Self::State) {
        state.clear();
        state.extend_from_slice(r);
    }

    fn diagonal(&self, c: usize) -> &Matrix<D> {
        &self.diagonal[c]
    }

    fn apply(&self, state: &Self::State, c: usize) -> Vector<D> {
        let mut u = [0.0; D];
        for k in self.starts[c]..self.starts[c + 1] {
            let part = mul(&self.blocks[k], &state[self.columns[k]]);
            for i in 0..D {
                u[i] += part[i];
            }
        }
        u
    }

    fn relax(&self, state: &mut Self::State, c: usize, visit: impl FnOnce(&Matrix<D>, Vector<D>) -> Vector<D>) {
        let change = visit(&self.diagonal[c], self.apply(state, c));
        for i in 0..D {
            state[c][i] += change[i];
        }
    }
}
