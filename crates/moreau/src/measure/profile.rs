//! Velocities by slabs along an axis; theory (79).

use super::MeasureError;
use super::cell::check_range;
use crate::space::Space;
use crate::world::World;
use moreau_solve::block::{dot, sub};

/// What moves between two planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slab<const D: usize> {
    /// The middle between the planes, m.
    pub middle: f64,
    /// How many free bodies have their centres there.
    pub bodies: usize,
    /// Their mass, kg.
    pub mass: f64,
    /// Mean velocity of their centres, by mass, m/s; zero where there are none.
    pub velocity: [f64; D],
    /// Granular temperature: what velocities differ from that mean, squared, by mass, per dimension, m²/s².
    pub temperature: f64,
}

/// The profile of `count` slabs of equal thickness across an axis, from one height to another (m).
///
/// # Errors
/// Where there is no such axis, no height between the two, or no slab.
pub fn profile<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    axis: usize,
    [from, to]: [f64; 2],
    count: usize,
) -> Result<Vec<Slab<D>>, MeasureError> {
    if axis >= D {
        return Err(MeasureError::Axis { axis, dimension: D });
    }
    check_range(axis, [from, to])?;
    if count == 0 {
        return Err(MeasureError::NoParts { what: "slabs" });
    }
    let (bodies, thickness) = (&world.bodies, (to - from) / count as f64);
    let empty = |k: usize| Slab {
        middle: from + (k as f64 + 0.5) * thickness,
        bodies: 0,
        mass: 0.0,
        velocity: [0.0; D],
        temperature: 0.0,
    };
    let mut slabs: Vec<_> = (0..count).map(empty).collect();
    let inside = |i: &usize| bodies.is_free(*i) && (from..to).contains(&bodies.pose[*i].position[axis]);
    let slab_of = |i: usize| (((bodies.pose[i].position[axis] - from) / thickness) as usize).min(count - 1);
    let of_body = |i: usize| (bodies.mass[i][0], std::array::from_fn::<f64, D, _>(|k| bodies.velocity[i][k]));
    for i in (0..bodies.len()).filter(inside) {
        let (slab, (mass, v)) = (&mut slabs[slab_of(i)], of_body(i));
        slab.bodies += 1;
        slab.mass += mass;
        (0..D).for_each(|k| slab.velocity[k] += mass * v[k]);
    }
    for slab in slabs.iter_mut().filter(|slab| slab.bodies > 0) {
        slab.velocity = slab.velocity.map(|momentum| momentum / slab.mass);
    }
    // Once the means are known: the difference of two great squares would lose a small temperature.
    for i in (0..bodies.len()).filter(inside) {
        let (slab, (mass, v)) = (&mut slabs[slab_of(i)], of_body(i));
        let difference = sub(&v, &slab.velocity);
        slab.temperature += mass / slab.mass * dot(&difference, &difference) / D as f64;
    }
    Ok(slabs)
}
