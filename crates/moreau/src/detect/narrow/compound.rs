//! A body of several parts and any other: what each part finds, the parts' numbers in the high bits of the feature.
//!
//! Only parts whose bounding ball meets that of the other body, or of its part, are looked at. The table is asked again for each part, and
//! what it finds is handed over through a `dyn FnMut`, without which there would be no end of types.

use super::common::{on_first_part, on_last_part};
use super::vector::{dot, sub};
use crate::detect::SLACK;
use crate::shape::{Part, Placed, Shape};
use crate::space::{Pose, Space, placed};

/// Where a contact goes.
type Emit<'a, const D: usize> = &'a mut dyn FnMut(u64, [f64; D], [f64; D], f64);

/// The parts of a body, and where it is.
type Parts<'a, T, R, const D: usize> = (&'a [Part<T, R, D>], &'a Pose<R, D>);

pub(super) fn collide<S: Space<D, N>, const D: usize, const N: usize>(
    a: Placed<'_, S::Shape, S::Rotation, D>,
    b: Placed<'_, S::Shape, S::Rotation, D>,
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; D], [f64; D], f64),
) {
    match (a.0.parts(), b.0.parts()) {
        ([], []) => {}
        ([], second) => {
            let flipped: Emit<'_, D> = &mut |feature, point, normal, gap| emit(feature, point, normal.map(|x| -x), gap);
            collide_parts::<S, D, N>((second, b.1), a, reach, on_last_part, flipped);
        }
        (first, []) => collide_parts::<S, D, N>((first, a.1), b, reach, on_last_part, emit),
        (first, second) => {
            // The second body's parts are the higher bits of a feature, and features ascend.
            each_part::<S, D, N>((second, b.1), a, reach, |part, shape, pose| {
                let emit: Emit<'_, D> = &mut |feature, point, normal, gap| emit(on_last_part(part, feature), point, normal, gap);
                collide_parts::<S, D, N>((first, a.1), (shape, pose), reach, on_first_part, emit);
            });
        }
    }
}

/// What each part finds, with its number in the bits of the feature that `on_part` sets.
fn collide_parts<S: Space<D, N>, const D: usize, const N: usize>(
    parts: Parts<'_, S::Shape, S::Rotation, D>,
    other: Placed<'_, S::Shape, S::Rotation, D>,
    reach: f64,
    on_part: fn(usize, u64) -> u64,
    emit: Emit<'_, D>,
) {
    each_part::<S, D, N>(parts, other, reach, |part, shape, pose| {
        let mut emit: Emit<'_, D> = &mut |feature, point, normal, gap| emit(on_part(part, feature), point, normal, gap);
        S::Shape::collide((shape, pose), other, reach, &mut emit);
    });
}

/// Hands over the parts that may be within reach of another body, in order, each with its place in the world.
fn each_part<S: Space<D, N>, const D: usize, const N: usize>(
    (parts, pose): Parts<'_, S::Shape, S::Rotation, D>,
    (other, other_pose): Placed<'_, S::Shape, S::Rotation, D>,
    reach: f64,
    mut found: impl FnMut(usize, &S::Shape, &Pose<S::Rotation, D>),
) {
    let radius = other.bounding_radius().unwrap_or(f64::INFINITY);
    for (number, part) in parts.iter().enumerate() {
        let place = placed::<S, D, N>(pose, &part.pose);
        let between = sub(place.position, other_pose.position);
        let sum = (part.radius + radius + reach.max(0.0)) * (1.0 + SLACK);
        if dot(between, between) <= sum * sum {
            found(number, &part.shape, &place);
        }
    }
}
