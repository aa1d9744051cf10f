//! A capsule and a body with flat faces: at the ends of what lies over a face, or one point at an edge, a vertex or an end.

use super::Pose;
use super::curved::{Best, Hull, Segment, Touch, contacts, hulls, seen_from};
use crate::detect::narrow::common::LEVEL;
use crate::shape::solid::{Capsule, Faceted};

pub(super) fn collide<F: Faceted>(
    (capsule, pose_a): (&Capsule, &Pose),
    (body, pose_b): (&F, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let segment = Segment { half: capsule.half };
    let (a, b) = (Hull::own(&segment), Hull { body, pose: seen_from(pose_a, pose_b) });
    let level = LEVEL * (capsule.half + capsule.radius + body.radius());
    let touch = Touch { radii: [capsule.radius, 0.0], level, reach };
    let mut best = Best::new(&a, &b, level);
    hulls(&mut best, &touch);
    contacts(&best, &touch, pose_a, emit);
}
