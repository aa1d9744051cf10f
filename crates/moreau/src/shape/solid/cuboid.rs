//! The box.

use super::{Edge, Faceted, faceted};
use crate::shape::{Contour, Figure, Polygons, SAME, ShapeError, error::length};
use crate::space::Solid;

/// A box around its centre, its edges along the body's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Half the edge lengths, m.
    pub half: [f64; 3],
}

impl Cuboid {
    /// A box with these (whole) edge lengths along x, y and z (m), which must be positive and finite.
    pub fn new([x, y, z]: [f64; 3]) -> Result<Self, ShapeError> {
        let x = length("the edge of the box along x", x)?;
        let y = length("the edge of the box along y", y)?;
        let z = length("the edge of the box along z", z)?;
        Ok(Self { half: [0.5 * x, 0.5 * y, 0.5 * z] })
    }

    /// Corner `index` (0 to 7) in the body's frame, m. The bits of the index, lowest first, say on which side it lies along x,
    /// y and z.
    #[inline]
    pub fn corner(&self, index: u64) -> [f64; 3] {
        let side = |axis: usize| if index >> axis & 1 == 0 { -self.half[axis] } else { self.half[axis] };
        [side(0), side(1), side(2)]
    }
}

impl Figure<Solid, 3, 6> for Cuboid {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.radius())
    }

    fn contour(&self, at: [f64; 3], outward: [f64; 3], _: usize) -> Contour<3> {
        let mut level = (0..3).filter(|&k| outward[k].abs() < SAME);
        match (level.next(), level.next()) {
            (Some(_), Some(_)) => Contour::Flat { at, outward },
            (Some(k), None) => Contour::Line { at, way: std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 }), radius: 0.0 },
            (None, _) => Contour::corner(at),
        }
    }

    fn polygons(&self) -> Polygons<3> {
        faceted::polygons(self)
    }

    fn mass(&self, density: f64) -> [f64; 6] {
        let [x, y, z] = self.half;
        let mass = density * 8.0 * x * y * z;
        // With half edges the familiar twelfth is a third.
        let moment = |p: f64, q: f64| mass / 3.0 * (p * p + q * q);
        [mass, mass, mass, moment(y, z), moment(z, x), moment(x, y)]
    }
}

/// Faces −x, +x, −y, +y, −z, +z by their corners.
const FACES: [[u16; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

const fn edge(start: u16, end: u16, left: u16, right: u16) -> Edge {
    Edge { ends: [start, end], faces: [left, right] }
}

const EDGES: [Edge; 12] = [
    edge(0, 1, 2, 4),
    edge(0, 2, 0, 4),
    edge(0, 4, 0, 2),
    edge(1, 3, 1, 4),
    edge(1, 5, 1, 2),
    edge(2, 3, 3, 4),
    edge(2, 6, 0, 3),
    edge(3, 7, 1, 3),
    edge(4, 5, 2, 5),
    edge(4, 6, 0, 5),
    edge(5, 7, 1, 5),
    edge(6, 7, 3, 5),
];

impl Faceted for Cuboid {
    fn vertices(&self) -> usize {
        8
    }

    #[inline]
    fn vertex(&self, i: usize) -> [f64; 3] {
        self.corner(i as u64)
    }

    fn faces(&self) -> usize {
        6
    }

    #[inline]
    fn normal(&self, i: usize) -> [f64; 3] {
        let outward = if i.is_multiple_of(2) { -1.0 } else { 1.0 };
        std::array::from_fn(|k| if k == i / 2 { outward } else { 0.0 })
    }

    #[inline]
    fn face(&self, i: usize) -> &[u16] {
        &FACES[i]
    }

    #[inline]
    fn edges(&self) -> &[Edge] {
        &EDGES
    }

    fn radius(&self) -> f64 {
        let [x, y, z] = self.half;
        (x * x + y * y + z * z).sqrt()
    }

    fn inner(&self) -> f64 {
        self.half.into_iter().fold(f64::INFINITY, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_run_counter_clockwise_and_edges_lie_between_their_faces() {
        let cuboid = Cuboid { half: [1.0, 2.0, 3.0] };
        for face in 0..6 {
            let [p, q, r] = [0, 1, 2].map(|k| cuboid.vertex(usize::from(cuboid.face(face)[k])));
            let (u, v): ([f64; 3], [f64; 3]) = (std::array::from_fn(|k| q[k] - p[k]), std::array::from_fn(|k| r[k] - q[k]));
            let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let along: f64 = (0..3).map(|k| normal[k] * cuboid.normal(face)[k]).sum();
            assert!(along > 0.0 && normal.iter().map(|x| x.abs()).sum::<f64>() == along, "face {face}");
        }
        for edge in cuboid.edges() {
            assert!(edge.faces.iter().all(|&face| edge.ends.iter().all(|end| cuboid.face(usize::from(face)).contains(end))));
        }
    }

    #[test]
    fn the_moments_of_a_box_are_twelfths() {
        let cuboid = Cuboid::new([1.0, 2.0, 3.0]).unwrap();
        let expected = [12.0, 12.0, 12.0, 13.0, 10.0, 5.0];
        for (found, right) in cuboid.mass(2.0).iter().zip(expected) {
            assert!((found - right).abs() < 1e-14);
        }
        assert!((cuboid.bounding_radius().unwrap() - 3.5_f64.sqrt()).abs() < 1e-15);
        assert_eq!(cuboid.corner(0b101), [0.5, -1.0, 1.5]);
    }

    #[test]
    fn each_edge_is_checked() {
        for axis in 0..3 {
            let mut edges = [1.0; 3];
            edges[axis] = f64::NAN;
            let text = Cuboid::new(edges).unwrap_err().to_string();
            assert!(text.contains(["along x", "along y", "along z"][axis]), "{text}");
        }
    }
}
