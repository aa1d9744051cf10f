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
/// `between` leads from the centre of the first to that of the second.
pub(super) fn best<A: Faceted, B: Faceted>(
    a: &Seen<'_, A>,
    b: &Seen<'_, B>,
    between: [f64; 3],
    sides: &mut Vec<i8>,
    level: f64,
    reach: f64,
) -> Option<(Axis, f64)> {
    // Most bodies that do not touch are told apart along the line of their centres.
    let (end, start) = (support(a.vertices, between), -support(b.vertices, between.map(|x| -x)));
    if start - end > reach.max(0.0) * dot(between, between).sqrt() {
        return None;
    }
    // Not `>`: what is nowhere touches nothing.
    let in_reach = |(face, apart): (usize, f64)| (apart <= reach).then_some((face, apart));
    let (face_a, apart_a) = in_reach(farthest(a, b))?;
    let (face_b, apart_b) = in_reach(farthest(b, a))?;
    let (mut axis, mut apart) = (Axis::FaceOfFirst(face_a), apart_a);
    if apart_b > apart + level {
        (axis, apart) = (Axis::FaceOfSecond(face_b), apart_b);
    }
    if let Some((point, within)) = edges(a, b, sides)
        && point.gap > apart + level
    {
        (axis, apart) = (Axis::Edges(point, within), point.gap);
    }
    (apart <= reach).then_some((axis, apart))
}

/// How far points go in a direction, times its length.
fn support(vertices: &[[f64; 3]], direction: [f64; 3]) -> f64 {
    vertices.iter().map(|&vertex| dot(direction, vertex)).fold(f64::NEG_INFINITY, f64::max)
}

/// The face of `body` beyond which `other` is farthest, and how far.
fn farthest<A: Faceted, B: Faceted>(body: &Seen<'_, A>, other: &Seen<'_, B>) -> (usize, f64) {
    let mut best = (0, f64::NEG_INFINITY);
    for (face, &normal) in body.normals.iter().enumerate() {
        let corner = body.corner(face, 0);
        let nearest = other.vertices.iter().map(|&vertex| dot(normal, sub(vertex, corner))).fold(f64::INFINITY, f64::min);
        if nearest > best.1 || nearest.is_nan() {
            best = (face, nearest);
        }
    }
    best
}

/// The two edges that separate best, with the point between them. Their normals are a face of the Minkowski difference only where the
/// arcs between the normals of their faces cross (Gregorius 2013).
fn edges<A: Faceted, B: Faceted>(a: &Seen<'_, A>, b: &Seen<'_, B>, sides: &mut Vec<i8>) -> Option<(Point, bool)> {
    let mut best: Option<(Point, bool)> = None;
    for (i, edge_a) in a.body.edges().iter().enumerate() {
        let [p, q] = a.ends(edge_a);
        let [n, m] = edge_a.faces.map(|face| a.normals[usize::from(face)]);
        let along_a = sub(q, p);
        // An arc of the second body crosses the plane of this edge's arc where its ends are on both sides: true of few.
        sides.clear();
        sides.extend(b.normals.iter().map(|&normal| side(dot(normal, along_a))));
        for (j, edge_b) in b.body.edges().iter().enumerate() {
            let [left, right] = edge_b.faces.map(usize::from);
            if sides[left] * sides[right] >= 0 {
                continue;
            }
            let [r, s] = b.ends(edge_b);
            let along_b = sub(s, r);
            if side(dot(n, along_b)) * side(dot(m, along_b)) >= 0 {
                continue;
            }
            // Of the two points where the planes meet on the sphere both arcs must go through the same one.
            let across = cross(along_a, along_b);
            if dot(across, sum(n, m)) * dot(across, sum(b.normals[left], b.normals[right])) >= 0.0 {
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

/// −1, 0 or 1.
fn side(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] + b[k])
}
