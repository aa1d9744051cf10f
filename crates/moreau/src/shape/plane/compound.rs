//! The compound: a rigid body of several convex parts.

use super::PlaneShape;
use super::boundary::dot;
use crate::shape::{self, Contour, Figure, Polygons, Shape, ShapeError};
use crate::space::{Plane, Pose, placed};
use std::sync::Arc;

/// The most parts that there can be: their numbers have ten bits in the feature of a contact.
const MOST_PARTS: usize = 1 << 10;

/// Several convex shapes, held together. Where parts overlap their mass counts as often as they do. Copies share one list of parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Compound {
    parts: Arc<[Part]>,
    area: f64,
    second_moment: f64,
    bounding_radius: f64,
}

/// One part of a compound: a disk, a capsule or a polygon.
pub type Part = shape::Part<PlaneShape, [f64; 2], 2>;

impl Compound {
    /// The compound of these shapes, each in its place, and its centre of mass in the same coordinates. Of a compound among them the
    /// parts are taken.
    pub fn new(shapes: Vec<(PlaneShape, Pose<[f64; 2], 2>)>) -> Result<(Self, [f64; 2]), ShapeError> {
        let mut parts = Vec::with_capacity(shapes.len());
        for (part, (shape, pose)) in shapes.into_iter().enumerate() {
            match (shape.bounding_radius(), &shape) {
                (_, PlaneShape::Compound(inner)) => {
                    parts.extend(
                        inner.parts.iter().map(|part| Part { pose: placed::<Plane, 2, 3>(&pose, &part.pose), ..part.clone() }),
                    );
                }
                (Some(radius), _) => parts.push(Part { shape, pose, radius }),
                (None, _) => return Err(ShapeError::NotAPart { part, name: shape.name() }),
            }
        }
        if parts.is_empty() {
            return Err(ShapeError::NoParts);
        }
        if parts.len() > MOST_PARTS {
            return Err(ShapeError::TooMany { what: "parts of a compound", count: parts.len(), most: MOST_PARTS });
        }
        let masses: Vec<[f64; 3]> = parts.iter().map(|part| part.shape.mass(1.0)).collect();
        let area = masses.iter().map(|mass| mass[0]).sum();
        // From the first part, so that a compound far from the origin loses nothing.
        let origin = parts[0].pose.position;
        let moment = |k: usize| -> f64 {
            parts.iter().zip(&masses).map(|(part, mass)| mass[0] * (part.pose.position[k] - origin[k])).sum()
        };
        let centre = [origin[0] + moment(0) / area, origin[1] + moment(1) / area];
        let (mut second_moment, mut bounding_radius) = (0.0, 0.0_f64);
        for (part, mass) in parts.iter_mut().zip(&masses) {
            part.pose.position = std::array::from_fn(|k| part.pose.position[k] - centre[k]);
            let square = dot(part.pose.position, part.pose.position);
            second_moment += mass[2] + mass[0] * square;
            bounding_radius = bounding_radius.max(square.sqrt() + part.radius);
        }
        Ok((Self { parts: parts.into(), area, second_moment, bounding_radius }, centre))
    }

    /// Its parts.
    #[inline]
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }
}

impl Figure<Plane, 2, 3> for Compound {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.bounding_radius)
    }

    fn parts(&self) -> &[Part] {
        &self.parts
    }

    fn contour(&self, at: [f64; 2], _: [f64; 2], _: usize) -> Contour<2> {
        Contour::corner(at)
    }

    fn polygons(&self) -> Polygons<2> {
        let mut all = Polygons::default();
        self.parts.iter().for_each(|part| all.add::<Plane, 3>(&part.shape.polygons(), &part.pose));
        all
    }

    fn mass(&self, density: f64) -> [f64; 3] {
        let mass = density * self.area;
        [mass, mass, density * self.second_moment]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::plane::{Capsule, Disk, HalfPlane, Polygon};

    const UP: [f64; 2] = [1.0, 0.0];

    fn at(x: f64, y: f64) -> Pose<[f64; 2], 2> {
        Pose { position: [x, y], rotation: UP }
    }

    #[test]
    fn an_l_of_two_boxes_has_the_moment_of_its_polygon() {
        let l = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        let foot = (Polygon::rectangle(3.0, 1.0).unwrap().into(), at(1.5, 0.5));
        let leg = (Polygon::rectangle(1.0, 1.0).unwrap().into(), at(0.5, 1.5));
        let (compound, centre) = Compound::new(vec![foot, leg]).unwrap();
        // Green's theorem on the whole boundary: A, ∫ x dA, ∫ y dA and ∫ |x|² dA.
        let mut sums = [0.0; 4];
        for (i, p) in l.iter().enumerate() {
            let q = l[(i + 1) % 6];
            let c = p[0] * q[1] - p[1] * q[0];
            let square: f64 = (0..2).map(|k| p[k] * p[k] + p[k] * q[k] + q[k] * q[k]).sum();
            for (sum, term) in sums.iter_mut().zip([c / 2.0, c * (p[0] + q[0]) / 6.0, c * (p[1] + q[1]) / 6.0, c * square / 12.0])
            {
                *sum += term;
            }
        }
        let right = [sums[1] / sums[0], sums[2] / sums[0]];
        assert!((0..2).all(|k| (centre[k] - right[k]).abs() < 1e-14), "{centre:?}");
        let [m, _, j] = compound.mass(5.0);
        let moment = sums[3] - sums[0] * (right[0] * right[0] + right[1] * right[1]);
        assert!((m - 5.0 * sums[0]).abs() < 1e-13 && (j - 5.0 * moment).abs() < 1e-12, "{m} {j}");
    }

    #[test]
    fn a_dumb_bell_has_the_moment_of_its_disks_wherever_it_is() {
        for far in [0.0, 1e6] {
            let (bell, centre) =
                Compound::new([-1.0, 1.0].map(|x| (Disk { radius: 0.5 }.into(), at(far + x, far))).to_vec()).unwrap();
            let area = std::f64::consts::PI / 4.0;
            let [m, _, j] = bell.mass(1.0);
            assert!((m - 2.0 * area).abs() < 1e-14 && (j - 2.0 * area * (0.125 + 1.0)).abs() < 1e-13, "{j}");
            assert!(centre == [far; 2] && bell.bounding_radius() == Some(1.5));
        }
    }

    #[test]
    fn parts_of_parts_are_parts() {
        let arm = Capsule::new(0.1, 1.0).unwrap();
        let (cross, _) =
            Compound::new(vec![(arm.into(), at(0.0, 0.0)), (arm.into(), Pose { position: [0.0, 0.0], rotation: [0.0, 1.0] })])
                .unwrap();
        let (pair, _) = Compound::new(vec![(cross.clone().into(), at(1.0, 0.0)), (cross.into(), at(-1.0, 0.0))]).unwrap();
        assert!(pair.parts().len() == 4 && pair.parts()[3].pose.rotation == [0.0, 1.0]);
    }

    #[test]
    fn compounds_that_cannot_be_are_refused() {
        assert_eq!(Compound::new(Vec::new()).unwrap_err(), ShapeError::NoParts);
        let disk = (PlaneShape::from(Disk { radius: 1.0 }), at(0.0, 0.0));
        let ground = (PlaneShape::from(HalfPlane), at(0.0, 0.0));
        let error = Compound::new(vec![disk.clone(), ground]).unwrap_err();
        assert_eq!(error, ShapeError::NotAPart { part: 1, name: "half_plane" });
        assert!(matches!(Compound::new(vec![disk; 1025]).unwrap_err(), ShapeError::TooMany { count: 1025, .. }));
    }
}
