//! Joints in the step: their rows and velocities, the rounds that close them, and what they did (theory, section 18).

use super::integrate;
use crate::bodies::Bodies;
use crate::contacts::Contact;
use crate::joints::{Joint, Part, Placed, parted, pose_of};
use crate::space::{Pose, Space};
use crate::world::World;
use moreau_solve::block::{dot, norm};

/// What is left open of a joint, relative to the sizes at hand, that no further round is needed for.
const CLOSED: f64 = 1e-11;

/// One block of a joint's rows in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block<const D: usize, const N: usize> {
    joint: usize,
    part: Part,
    /// The bodies of its two sides.
    pub(super) bodies: [Option<usize>; 2],
    /// The components that it holds, as bits.
    pub(super) held: u8,
    /// Its rows of H* for the two sides, with their signs; zeros where nothing is held.
    pub(super) rows: [[[f64; N]; D]; 2],
    /// What a spin and a sine are multiplied by to be a velocity and a length, m (theory (58)); 1 for translations.
    arm: f64,
    /// Added to the velocity in the solve: the errors of position that it closes, over h, m/s.
    pub(super) shift: [f64; D],
    /// The error of position at the next prediction, by which the shift is to grow times h, m.
    miss: [f64; D],
    /// Relative velocities at the beginning and at the end of the step, m/s; the second without impulses until the solve.
    pub(super) before: [f64; D],
    pub(super) after: [f64; D],
    /// The part of both that driven bodies give.
    pub(super) driven: [f64; D],
    /// Impulse on the second side, N·s.
    pub(super) impulse: [f64; D],
}

/// What a joint did in the last step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction<const D: usize> {
    /// Where its impulse acts, at the predicted configuration, m.
    pub point: [f64; D],
    /// Its impulse on the second of its bodies, in the world, N·s.
    pub impulse: [f64; D],
    /// Its moment's impulse on that body about the point, in the world, N·m·s; in the plane the third component alone.
    pub moment: [f64; 3],
}

/// The joints of a step, and what the next one keeps of them.
#[derive(Clone, Debug)]
pub(super) struct StepJoints<const D: usize, const N: usize> {
    pub(super) blocks: Vec<Block<D, N>>,
    pub(super) previous: Vec<[f64; D]>,
    pub(super) reactions: Vec<Reaction<D>>,
    /// The greatest error of position that was measured last, m.
    pub(super) left: f64,
    parted: Vec<[u32; 2]>,
}

impl<const D: usize, const N: usize> Default for StepJoints<D, N> {
    fn default() -> Self {
        Self { blocks: Vec::new(), previous: Vec::new(), reactions: Vec::new(), left: 0.0, parted: Vec::new() }
    }
}

impl<const D: usize, const N: usize> StepJoints<D, N> {
    /// Drops the contacts of bodies that a joint keeps from touching.
    pub(super) fn part(&mut self, joints: &[Joint<D>], found: &mut Vec<Contact<D>>) {
        parted(joints, &mut self.parted);
        if !self.parted.is_empty() {
            found.retain(|contact| self.parted.binary_search(&[contact.key.a, contact.key.b]).is_err());
        }
    }

    /// Makes the blocks anew at the predicted configuration.
    pub(super) fn localise<S: Space<D, N>>(
        &mut self,
        world: &World<S, D, N>,
        middle: &[Pose<S::Rotation, D>],
        free: &[[f64; N]],
        h: f64,
    ) {
        self.blocks.clear();
        self.reactions.clear();
        self.left = 0.0;
        for (index, joint) in world.joints.iter().enumerate() {
            // A joint goes with the first of its bodies that is removed.
            if !joint.bodies.iter().flatten().all(|&body| world.bodies.is_present(body)) {
                self.reactions.push(Reaction { point: [0.0; D], impulse: [0.0; D], moment: [0.0; 3] });
                continue;
            }
            let poses = joint.bodies.map(|body| pose_of::<S, D, N>(middle, body));
            let placed = joint.at::<S, N>(poses);
            for part in [Part::Translation, Part::Rotation] {
                if joint.kind.held::<D, N>(part) != 0 {
                    let arm = if part == Part::Rotation { joint.arm(&world.bodies) } else { 1.0 };
                    let mut block = Block::new::<S>((index, joint), part, &placed, &poses, arm);
                    block.shift = placed.error::<N>(part).map(|c| arm * c / h);
                    block.meet(&world.bodies, free);
                    self.blocks.push(block);
                }
            }
            self.reactions.push(Reaction { point: *placed.point(), impulse: [0.0; D], moment: [0.0; 3] });
        }
    }

    /// Starts from the impulses of the step before, if it had the same blocks.
    pub(super) fn recall(&mut self) {
        if self.previous.len() == self.blocks.len() {
            self.blocks.iter_mut().zip(&self.previous).for_each(|(block, r)| block.impulse = *r);
        }
    }

    /// Keeps the impulses for the next step.
    pub(super) fn remember(&mut self) {
        self.previous.clear();
        self.previous.extend(self.blocks.iter().map(|block| block.impulse));
    }

    /// Measures the errors of position at the next prediction, where the velocities v⁺ of now lead; whether all are as good as closed.
    pub(super) fn measure<S: Space<D, N>>(
        &mut self,
        world: &World<S, D, N>,
        middle: &[Pose<S::Rotation, D>],
        velocities: [&[[f64; N]]; 2],
        (h, theta): (f64, f64),
    ) -> bool {
        let mut closed = true;
        self.left = 0.0;
        for block in &mut self.blocks {
            let joint = &world.joints[block.joint];
            let next = |body: usize| integrate::next_prediction(&world.bodies, body, middle, velocities, h, theta);
            let poses = joint.bodies.map(|body| body.map_or_else(|| pose_of::<S, D, N>(&[], None), next));
            block.miss = joint.at::<S, N>(poses).error::<N>(block.part).map(|c| block.arm * c);
            let far = poses.iter().flat_map(|pose| pose.position).fold(0.0_f64, |far, x| far.max(x.abs()));
            let size = joint.anchor.iter().map(norm).fold(block.arm, f64::max);
            let error = norm(&block.miss);
            self.left = self.left.max(error);
            closed &= error <= CLOSED * size + 16.0 * f64::EPSILON * far;
        }
        closed
    }

    /// Adds what was measured to the shifts.
    pub(super) fn shift(&mut self, h: f64) {
        for block in &mut self.blocks {
            block.shift = std::array::from_fn(|i| block.shift[i] + block.miss[i] / h);
        }
    }

    /// Sums the impulses of each joint's blocks, in the world.
    pub(super) fn react<S: Space<D, N>>(&mut self, joints: &[Joint<D>], middle: &[Pose<S::Rotation, D>]) {
        for block in &self.blocks {
            let (joint, reaction) = (&joints[block.joint], &mut self.reactions[block.joint]);
            let placed = joint.at::<S, N>(joint.bodies.map(|body| pose_of::<S, D, N>(middle, body)));
            match block.part {
                Part::Translation => reaction.impulse = placed.impulse_in_world(&block.impulse),
                Part::Rotation => reaction.moment = placed.moment_in_world(&block.impulse.map(|r| block.arm * r)),
            }
        }
    }
}

impl<const D: usize, const N: usize> Block<D, N> {
    /// The block with its rows and without velocities.
    fn new<S: Space<D, N>>(
        (index, joint): (usize, &Joint<D>),
        part: Part,
        placed: &Placed<D>,
        poses: &[Pose<S::Rotation, D>; 2],
        arm: f64,
    ) -> Self {
        let held = joint.kind.held::<D, N>(part);
        let side = |side: usize, sign: f64| {
            std::array::from_fn(|i| match joint.bodies[side] {
                Some(_) if held >> i & 1 == 1 => placed.row::<S, N>(part, i, &poses[side]).map(|x| sign * arm * x),
                _ => [0.0; N],
            })
        };
        let rows = [side(0, -1.0), side(1, 1.0)];
        let zero = [0.0; D];
        let (bodies, joint) = (joint.bodies, index);
        Self {
            joint,
            part,
            bodies,
            held,
            rows,
            arm,
            shift: zero,
            miss: zero,
            before: zero,
            after: zero,
            driven: zero,
            impulse: zero,
        }
    }

    /// Gives it its velocities at the beginning of the step and without impulses.
    fn meet<S: Space<D, N>>(&mut self, bodies: &Bodies<S, D, N>, free: &[[f64; N]]) {
        for (rows, body) in self.rows.iter().zip(self.bodies) {
            let Some(body) = body else { continue };
            for i in 0..D {
                let before = dot(&rows[i], &bodies.velocity[body]);
                self.before[i] += before;
                self.after[i] += dot(&rows[i], &free[body]);
                self.driven[i] += if bodies.is_free(body) { 0.0 } else { before };
            }
        }
    }
}
