//! The axis that separates two bodies best.

use super::bounds::{Bounds, Most, keep};
use super::nearest::between_lines;
use super::{Point, Seen, feature};
use crate::detect::narrow::vector::{cross, dot, sub};
use crate::shape::solid::Faceted;

/// Part of a gap that rounding may be, with room: what is skipped for it would not have been better.
const NEARLY: f64 = 1e-9;

/// A face beyond which the other body is `apart` (m), negative where they overlap.
pub(super) struct Face {
    pub(super) of_first: bool,
    pub(super) number: usize,
    pub(super) apart: f64,
}

/// Whether two bodies are farther apart than `reach` along the line between their centres, as most are that do not touch. `between` leads
/// from the centre of the first to that of the second.
pub(super) fn are_beyond<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>, between: [f64; 3], reach: f64) -> bool {
    let (end, start) = (support(a.vertices, between), -support(b.vertices, between.map(|x| -x)));
    start - end > reach.max(0.0) * dot(between, between).sqrt()
}

/// The face beyond which the other body is farthest. `None` where that is beyond `reach`, or nowhere. Of faces that are as good as each other
/// those of the first body come before those of the second.
pub(super) fn faces<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>, level: f64, reach: f64) -> Option<Face> {
    let (face_a, apart_a) = farthest(a, b, f64::NEG_INFINITY, level, reach)?;
    let (face_b, apart_b) = farthest(b, a, apart_a, level, reach)?;
    let of_first = apart_b <= apart_a + level;
    Some(if of_first {
        Face { of_first, number: face_a, apart: apart_a }
    } else {
        Face { of_first, number: face_b, apart: apart_b }
    })
}

/// How far points go in a direction, times its length.
pub(in crate::detect::narrow::solid) fn support(vertices: &[[f64; 3]], direction: [f64; 3]) -> f64 {
    vertices.iter().map(|&vertex| dot(direction, vertex)).fold(f64::NEG_INFINITY, |most, x| if most > x { most } else { x })
}

/// The face of `body` beyond which `other` is farthest, and how far, if that is more than `floor`; of those that are level the first, so that
/// rounding does not choose the normal of bodies that share an edge. `None` if that is beyond `reach`, or nowhere.
fn farthest<A: Faceted, B: Faceted>(
    body: &Seen<'_, A>,
    other: &Seen<'_, B>,
    floor: f64,
    level: f64,
    reach: f64,
) -> Option<(usize, f64)> {
    let most = Most::new(body, other);
    let mut best = (0, f64::NEG_INFINITY);
    for (face, &normal) in body.normals.iter().enumerate() {
        // With room for rounding; what is not a number is looked at.
        if most.along(normal) < best.1.max(floor) - level {
            continue;
        }
        let corner = body.corner(face, 0);
        let height = |vertex: &[f64; 3]| dot(normal, sub(*vertex, corner));
        let nearest = other.vertices.iter().map(height).fold(f64::INFINITY, |least, x| if least < x { least } else { x });
        // What is nowhere touches nothing.
        if nearest.is_nan() || nearest > reach {
            return None;
        }
        if nearest > best.1 + level {
            best = (face, nearest);
        }
    }
    Some(best)
}

/// The two edges that separate best and more than `floor`, with the point between them. Their normals are a face of the
/// Minkowski difference only where the arcs between the normals of their faces cross (Gregorius 2013).
pub(super) fn edges<A: Faceted, B: Faceted>(
    a: &Seen<'_, A>,
    b: &Seen<'_, B>,
    floor: f64,
    level: f64,
    bounds: &mut Bounds,
) -> Option<(Point, bool)> {
    bounds.find(a, b, floor - level);
    let mut best: Option<(Point, bool)> = None;
    let mut least = floor;
    let Bounds { first, second, crossing, .. } = bounds;
    for &i in &*first {
        let edge_a = &a.body.edges()[usize::from(i)];
        let [p, q] = a.ends(edge_a);
        let [n, m] = edge_a.faces.map(|face| a.normals[usize::from(face)]);
        let along_a = sub(q, p);
        // The arcs of these cross the plane across the edge.
        let across = |j: u16| {
            let [left, right] = b.body.edges()[usize::from(j)].faces.map(|face| dot(b.normals[usize::from(face)], along_a));
            left * right < 0.0
        };
        keep(second.iter().copied(), across, crossing);
        for &j in &*crossing {
            let edge_b = &b.body.edges()[usize::from(j)];
            let [left, right] = edge_b.faces.map(usize::from);
            let [r, s] = b.ends(edge_b);
            let along_b = sub(s, r);
            if dot(n, along_b) * dot(m, along_b) >= 0.0 {
                continue;
            }
            // Of the two points where the planes meet on the sphere both arcs must go through the same one.
            let across = cross(along_a, along_b);
            if dot(across, sum(n, m)) * dot(across, sum(b.normals[left], b.normals[right])) >= 0.0 {
                continue;
            }
            // Outward of the first body: the normals of both its faces are on that side. Most are not as far apart as the best, which takes
            // no more than a square root to see.
            let outward = 1.0_f64.copysign(dot(across, sum(n, m)));
            if outward * dot(across, sub(r, p)) < (least - NEARLY * least.abs()) * dot(across, across).sqrt() {
                continue;
            }
            let Some((normal, at, within)) = between_lines([p, along_a], [r, along_b], across) else { continue };
            let normal = normal.map(|x| outward * x);
            let point = Point { feature: feature(2, usize::from(i), usize::from(j)), at, normal, gap: dot(normal, sub(r, p)) };
            if point.gap > least {
                (best, least) = (Some((point, within)), point.gap);
            }
        }
    }
    best
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k])
}
