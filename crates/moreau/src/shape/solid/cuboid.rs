//! The box.

use crate::shape::{Figure, ShapeError, error::length};
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
    pub fn corner(&self, index: u32) -> [f64; 3] {
        let side = |axis: usize| if index >> axis & 1 == 0 { -self.half[axis] } else { self.half[axis] };
        [side(0), side(1), side(2)]
    }
}

impl Figure<Solid, 3, 6> for Cuboid {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        let [x, y, z] = self.half;
        Some((x * x + y * y + z * z).sqrt())
    }

    fn mass(&self, density: f64) -> [f64; 6] {
        let [x, y, z] = self.half;
        let mass = density * 8.0 * x * y * z;
        // With half edges the familiar twelfth is a third.
        let moment = |p: f64, q: f64| mass / 3.0 * (p * p + q * q);
        [mass, mass, mass, moment(y, z), moment(z, x), moment(x, y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
