//! What convex bodies of the plane have in common.

use crate::detect::narrow::vector::dot;
use crate::shape::plane::{Capsule, Disk, Polygon, Side};

/// Cosine of the angle, 45°, by which a normal may miss a corner and still be one of a contact there: bodies that touch along a side
/// are never quite parallel, and no other side of a body is that near to parallel.
const ABOUT: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A convex body as a core with straight sides, grown all around by a radius: a polygon by none, the segment of a capsule and the centre
/// of a disk by theirs.
#[derive(Clone, Copy)]
pub(super) struct Core<'a> {
    /// The sides of the core, counter-clockwise: two for a segment, none for a point.
    pub(super) sides: &'a [Side],
    /// By how much it is grown, m.
    pub(super) grown: f64,
    /// Radius of the disk around the centre that holds the body, m.
    pub(super) radius: f64,
}

impl<'a> From<&'a Polygon> for Core<'a> {
    fn from(polygon: &'a Polygon) -> Self {
        Self { sides: polygon.sides(), grown: 0.0, radius: polygon.radius() }
    }
}

impl<'a> From<&'a Capsule> for Core<'a> {
    fn from(capsule: &'a Capsule) -> Self {
        Self { sides: capsule.axis(), grown: capsule.radius(), radius: 0.5 * capsule.length() + capsule.radius() }
    }
}

impl<'a> From<&'a Disk> for Core<'a> {
    fn from(disk: &'a Disk) -> Self {
        Self { sides: &[], grown: disk.radius, radius: disk.radius }
    }
}

impl Core<'_> {
    /// The vertices of the core, in the body's frame.
    pub(super) fn vertices(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.sides.iter().map(|side| side.start)
    }

    /// The corners of the core: its vertices, or the point that it is.
    pub(super) fn corners(&self) -> impl Iterator<Item = Corner> + '_ {
        let count = self.sides.len();
        (0..count.max(1)).map(move |i| match count {
            0 => Corner { point: [0.0; 2], sides: None },
            _ => Corner {
                point: self.sides[i].start,
                sides: Some([self.sides[(i + count - 1) % count].normal, self.sides[i].normal]),
            },
        })
    }
}

/// A corner of a core.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) point: [f64; 2],
    /// The normals of the sides before and after it; none of a point, out of which every direction leads.
    pub(super) sides: Option<[[f64; 2]; 2]>,
}

impl Corner {
    /// Whether a direction leads out of the body about here.
    pub(super) fn faces(&self, direction: [f64; 2]) -> bool {
        self.sides.is_none_or(|[before, after]| faces(direction, [before, after]))
    }

    /// Whether this corner is what the body has nearest to a point `from` it, both in the body's frame: beyond the ends of both sides.
    pub(super) fn is_nearest(&self, from: [f64; 2], level: f64) -> bool {
        self.sides.is_none_or(|[before, after]| dot(along(before), from) >= -level && dot(along(after), from) <= level)
    }
}

/// The direction in which one goes along a side of this outward normal, counter-clockwise.
fn along([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

/// Whether a direction is about between two others, the second counter-clockwise from the first by at most half a turn.
pub(super) fn faces(direction: [f64; 2], [first, last]: [[f64; 2]; 2]) -> bool {
    let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let between = cross(first, direction) >= 0.0 && cross(direction, last) >= 0.0;
    between || dot(direction, first) >= ABOUT || dot(direction, last) >= ABOUT
}
