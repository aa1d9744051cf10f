//! Figures bounded by straight sides: small vectors, and what their boundaries must keep to.

use crate::shape::ShapeError;

/// Relative size below which a width or a turn counts as rounding.
pub(super) const ROUNDING: f64 = 1e-12;

/// Largest coordinate whose fourth power, as in a moment of inertia, is far from overflow, m.
pub(super) const FARTHEST: f64 = 1e70;

/// One side of a figure, in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// The vertex at which it begins, m.
    pub start: [f64; 2],
    /// The vertex at which it ends and the next side begins, m.
    pub end: [f64; 2],
    /// Its outward unit normal: the figure lies to the left of the way from start to end.
    pub normal: [f64; 2],
}

pub(super) fn sub(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

pub(super) fn dot(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[0] + p[1] * q[1]
}

pub(super) fn cross(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

/// The side from one vertex to another.
pub(super) fn side(start: [f64; 2], end: [f64; 2]) -> Side {
    let along = sub(end, start);
    let length = dot(along, along).sqrt();
    Side { start, end, normal: [along[1] / length, -along[0] / length] }
}

/// Σ of a function over the edges.
pub(super) fn sum(vertices: &[[f64; 2]], of: impl Fn([f64; 2], [f64; 2]) -> f64) -> f64 {
    (0..vertices.len()).map(|i| of(vertices[i], vertices[(i + 1) % vertices.len()])).sum()
}

/// Area, m²; negative if clockwise. Taken from the first vertex, so that a polygon far from the origin loses nothing.
pub(super) fn signed_area(vertices: &[[f64; 2]]) -> f64 {
    0.5 * sum(vertices, |p, q| cross(sub(p, vertices[0]), sub(q, vertices[0])))
}

/// Refuses points that are nowhere.
pub(super) fn check_finite(vertices: &[[f64; 2]]) -> Result<(), ShapeError> {
    let bad = vertices.iter().position(|&[x, y]| !(x.abs() < FARTHEST && y.abs() < FARTHEST));
    bad.map_or(Ok(()), |vertex| Err(ShapeError::NotFinite { vertex, x: vertices[vertex][0], y: vertices[vertex][1] }))
}

/// Refuses what is wrong with the vertices as points: too few, nowhere, repeated, on one line.
pub(super) fn check_points(vertices: &[[f64; 2]]) -> Result<(), ShapeError> {
    if vertices.len() < 3 {
        return Err(ShapeError::TooFewVertices { count: vertices.len() });
    }
    check_finite(vertices)?;
    for second in 1..vertices.len() {
        if let Some(first) = (0..second).find(|&first| vertices[first] == vertices[second]) {
            return Err(ShapeError::RepeatedVertex { first, second });
        }
    }
    let from_first = |i: usize| sub(vertices[i], vertices[0]);
    let distance = |i: usize| dot(from_first(i), from_first(i));
    let farthest = (1..vertices.len()).fold(1, |best, i| if distance(i) > distance(best) { i } else { best });
    let width = vertices.iter().fold(0.0, |w: f64, &v| w.max(cross(from_first(farthest), sub(v, vertices[0])).abs()));
    // The last condition is for polygons so small that their moment of inertia underflows.
    if width <= ROUNDING * distance(farthest) || width * width < f64::MIN_POSITIVE {
        return Err(ShapeError::NoArea { vertex: farthest });
    }
    Ok(())
}

/// Refuses an order of distinct vertices, not all on a line, in which edges meet.
pub(super) fn check_simple(vertices: &[[f64; 2]]) -> Result<(), ShapeError> {
    let count = vertices.len();
    let ends = |i: usize| (vertices[i], vertices[(i + 1) % count]);
    for second in 2..count {
        // Neighbouring edges share a vertex: the one before `second`, and, of the last edge, the first.
        let start = usize::from(second == count - 1);
        if let Some(first) = (start..second - 1).find(|&first| meet(ends(first), ends(second))) {
            return Err(ShapeError::SelfIntersecting { first, second });
        }
    }
    Ok(())
}

/// The turn at the middle one of three vertices: its sine, left positive, with what is rounding set to zero; and whether the way goes on
/// rather than back.
pub(super) fn turn([before, at, after]: [[f64; 2]; 3]) -> (f64, bool) {
    let (into, out) = (sub(at, before), sub(after, at));
    let sine = cross(into, out) / (dot(into, into).sqrt() * dot(out, out).sqrt());
    (if sine.abs() <= ROUNDING { 0.0 } else { sine }, dot(into, out) > 0.0)
}

/// Refuses a boundary that turns inwards. One that neither meets itself nor turns inwards is convex.
pub(super) fn check_convex(vertices: &[[f64; 2]]) -> Result<(), ShapeError> {
    let (count, orientation) = (vertices.len(), signed_area(vertices).signum());
    let inwards = (0..count).find(|&vertex| {
        let (sine, on) = turn([vertices[(vertex + count - 1) % count], vertices[vertex], vertices[(vertex + 1) % count]]);
        orientation * sine < 0.0 || (sine == 0.0 && !on)
    });
    inwards.map_or(Ok(()), |vertex| Err(ShapeError::NotConvex { vertex }))
}

/// Whether two closed segments have a point in common.
pub(super) fn meet((p, q): ([f64; 2], [f64; 2]), (r, s): ([f64; 2], [f64; 2])) -> bool {
    let overlap = |axis: usize| p[axis].min(q[axis]) <= r[axis].max(s[axis]) && r[axis].min(s[axis]) <= p[axis].max(q[axis]);
    let apart = |p, q, r, s| cross(sub(q, p), sub(r, p)) * cross(sub(q, p), sub(s, p)) > 0.0;
    overlap(0) && overlap(1) && !apart(p, q, r, s) && !apart(r, s, p, q)
}
