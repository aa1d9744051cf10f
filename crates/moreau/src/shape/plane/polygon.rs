//! The convex polygon.

use super::boundary::{Side, check_convex, check_points, check_simple, cross, dot, side, signed_area, sub, sum};
use crate::shape::error::length;
use crate::shape::{Contour, Figure, Polygons, ShapeError, is_same};
use crate::space::Plane;
use std::sync::Arc;

/// A convex polygon around its centre of mass, counter-clockwise. Copies share one list of vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    sides: Arc<[Side]>,
    area: f64,
    second_moment: f64,
    bounding_radius: f64,
}

impl Polygon {
    /// The polygon with these vertices (m), in order around it either way, and its centre of mass in the same coordinates.
    /// Clockwise vertices are reversed, the first staying first. Vertices within a straight side are allowed.
    pub fn new(mut vertices: Vec<[f64; 2]>) -> Result<(Self, [f64; 2]), ShapeError> {
        check_points(&vertices)?;
        check_simple(&vertices)?;
        check_convex(&vertices)?;
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

    /// The rectangle with these edges (m) along the axes of its frame; vertex 0 is the lowest of both.
    pub fn rectangle(width: f64, height: f64) -> Result<Self, ShapeError> {
        let (width, height) = (length("the width of the box", width)?, length("the height of the box", height)?);
        let (x, y) = (0.5 * width, 0.5 * height);
        let vertices = [[-x, -y], [x, -y], [x, y], [-x, y]];
        check_points(&vertices)?;
        let (area, square) = (width * height, width * width + height * height);
        let sides = (0..4).map(|i| side(vertices[i], vertices[(i + 1) % 4])).collect();
        Ok(Self { sides, area, second_moment: area * square / 12.0, bounding_radius: 0.5 * square.sqrt() })
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

    fn contour(&self, at: [f64; 2], outward: [f64; 2], _: usize) -> Contour<2> {
        let is_side = self.sides.iter().any(|side| is_same(side.normal, outward));
        if is_side { Contour::Flat { at, outward } } else { Contour::corner(at) }
    }

    fn polygons(&self) -> Polygons<2> {
        Polygons::of_loop(self.vertices())
    }

    fn mass(&self, density: f64) -> [f64; 3] {
        let mass = density * self.area;
        [mass, mass, density * self.second_moment]
    }
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

#[cfg(test)]
mod tests;
