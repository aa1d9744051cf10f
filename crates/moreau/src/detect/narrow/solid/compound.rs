//! A body of several parts and any other: what each part finds, the parts' numbers in the high bits of the feature.
//!
//! Only parts whose bounding ball meets that of the other body, or of its part, are looked at.

use super::Pose;
use crate::detect::SLACK;
use crate::detect::narrow::common::{on_first_part, on_last_part};
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::Compound;
use crate::shape::{Shape, SolidShape};
use crate::space::{Solid, Space};

/// Where a contact goes.
type Emit<'a> = &'a mut dyn FnMut(u64, [f64; 3], [f64; 3], f64);

pub(super) fn collide(
    (a, pose_a): (&SolidShape, &Pose),
    (b, pose_b): (&SolidShape, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    match (a, b) {
        (SolidShape::Compound(first), SolidShape::Compound(second)) => {
            // The second body's parts are the higher bits of a feature, and features ascend.
            each_part(second, pose_b, (a, pose_a), reach, &mut |part, shape, pose| {
                let emit: Emit<'_> = &mut |feature, point, normal, gap| emit(on_last_part(part, feature), point, normal, gap);
                parts(first, pose_a, (shape, pose), reach, on_first_part, emit);
            });
        }
        (SolidShape::Compound(compound), _) => parts(compound, pose_a, (b, pose_b), reach, on_last_part, emit),
        (_, SolidShape::Compound(compound)) => {
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
    other: (&SolidShape, &Pose),
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
    (other, other_pose): (&SolidShape, &Pose),
    reach: f64,
    found: &mut dyn FnMut(usize, &SolidShape, &Pose),
) {
    let radius = other.bounding_radius().unwrap_or(f64::INFINITY);
    for (number, part) in compound.parts().iter().enumerate() {
        let position = along(pose.position, 1.0, Solid::rotate(pose.rotation, part.pose.position));
        let between = sub(position, other_pose.position);
        let sum = (part.radius + radius + reach.max(0.0)) * (1.0 + SLACK);
        if dot(between, between) <= sum * sum {
            found(number, &part.shape, &Pose { position, rotation: pose.rotation * part.pose.rotation });
        }
    }
}
