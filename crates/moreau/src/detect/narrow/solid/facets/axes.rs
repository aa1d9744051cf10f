//! The axis that separates two bodies best.

use super::nearest::between_lines;
use super::{Point, Seen, feature};
use crate::detect::narrow::vector::{cross, dot, sub};
use crate::shape::solid::Faceted;

/// Along which direction two bodies are farthest apart, or overlap least.
pub(super) enum Axis {
    /// The normal of this face of the first body.
    FaceOfFirst(usize),
    /// The normal of this face of the second body.
    FaceOfSecond(usize),
    /// The cross product of two edges, with the point between these, and whether it lies within both.
    Edges(Point, bool),
}

/// The best axis and how far apart the bodies are along it; negative where they overlap. `None` where they are farther apart than `reach`,
/// or nowhere. Of axes that are as good as each other faces come before edges, and those of the first body before those of the second.
pub(super) fn best<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>, level: f64, reach: f64) -> Option<(Axis, f64)> {
    let (face_a, apart_a) = farthest(a, b);
    let (face_b, apart_b) = farthest(b, a);
    // Not `>`: what is nowhere touches nothing.
    if !(apart_a <= reach && apart_b <= reach) {
        return None;
    }
    let (mut axis, mut apart) = (Axis::FaceOfFirst(face_a), apart_a);
    if apart_b > apart + level {
        (axis, apart) = (Axis::FaceOfSecond(face_b), apart_b);
    }
    if let Some((point, within)) = edges(a, b)
        && point.gap > apart + level
    {
        (axis, apart) = (Axis::Edges(point, within), point.gap);
    }
    (apart <= reach).then_some((axis, apart))
}

/// The face of `body` beyond which `other` is farthest, and how far.
fn farthest<A: Faceted, B: Faceted>(body: &Seen<'_, A>, other: &Seen<'_, B>) -> (usize, f64) {
    let mut best = (0, f64::NEG_INFINITY);
    for face in 0..body.body.faces() {
        let (normal, corner) = (body.normal(face), body.corner(face, 0));
        let nearest = (0..other.body.vertices()).map(|i| dot(normal, sub(other.vertex(i), corner))).fold(f64::INFINITY, f64::min);
        if nearest > best.1 || nearest.is_nan() {
            best = (face, nearest);
        }
    }
    best
}

/// The two edges that separate best, with the point between them. Their normals are a face of the Minkowski difference only where the
/// arcs between the normals of their faces cross (Gregorius 2013).
fn edges<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>) -> Option<(Point, bool)> {
    let mut best: Option<(Point, bool)> = None;
    for (i, edge_a) in a.body.edges().iter().enumerate() {
        let [p, q] = edge_a.ends.map(|end| a.vertex(usize::from(end)));
        let [n, m] = edge_a.faces.map(|face| a.normal(usize::from(face)));
        let along_a = sub(q, p);
        for (j, edge_b) in b.body.edges().iter().enumerate() {
            let [r, s] = edge_b.ends.map(|end| b.vertex(usize::from(end)));
            let [k, l] = edge_b.faces.map(|face| b.normal(usize::from(face)).map(|x| -x));
            let along_b = sub(s, r);
            let across = cross(along_a, along_b);
            if !arcs_cross([n, m], along_a, [k, l], along_b, across) {
                continue;
            }
            let Some((normal, at, within)) = between_lines([p, along_a], [r, along_b], across) else { continue };
            // Outward of the first body: the normals of both its faces are on that side.
            let sign = 1.0_f64.copysign(dot(normal, sum(n, m)));
            let normal = normal.map(|x| sign * x);
            let point = Point { feature: feature(2, i, j), at, normal, gap: dot(normal, sub(r, p)) };
            if best.is_none_or(|(best, _)| point.gap > best.gap) {
                best = Some((point, within));
            }
        }
    }
    best
}

/// Whether the arc from n to m crosses that from k to l. The edges are the normals of the planes of the arcs, and `across` their product,
/// in which these planes meet.
fn arcs_cross([n, m]: [[f64; 3]; 2], edge_a: [f64; 3], [k, l]: [[f64; 3]; 2], edge_b: [f64; 3], across: [f64; 3]) -> bool {
    let apart = dot(k, edge_a) * dot(l, edge_a) < 0.0 && dot(n, edge_b) * dot(m, edge_b) < 0.0;
    // Of the two points where the planes meet on the sphere both arcs go through the same one.
    apart && dot(across, sum(n, m)) * dot(across, sum(k, l)) > 0.0
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k])
}
