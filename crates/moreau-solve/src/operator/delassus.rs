//! W stored by rows of blocks: for problems that come without bodies, and to check the matrix-free operator.

use super::{MatrixFree, NONE, Operator, Visit};
use crate::block::{Matrix, Vector, mul};
use std::borrow::Cow;

/// W in compressed rows of D×D blocks.
#[derive(Clone, Debug, Default)]
pub struct Delassus<const D: usize> {
    starts: Vec<usize>,
    columns: Vec<u32>,
    blocks: Vec<Matrix<D>>,
    diagonal: Vec<Matrix<D>>,
}

impl<const D: usize> Delassus<D> {
    /// From all blocks, `blocks[c][d]` = W_cd; a missing diagonal block counts as zero.
    pub fn dense(blocks: &[Vec<Matrix<D>>]) -> Self {
        Self::from_blocks(blocks.len(), |c| (0..blocks[c].len()).collect(), |c, d| blocks[c].get(d).copied())
    }

    /// The same operator as `other`, stored.
    pub fn assemble<const N: usize>(other: &MatrixFree<D, N>) -> Self {
        let of_bodies = other.contacts_of_bodies();
        let neighbours = |c: usize| {
            let bodies = other.pair(c).into_iter().filter(|&body| body != NONE);
            let mut all: Vec<usize> = bodies.flat_map(|body| &of_bodies[body as usize]).map(|&d| d as usize).collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        Self::from_blocks(other.len(), neighbours, |c, d| other.block(c, d))
    }

    /// From entries (row, column, value) of W in any order, `contacts` · D rows of them; entries at one place are added, those outside
    /// are left out. A block is stored where it has an entry. Linear in entries and contacts.
    pub fn from_entries(contacts: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let entries: Vec<_> = entries.filter(|&(i, j, _)| i / D < contacts && j / D < contacts).collect();
        let mut next = vec![0; contacts + 1];
        for (i, ..) in &entries {
            next[i / D + 1] += 1;
        }
        for c in 0..contacts {
            next[c + 1] += next[c];
        }
        let ends = next[1..].to_vec();
        let mut by_row = vec![(0, 0, 0.0); entries.len()];
        for entry in entries {
            by_row[next[entry.0 / D]] = entry;
            next[entry.0 / D] += 1;
        }
        let mut stored = Self { starts: vec![0], diagonal: vec![[[0.0; D]; D]; contacts], ..Self::default() };
        // Where the block in column d of the current row is; what is before the row's start is an earlier row's.
        let mut place = vec![usize::MAX; contacts];
        let mut begin = 0;
        for (c, &end) in ends.iter().enumerate() {
            stored.push_row(c, &by_row[begin..end], &mut place);
            begin = end;
        }
        stored
    }

    /// Adds the row c of blocks that these entries make up.
    fn push_row(&mut self, c: usize, entries: &[(usize, usize, f64)], place: &mut [usize]) {
        let start = self.columns.len();
        for &(_, j, _) in entries {
            let d = j / D;
            if place[d] == usize::MAX || place[d] < start {
                place[d] = self.columns.len();
                self.columns.push(d as u32);
            }
        }
        self.columns[start..].sort_unstable();
        for k in start..self.columns.len() {
            place[self.columns[k] as usize] = k;
        }
        self.blocks.resize(self.columns.len(), [[0.0; D]; D]);
        for &(i, j, value) in entries {
            self.blocks[place[j / D]][i % D][j % D] += value;
        }
        if place[c] != usize::MAX && place[c] >= start {
            self.diagonal[c] = self.blocks[place[c]];
        }
        self.starts.push(self.columns.len());
    }

    fn from_blocks(
        contacts: usize,
        neighbours: impl Fn(usize) -> Vec<usize>,
        block: impl Fn(usize, usize) -> Option<Matrix<D>>,
    ) -> Self {
        let mut stored = Self { starts: vec![0], ..Self::default() };
        for c in 0..contacts {
            for d in neighbours(c) {
                if let Some(w) = block(c, d) {
                    stored.columns.push(d as u32);
                    stored.blocks.push(w);
                }
            }
            stored.starts.push(stored.columns.len());
            stored.diagonal.push(block(c, c).unwrap_or([[0.0; D]; D]));
        }
        stored
    }
}

impl<const D: usize> Delassus<D> {
    /// How many contacts it has.
    pub fn len(&self) -> usize {
        self.diagonal.len()
    }

    /// Whether it has none.
    pub fn is_empty(&self) -> bool {
        self.diagonal.is_empty()
    }

    /// The blocks that are stored, by rows: c, d and W_cd.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, usize, &Matrix<D>)> {
        (0..self.len()).flat_map(|c| self.row(c).map(move |(d, block)| (c, d, block)))
    }

    /// The blocks of row c, each with its column.
    pub fn row(&self, c: usize) -> impl Iterator<Item = (usize, &Matrix<D>)> {
        let range = self.starts[c]..self.starts[c + 1];
        self.columns[range.clone()].iter().map(|&d| d as usize).zip(&self.blocks[range])
    }
}

impl<const D: usize> Operator<D> for Delassus<D> {
    type State = Vec<Vector<D>>;

    fn start(&self, r: &[Vector<D>], state: &mut Self::State) {
        state.clear();
        state.extend_from_slice(r);
    }

    fn diagonal(&self, c: usize) -> Matrix<D> {
        self.diagonal[c]
    }

    fn apply(&self, state: &Self::State, c: usize) -> Vector<D> {
        let mut u = [0.0; D];
        for (d, w) in self.row(c) {
            let part = mul(w, &state[d]);
            for i in 0..D {
                u[i] += part[i];
            }
        }
        u
    }

    fn extrapolate(&self, state: &mut Self::State, previous: &Self::State, beta: f64) {
        super::extrapolate(state, previous, beta);
    }

    fn stored(&self) -> Cow<'_, Delassus<D>> {
        Cow::Borrowed(self)
    }

    fn relax(&self, state: &mut Self::State, c: usize, visit: impl Visit<D>) {
        let change = visit.change(&self.diagonal[c], self.apply(state, c));
        for i in 0..D {
            state[c][i] += change[i];
        }
    }
}
