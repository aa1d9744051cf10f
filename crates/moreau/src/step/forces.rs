//! Stages 1 and 2: forces and the free velocity v_free = v + h M⁻¹ f (before eq. 14), with the gyroscopic torque.

use crate::bodies::Bodies;
use crate::space::Space;
use moreau_solve::tasks;

/// Writes the velocity that each body would have without contacts.
pub(super) fn free_velocity<S: Space<D, N>, const D: usize, const N: usize>(
    bodies: &Bodies<S, D, N>,
    gravity: &[f64; D],
    h: f64,
    free: &mut Vec<[f64; N]>,
) {
    tasks::fill(free, bodies.len(), |i| {
        let mut v = bodies.velocity[i];
        if !bodies.is_free(i) {
            return v;
        }
        let load = bodies.load_in_body(i);
        for k in 0..N {
            v[k] += h * bodies.inverse_mass[i][k] * load[k];
        }
        for k in 0..D {
            v[k] += h * gravity[k];
        }
        S::gyroscopic(&bodies.mass[i], &bodies.velocity[i], &mut v, h);
        v
    });
}
