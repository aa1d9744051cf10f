//! Stages 3 and 11: positions from velocities (eqs. 13 and 18).

use crate::bodies::Bodies;
use crate::space::{Pose, Space};

/// The pose after the time `h` at the constant velocity `v`.
fn moved<S: Space<D, N>, const D: usize, const N: usize>(
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
    middle.clear();
    middle.extend(bodies.pose.iter().zip(&bodies.velocity).map(|(pose, v)| moved::<S, D, N>(pose, v, h * (1.0 - theta))));
}

/// Moves the bodies, q⁺ = q + h (θ v⁺ + (1 − θ) v), and gives them the velocities v⁺ in `after`.
///
/// Rotations are turned at once by the θ-averaged spin: for θ = 1/2 that keeps the angular momentum of a free body exactly, which
/// two turns one after the other would not. With contacts the spin is settled by the balance of momentum; see [`Space::settle`].
/// Returns the kinetic energy that settling took, of either sign: rounding for balls without torque; for other bodies of second order
/// in h in lasting contact, of first order at an impact; and for θ > 1/2 what the scheme damps of a free rotation.
pub(super) fn advance<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &mut Bodies<S, D, N>,
    middle: &[Pose<S::Rotation, D>],
    [free, after]: [&[[f64; N]]; 2],
    h: f64,
    theta: f64,
) -> f64 {
    let mut taken = 0.0;
    for i in 0..bodies.len() {
        let before = bodies.velocity[i];
        let mean = std::array::from_fn(|k| theta * after[i][k] + (1.0 - theta) * before[k]);
        let end = moved::<S, D, N>(&bodies.pose[i], &mean, h);
        bodies.velocity[i] = after[i];
        if bodies.is_free(i) {
            let rotations = [bodies.pose[i].rotation, middle[i].rotation, end.rotation];
            let impulse = bodies.load[i].map(|x| h * x);
            let settled = S::settle(&bodies.mass[i], rotations, [&before, &free[i], &after[i]], &impulse);
            taken += (D..N).map(|k| 0.5 * bodies.mass[i][k] * (after[i][k].powi(2) - settled[k].powi(2))).sum::<f64>();
            bodies.velocity[i] = settled;
        }
        bodies.pose[i] = end;
    }
    taken
}
