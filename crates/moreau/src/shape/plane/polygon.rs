//! The convex polygon.

use crate::shape::{Figure, ShapeError};
use crate::space::Plane;
use std::sync::Arc;

/// Relative size below which a width or a turn counts as rounding.
const ROUNDING: f64 = 1e-12;

/// Largest coordinate whose fourth power, as in a moment of inertia, is far from overflow, m.
const FARTHEST: f64 = 1e70;

/// A convex polygon around its centre of mass, counter-clockwise. Copies share one list of vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    sides: Arc<[Side]>,
    area: f64,
    second_moment: f64,
    bounding_radius: f64,
}

/// One side of a polygon, in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// The vertex at which it begins, m.
    pub start: [f64; 2],
    /// The vertex at which it ends and the next side begins, m.
    pub end: [f64; 2],
    /// Its outward unit normal.
    pub normal: [f64; 2],
}

impl Polygon {
    /// The polygon with these vertices (m), in order around it either way, and its centre of mass in the same coordinates.
    /// Clockwise vertices are reversed, the first staying first. Vertices within a straight side are allowed.
    pub fn new(mut vertices: Vec<[f64; 2]>) -> Result<(Self, [f64; 2]), ShapeError> {
        check_points(&vertices)?;
        check_boundary(&vertices)?;
        if signed_area(&vertices) < 0.0 {
            vertices[1..].reverse();
        }
        let centre = centre_of_mass(&vertices);
        let vertices: Vec<_> = vertices.iter().map(|&v| sub(v, centre)).collect();
        let second_moment = sum(&vertices, |p, q| cross(p, q) * (dot(p, p) + dot(p, q) + dot(q, q))) / 12.0;
        let sides = (0..vertices.len()).map(|i| side(vertices[i], vertices[(i + 1) % vertices.len()])).collect();
        let bounding_radius = vertices.iter().fold(0.0, |r: f64, &v| r.max(dot(v, v))).sqrt();
        Ok((Self { sides, area: signed_area(&vertices), second_moment, bounding_radius }, centre))
    }

    /// Its sides, counter-clockwise; side `i` begins at vertex `i`.
    #[inline]
    pub fn sides(&self) -> &[Side] {
        &self.sides
    }

    /// Its vertices in the body's frame, counter-clockwise, m.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = [f64; 2]> + '_ {
        self.sides.iter().map(|side| side.start)
    }

    /// Radius of the disk around its centre of mass that holds it, m.
    #[inline]
    pub fn radius(&self) -> f64 {
        self.bounding_radius
    }

    /// Its area, m².
    pub fn area(&self) -> f64 {
        self.area
    }

    /// ∫ |x|² dA about its centre of mass, m⁴.
    pub fn second_moment(&self) -> f64 {
        self.second_moment
    }
}

impl Figure<Plane, 2, 3> for Polygon {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.bounding_radius)
    }

    fn mass(&self, density: f64) -> [f64; 3] {
        let mass = density * self.area;
        [mass, mass, density * self.second_moment]
    }
}

fn sub(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [p[0] - q[0], p[1] - q[1]]
}

fn dot(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[0] + p[1] * q[1]
}

fn cross(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

fn side(start: [f64; 2], end: [f64; 2]) -> Side {
    let along = sub(end, start);
    let length = dot(along, along).sqrt();
    Side { start, end, normal: [along[1] / length, -along[0] / length] }
}

/// Σ of a function over the edges.
fn sum(vertices: &[[f64; 2]], of: impl Fn([f64; 2], [f64; 2]) -> f64) -> f64 {
    (0..vertices.len()).map(|i| of(vertices[i], vertices[(i + 1) % vertices.len()])).sum()
}

/// Area, m²; negative if clockwise. Taken from the first vertex, so that a polygon far from the origin loses nothing.
fn signed_area(vertices: &[[f64; 2]]) -> f64 {
    0.5 * sum(vertices, |p, q| cross(sub(p, vertices[0]), sub(q, vertices[0])))
}

fn centre_of_mass(vertices: &[[f64; 2]]) -> [f64; 2] {
    let origin = vertices[0];
    let area = signed_area(vertices);
    let moment = |axis: usize| {
        sum(vertices, |p, q| {
            let (p, q) = (sub(p, origin), sub(q, origin));
            cross(p, q) * (p[axis] + q[axis])
        })
    };
    [origin[0] + moment(0) / (6.0 * area), origin[1] + moment(1) / (6.0 * area)]
}

/// Refuses what is wrong with the vertices as points: too few, nowhere, repeated, on one line.
fn check_points(vertices: &[[f64; 2]]) -> Result<(), ShapeError> {
    if vertices.len() < 3 {
        return Err(ShapeError::TooFewVertices { count: vertices.len() });
    }
    for (vertex, &[x, y]) in vertices.iter().enumerate() {
        if !(x.abs() < FARTHEST && y.abs() < FARTHEST) {
            return Err(ShapeError::NotFinite { vertex, x, y });
        }
    }
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

/// Refuses what is wrong with the order of distinct vertices that are not all on a line: edges that meet, notches. A boundary
/// that does not meet itself and never turns inwards is convex.
fn check_boundary(vertices: &[[f64; 2]]) -> Result<(), ShapeError> {
    let count = vertices.len();
    let ends = |i: usize| (vertices[i], vertices[(i + 1) % count]);
    for second in 2..count {
        // Neighbouring edges share a vertex: the one before `second`, and, of the last edge, the first.
        let start = usize::from(second == count - 1);
        if let Some(first) = (start..second - 1).find(|&first| meet(ends(first), ends(second))) {
            return Err(ShapeError::SelfIntersecting { first, second });
        }
    }
    let orientation = signed_area(vertices).signum();
    for vertex in 0..count {
        let into = sub(vertices[vertex], vertices[(vertex + count - 1) % count]);
        let out = sub(vertices[(vertex + 1) % count], vertices[vertex]);
        let turn = orientation * cross(into, out);
        let rounding = ROUNDING * (dot(into, into) * dot(out, out)).sqrt();
        if turn < -rounding || (turn <= rounding && dot(into, out) < 0.0) {
            return Err(ShapeError::NotConvex { vertex });
        }
    }
    Ok(())
}

/// Whether two closed segments have a point in common.
fn meet((p, q): ([f64; 2], [f64; 2]), (r, s): ([f64; 2], [f64; 2])) -> bool {
    let overlap = |axis: usize| p[axis].min(q[axis]) <= r[axis].max(s[axis]) && r[axis].min(s[axis]) <= p[axis].max(q[axis]);
    let apart = |p, q, r, s| cross(sub(q, p), sub(r, p)) * cross(sub(q, p), sub(s, p)) > 0.0;
    overlap(0) && overlap(1) && !apart(p, q, r, s) && !apart(r, s, p, q)
}

#[cfg(test)]
mod tests;
