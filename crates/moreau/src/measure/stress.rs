//! The stress of Love and Weber, of bodies and of regions; theory (75)-(76).
//!
//! Compression is positive. Component `[i][j]` is the force along `i` through a surface across `j`.

use super::branch::branch;
use super::{Cell, volume};
use crate::space::Space;
use crate::step::Localised;
use crate::world::World;
use moreau_solve::block::{Matrix, sub};

/// The mean stress inside each body, Pa (N/m in the plane): over its own volume, by the contacts on it, which acted for the time `h` (s).
/// Zero for bodies that are not free.
pub fn stress_of_bodies<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    contacts: &[Localised<D>],
    h: f64,
) -> Vec<Matrix<D>> {
    let bodies = &world.bodies;
    let mut stress = vec![[[0.0; D]; D]; bodies.len()];
    for c in contacts {
        let force = c.impulse_in_world().map(|p| p / h);
        // The force on `b` pushes it away from the contact, that on `a` is its opposite: both compress.
        for (body, sign) in [(c.contact.key.a, 1.0), (c.contact.key.b, -1.0)] {
            let i = body as usize;
            if bodies.is_free(i) {
                let arm = sub(&c.contact.point, &bodies.pose[i].position);
                add(&mut stress[i], &force, &arm, sign / volume(bodies, i));
            }
        }
    }
    stress
}

/// The mean stress of the cell, Pa (N/m in the plane): over its whole volume, by contacts which acted for the time `h` (s), each with the part of
/// its branch vector that is inside.
pub fn stress_in<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    contacts: &[Localised<D>],
    h: f64,
    cell: &Cell<D>,
) -> Matrix<D> {
    let mut stress = [[0.0; D]; D];
    for c in contacts {
        let force = c.impulse_in_world().map(|p| p / h);
        let [from, to] = branch(world, c);
        let way = sub(&to, &from);
        add(&mut stress, &force, &way, inside(&from, &way, cell) / cell.volume());
    }
    stress
}

/// Adds s f lᵀ.
fn add<const D: usize>(stress: &mut Matrix<D>, f: &[f64; D], l: &[f64; D], s: f64) {
    for i in 0..D {
        for j in 0..D {
            stress[i][j] += s * f[i] * l[j];
        }
    }
}

/// Which part of the way from a point is inside the cell, 0 to 1. A way along a side is inside the cell whose lower side it is.
fn inside<const D: usize>(from: &[f64; D], way: &[f64; D], cell: &Cell<D>) -> f64 {
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for k in 0..D {
        if way[k] == 0.0 {
            if !(cell.min[k] <= from[k] && from[k] < cell.max[k]) {
                return 0.0;
            }
            continue;
        }
        let [one, other] = [cell.min[k], cell.max[k]].map(|side| (side - from[k]) / way[k]);
        enters = enters.max(one.min(other));
        leaves = leaves.min(one.max(other));
    }
    (leaves - enters).max(0.0)
}
