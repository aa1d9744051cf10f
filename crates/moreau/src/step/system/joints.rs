//! Joints' blocks behind the contacts of the full system.

use super::System;
use super::operators::Assembled;
use crate::bodies::Bodies;
use crate::space::{Pose, Space};
use crate::step::joints::{Block, StepJoints};
use moreau_solve::operator::{Lightest, NONE, Standing};
use moreau_solve::{Cone, MatrixFree, Operator, Problem, Residual};

impl<S: Space<D, N>, const D: usize, const N: usize> System<MatrixFree<D, N>, S, D, N, D> {
    /// Draws the impulses to start from to the least ones; see [`MatrixFree::least_start`].
    pub(in crate::step) fn least_start(
        &mut self,
        standing: &dyn Fn(usize) -> Standing,
        ways: (Option<&[[f64; N]]>, Option<f64>),
        scratch: &mut Lightest<D, N>,
    ) {
        self.operator.least_start((&self.cones, standing), ways, &mut self.r, scratch);
    }

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

    /// Gives the blocks their current impulses, and adds what all impulses do to the velocities.
    pub(in crate::step) fn carry(
        &self,
        bodies: &Bodies<S, D, N>,
        middle: &[Pose<S::Rotation, D>],
        joints: &mut StepJoints<D, N>,
        velocity: &mut [[f64; N]],
    ) {
        self.operator.start(&self.r, &mut joints.state);
        Assembled::<S, D, N, D>::give(&self.operator, &joints.state, bodies, middle, velocity);
        let first = self.q.len() - joints.blocks.len();
        joints.blocks.iter_mut().zip(&self.r[first..]).for_each(|(block, r)| block.impulse = *r);
    }

    /// Takes the impulses of the blocks.
    pub(in crate::step) fn take_impulses(&mut self, blocks: &[Block<D, N>]) {
        let first = self.q.len() - blocks.len();
        self.r[first..].iter_mut().zip(blocks).for_each(|(r, block)| *r = block.impulse);
    }

    /// Measures the current impulses.
    pub(in crate::step) fn certify(&mut self) -> Residual {
        let problem = Problem { operator: &self.operator, q: &self.q, cones: &self.cones };
        moreau_solve::certify(&problem, &self.r, &mut self.scratch)
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
