//! Convex bodies with flat faces, as contacts see them.

use crate::shape::Polygons;

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

/// An edge, where two faces meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// Its vertices.
    pub ends: [u16; 2],
    /// The faces on both sides.
    pub faces: [u16; 2],
}
