//! Bodies with curved sides, and points and segments that are grown by a radius, against each other and against flat faces.
//!
//! Two convex bodies are apart by the greatest value, over unit vectors n from the first to the second, of
//!
//!   s(n) = min over b of n·b − max over a of n·a.
//!
//! Where it is positive it is their distance; where it is negative, n is the way along which the least translation parts them.
//! A radius by which a body is grown is taken off afterwards, since it shifts all of s alike. A greatest value lies at the normal of a
//! face or where a line, an edge or a rim of one body meets a vertex, an edge or a rim of the other, and for each such pair
//! there are a few directions that can be written down. All are tried with the whole bodies (`best`): because s(n) is never above the
//! answer, a direction too many does no harm, and no case asks which features are within reach of each other, which rounding
//! would decide. Of directions that are as good as each other the first counts, and faces come first.
//!
//! Then each body shows the face, line or vertex that looks along n (`patch`), and the corners of what the two share, seen along
//! n, are the points of contact (`overlap`); two lines that are round on both sides have theirs at their ends (`lines`). Every
//! point is one of both surfaces, so no gap is below s, and one that is s is added if there is none.
//!
//! A cap is a disk whose corners are eight points of its rim that are fixed in the body; as soon as it is tilted the one
//! nearest to the direction of the tilt gives way to the lowest point. So a cylinder that stands has the same points at every step, one that rocks
//! or rolls has one at the place that touches, always under the same feature, and no gap is missed.

mod best;
mod hull;
mod hulls;
mod lines;
mod overlap;
mod patch;
mod points;
mod rim;
mod tube;
mod tubes;

use super::Pose;
use crate::detect::narrow::common::CLOSE;
use crate::detect::narrow::vector::{NO_DIRECTION, along, dot, sub};
use crate::space::{Solid, Space};

use best::Direction;

pub(super) use best::Best;
pub(super) use hull::{Dot, Hull, Segment};
pub(super) use hulls::hulls;
pub(super) use points::{Point, Points, feature};
pub(super) use rim::{over_line, rims};
pub(super) use tube::Tube;
pub(super) use tubes::tube_with;

use patch::Patch;

/// A convex body in the frame in which a pair is looked at.
pub(super) trait Convex {
    /// Greatest coordinate of its points along a direction, m for a unit vector.
    fn height(&self, direction: [f64; 3]) -> f64;

    /// What of it looks along a unit vector, with the highest point among its corners; heights that differ by less than `level`
    /// (m) are equal.
    fn patch(&self, outward: [f64; 3], level: f64) -> Patch;
}

/// What a pair is looked at with.
#[derive(Clone, Copy)]
pub(super) struct Touch {
    /// By how much each of the two is grown, m.
    pub(super) radii: [f64; 2],
    /// What lengths of equal things may differ by, m.
    pub(super) level: f64,
    /// Greatest gap that is asked for, m.
    pub(super) reach: f64,
}

impl Touch {
    fn grown(&self) -> f64 {
        self.radii[0] + self.radii[1]
    }

    /// Whether the cores are too far from each other, or nowhere.
    pub(super) fn is_beyond(&self, apart: f64) -> bool {
        // Not `>`: what is nowhere touches nothing.
        !(apart - self.grown() <= self.reach && apart > f64::NEG_INFINITY)
    }
}

/// The pose of `b` in the frame of `a`.
pub(super) fn seen_from(a: &Pose, b: &Pose) -> Pose {
    let position = Solid::unrotate(a.rotation, sub(b.position, a.position));
    Pose { position, rotation: a.rotation.conjugate() * b.rotation }
}

/// Hands over the contacts of two bodies whose best direction is known, both in the frame of `pose`.
pub(super) fn contacts<A: Convex, B: Convex>(
    best: &Best<'_, A, B>,
    touch: &Touch,
    pose: &Pose,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    if best.is_beyond(touch) {
        return;
    }
    let gap = best.first.apart - touch.grown();
    if let Some(face) = best.face_beside().filter(|_| gap.abs() <= CLOSE * touch.level) {
        let points = points_along(best, face, touch);
        if points.all().iter().any(|point| point.gap <= gap + touch.level) {
            return show(points, pose, emit);
        }
    }
    let mut points = points_along(best, &best.first, touch);
    if !points.have_least(1.0) {
        // Only nearly as good as the best, so that what is lowest lies beside what is highest.
        points = points_along(best, &best.best, touch);
    }
    if !points.have_least(1.0) {
        points.add_seen(between(best, &best.best, touch));
    }
    show(points, pose, emit);
}

/// Hands over the contacts that they have along a unit vector from the first to the second, in the frame of `pose`, wherever they are nearest.
pub(super) fn contacts_along<A: Convex, B: Convex>(
    (a, b): (&A, &B),
    normal: [f64; 3],
    touch: &Touch,
    pose: &Pose,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let mut best = Best::new(a, b, touch.level);
    best.offer(normal);
    show(points_along(&best, &best.first, touch), pose, emit);
}

fn show(mut points: Points, pose: &Pose, emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64)) {
    points.spread();
    for &Point { feature, at, normal, gap } in points.all() {
        let at = along(pose.position, 1.0, Solid::rotate(pose.rotation, at));
        emit(feature, at, Solid::rotate(pose.rotation, normal), gap);
    }
}

fn points_along<A: Convex, B: Convex>(best: &Best<'_, A, B>, direction: &Direction, touch: &Touch) -> Points {
    let &Direction { normal, apart, .. } = direction;
    let patches = [best.a.patch(normal, touch.level), best.b.patch(normal.map(|x| -x), touch.level)];
    let mut ends = Points::new(apart - touch.grown(), touch);
    lines::ends(&patches, normal, touch, &mut ends);
    // Where lines cross only just within their ends, an end has the gap to many digits but not the normal.
    if ends.have_least(1e-3) {
        return ends;
    }
    let mut points = Points::new(apart - touch.grown(), touch);
    overlap::overlap(&patches, normal, touch, &mut points);
    ends.all().iter().for_each(|&end| points.add_seen(end));
    points
}

/// The point half-way between the two that the direction comes from. A direction that is the normal of a face comes from none: then the point is
/// straight over that face, at the highest corner of the first body or the lowest of the second.
fn between<A: Convex, B: Convex>(best: &Best<'_, A, B>, direction: &Direction, touch: &Touch) -> Point {
    let &Direction { normal, apart, pair } = direction;
    let highest = |patch: &Patch, sign: f64| {
        let height = |k: usize| sign * dot(normal, patch.corners()[k].at);
        patch.corners()[(1..patch.corners().len()).fold(0, |best, k| if height(k) > height(best) { k } else { best })]
    };
    let patches = [best.a.patch(normal, touch.level), best.b.patch(normal.map(|x| -x), touch.level)];
    let (a, b) = (highest(&patches[0], 1.0), highest(&patches[1], -1.0));
    let [on_a, on_b] = pair.unwrap_or(match [patches[0].normal, patches[1].normal] {
        [None, Some(_)] => [a.at, along(a.at, apart, normal)],
        [Some(_), None] => [along(b.at, -apart, normal), b.at],
        _ => [a.at, b.at],
    });
    let (on_a, on_b) = (along(on_a, touch.radii[0], normal), along(on_b, -touch.radii[1], normal));
    let at = std::array::from_fn(|k| 0.5 * (on_a[k] + on_b[k]));
    Point { feature: feature(2, a.id, b.id), at, normal, gap: apart - touch.grown() }
}

/// The unit vector along another one that is long enough.
fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let square = dot(v, v);
    (square > NO_DIRECTION).then(|| v.map(|x| x / square.sqrt()))
}
