//! A compound and any body: each of its parts with the other, or with each part of the other.

use super::Pose;
use crate::contacts::{part, second_part};
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::{Compound, Part};
use crate::shape::{Shape, SolidShape};
use crate::space::{Solid, Space};

pub(super) fn collide(
    (compound, pose): (&Compound, &Pose),
    (other, pose_other): (&SolidShape, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    each((compound, pose), (other, pose_other), reach, emit);
}

/// Whatever takes the contacts: a function for each kind of them would call itself with ever new kinds.
fn each(
    (compound, pose): (&Compound, &Pose),
    (other, pose_other): (&SolidShape, &Pose),
    reach: f64,
    emit: &mut dyn FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let radius = other.bounding_radius().unwrap_or(f64::INFINITY);
    for (i, own) in compound.parts().iter().enumerate() {
        let place = placed(own, pose);
        if !near(place.position, pose_other.position, own.radius + radius + reach) {
            continue;
        }
        if let SolidShape::Compound(theirs) = other {
            for (j, their) in theirs.parts().iter().enumerate() {
                let their_place = placed(their, pose_other);
                if near(place.position, their_place.position, own.radius + their.radius + reach) {
                    let mut named = |f, p, n, gap| emit(part(i) | second_part(j) | f, p, n, gap);
                    SolidShape::collide((&own.shape, &place), (&their.shape, &their_place), reach, &mut named);
                }
            }
        } else {
            let mut named = |f, p, n, gap| emit(part(i) | f, p, n, gap);
            SolidShape::collide((&own.shape, &place), (other, pose_other), reach, &mut named);
        }
    }
}

/// A part in the world.
fn placed(part: &Part, pose: &Pose) -> Pose {
    let position = along(pose.position, 1.0, Solid::rotate(pose.rotation, part.pose.position));
    Pose { position, rotation: pose.rotation * part.pose.rotation }
}

/// Whether two points are no farther apart than that.
fn near(p: [f64; 3], q: [f64; 3], distance: f64) -> bool {
    let between = sub(q, p);
    dot(between, between) <= distance * distance
}
