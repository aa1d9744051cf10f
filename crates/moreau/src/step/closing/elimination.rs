//! Sparse block elimination for the equations of the joints: A x = b with one D×D block a pair of joint blocks that share a free body.
//!
//! The pattern of A is symmetric and depends on the joints alone, so the order of the pivots (minimum degree) and the fill-in are found once and kept
//! while the same joints are there. A chain, or any tree of bodies with few joints each, has no fill-in: n joints cost O(n).
//!
//! ```text
//! for each pivot k in order:   for its later neighbours i, j:   A_ij ← A_ij − A_ik A_kk⁺ A_kj
//! ```
//!
//! A_kk⁺ inverts A_kk on the rows that are left. A row whose pivot is rounding is dropped: the rows before hold what it holds, as in a closed loop of
//! hinges in space. Pivots are taken from the diagonal, which is right for a matrix near a symmetric positive semidefinite one. All runs in one thread and in
//! one order.

use moreau_solve::block::{Matrix, Vector, mul, sub};
use std::collections::BTreeSet;

/// The part of the diagonal of A below which a pivot is rounding.
const DROPPED: f64 = 1e-12;

/// Pairs of neighbours, over all pivots, above which the factors are too large to be of use.
const MOST_PAIRS: usize = 2_000_000;

/// One off-diagonal pair of blocks: `to` is the later pivot.
#[derive(Clone, Copy, Debug)]
struct Pair<const D: usize> {
    to: usize,
    /// A_(from, to) and A_(to, from).
    upper: Matrix<D>,
    lower: Matrix<D>,
}

/// The matrix, and then its factors.
#[derive(Clone, Debug, Default)]
pub(in crate::step) struct Elimination<const D: usize> {
    /// What the pattern was made for: the free bodies of each block.
    pattern: Vec<[Option<usize>; 2]>,
    /// Whether the factors are small enough.
    fits: bool,
    /// The block of each pivot.
    order: Vec<usize>,
    /// The later neighbours of pivot k are `pairs[first[k]..first[k + 1]]`, sorted.
    first: Vec<usize>,
    pairs: Vec<Pair<D>>,
    diagonal: Vec<Matrix<D>>,
    /// The diagonal of A before the elimination.
    size: Vec<Vector<D>>,
    side: Vec<Vector<D>>,
}

impl<const D: usize> Elimination<D> {
    /// Prepares the pattern of blocks with these free bodies; false if its factors would be too large.
    pub(in crate::step) fn prepare(&mut self, bodies: impl Iterator<Item = [Option<usize>; 2]> + Clone) -> bool {
        if !bodies.clone().eq(self.pattern.iter().copied()) {
            self.pattern = bodies.collect();
            self.analyse();
        }
        self.fits
    }

    /// Finds the order of the pivots and the fill-in.
    fn analyse(&mut self) {
        let n = self.pattern.len();
        let mut near = neighbours(&self.pattern);
        let mut waiting: BTreeSet<(usize, usize)> = (0..n).map(|block| (near[block].len(), block)).collect();
        let mut later: Vec<Vec<usize>> = Vec::with_capacity(n);
        self.order.clear();
        let mut work = 0;
        while let Some((degree, block)) = waiting.pop_first() {
            work += degree * degree;
            if work > MOST_PAIRS {
                break;
            }
            let around = std::mem::take(&mut near[block]);
            for &one in &around {
                waiting.remove(&(near[one].len(), one));
                near[one].remove(&block);
                near[one].extend(around.iter().filter(|&&other| other != one));
                waiting.insert((near[one].len(), one));
            }
            self.order.push(block);
            later.push(around.into_iter().collect());
        }
        self.fits = work <= MOST_PAIRS;
        if self.fits {
            self.store(later);
        }
    }

    /// Lays out the pairs by pivots.
    fn store(&mut self, later: Vec<Vec<usize>>) {
        let n = self.order.len();
        let mut place = vec![0; n];
        self.order.iter().enumerate().for_each(|(k, &block)| place[block] = k);
        let zero = [[0.0; D]; D];
        (self.first, self.pairs) = (vec![0], Vec::new());
        for blocks in later {
            let mut to: Vec<usize> = blocks.into_iter().map(|block| place[block]).collect();
            to.sort_unstable();
            self.pairs.extend(to.into_iter().map(|to| Pair { to, upper: zero, lower: zero }));
            self.first.push(self.pairs.len());
        }
        self.diagonal = vec![zero; n];
        self.size = vec![[0.0; D]; n];
        self.side = vec![[0.0; D]; n];
    }

    /// Fills the matrix with the blocks that `block(i, j)` gives, zeros where i and j share no body, and eliminates.
    pub(in crate::step) fn factorise(&mut self, block: impl Fn(usize, usize) -> Matrix<D>) {
        for k in 0..self.order.len() {
            let i = self.order[k];
            self.diagonal[k] = block(i, i);
            self.size[k] = std::array::from_fn(|c| self.diagonal[k][c][c].abs());
            for pair in &mut self.pairs[self.first[k]..self.first[k + 1]] {
                let j = self.order[pair.to];
                (pair.upper, pair.lower) = (block(i, j), block(j, i));
            }
        }
        for k in 0..self.order.len() {
            self.diagonal[k] = inverse(&self.diagonal[k], &self.size[k]);
            for p in self.first[k]..self.first[k + 1] {
                let Pair { to, lower, .. } = self.pairs[p];
                let factor = times(&lower, &self.diagonal[k]);
                for q in self.first[k]..self.first[k + 1] {
                    let Pair { to: other, upper, .. } = self.pairs[q];
                    let product = times(&factor, &upper);
                    let target = self.entry(to, other);
                    *target = std::array::from_fn(|c| sub(&target[c], &product[c]));
                }
            }
        }
    }

    /// The entry of the rows of pivot `i` and the columns of pivot `j`, which is stored.
    fn entry(&mut self, i: usize, j: usize) -> &mut Matrix<D> {
        if i == j {
            return &mut self.diagonal[i];
        }
        let (low, high) = (i.min(j), i.max(j));
        let begin = self.first[low];
        let at = self.pairs[begin..self.first[low + 1]].partition_point(|pair| pair.to < high);
        let pair = &mut self.pairs[begin + at];
        if i < j { &mut pair.upper } else { &mut pair.lower }
    }

    /// Solves for the right side that `b` gives; zeros in rows that were dropped.
    pub(in crate::step) fn solve(&mut self, b: impl Fn(usize) -> Vector<D>) {
        for k in 0..self.order.len() {
            self.side[k] = b(self.order[k]);
        }
        for k in 0..self.order.len() {
            self.side[k] = mul(&self.diagonal[k], &self.side[k]);
            for Pair { to, lower, .. } in &self.pairs[self.first[k]..self.first[k + 1]] {
                self.side[*to] = sub(&self.side[*to], &mul(lower, &self.side[k]));
            }
        }
        for k in (0..self.order.len()).rev() {
            let mut sum = [0.0; D];
            for Pair { to, upper, .. } in &self.pairs[self.first[k]..self.first[k + 1]] {
                sum = sub(&sum, &mul(upper, &self.side[*to]));
            }
            let change = mul(&self.diagonal[k], &sum);
            self.side[k] = std::array::from_fn(|c| self.side[k][c] + change[c]);
        }
    }

    /// The blocks with what was found for each.
    pub(in crate::step) fn answer(&self) -> impl Iterator<Item = (usize, &Vector<D>)> {
        self.order.iter().copied().zip(&self.side)
    }
}

/// The blocks that share a free body with each block.
fn neighbours(pattern: &[[Option<usize>; 2]]) -> Vec<BTreeSet<usize>> {
    let mut near = vec![BTreeSet::new(); pattern.len()];
    let mut of_bodies: Vec<(usize, usize)> =
        pattern.iter().enumerate().flat_map(|(block, bodies)| bodies.iter().flatten().map(move |&body| (body, block))).collect();
    of_bodies.sort_unstable();
    for group in of_bodies.chunk_by(|a, b| a.0 == b.0) {
        for &(_, block) in group {
            near[block].extend(group.iter().map(|&(_, other)| other).filter(|&other| other != block));
        }
    }
    near
}

fn times<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..D).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The inverse of the rows and columns whose pivots are more than rounding of `size`; zeros in the others.
fn inverse<const D: usize>(a: &Matrix<D>, size: &Vector<D>) -> Matrix<D> {
    let (mut m, mut taken) = (*a, [false; D]);
    for _ in 0..D {
        let part = |i: usize| m[i][i].abs() / size[i];
        let usable = |&i: &usize| !taken[i] && size[i] > 0.0 && part(i) > DROPPED;
        let Some(p) = (0..D).filter(usable).max_by(|&i, &j| part(i).total_cmp(&part(j))) else { break };
        taken[p] = true;
        let pivot = 1.0 / m[p][p];
        m[p][p] = 1.0;
        m[p] = m[p].map(|x| x * pivot);
        for i in (0..D).filter(|&i| i != p) {
            let factor = m[i][p];
            m[i][p] = 0.0;
            m[i] = std::array::from_fn(|j| m[i][j] - factor * m[p][j]);
        }
    }
    std::array::from_fn(|i| std::array::from_fn(|j| if taken[i] && taken[j] { m[i][j] } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Entries that are the same in each run, between −1 and 1.
    fn entry(i: usize, j: usize, a: usize, b: usize) -> f64 {
        let n = (i * 7919 + j * 104_729 + a * 1299 + b * 15_485) % 1009;
        n as f64 / 504.5 - 1.0
    }

    fn check(pattern: &[[Option<usize>; 2]]) {
        let shares = |i: usize, j: usize| pattern[i].iter().flatten().any(|body| pattern[j].contains(&Some(*body)));
        let block = |i: usize, j: usize| -> Matrix<2> {
            let on = if i == j { 6.0 } else { 0.0 };
            let value = |a: usize, b: usize| entry(i, j, a, b) + if a == b { on } else { 0.0 };
            std::array::from_fn(|a| std::array::from_fn(|b| if shares(i, j) { value(a, b) } else { 0.0 }))
        };
        let known = |i: usize| [1.0 + i as f64, -0.5 * i as f64];
        let side = |i: usize| {
            (0..pattern.len()).fold([0.0; 2], |sum, j| {
                let product = mul(&block(i, j), &known(j));
                [sum[0] + product[0], sum[1] + product[1]]
            })
        };
        let mut elimination = Elimination::default();
        assert!(elimination.prepare(pattern.iter().copied()));
        elimination.factorise(block);
        elimination.solve(side);
        let found: Vec<_> = elimination.answer().collect();
        assert_eq!(found.len(), pattern.len());
        for (i, x) in found {
            let wanted = known(i);
            assert!((x[0] - wanted[0]).abs() < 1e-12 && (x[1] - wanted[1]).abs() < 1e-12, "{i}: {x:?} is not {wanted:?}");
        }
    }

    #[test]
    fn chains_loops_and_hubs_are_solved() {
        let chain: Vec<_> = (0..9).map(|i| [(i > 0).then_some(i), Some(i + 1)]).collect();
        check(&chain);
        let ring: Vec<_> = (0..7).map(|i| [Some(i), Some((i + 1) % 7)]).collect();
        check(&ring);
        let hub: Vec<_> = (0..6).map(|i| [Some(0), Some(i + 1)]).collect();
        check(&hub);
        check(&[[Some(3), None]]);
    }

    /// The same rows twice: one of them is dropped, and the answer still obeys both.
    #[test]
    fn a_row_that_others_hold_is_dropped() {
        let mut elimination = Elimination::<1>::default();
        assert!(elimination.prepare([[Some(0), None]; 2].into_iter()));
        elimination.factorise(|_, _| [[2.0]]);
        elimination.solve(|_| [3.0]);
        let sum: f64 = elimination.answer().map(|(_, x)| x[0]).sum();
        assert!((sum - 1.5).abs() < 1e-15, "{sum}");
    }
}
