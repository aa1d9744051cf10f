//! Joints while positions are corrected: what they hold must not move.
//!
//! At the end of a step a joint is open by the sagitta of the paths between two predictions (theory, section 18). A correction must neither
//! close nor widen that, so what it holds at zero is c − c₀, with c₀ the error of position where the correction began.

use crate::bodies::Bodies;
use crate::joints::{Part, pose_of};
use crate::space::Space;
use crate::step::closing::{Elimination, coupling};
use crate::step::integrate::moved;
use crate::step::joints::Block;
use crate::world::World;

/// How often bodies are moved back onto their joints after a displacement, whose turns are not straight.
const ROUNDS: usize = 8;

/// The joints' blocks where the bodies are.
#[derive(Clone, Debug, Default)]
pub(super) struct Held<const D: usize, const N: usize> {
    pub(super) blocks: Vec<Block<D, N>>,
    /// c₀ of each block, m.
    start: Vec<[f64; D]>,
    /// Scratch: a displacement, m and rad.
    moves: Vec<[f64; N]>,
}

impl<const D: usize, const N: usize> Held<D, N> {
    /// Notes the errors of position from which a correction begins.
    pub(super) fn begin<S: Space<D, N>>(&mut self, world: &World<S, D, N>) {
        self.start.clear();
        self.place(world);
        self.start.extend(self.blocks.iter().map(|block| block.shift));
    }

    /// Makes the blocks where the bodies are, their shifts c − c₀; whether all are as good as closed.
    pub(super) fn place<S: Space<D, N>>(&mut self, world: &World<S, D, N>) -> bool {
        self.blocks.clear();
        let mut closed = true;
        for (index, joint) in world.joints.iter().enumerate() {
            if !joint.bodies.iter().flatten().all(|&body| world.bodies.is_present(body)) {
                continue;
            }
            let poses = joint.bodies.map(|body| pose_of::<S, D, N>(&world.bodies.pose, body));
            let placed = joint.at::<S, N>(poses);
            for part in [Part::Translation, Part::Rotation] {
                if joint.kind.held::<D, N>(part) == 0 {
                    continue;
                }
                let arm = if part == Part::Rotation { joint.arm(&world.bodies) } else { 1.0 };
                let mut block = Block::new::<S>((index, joint), part, &placed, &poses, arm);
                let start = self.start.get(self.blocks.len()).copied().unwrap_or([0.0; D]);
                let error = placed.error::<N>(part);
                block.shift = std::array::from_fn(|i| arm * error[i] - start[i]);
                closed &= block.is_closed(&poses, &block.shift);
                self.blocks.push(block);
            }
        }
        closed
    }

    /// Moves the bodies back onto their joints by the least displacement in the norm of M. Joints that count as closed are closed once more: what is left of them, divided
    /// by the step, would be a velocity.
    pub(super) fn restore<S: Space<D, N>>(&mut self, world: &mut World<S, D, N>, elimination: &mut Elimination<D>) {
        for _ in 0..ROUNDS {
            let closed = self.place(world);
            let (bodies, blocks) = (&mut world.bodies, &self.blocks);
            if !elimination.prepare(blocks.iter().map(|block| free(bodies, block))) {
                return;
            }
            elimination.factorise(|i, j| coupling(&blocks[i], &blocks[j], &bodies.inverse_mass));
            elimination.solve(|i| blocks[i].shift.map(|c| -c));
            self.moves.clear();
            self.moves.resize(bodies.len(), [0.0; N]);
            for (i, change) in elimination.answer() {
                blocks[i].push(change, &bodies.inverse_mass, &mut self.moves);
            }
            shift(bodies, &self.moves);
            if closed {
                return;
            }
        }
    }
}

/// The free bodies of a block.
fn free<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>, block: &Block<D, N>) -> [Option<usize>; 2] {
    block.bodies.map(|body| body.filter(|&body| bodies.is_free(body)))
}

/// Displaces the bodies, but for what is not a number.
pub(super) fn shift<S: Space<D, N>, const D: usize, const N: usize>(bodies: &mut Bodies<S, D, N>, displacement: &[[f64; N]]) {
    for (pose, displacement) in bodies.pose.iter_mut().zip(displacement) {
        if displacement.iter().all(|x| x.is_finite()) && *displacement != [0.0; N] {
            *pose = moved::<S, D, N>(pose, displacement, 1.0);
        }
    }
}
