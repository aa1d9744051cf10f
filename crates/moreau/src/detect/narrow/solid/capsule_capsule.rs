//! Two capsules: one point, or side by side one at each end of what lies beside the other.

use super::Pose;
use super::curved::{Best, Hull, Segment, Touch, contacts, hulls, seen_from};
use crate::detect::narrow::common::LEVEL;
use crate::shape::solid::Capsule;

pub(super) fn collide(
    (a, pose_a): (&Capsule, &Pose),
    (b, pose_b): (&Capsule, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let level = LEVEL * (a.half + a.radius + b.half + b.radius);
    let touch = Touch { radii: [a.radius, b.radius], level, reach };
    let (segment_a, segment_b) = (Segment { half: a.half }, Segment { half: b.half });
    let (a, b) = (Hull::own(&segment_a), Hull { body: &segment_b, pose: seen_from(pose_a, pose_b) });
    let mut best = Best::new(&a, &b, level);
    hulls(&mut best, &touch);
    contacts(&best, &touch, pose_a, emit);
}
