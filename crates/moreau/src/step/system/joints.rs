//! Joints' blocks behind the contacts of the full system.

use super::System;
use crate::bodies::Bodies;
use crate::space::Space;
use crate::step::joints::Block;
use moreau_solve::operator::NONE;
use moreau_solve::{Cone, MatrixFree, Problem};

impl<S: Space<D, N>, const D: usize, const N: usize> System<MatrixFree<D, N>, S, D, N, D> {
    /// Adds the blocks to the contacts that fill the system.
    pub(in crate::step) fn join(&mut self, bodies: &Bodies<S, D, N>, blocks: &[Block<D, N>]) {
        for block in blocks {
            let free = |side: usize| block.bodies[side].filter(|&body| bodies.is_free(body));
            let weighed = [0, 1].map(|side| {
                let root = free(side).map_or([0.0; N], |body| bodies.root_inverse_mass[body]);
                block.rows[side].map(|row| std::array::from_fn(|k| row[k] * root[k]))
            });
            self.operator.push([0, 1].map(|side| free(side).map_or(NONE, |body| body as u32)), weighed);
            self.q.push(std::array::from_fn(|i| block.after[i] + block.shift[i]));
            self.cones.push(Cone::Bilateral { held: block.held });
            self.r.push(block.impulse);
        }
    }

    /// Puts the shifts of the blocks in the place of those that it had.
    pub(in crate::step) fn shift(&mut self, blocks: &[Block<D, N>]) {
        let first = self.q.len() - blocks.len();
        for (q, block) in self.q[first..].iter_mut().zip(blocks) {
            *q = std::array::from_fn(|i| block.after[i] + block.shift[i]);
        }
    }

    /// Gives the blocks their impulses and their velocities, without the shifts.
    pub(in crate::step) fn answer_joints(&self, blocks: &mut [Block<D, N>]) {
        let problem = Problem { operator: &self.operator, q: &self.q, cones: &self.cones };
        let first = self.q.len() - blocks.len();
        for (block, c) in blocks.iter_mut().zip(first..) {
            let u = problem.velocity(self.scratch.state(), c);
            block.impulse = self.r[c];
            block.after = std::array::from_fn(|i| u[i] - block.shift[i]);
        }
    }
}
