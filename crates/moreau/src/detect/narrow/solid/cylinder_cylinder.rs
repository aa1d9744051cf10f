//! Two cylinders: up to four points of what their caps share, two along their sides, or one.

use super::Pose;
use super::curved::{Best, Touch, Tube, contacts, over_line, rims, seen_from};
use crate::detect::narrow::common::LEVEL;
use crate::shape::solid::Cylinder;

pub(super) fn collide(
    (a, pose_a): (&Cylinder, &Pose),
    (b, pose_b): (&Cylinder, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let (a, b) = (Tube::own(a), Tube::new(b, &seen_from(pose_a, pose_b)));
    let level = LEVEL * (a.half + a.radius + b.half + b.radius);
    let touch = Touch { radii: [0.0; 2], level, reach };
    let mut best = Best::new(&a, &b, level);
    best.offer_caps(a.axis());
    best.offer_caps(b.axis());
    if best.is_beyond(&touch) {
        return;
    }
    // A rim and the side of the other, seen along that.
    for rim in a.rims() {
        over_line(&rim, b.centre, b.axis()).into_iter().for_each(|normal| best.offer(normal));
    }
    for rim in b.rims() {
        over_line(&rim, a.centre, a.axis()).into_iter().for_each(|normal| best.offer(normal.map(|x| -x)));
    }
    // Side and side; in this frame the first axis is z.
    let [x, y, _] = b.axis();
    best.offer_both_ways([-y, x, 0.0]);
    for rim_a in a.rims() {
        for rim_b in b.rims() {
            rims(&rim_a, &rim_b, |way, pair| best.offer_across(way, pair));
        }
    }
    contacts(&best, &touch, pose_a, emit);
}
