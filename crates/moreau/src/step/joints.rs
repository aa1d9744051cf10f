//! Joints in the step: their rows and velocities, the rounds that close them, and what they did (theory, section 18).

use super::closing::Elimination;
use super::integrate;
use crate::bodies::Bodies;
use crate::contacts::Contact;
use crate::joints::{Joint, Part, Placed, parted, pose_of};
use crate::shape::Shape;
use crate::space::{Pose, Space};
use crate::world::World;
use moreau_solve::block::{dot, norm};
use moreau_solve::residual::larger;

/// What is left open of a joint, relative to the sizes at hand, that no further round is needed for.
const CLOSED: f64 = 1e-11;

/// What is left open of a joint, relative to the sizes at hand, at which its step has failed. Steps that close end near [`CLOSED`] or at the tolerance of the
/// solver; those that do not are open by the curvature of a step, (h ω)²/8, or much more.
const OPEN: f64 = 1e-6;

/// (h ω)² up to which a step resolves the swing of a body between the joints that pull it. Leapfrog ends at 4, and at 3 a third of a turn a step feeds
/// energy into it from the second order on.
pub(super) const RESOLVED: f64 = 2.0;

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
    /// The derivative of its error of position at the next prediction with respect to the velocities v⁺ of the two sides, over h.
    pub(super) ahead: [[[f64; N]; D]; 2],
    /// What a spin and a sine are multiplied by to be a velocity and a length, m (theory (58)); 1 for translations.
    arm: f64,
    /// The size of the joint, which its errors are held against: from the centres of its bodies to its point, at least the arm of its bodies, m.
    size: f64,
    /// Added to the velocity in the solve: the errors of position that it closes, over h, m/s.
    pub(super) shift: [f64; D],
    /// The error of position at the next prediction, by which the shift is to grow times h, m.
    pub(super) miss: [f64; D],
    /// Relative velocities at the beginning and at the end of the step, m/s; the second without impulses until the solve.
    pub(super) before: [f64; D],
    pub(super) after: [f64; D],
    /// What driven bodies give of their mean.
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
    /// The sum of the squares of all errors that were measured last, each relative to what is left of it where it counts as closed.
    pub(super) openness: f64,
    /// The joint that is open by most, relative to its size: its index, its error and its size, m.
    pub(super) worst: Option<(usize, f64, f64)>,
    /// The body that swings faster than the step resolves, and (h ω)².
    pub(super) strain: Option<(usize, f64)>,
    pub(super) elimination: Elimination<D>,
    /// Scratch: what impulses do to the bodies.
    pub(super) state: Vec<[f64; N]>,
    parted: Vec<[u32; 2]>,
    /// Scratch: for each body what pulls it straight, a · p, now and in the step before, J·s.
    pulls: Vec<[f64; 2]>,
}

impl<const D: usize, const N: usize> Default for StepJoints<D, N> {
    fn default() -> Self {
        Self {
            blocks: Vec::new(),
            previous: Vec::new(),
            reactions: Vec::new(),
            left: 0.0,
            openness: 0.0,
            worst: None,
            strain: None,
            elimination: Elimination::default(),
            state: Vec::new(),
            parted: Vec::new(),
            pulls: Vec::new(),
        }
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
        (self.left, self.worst) = (0.0, None);
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
                    let own = joint.arm(&world.bodies);
                    let arm = if part == Part::Rotation { own } else { 1.0 };
                    let mut block = Block::new::<S>((index, joint), part, &placed, &poses, arm);
                    block.size = joint.anchor.iter().map(norm).fold(own, f64::max);
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
        (self.left, self.openness, self.worst) = (0.0, 0.0, None);
        for block in &mut self.blocks {
            let joint = &world.joints[block.joint];
            let next = |body: usize| integrate::next_prediction(&world.bodies, body, middle, velocities, h, theta);
            let poses = joint.bodies.map(|body| body.map_or_else(|| pose_of::<S, D, N>(&[], None), next));
            block.miss = joint.at::<S, N>(poses).error::<N>(block.part).map(|c| block.arm * c);
            let error = norm(&block.miss);
            self.left = self.left.max(error);
            let [enough, bound] = block.bounds(&poses);
            closed &= error <= enough;
            self.openness += (error / enough).powi(2);
            let worse = self.worst.is_none_or(|(_, worst, limit)| error * limit > worst * bound);
            if worse || error.is_nan() {
                self.worst = Some((block.joint, error, bound));
            }
        }
        closed
    }

    /// The joint that is open beyond the bound, if any: its index, by how much it is open, and by how much it may be, m.
    pub(super) fn open(&self) -> Option<(usize, f64, f64)> {
        self.worst.filter(|(_, error, bound)| error.is_nan() || error > bound)
    }

    /// The free body that the pull of its joints swings fastest, with (h ω)² = h Σ a · p / J, where that is more than a step resolves. A pull that was not there
    /// in the step before is an impact, which swings nothing; the step before may have been half as long.
    pub(super) fn strained<S: Space<D, N>>(
        &mut self,
        bodies: &Bodies<S, D, N>,
        middle: &[Pose<S::Rotation, D>],
        h: f64,
    ) -> Option<(usize, f64)> {
        if self.previous.len() != self.blocks.len() {
            return None;
        }
        self.pulls.clear();
        self.pulls.resize(bodies.len(), [0.0; 2]);
        for (block, previous) in self.blocks.iter().zip(&self.previous) {
            let turns = (0..N - D).any(|i| block.held >> i & 1 == 0);
            for (rows, body) in block.rows.iter().zip(block.bodies) {
                let Some(body) = body.filter(|&body| bodies.is_free(body)) else { continue };
                let arm: [f64; D] = std::array::from_fn(|k| self.reactions[block.joint].point[k] - middle[body].position[k]);
                let along =
                    |r: &[f64; D]| -> f64 { (0..D).map(|i| r[i] * (0..D).map(|k| rows[i][k] * arm[k]).sum::<f64>()).sum() };
                match block.part {
                    Part::Translation => {
                        self.pulls[body][0] += along(&block.impulse);
                        self.pulls[body][1] += along(previous);
                    }
                    // A body that may not turn against another does not swing by itself.
                    Part::Rotation if !turns => self.pulls[body] = [f64::NEG_INFINITY; 2],
                    Part::Rotation => {}
                }
            }
        }
        let swing = |i: usize| {
            let mut inertia: [f64; N] = bodies.mass[i];
            let inertia = &mut inertia[D..];
            inertia.sort_by(f64::total_cmp);
            h * self.pulls[i][0].min(2.0 * self.pulls[i][1]) / inertia[(N - D) / 2]
        };
        let swings = (0..bodies.len()).filter(|&i| self.pulls[i][0] > 0.0).map(|i| (i, swing(i)));
        swings.filter(|(_, swing)| *swing > RESOLVED).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Adds a part of the change that the elimination has found to the impulses, and what it does to the velocities.
    pub(super) fn push(&mut self, part: f64, inverse_mass: &[[f64; N]], velocity: &mut [[f64; N]]) {
        for (i, change) in self.elimination.answer() {
            let block = &mut self.blocks[i];
            let change = change.map(|x| part * x);
            block.impulse = std::array::from_fn(|c| block.impulse[c] + change[c]);
            block.push(&change, inverse_mass, velocity);
        }
    }

    /// Makes the shifts those with which these velocities obey the law.
    pub(super) fn settle_shifts(&mut self, velocity: &[[f64; N]]) {
        for block in &mut self.blocks {
            let along = |i: usize| {
                let sides = block.rows.iter().zip(block.bodies);
                sides.filter_map(|(rows, body)| Some(dot(&rows[i], &velocity[body?]))).sum::<f64>()
            };
            block.shift = std::array::from_fn(|i| -along(i));
        }
    }

    /// Returns the greatest error that was measured, as a part of the bounding radius of the smaller body of its joint.
    pub(super) fn gap<S: Space<D, N>>(&self, joints: &[Joint<D>], bodies: &Bodies<S, D, N>) -> f64 {
        let radius = |body: &usize| bodies.shape[*body].bounding_radius();
        let size = |joint: &Joint<D>| joint.bodies.iter().flatten().filter_map(radius).fold(f64::INFINITY, f64::min);
        self.blocks.iter().map(|block| norm(&block.miss) / size(&joints[block.joint])).fold(0.0, larger)
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
    /// The errors (m) below which it counts as closed, and above which it counts as open, with its sides at these poses.
    fn bounds<R>(&self, poses: &[Pose<R, D>; 2]) -> [f64; 2] {
        let far = poses.iter().flat_map(|pose| pose.position).fold(0.0_f64, |far, x| far.max(x.abs()));
        [CLOSED, OPEN].map(|part| part * self.size + 16.0 * f64::EPSILON * far)
    }

    /// Whether this error (m) is as good as none.
    pub(super) fn is_closed<R>(&self, poses: &[Pose<R, D>; 2], error: &[f64; D]) -> bool {
        norm(error) <= self.bounds(poses)[0]
    }

    /// Adds to the velocities what an impulse does to its bodies.
    pub(super) fn push(&self, impulse: &[f64; D], inverse_mass: &[[f64; N]], velocity: &mut [[f64; N]]) {
        for (rows, body) in self.rows.iter().zip(self.bodies) {
            let Some(body) = body else { continue };
            for (row, impulse) in rows.iter().zip(impulse) {
                (0..N).for_each(|k| velocity[body][k] += inverse_mass[body][k] * row[k] * impulse);
            }
        }
    }

    /// The block with its rows and without velocities.
    pub(super) fn new<S: Space<D, N>>(
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
            ahead: rows,
            arm,
            size: arm,
            shift: zero,
            miss: zero,
            before: zero,
            after: zero,
            driven: zero,
            impulse: zero,
        }
    }

    /// Makes the rows of the next prediction, from the poses there and from how they turn with the spins.
    pub(super) fn look_ahead<S: Space<D, N>>(
        &mut self,
        joints: &[Joint<D>],
        next: impl Fn(usize) -> Pose<S::Rotation, D>,
        response: impl Fn(usize) -> [[f64; 3]; 3],
    ) {
        let poses = self.bodies.map(|body| body.map_or_else(|| pose_of::<S, D, N>(&[], None), &next));
        let placed = joints[self.joint].at::<S, N>(poses);
        for side in 0..2 {
            let Some(body) = self.bodies[side] else { continue };
            let turns = response(body);
            for i in (0..D).filter(|&i| self.held >> i & 1 == 1) {
                let (direction, torque) = placed.gradient(self.part, i, side, &poses[side].position);
                let entry = |k: usize| if k < D { direction[k] } else { dot(&turns[k - D], &torque) };
                self.ahead[side][i] = std::array::from_fn(|k| self.arm * entry(k));
            }
        }
    }

    /// Gives it its velocities at the beginning of the step and without impulses.
    fn meet<S: Space<D, N>>(&mut self, bodies: &Bodies<S, D, N>, free: &[[f64; N]]) {
        for (rows, body) in self.rows.iter().zip(self.bodies) {
            let Some(body) = body else { continue };
            for i in 0..D {
                let (before, after) = (dot(&rows[i], &bodies.velocity[body]), dot(&rows[i], &free[body]));
                self.before[i] += before;
                self.after[i] += after;
                self.driven[i] += if bodies.is_free(body) { 0.0 } else { 0.5 * (before + after) };
            }
        }
    }
}
