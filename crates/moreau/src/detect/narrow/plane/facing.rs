//! Two bodies with sides, polygons or capsules: both ends of the stretch along which they face each other.
//!
//! A capsule is its segment, a figure of two sides without width, grown all around: what is found of the segment holds of the capsule
//! with the gap less the radius. Of all sides that one is the reference beyond which the other body is farthest, or least deep: the axis that separates best
//! (Gottschalk, Lin & Manocha 1996). The side of the other body that faces it is cut to its length. Each end is then a vertex of
//! either one, and that is its feature: of two parallel sides it does not matter which one is the reference, so the features of
//! blocks at rest stay what they are. Two bodies that are apart at a vertex each have one point between these.

use super::Pose;
use super::core::Core;
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::plane::Side;
use crate::space::{Plane, Space};

pub(super) fn collide<'a, A, B>(
    (a, pose_a): (&'a A, &Pose),
    (b, pose_b): (&'a B, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) where
    Core<'a>: From<&'a A> + From<&'a B>,
{
    let (a, b) = (Core::from(a), Core::from(b));
    let grown = a.grown + b.grown;
    let (from_a, from_b) = (Seen::new((b, pose_b), pose_a), Seen::new((a, pose_a), pose_b));
    let level = LEVEL * (a.radius + b.radius);
    let ((side_a, apart_a), (side_b, apart_b)) = (farthest(&a, &from_a, level), farthest(&b, &from_b, level));
    // Not `>`: what is nowhere touches nothing.
    if !(apart_a <= reach + grown && apart_b <= reach + grown) {
        return;
    }
    let (facing, pose, sign) = if apart_b > apart_a + level {
        (Facing { side: side_b, own: b, other: from_b, first: false, level }, pose_b, -1.0)
    } else {
        (Facing { side: side_a, own: a, other: from_a, first: true, level }, pose_a, 1.0)
    };
    let apart = apart_a.max(apart_b);
    let mut ends = facing.ends();
    let nearest = ends.iter().flatten().map(|end| end.gap).fold(f64::INFINITY, f64::min);
    // Where a vertex is nearest to a side, the axis that separates best has their distance.
    if nearest > apart.max(0.0) + level {
        ends = [Some(facing.vertices(apart)), None];
    }
    ends.sort_unstable_by_key(|end| end.map_or(u64::MAX, |end| end.feature));
    // Corners that touch share no stretch: its ends are one point.
    if let [Some(one), Some(other)] = ends {
        let between = sub(other.point, one.point);
        if dot(between, between) <= (4.0 * level) * (4.0 * level) {
            ends[1] = None;
        }
    }
    for End { feature, point, normal, gap: apart } in ends.into_iter().flatten().filter(|end| end.gap <= reach + grown) {
        let gap = apart - grown;
        // Half-way between the surfaces, from the other's.
        let middle = Plane::rotate(pose.rotation, along(point, -(facing.other.core.grown + 0.5 * gap), normal));
        emit(feature, along(pose.position, 1.0, middle), Plane::rotate(pose.rotation, normal).map(|x| sign * x), gap);
    }
}

/// A core as seen in the frame of another.
#[derive(Clone, Copy)]
struct Seen<'a> {
    core: Core<'a>,
    rotation: [f64; 2],
    position: [f64; 2],
}

impl<'a> Seen<'a> {
    fn new((core, pose): (Core<'a>, &Pose), frame: &Pose) -> Self {
        let position = Plane::unrotate(frame.rotation, sub(pose.position, frame.position));
        Self { core, rotation: Plane::unrotate(frame.rotation, pose.rotation), position }
    }

    fn at(&self, vertex: [f64; 2]) -> [f64; 2] {
        along(self.position, 1.0, Plane::rotate(self.rotation, vertex))
    }
}

/// The side of a core beyond which another one is farthest, and how far; negative where it reaches behind each side. Of sides that are level
/// the first: rounding must not choose the normal of two corners that touch.
fn farthest(core: &Core<'_>, other: &Seen<'_>, level: f64) -> (usize, f64) {
    let mut best = (0, f64::NEG_INFINITY);
    for (i, side) in core.sides.iter().enumerate() {
        // Along the other's own axes, so that only what is found has to be turned.
        let inward = Plane::unrotate(other.rotation, side.normal);
        let nearest = other.core.vertices().map(|vertex| dot(inward, vertex)).fold(f64::INFINITY, f64::min);
        let apart = nearest + dot(side.normal, sub(other.position, side.start));
        if apart > best.1 + level || apart.is_nan() {
            best = (i, apart);
        }
    }
    best
}

/// A side of one core, and the other core before it.
struct Facing<'a> {
    side: usize,
    own: Core<'a>,
    other: Seen<'a>,
    /// Whether the side is of the first body.
    first: bool,
    level: f64,
}

/// One end of the stretch; the point on the other core, the normal from the reference to it, both in the frame of the reference.
#[derive(Clone, Copy)]
struct End {
    feature: u64,
    point: [f64; 2],
    normal: [f64; 2],
    /// Between the cores, m.
    gap: f64,
}

impl Facing<'_> {
    fn ends(&self) -> [Option<End>; 2] {
        let side = self.own.sides[self.side];
        let (index, facing) = self.facing(side.normal);
        let count = (self.own.sides.len(), self.other.core.sides.len());
        let along_side = sub(side.end, side.start);
        let length = dot(along_side, along_side).sqrt();
        let place = |point: [f64; 2]| dot(along_side, sub(point, side.start)) / length;
        // The facing side runs back along the reference: from `from`, near its end, to `to`.
        let (from, to) = ((self.other.at(facing.start), index), (self.other.at(facing.end), (index + 1) % count.1));
        let (x_from, x_to) = (place(from.0), place(to.0));
        // Opposite vertices: the first body's counts.
        let level = if self.first { -self.level } else { self.level };
        let between = |x: f64| along(from.0, ((x_from - x) / (x_from - x_to)).clamp(0.0, 1.0), sub(to.0, from.0));
        let end = |(point, vertex), beyond: bool, corner: ([f64; 2], usize)| {
            let (point, feature) = match beyond {
                true => (between(place(corner.0)), self.feature(true, corner.1)),
                false => (point, self.feature(false, vertex)),
            };
            Some(End { feature, point, normal: side.normal, gap: dot(side.normal, sub(point, side.start)) })
        };
        if x_from < -self.level || x_to > length + self.level {
            return [None; 2];
        }
        let corners = ((side.end, (self.side + 1) % count.0), (side.start, self.side));
        [end(from, x_from > length + level, corners.0), end(to, x_to < -level, corners.1)]
    }

    /// The other's side that faces this normal most.
    fn facing(&self, normal: [f64; 2]) -> (usize, Side) {
        let inward = Plane::unrotate(self.other.rotation, normal);
        let sides = self.other.core.sides;
        let most = (1..sides.len())
            .fold(0, |best, i| if dot(inward, sides[i].normal) < dot(inward, sides[best].normal) { i } else { best });
        (most, sides[most])
    }

    /// The point between the nearest two vertices. Where these are as good as one the normal is that of the side, beyond which the other
    /// core is as far as it is `apart`. Two segments on a line are beside each other though neither is beyond a side of the other.
    fn vertices(&self, apart: f64) -> End {
        let pairs = self.own.vertices().enumerate().flat_map(|(own, corner)| {
            self.other.core.vertices().map(move |vertex| (own, self.other.at(vertex), sub(self.other.at(vertex), corner)))
        });
        let start = (0, [0.0; 2], [f64::INFINITY; 2]);
        let (own, point, between) =
            pairs.fold(start, |best, pair| if dot(pair.2, pair.2) < dot(best.2, best.2) { pair } else { best });
        let (gap, feature) = (dot(between, between).sqrt(), self.feature(true, own));
        let segments = self.own.sides.len() == 2 && self.other.core.sides.len() == 2;
        if gap > self.level && (apart > 0.0 || segments) {
            return End { feature, point, normal: between.map(|x| x / gap), gap };
        }
        End { feature, point, normal: self.own.sides[self.side].normal, gap: apart }
    }

    /// Vertices of the first body have even numbers.
    fn feature(&self, own: bool, vertex: usize) -> u64 {
        2 * vertex as u64 + u64::from(own != self.first)
    }
}
