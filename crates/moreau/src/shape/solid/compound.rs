//! Several shapes as one rigid body: clumps of balls, convex pieces of a concave body.

use super::SolidShape;
use super::inertia::Moments;
use crate::shape::{self, Contour, Figure, Polygons, Shape, ShapeError};
use crate::space::{Pose, Solid};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// A body of several parts, around its centre of mass, turned into its principal axes. Copies share what they are made of, and hold no more of
/// it than a place: all bodies have the size of the largest shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Compound(Arc<Form>);

#[derive(Debug, PartialEq)]
struct Form {
    parts: Vec<Part>,
    radius: f64,
    /// m³.
    volume: f64,
    /// Principal moments of inertia at density 1, m⁵.
    moments: [f64; 3],
}

/// A part of a compound.
pub type Part = shape::Part<SolidShape, DQuat, 3>;

impl Compound {
    /// The most parts that one may have: features of contacts number them with 10 bits.
    pub const MOST_PARTS: usize = 1 << 10;

    /// The body of these parts, and where its own frame is in their coordinates. Its mass is the sum of theirs: where parts overlap, what
    /// they share counts as often, as is usual for clumps.
    ///
    /// # Errors
    /// No parts or too many, and parts that are unbounded, have no mass, or are compounds themselves.
    pub fn new(parts: Vec<(SolidShape, Pose<DQuat, 3>)>) -> Result<(Self, Pose<DQuat, 3>), ShapeError> {
        let moments = parts.iter().map(|(shape, pose)| Moments::of_body(&shape.mass(1.0), pose));
        let moments = Moments::sum(moments);
        Self::with_moments(parts, &moments)
    }

    /// The body of these parts with mass and inertia that are known otherwise, as of a mesh that they stand for.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn with_moments(parts: Vec<(SolidShape, Pose<DQuat, 3>)>, mass: &Moments) -> Result<(Self, Pose<DQuat, 3>), ShapeError> {
        if parts.is_empty() {
            return Err(ShapeError::NoParts);
        }
        if parts.len() > Self::MOST_PARTS {
            return Err(ShapeError::TooMany { what: "parts of a compound", count: parts.len(), most: Self::MOST_PARTS });
        }
        let (moments, rotation) = mass.principal();
        let inside = |pose: Pose<DQuat, 3>| Pose {
            position: (rotation.conjugate() * (DVec3::from(pose.position) - DVec3::from(mass.centre))).into(),
            rotation: (rotation.conjugate() * pose.rotation).normalize(),
        };
        let part = |(index, (shape, pose)): (usize, (SolidShape, Pose<DQuat, 3>))| match shape.bounding_radius() {
            Some(radius) if shape.is_convex() => Ok(Part { shape, pose: inside(pose), radius }),
            _ => Err(ShapeError::NotAPart { part: index, name: shape.name() }),
        };
        let parts = parts.into_iter().enumerate().map(part).collect::<Result<Vec<_>, _>>()?;
        let reach = |part: &Part| DVec3::from(part.pose.position).length() + part.radius;
        let radius = parts.iter().map(reach).fold(0.0, f64::max);
        let own = Pose { position: mass.centre, rotation };
        Ok((Self(Arc::new(Form { parts, radius, volume: mass.volume, moments })), own))
    }

    /// Its parts.
    #[inline]
    pub fn parts(&self) -> &[Part] {
        &self.0.parts
    }
}

impl Figure<Solid, 3, 6> for Compound {
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        Some(self.0.radius)
    }

    fn is_convex(&self) -> bool {
        false
    }

    fn parts(&self) -> &[Part] {
        &self.0.parts
    }

    /// Those of all parts, also where they lie inside others.
    fn contour(&self, at: [f64; 3], _: [f64; 3], _: usize) -> Contour<3> {
        Contour::corner(at)
    }

    fn polygons(&self) -> Polygons<3> {
        let mut all = Polygons::default();
        self.0.parts.iter().for_each(|part| all.add::<Solid, 6>(&part.shape.polygons(), &part.pose));
        all
    }

    fn mass(&self, density: f64) -> [f64; 6] {
        let (mass, [i, j, k]) = (density * self.0.volume, self.0.moments.map(|moment| density * moment));
        [mass, mass, mass, i, j, k]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::solid::{Ball, Cuboid, HalfSpace};

    fn at(position: [f64; 3], rotation: DQuat) -> Pose<DQuat, 3> {
        Pose { position, rotation }
    }

    #[test]
    fn a_box_of_two_halves_has_the_mass_of_the_box() {
        let half = || SolidShape::from(Cuboid::new([1.0, 2.0, 3.0]).unwrap());
        let quarter = DQuat::from_xyzw(0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt());
        // The second half is turned by a half turn, which changes nothing.
        let parts = vec![(half(), at([1.0, 1.0, 1.0], DQuat::IDENTITY)), (half(), at([2.0, 1.0, 1.0], quarter * quarter))];
        let (compound, own) = Compound::new(parts).unwrap();
        assert!((DVec3::from(own.position) - DVec3::new(1.5, 1.0, 1.0)).length() < 1e-14, "{own:?}");
        for (found, right) in compound.mass(2.0).iter().zip(Cuboid::new([2.0, 2.0, 3.0]).unwrap().mass(2.0)) {
            assert!((found - right).abs() < 1e-13, "{found} {right}");
        }
        assert!((compound.bounding_radius().unwrap() - 0.5 - 3.5_f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn a_dumb_bell_turns_about_its_own_axes() {
        let ball = || SolidShape::from(Ball::new(0.1).unwrap());
        let way = DVec3::new(1.0, 2.0, -2.0) / 3.0;
        let parts = [-0.5, 0.5].map(|s| (ball(), at((s * way).into(), DQuat::IDENTITY)));
        let (compound, own) = Compound::new(parts.to_vec()).unwrap();
        let mut moments = compound.mass(1.0);
        let m = moments[0];
        moments[3..].sort_by(f64::total_cmp);
        let small = 0.4 * 0.01 * m;
        for (found, right) in moments[3..].iter().zip([small, small + 0.25 * m, small + 0.25 * m]) {
            assert!((found - right).abs() < 1e-15, "{moments:?}");
        }
        for part in compound.parts() {
            let back = own.rotation * DVec3::from(part.pose.position);
            assert!((back.cross(way)).length() < 1e-14 && (back.length() - 0.5).abs() < 1e-14);
        }
    }

    #[test]
    fn what_cannot_be_a_part_is_said() {
        let ball = || (SolidShape::from(Ball::new(0.1).unwrap()), at([0.0; 3], DQuat::IDENTITY));
        assert!(Compound::new(vec![]).unwrap_err().to_string().contains("at least 1"));
        assert!(Compound::new(vec![ball(); 1025]).unwrap_err().to_string().contains("1025"));
        let wall = (SolidShape::from(HalfSpace), at([0.0; 3], DQuat::IDENTITY));
        assert!(Compound::new(vec![ball(), wall]).unwrap_err().to_string().contains("part 1 is a half_space"));
        let nested = (Compound::new(vec![ball()]).unwrap().0.into(), at([0.0; 3], DQuat::IDENTITY));
        assert!(Compound::new(vec![nested]).unwrap_err().to_string().contains("part 0 is a compound"));
    }
}
