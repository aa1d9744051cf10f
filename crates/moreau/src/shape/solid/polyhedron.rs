//! The convex polyhedron.

mod hull;
#[cfg(test)]
mod tests;

use super::inertia::Moments;
use super::{Edge, Faceted, faceted};
use crate::detect::narrow::vector::dot;
use crate::shape::{Contour, Figure, Polygons, ShapeError};
use crate::space::{Pose, Solid, Space};
use glam::DQuat;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A convex polyhedron around its centre of mass, turned into its principal axes. Copies share one description.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    form: Arc<Form>,
}

/// What a polyhedron is, in its body's frame.
#[derive(Debug, PartialEq)]
struct Form {
    vertices: Vec<[f64; 3]>,
    /// Corners of all faces, one face after the other.
    corners: Vec<u16>,
    /// Where each face begins among the corners, and their number.
    starts: Vec<u32>,
    normals: Vec<[f64; 3]>,
    edges: Vec<Edge>,
    radius: f64,
    inner: f64,
    /// m³.
    volume: f64,
    /// Principal moments of inertia at density 1, m⁵.
    moments: [f64; 3],
}

impl Polyhedron {
    /// The most corners that one may have: features of contacts number corners and edges with 15 bits.
    pub const MOST_VERTICES: usize = 4096;

    /// The convex hull of these points (m) and where its body is in their coordinates: its centre of mass, and the rotation from its
    /// principal axes. Points inside, on faces and on edges are left out; what deviates from a common plane by less than a part in 10⁹
    /// of the size is one face.
    ///
    /// # Errors
    /// Too few points or too many corners, points that are nowhere, points that all lie in a plane, and points of which no polyhedron
    /// can be told from rounding.
    pub fn hull(points: &[[f64; 3]]) -> Result<(Self, Pose<DQuat, 3>), ShapeError> {
        Self::hull_within(points, 1e-9)
    }

    /// [`hull`](Self::hull), with faces that are flat to `flat` parts of the size: for data of few digits.
    ///
    /// # Errors
    /// As there.
    pub fn hull_within(points: &[[f64; 3]], flat: f64) -> Result<(Self, Pose<DQuat, 3>), ShapeError> {
        let (vertices, faces) = hull::hull(points, flat)?;
        if vertices.len() > Self::MOST_VERTICES {
            return Err(ShapeError::TooMany {
                what: "corners of a polyhedron",
                count: vertices.len(),
                most: Self::MOST_VERTICES,
            });
        }
        let fan = faces.iter().flat_map(|face| (2..face.len()).map(|k| [face[0], face[k - 1], face[k]]));
        let mass = Moments::of_closed(fan.map(|triangle| triangle.map(|i| vertices[usize::from(i)])));
        let (moments, rotation) = mass.principal();
        let pose = Pose { position: mass.centre, rotation };
        let inside = |p: [f64; 3]| Solid::unrotate(rotation, std::array::from_fn(|k| p[k] - mass.centre[k]));
        let form = Form::new(vertices.into_iter().map(inside).collect(), &faces, mass.volume, moments);
        Ok((Self { form: Arc::new(form) }, pose))
    }

    /// Its volume, m³.
    pub fn volume(&self) -> f64 {
        self.form.volume
    }
}

impl Form {
    fn new(vertices: Vec<[f64; 3]>, faces: &[Vec<u16>], volume: f64, moments: [f64; 3]) -> Self {
        let mut starts = vec![0];
        starts.extend(faces.iter().scan(0, |end, face| {
            *end += face.len() as u32;
            Some(*end)
        }));
        let radius = vertices.iter().map(|v| v.iter().map(|x| x * x).sum::<f64>()).fold(0.0, f64::max).sqrt();
        let normals: Vec<[f64; 3]> = faces.iter().map(|face| normal(&vertices, face)).collect();
        // Faces need be flat only so far: of each the lowest corner counts.
        let heights = faces.iter().zip(&normals).flat_map(|(face, &n)| face.iter().map(move |&i| (n, usize::from(i))));
        let inner = heights.map(|(normal, i)| dot(normal, vertices[i])).fold(radius, f64::min).max(0.0);
        Self { normals, edges: edges(faces), corners: faces.concat(), starts, radius, inner, volume, moments, vertices }
    }
}

/// The unit normal of a face: that of its vector area (Newell), in which every corner counts.
fn normal(vertices: &[[f64; 3]], face: &[u16]) -> [f64; 3] {
    let at = |k: usize| glam::DVec3::from(vertices[usize::from(face[k % face.len()])]);
    let area: glam::DVec3 = (1..face.len() - 1).map(|k| (at(k) - at(0)).cross(at(k + 1) - at(0))).sum();
    area.normalize().into()
}

/// Each edge once, in the order of its vertices.
fn edges(faces: &[Vec<u16>]) -> Vec<Edge> {
    let mut sides = BTreeMap::new();
    for (face, corners) in (0..).zip(faces) {
        for k in 0..corners.len() {
            sides.insert((corners[k], corners[(k + 1) % corners.len()]), face);
        }
    }
    let of = |(&(start, end), &left): (&(u16, u16), &u16)| {
        sides.get(&(end, start)).filter(|_| start < end).map(|&right| Edge { ends: [start, end], faces: [left, right] })
    };
    sides.iter().filter_map(of).collect()
}

impl Figure<Solid, 3, 6> for Polyhedron {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.form.radius)
    }

    fn contour(&self, at: [f64; 3], outward: [f64; 3], _: usize) -> Contour<3> {
        faceted::contour(self, at, outward)
    }

    fn polygons(&self) -> Polygons<3> {
        faceted::polygons(self)
    }

    fn mass(&self, density: f64) -> [f64; 6] {
        let (mass, [i, j, k]) = (density * self.form.volume, self.form.moments.map(|moment| density * moment));
        [mass, mass, mass, i, j, k]
    }
}

impl Faceted for Polyhedron {
    #[inline]
    fn vertices(&self) -> usize {
        self.form.vertices.len()
    }

    #[inline]
    fn vertex(&self, i: usize) -> [f64; 3] {
        self.form.vertices[i]
    }

    #[inline]
    fn faces(&self) -> usize {
        self.form.normals.len()
    }

    #[inline]
    fn normal(&self, i: usize) -> [f64; 3] {
        self.form.normals[i]
    }

    #[inline]
    fn face(&self, i: usize) -> &[u16] {
        &self.form.corners[self.form.starts[i] as usize..self.form.starts[i + 1] as usize]
    }

    #[inline]
    fn edges(&self) -> &[Edge] {
        &self.form.edges
    }

    #[inline]
    fn radius(&self) -> f64 {
        self.form.radius
    }

    #[inline]
    fn inner(&self) -> f64 {
        self.form.inner
    }
}
