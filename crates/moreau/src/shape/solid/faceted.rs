//! Convex bodies with flat faces, as contacts see them.

use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::{Contour, Polygons, SAME, is_same};

/// A convex polyhedron around its centre of mass, in its body's frame.
pub trait Faceted {
    /// How many vertices it has.
    fn vertices(&self) -> usize;
    /// Vertex `i`, m.
    fn vertex(&self, i: usize) -> [f64; 3];
    /// How many faces it has.
    fn faces(&self) -> usize;
    /// Outward unit normal of face `i`.
    fn normal(&self, i: usize) -> [f64; 3];
    /// The vertices of face `i`, counter-clockwise seen from outside.
    fn face(&self, i: usize) -> &[u16];
    /// All edges.
    fn edges(&self) -> &[Edge];
    /// Radius of the ball around the centre of mass that holds it, m.
    fn radius(&self) -> f64;
    /// Radius of a ball around the centre of mass that lies inside it, m: the larger, the sooner contacts are found.
    fn inner(&self) -> f64;
}

/// Its faces.
pub(super) fn polygons(body: &impl Faceted) -> Polygons<3> {
    let mut all = Polygons::on((0..body.vertices()).map(|i| body.vertex(i)).collect());
    (0..body.faces()).for_each(|i| all.push(body.face(i).iter().map(|&corner| usize::from(corner))));
    all
}

/// What it is like near a point of contact: a face, an edge or a corner.
pub(super) fn contour(body: &impl Faceted, at: [f64; 3], outward: [f64; 3]) -> Contour<3> {
    if (0..body.faces()).any(|face| is_same(body.normal(face), outward)) {
        return Contour::Flat { at, outward };
    }
    for edge in body.edges() {
        let [start, end] = edge.ends.map(|i| body.vertex(usize::from(i)));
        let (side, from) = (sub(end, start), sub(at, start));
        let length = dot(side, side).sqrt();
        let way = side.map(|x| x / length);
        let off = along(from, -dot(from, way), way);
        if dot(way, outward).abs() < SAME && dot(off, off) < (SAME * body.radius()) * (SAME * body.radius()) {
            return Contour::Line { at, way, radius: 0.0 };
        }
    }
    Contour::corner(at)
}

/// An edge, where two faces meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its vertices.
    pub ends: [u16; 2],
    /// The faces on both sides.
    pub faces: [u16; 2],
}
