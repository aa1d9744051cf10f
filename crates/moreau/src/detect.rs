//! Detection: from poses to contacts.
//!
//! The broad phase (`broad`) finds pairs of bounding balls that come within reach, unbounded shapes are held against every
//! body, then the pairs are sorted and the narrow phase (`narrow`) computes their contacts in the order of their keys. What
//! comes out therefore does not depend on how the pairs were found. All scratch is kept from call to call.

mod broad;
pub(crate) mod narrow;
mod pairs;

use crate::contacts::{Contact, ContactKey};
use crate::shape::Shape;
use crate::space::{Pose, Space};
use broad::{Grid, Sphere};
use pairs::Pairs;

/// By how much bounding balls are enlarged, so that the rounding of a coarse test never drops what the exact one would keep.
const SLACK: f64 = 1e-12;

/// Finds the contacts of all bodies. It remembers nothing of the bodies, only memory: an allocation is made only where a scene
/// needs more than any before it.
#[derive(Clone, Debug, Default)]
pub struct Detector<const D: usize> {
    /// Bounding balls of bodies that have one.
    spheres: Vec<Sphere<D>>,
    /// Bodies without: to be held against every other.
    wide: Vec<u32>,
    grid: Grid<D>,
    pairs: Pairs,
}

impl<const D: usize> Detector<D> {
    /// A detector with nothing reserved.
    pub fn new() -> Self {
        Self::default()
    }

    /// Clears `out` and fills it with every contact whose gap is at most the sum of its bodies' `reach` (m), sorted by key and
    /// without duplicates; pairs of two `driven` bodies are left out, and so are pairs that no narrow phase knows.
    ///
    /// Bodies are the entries of the three slices, as far as all three go. A body whose position is not finite touches nothing.
    pub fn detect<S: Space<D, N>, const N: usize>(
        &mut self,
        shapes: &[S::Shape],
        poses: &[Pose<S::Rotation, D>],
        reach: &[f64],
        driven: impl Fn(usize) -> bool,
        out: &mut Vec<Contact<D>>,
    ) {
        let count = shapes.len().min(poses.len()).min(reach.len());
        let (shapes, poses, reach) = (&shapes[..count], &poses[..count], &reach[..count]);
        self.bound::<S, N>(shapes, poses, reach);
        self.pairs.clear();
        let mut found = |a: u32, b: u32| {
            if !(driven(a as usize) && driven(b as usize)) {
                self.pairs.push(a, b);
            }
        };
        self.grid.pairs(&self.spheres, &mut found);
        for (rank, &wide) in self.wide.iter().enumerate() {
            let index = wide as usize;
            near_wide::<S, D, N>(&shapes[index], &poses[index], reach[index], &self.spheres, |other| found(wide, other));
            self.wide[rank + 1..].iter().for_each(|&other| found(wide, other));
        }
        out.clear();
        for (a, b) in self.pairs.sorted(count) {
            let (i, j) = (a as usize, b as usize);
            let mut emit = |feature, point, normal, gap| {
                out.push(Contact { key: ContactKey { a, b, feature }, point, normal, gap });
            };
            S::Shape::collide((&shapes[i], &poses[i]), (&shapes[j], &poses[j]), reach[i] + reach[j], &mut emit);
        }
    }

    /// Sorts the bodies into those with a bounding ball and the wide ones.
    fn bound<S: Space<D, N>, const N: usize>(&mut self, shapes: &[S::Shape], poses: &[Pose<S::Rotation, D>], reach: &[f64]) {
        self.spheres.clear();
        self.wide.clear();
        for (body, ((shape, pose), &reach)) in (0..).zip(shapes.iter().zip(poses).zip(reach)) {
            if !pose.position.iter().all(|x| x.is_finite()) {
                continue;
            }
            // A negative reach is left to the narrow phase: a bounding ball has no negative radius.
            match shape.bounding_radius().map(|radius| (radius + reach.max(0.0)) * (1.0 + SLACK)) {
                Some(radius) if radius.is_finite() => self.spheres.push(Sphere { centre: pose.position, radius, body }),
                _ => self.wide.push(body),
            }
        }
    }
}

/// Hands over the bodies that may touch a wide one: all, or those not outside its bounding half-space.
fn near_wide<S: Space<D, N>, const D: usize, const N: usize>(
    shape: &S::Shape,
    pose: &Pose<S::Rotation, D>,
    reach: f64,
    spheres: &[Sphere<D>],
    mut found: impl FnMut(u32),
) {
    let Some(normal) = shape.bounding_normal(pose.rotation) else {
        return spheres.iter().for_each(|sphere| found(sphere.body));
    };
    for sphere in spheres {
        let (mut height, mut size) = (0.0, 0.0);
        for k in 0..D {
            let term = normal[k] * (sphere.centre[k] - pose.position[k]);
            height += term;
            size += term.abs();
        }
        if height - SLACK * size <= sphere.radius + reach.max(0.0) {
            found(sphere.body);
        }
    }
}

#[cfg(test)]
mod tests;
