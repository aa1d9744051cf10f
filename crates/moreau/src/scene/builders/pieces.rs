//! The bodies of a builder, and what they are made of.

use crate::scene::ShapeSpec;
use crate::scene::values::Numbers;

/// One body in the coordinates of its builder.
pub(in crate::scene) struct Piece {
    /// Its form.
    pub(in crate::scene) shape: ShapeSpec,
    /// The place of the shape's origin, x, y, up, m; in the plane without y.
    pub(in crate::scene) position: [f64; 3],
}

impl Piece {
    /// A shape whose coordinates are the builder's.
    pub(super) fn at_origin(shape: ShapeSpec) -> Self {
        Self { shape, position: [0.0; 3] }
    }

    /// A prism in the coordinates of the builder.
    pub(super) fn prism(profile: Vec<[f64; 2]>, depth: Option<f64>) -> Self {
        Self::at_origin(prism(profile, depth))
    }

    /// An upright block around the point (x, up) of the middle plane.
    pub(super) fn block([width, height]: [f64; 2], depth: Option<f64>, [x, up]: [f64; 2]) -> Self {
        let shape = match depth {
            Some(depth) => ShapeSpec::Box { size: vec![width, depth, height] },
            None => prism(rectangle([-0.5 * width, 0.5 * width], [-0.5 * height, 0.5 * height]), None),
        };
        Self { shape, position: [x, 0.0, up] }
    }
}

/// The convex prism over a profile, half of its depth on either side of the middle plane; without a depth the polygon.
pub(super) fn prism(profile: Vec<[f64; 2]>, depth: Option<f64>) -> ShapeSpec {
    match depth {
        Some(depth) => extruded(&profile, [-0.5 * depth, 0.5 * depth]),
        None => ShapeSpec::Polygon { vertices: profile.into_iter().map(Numbers).collect(), decompose: false, file: None },
    }
}

/// The convex prism over a profile between two places along y.
pub(super) fn extruded(profile: &[[f64; 2]], between: [f64; 2]) -> ShapeSpec {
    ShapeSpec::polyhedron(between.into_iter().flat_map(|y| profile.iter().map(move |&[x, up]| [x, y, up])))
}

/// The profile of what lies between two x and two heights.
pub(super) fn rectangle([left, right]: [f64; 2], [bottom, top]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[left, bottom], [right, bottom], [right, top], [left, top]]
}

/// The point at this distance from the origin in the direction of an angle from x towards up.
pub(super) fn polar(radius: f64, degrees: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(degrees.to_radians());
    [radius * cosine, radius * sine]
}
