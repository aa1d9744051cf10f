//! Stages 3 and 11: positions from velocities (eqs. 13 and 18).

use super::record::Balance;
use crate::bodies::{Bodies, Motion};
use crate::space::{Pose, Space};
use moreau_solve::tasks;

/// The pose after the time `h` at the constant velocity `v`.
pub(super) fn moved<S: Space<D, N>, const D: usize, const N: usize>(
    pose: &Pose<S::Rotation, D>,
    v: &[f64; N],
    h: f64,
) -> Pose<S::Rotation, D> {
    Pose { position: std::array::from_fn(|k| pose.position[k] + h * v[k]), rotation: S::turn(pose.rotation, v, h) }
}

/// Predicts q_m = q + h (1 − θ) v, where contacts are sought (eq. 18 has θ = 1/2).
pub(super) fn predict<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    h: f64,
    theta: f64,
    middle: &mut Vec<Pose<S::Rotation, D>>,
) {
    tasks::fill(middle, bodies.len(), |i| moved::<S, D, N>(&bodies.pose[i], &bodies.velocity[i], h * (1.0 - theta)));
}

/// Moves the bodies, q⁺ = q + h (θ v⁺ + (1 − θ) v), and gives them the velocities v⁺ in `after`.
///
/// Rotations are turned at once by the θ-averaged spin: for θ = 1/2 that keeps the angular momentum of a free body exactly, which
/// two turns one after the other would not. With contacts the spin is settled by the balance of momentum; see [`Space::settle`].
/// Returns the kinetic energy that settling took, of either sign, J: rounding for balls without torque; for other bodies of second order
/// in h in lasting contact, of first order at an impact; and for θ > 1/2 what the scheme damps of a free rotation. The second number is
/// the energy that the scheme created: the sum over the bodies for which settling and what is in `losses` together are negative.
pub(super) fn advance<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &mut Bodies<S, D, N>,
    middle: &[Pose<S::Rotation, D>],
    [free, after]: [&[[f64; N]]; 2],
    losses: &[Balance],
    (h, theta): (f64, f64),
) -> [f64; 2] {
    let Bodies { pose, velocity, mass, load, motion, .. } = bodies;
    tasks::sums_mut(0, pose, velocity, &|i, pose, velocity| {
        let before = *velocity;
        let end = arrival::<S, D, N>(pose, [&before, &after[i]], h, theta);
        *velocity = after[i];
        let mut taken = 0.0;
        if motion[i] == Motion::Free {
            let rotations = [pose.rotation, middle[i].rotation, end.rotation];
            let impulse = load[i].map(|x| h * x);
            let settled = S::settle(&mass[i], rotations, [&before, &free[i], &after[i]], &impulse);
            taken = (D..N).map(|k| 0.5 * mass[i][k] * (after[i][k].powi(2) - settled[k].powi(2))).sum::<f64>();
            *velocity = settled;
        }
        *pose = end;
        let lost = losses[i].scheme + taken;
        [taken, if lost >= 0.0 { 0.0 } else { -lost }]
    })
}

/// q⁺ = q + h (θ v⁺ + (1 − θ) v) of one body.
fn arrival<S: Space<D, N>, const D: usize, const N: usize>(
    pose: &Pose<S::Rotation, D>,
    [before, after]: [&[f64; N]; 2],
    h: f64,
    theta: f64,
) -> Pose<S::Rotation, D> {
    let mean = std::array::from_fn(|k| theta * after[k] + (1.0 - theta) * before[k]);
    moved::<S, D, N>(pose, &mean, h)
}

/// Where the next step, as long as this one, will predict body `i` if it ends this one with the velocity v⁺ in `after`.
pub(super) fn next_prediction<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    i: usize,
    middle: &[Pose<S::Rotation, D>],
    velocities: [&[[f64; N]]; 2],
    h: f64,
    theta: f64,
) -> Pose<S::Rotation, D> {
    let (end, velocity) = settled(bodies, i, middle, velocities, (h, theta));
    moved::<S, D, N>(&end, &velocity, h * (1.0 - theta))
}

/// By how much that prediction turns for each component of the spin in `after`, over h; see [`Space::response`].
pub(super) fn response<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    i: usize,
    middle: &[Pose<S::Rotation, D>],
    [free, after]: [&[[f64; N]]; 2],
    (h, theta): (f64, f64),
) -> [[f64; 3]; 3] {
    let (end, velocity) = settled(bodies, i, middle, [free, after], (h, theta));
    let rotations = [bodies.pose[i].rotation, middle[i].rotation, end.rotation];
    let (velocities, impulse) = ([&bodies.velocity[i], &free[i], &after[i]], bodies.load[i].map(|x| h * x));
    S::response(&bodies.mass[i], rotations, velocities, &velocity, &impulse, (h, theta))
}

/// The end of the step of body `i`: its pose, and its velocity after settling.
fn settled<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    i: usize,
    middle: &[Pose<S::Rotation, D>],
    [free, after]: [&[[f64; N]]; 2],
    (h, theta): (f64, f64),
) -> (Pose<S::Rotation, D>, [f64; N]) {
    let (pose, before) = (&bodies.pose[i], &bodies.velocity[i]);
    let end = arrival::<S, D, N>(pose, [before, &after[i]], h, theta);
    if !bodies.is_free(i) {
        return (end, after[i]);
    }
    let rotations = [pose.rotation, middle[i].rotation, end.rotation];
    let impulse = bodies.load[i].map(|x| h * x);
    (end, S::settle(&bodies.mass[i], rotations, [before, &free[i], &after[i]], &impulse))
}
