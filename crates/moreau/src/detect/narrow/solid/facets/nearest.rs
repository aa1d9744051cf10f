//! Nearest points of edges and vertices.

use super::{Point, Seen, feature};
use crate::detect::narrow::vector::{along, cross, dot, sub};
use crate::shape::solid::Faceted;

/// The sine of the angle below which two edges are parallel: the direction across them has lost its digits.
const PARALLEL: f64 = 1e-7;

/// The unit vector across two edges, each from a point along a way, the point of the second one's line that is nearest to the first one's,
/// and whether both nearest points lie within the edges. `None` for parallel ones.
pub(super) fn between_lines(
    [p, u]: [[f64; 3]; 2],
    [r, v]: [[f64; 3]; 2],
    across: [f64; 3],
) -> Option<([f64; 3], [f64; 3], bool)> {
    let square = dot(across, across);
    if square <= PARALLEL * PARALLEL * dot(u, u) * dot(v, v) {
        return None;
    }
    // r + t v − p − s u is along u × v.
    let (beside_a, beside_b) = (cross(u, across), cross(v, across));
    let (s, t) = (dot(sub(r, p), beside_b) / dot(u, beside_b), dot(sub(p, r), beside_a) / dot(v, beside_a));
    let within = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
    Some((across.map(|x| x / square.sqrt()), along(r, t, v), within))
}

/// The nearest points of which one is a vertex and the other a vertex or on an edge, from all of them: for bodies that are apart and have
/// no face and no two edges nearest. Where they are as good as one the normal is that along which they are `apart`.
pub(super) fn nearest<A: Faceted, B: Faceted>(
    a: &Seen<'_, A>,
    b: &Seen<'_, B>,
    (normal, apart): ([f64; 3], f64),
    level: f64,
) -> Point {
    let mut best = (f64::INFINITY, 0, [[0.0; 3]; 2]);
    let mut meet = |feature: u64, on_a: [f64; 3], on_b: [f64; 3]| {
        let between = sub(on_b, on_a);
        if dot(between, between) < best.0 {
            best = (dot(between, between), feature, [on_a, on_b]);
        }
    };
    for (i, &on_a) in a.vertices.iter().enumerate() {
        for (j, &on_b) in b.vertices.iter().enumerate() {
            meet(feature(3, i, j), on_a, on_b);
        }
    }
    for (j, ends) in b.body.edges().iter().map(|edge| b.ends(edge)).enumerate() {
        for (i, &on_a) in a.vertices.iter().enumerate() {
            within(ends, on_a).into_iter().for_each(|on_b| meet(feature(0, i, j), on_a, on_b));
        }
    }
    for (i, ends) in a.body.edges().iter().map(|edge| a.ends(edge)).enumerate() {
        for (j, &on_b) in b.vertices.iter().enumerate() {
            within(ends, on_b).into_iter().for_each(|on_a| meet(feature(1, i, j), on_a, on_b));
        }
    }
    let (square, feature, [on_a, on_b]) = best;
    let gap = square.sqrt();
    if gap > level && apart > 0.0 {
        return Point { feature, at: on_b, normal: sub(on_b, on_a).map(|x| x / gap), gap };
    }
    Point { feature, at: on_b, normal, gap: apart }
}

/// The point between the ends of a segment that is nearest to another point, if there is one.
fn within([p, q]: [[f64; 3]; 2], point: [f64; 3]) -> Option<[f64; 3]> {
    let way = sub(q, p);
    let t = dot(sub(point, p), way) / dot(way, way);
    (t > 0.0 && t < 1.0).then(|| along(p, t, way))
}
