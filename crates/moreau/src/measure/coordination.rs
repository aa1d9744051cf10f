//! How many others a body touches; theory (73).

use super::Touch;
use crate::space::Space;
use crate::step::Localised;
use crate::world::World;

/// Coordination numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordination {
    /// How many bodies each body touches, walls among them; of all bodies, in their order.
    pub of_body: Vec<u32>,
    /// Whether a body is a rattler: free, with fewer contact points than there are dimensions when those with other rattlers are not counted.
    /// A ball with so few neighbours can be at rest, as in a column, but not against a push from anywhere; one face holds a block.
    pub rattler: Vec<bool>,
    /// Mean over free bodies; zero where there are none.
    pub mean: f64,
    /// Mean over free bodies without the rattlers and what touches only them; zero where there are none.
    pub without_rattlers: f64,
}

/// The coordination numbers by the contacts that count, which are sorted by key; pairs of bodies count once, however many points they share.
pub fn coordination<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    contacts: &[Localised<D>],
    touch: Touch,
) -> Coordination {
    let bodies = &world.bodies;
    let both_ways = |([a, b], points): ([u32; 2], usize)| [([a, b], points), ([b, a], points)];
    let mut beside: Vec<_> = touch.pairs(contacts).flat_map(both_ways).collect();
    beside.sort_unstable();
    let mut of_body = vec![0; bodies.len()];
    beside.iter().for_each(|(pair, _)| of_body[pair[0] as usize] += 1);
    let free: Vec<bool> = (0..bodies.len()).map(|i| bodies.is_free(i)).collect();
    let (rattler, left) = rattlers::<D>(&free, &beside, &of_body);
    let mean = |counts: &[u32], takes: &dyn Fn(usize) -> bool| {
        let (mut sum, mut number) = (0, 0_u64);
        for i in (0..free.len()).filter(|&i| free[i] && takes(i)) {
            sum += u64::from(counts[i]);
            number += 1;
        }
        if number > 0 { sum as f64 / number as f64 } else { 0.0 }
    };
    let (all, without_rattlers) = (mean(&of_body, &|_| true), mean(&left, &|i| !rattler[i]));
    Coordination { of_body, rattler, mean: all, without_rattlers }
}

/// Who is a rattler, and how many neighbours each body has that are none. A rattler that is taken away may make its neighbours rattlers.
/// Neighbours, with their points, are sorted by body.
fn rattlers<const D: usize>(free: &[bool], beside: &[([u32; 2], usize)], of_body: &[u32]) -> (Vec<bool>, Vec<u32>) {
    let (mut left, mut points) = (of_body.to_vec(), vec![0; free.len()]);
    beside.iter().for_each(|(pair, count)| points[pair[0] as usize] += count);
    let loose = |i: usize, points: &[usize]| free[i] && points[i] < D;
    let mut rattler: Vec<bool> = (0..free.len()).map(|i| loose(i, &points)).collect();
    let mut taken: Vec<usize> = (0..free.len()).filter(|&i| rattler[i]).collect();
    while let Some(body) = taken.pop() {
        let first = beside.partition_point(|(pair, _)| (pair[0] as usize) < body);
        for &([_, other], count) in beside[first..].iter().take_while(|(pair, _)| pair[0] as usize == body) {
            let other = other as usize;
            left[other] -= 1;
            points[other] -= count;
            if !rattler[other] && loose(other, &points) {
                rattler[other] = true;
                taken.push(other);
            }
        }
    }
    (rattler, left)
}
