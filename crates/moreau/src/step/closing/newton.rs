//! Newton's method for the impulses of the joints: c(q_m⁺(v⁺)) = 0 with v⁺ = v_free + M⁻¹ H p.
//!
//! ```text
//! repeat:  (G⁺ M⁻¹ H) Δp = −c/h      G⁺: the exact derivative of c at the next prediction, with the turn (10) and the settling (12)
//!          p ← p + Δp, or a part of Δp where that is better;  v⁺ ← v⁺ + M⁻¹ H Δp
//! ```
//!
//! Impulses act along H of q_m, as in every step; only what they are to reach is looked at where the bodies go. The matrix is symmetric but for the turn in
//! one step. With H in the place of G⁺ the rounds converge by a factor of the order (h |ω|)² times the ratio of the masses: a light link between heavy bodies
//! is thrown sideways by an impulse that moves the heavy ones.

use crate::space::Space;
use crate::step::Workspace;
use crate::step::integrate;
use crate::step::joints::{Block, StepJoints};
use crate::world::World;
use moreau_solve::block::dot;

/// Steps of Newton's method; three or four are usual.
const STEPS: u32 = 20;
/// The least part of a step that is tried.
const LEAST_PART: f64 = 1.0 / 64.0;

/// Closes the joints with the impulses of contacts as they are, and sets the shifts to what that means. False, and nothing done, where the equations are too
/// large.
pub(super) fn close<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
) -> bool {
    let (bodies, joints) = (&world.bodies, &mut work.joints);
    let free = |body: Option<usize>| body.filter(|&body| bodies.is_free(body));
    if !joints.elimination.prepare(joints.blocks.iter().map(|block| block.bodies.map(free))) {
        return false;
    }
    let time = (h, world.settings.theta);
    work.after.clone_from(&work.free);
    work.systems.full.carry(bodies, &work.middle, joints, &mut work.after);
    let mut closed = joints.measure(world, &work.middle, [&work.free, &work.after], time);
    for _ in 0..STEPS {
        if closed {
            break;
        }
        for block in &mut joints.blocks {
            let gradient = |body: usize| integrate::response(bodies, body, &work.middle, [&work.free, &work.after], time);
            let next = |body: usize| integrate::next_prediction(bodies, body, &work.middle, [&work.free, &work.after], h, time.1);
            block.look_ahead::<S>(&world.joints, next, gradient);
        }
        let StepJoints { blocks, elimination, .. } = joints;
        elimination.factorise(|i, j| coupling(&blocks[i], &blocks[j], &bodies.inverse_mass));
        elimination.solve(|i| blocks[i].miss.map(|c| -c / h));
        if !elimination.answer().all(|(_, change)| change.iter().all(|x| x.is_finite())) {
            break;
        }
        let before = joints.openness;
        let (mut part, mut push) = (1.0, 1.0);
        closed = loop {
            joints.push(push, &bodies.inverse_mass, &mut work.after);
            let closed = joints.measure(world, &work.middle, [&work.free, &work.after], time);
            // Written so that what is not a number is no gain.
            if joints.openness < before || part == 0.0 {
                break closed;
            }
            let next = if part > LEAST_PART { 0.5 * part } else { 0.0 };
            (part, push) = (next, next - part);
        };
        if part == 0.0 {
            break;
        }
    }
    joints.settle_shifts(&work.after);
    work.systems.full.take_impulses(&joints.blocks);
    true
}

/// The block G_i M⁻¹ H_jᵀ.
pub(in crate::step) fn coupling<const D: usize, const N: usize>(
    i: &Block<D, N>,
    j: &Block<D, N>,
    inverse_mass: &[[f64; N]],
) -> [[f64; D]; D] {
    let mut sum = [[0.0; D]; D];
    for (ahead, body) in i.ahead.iter().zip(i.bodies) {
        for (rows, other) in j.rows.iter().zip(j.bodies) {
            let Some(body) = body.filter(|_| body == other) else { continue };
            let moved = rows.map(|row| std::array::from_fn(|k| inverse_mass[body][k] * row[k]));
            for (sum, ahead) in sum.iter_mut().zip(ahead) {
                *sum = std::array::from_fn(|b| sum[b] + dot::<N>(ahead, &moved[b]));
            }
        }
    }
    sum
}
