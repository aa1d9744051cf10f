//! A body of several parts and any other: what each part finds, the parts' numbers in the high bits of the feature.
//!
//! Only parts whose bounding disk meets that of the other body, or of its part, are looked at.

use super::Pose;
use crate::detect::SLACK;
use crate::detect::narrow::common::{on_first_part, on_last_part};
use crate::detect::narrow::vector::{dot, sub};
use crate::shape::plane::{Compound, placed};
use crate::shape::{PlaneShape, Shape};

/// Where a contact goes.
type Emit<'a> = &'a mut dyn FnMut(u64, [f64; 2], [f64; 2], f64);

pub(super) fn collide(
    (a, pose_a): (&PlaneShape, &Pose),
    (b, pose_b): (&PlaneShape, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) {
    match (a, b) {
        (PlaneShape::Compound(first), PlaneShape::Compound(second)) => {
            // The second body's parts are the higher bits of a feature, and features ascend.
            each_part(second, pose_b, (a, pose_a), reach, &mut |part, shape, pose| {
                let emit: Emit<'_> = &mut |feature, point, normal, gap| emit(on_last_part(part, feature), point, normal, gap);
                parts(first, pose_a, (shape, pose), reach, on_first_part, emit);
            });
        }
        (PlaneShape::Compound(compound), _) => parts(compound, pose_a, (b, pose_b), reach, on_last_part, emit),
        (_, PlaneShape::Compound(compound)) => {
            let flipped: Emit<'_> = &mut |feature, point, normal, gap| emit(feature, point, normal.map(|x| -x), gap);
            parts(compound, pose_b, (a, pose_a), reach, on_last_part, flipped);
        }
        _ => {}
    }
}

/// What each part of a compound finds, with its number in the bits of the feature that `on_part` sets.
fn parts(
    compound: &Compound,
    pose: &Pose,
    other: (&PlaneShape, &Pose),
    reach: f64,
    on_part: fn(usize, u64) -> u64,
    emit: Emit<'_>,
) {
    each_part(compound, pose, other, reach, &mut |part, shape, pose| {
        let mut emit: Emit<'_> = &mut |feature, point, normal, gap| emit(on_part(part, feature), point, normal, gap);
        super::collide((shape, pose), other, reach, &mut emit);
    });
}

/// Hands over the parts that may be within reach of another body, in order, each with its place in the world.
fn each_part(
    compound: &Compound,
    pose: &Pose,
    (other, other_pose): (&PlaneShape, &Pose),
    reach: f64,
    found: &mut dyn FnMut(usize, &PlaneShape, &Pose),
) {
    let radius = other.bounding_radius().unwrap_or(f64::INFINITY);
    for (number, part) in compound.parts().iter().enumerate() {
        let place = placed(pose, &part.pose);
        let between = sub(place.position, other_pose.position);
        let sum = (part.radius + radius + reach.max(0.0)) * (1.0 + SLACK);
        if dot(between, between) <= sum * sum {
            found(number, &part.shape, &place);
        }
    }
}
