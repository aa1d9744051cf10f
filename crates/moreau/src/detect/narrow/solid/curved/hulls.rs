//! The best direction between a point or a segment and a body with flat faces.

use super::{Best, Hull, Touch, unit};
use crate::detect::narrow::vector::{along, cross, dot, sub};
use crate::shape::solid::Faceted;
use crate::space::{Solid, Space};

/// Square of the sine of the angle below which two edges are parallel: the direction across them has lost its digits.
const PARALLEL: f64 = 1e-14;

/// By how much of its length an edge may miss another one that it crosses.
const BEYOND: f64 = 1e-9;

/// Tries the faces of `b`, vertices with edges and vertices, and edges across each other. `a` has no faces.
pub(in crate::detect::narrow::solid) fn hulls<A: Faceted, B: Faceted>(
    best: &mut Best<'_, Hull<'_, A>, Hull<'_, B>>,
    touch: &Touch,
) {
    let (a, b) = (best.a, best.b);
    for face in 0..b.body.faces() {
        let (outward, height) = b.face(face);
        let lowest = (0..a.body.vertices()).map(|i| dot(outward, a.vertex(i))).fold(f64::INFINITY, f64::min);
        best.take_face(outward.map(|x| -x), lowest - height);
    }
    if b.body.faces() > 0 && best.is_beyond(touch) {
        return;
    }
    for edge in b.body.edges() {
        let ends = b.ends(edge);
        (0..a.body.vertices()).for_each(|i| {
            let vertex = a.vertex(i);
            within(ends, vertex).into_iter().for_each(|foot| best.offer_between([vertex, foot]));
        });
    }
    for edge in a.body.edges() {
        let ends = a.ends(edge);
        (0..b.body.vertices()).for_each(|i| {
            let vertex = b.vertex(i);
            within(ends, vertex).into_iter().for_each(|foot| best.offer_between([foot, vertex]));
        });
    }
    for i in 0..a.body.vertices() {
        (0..b.body.vertices()).for_each(|j| best.offer_between([a.vertex(i), b.vertex(j)]));
    }
    for edge_a in a.body.edges() {
        let ends_a = a.ends(edge_a);
        b.body.edges().iter().for_each(|edge_b| edges(best, ends_a, b.ends(edge_b)));
    }
}

/// Tries what is across two edges, if they are nearest within both.
fn edges<A: Faceted, B: Faceted>(best: &mut Best<'_, Hull<'_, A>, Hull<'_, B>>, [p, q]: [[f64; 3]; 2], [r, s]: [[f64; 3]; 2]) {
    let (u, v) = (sub(q, p), sub(s, r));
    let across = cross(u, v);
    let square = dot(across, across);
    if square <= PARALLEL * dot(u, u) * dot(v, v) {
        // Parallel ones that lie in each other leave each other across.
        let way = unit(u).unwrap_or([0.0; 3]);
        best.offer_beside(Solid::frame(way)[1], shared([p, q], [r, s]));
        return;
    }
    // r + y v − p − x u is along u × v.
    let (x, y) = (dot(cross(sub(r, p), v), across) / square, dot(cross(sub(r, p), u), across) / square);
    let within = |x: f64| x > -BEYOND && x < 1.0 + BEYOND;
    if within(x) && within(y) {
        best.offer_across(across, [along(p, x, u), along(r, y, v)]);
    }
}

/// The middle of what of the first segment is beside a parallel one, and the point beside it.
fn shared([p, q]: [[f64; 3]; 2], [r, s]: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
    let (u, v) = (sub(q, p), sub(s, r));
    let [x, y] = [r, s].map(|end| (dot(sub(end, p), u) / dot(u, u)).clamp(0.0, 1.0));
    let on_a = along(p, 0.5 * (x + y), u);
    [on_a, along(r, dot(sub(on_a, r), v) / dot(v, v), v)]
}

/// The point between the ends of a segment that is nearest to another point, if there is one.
fn within([p, q]: [[f64; 3]; 2], point: [f64; 3]) -> Option<[f64; 3]> {
    let way = sub(q, p);
    let place = dot(sub(point, p), way) / dot(way, way);
    (place > 0.0 && place < 1.0).then(|| along(p, place, way))
}
