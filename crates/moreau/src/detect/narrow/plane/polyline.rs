//! A polyline and a convex body: corners of the body on segments, and ridges of the chain on sides and corners of the body.
//!
//! A body slides over joints as over one smooth ground, because each contact is made by one thing only:
//!
//! 1. A corner of the body, grown by its radius, touches the segment that it is over. At a joint that does not bend, one and the same
//!    number says which of two that is. Ridges end a segment; into a valley both go on as far as the corner is behind the other.
//! 2. A corner behind the surface is behind many a segment of the chain. It touches the nearest one that faces it, and the one next to
//!    that across a valley: to leave the solid through the nearest is to leave all others, but for the one that stands in the way. A
//!    corner before the surface that is nearest is behind no other, but for one across a valley.
//! 3. Over a ridge, and not over one of its segments, a corner touches the ridge itself, along the line between them.
//! 4. A ridge touches the side of the body that it is before, if it is before none of its corners.
//!
//! In 2 to 4 the normal must lead out of what it leaves: out of the chain between the normals of the joint, out of the body between
//! those of the corner. Features: the segment, or the joint at its beginning, as the piece; below that 0 for a
//! ridge, which touches a body in one place, and i + 1 for corner i on the segment.

use super::Pose;
use super::core::{Core, Corner, faces};
use crate::detect::narrow::common::{LEVEL, on_piece};
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::plane::{Bend, Joint, Polyline, Segment};
use crate::space::{Plane, Space};

pub(super) fn collide<'a, T>(
    (line, frame): (&Polyline, &Pose),
    (body, pose): (&'a T, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 2], [f64; 2], f64),
) where
    Core<'a>: From<&'a T>,
{
    let core = Core::from(body);
    let over = Over {
        line,
        core,
        position: Plane::unrotate(frame.rotation, sub(pose.position, frame.position)),
        rotation: Plane::unrotate(frame.rotation, pose.rotation),
        level: LEVEL * core.radius,
        reach,
    };
    let mut emit = |feature, Touch { point, normal, gap }: Touch| {
        let middle = Plane::rotate(frame.rotation, along(point, -(core.grown + 0.5 * gap), normal));
        emit(feature, along(frame.position, 1.0, middle), Plane::rotate(frame.rotation, normal), gap);
    };
    let around = core.radius + reach.max(0.0);
    let (segments, joints) = (line.segments().len(), line.joints());
    line.near(over.position.map(|x| x - around), over.position.map(|x| x + around), |i| {
        if let Some(touch) = over.joint(&joints[i]) {
            emit(on_piece(i, 0), touch);
        }
        for (corner, feature) in core.corners().zip(1..) {
            if let Some(touch) = over.segment(i, corner) {
                emit(on_piece(i, feature), touch);
            }
        }
        // The end of an open chain.
        let end = joints.get(segments).filter(|_| i + 1 == segments);
        if let Some(touch) = end.and_then(|joint| over.joint(joint)) {
            emit(on_piece(segments, 0), touch);
        }
    });
}

/// A contact in the frame of the chain: the point of the core, the normal from the chain to the body.
struct Touch {
    point: [f64; 2],
    normal: [f64; 2],
    gap: f64,
}

/// A body over a chain, in whose frame it is seen.
struct Over<'a> {
    line: &'a Polyline,
    core: Core<'a>,
    position: [f64; 2],
    rotation: [f64; 2],
    level: f64,
    reach: f64,
}

impl Over<'_> {
    fn at(&self, corner: Corner) -> [f64; 2] {
        along(self.position, 1.0, Plane::rotate(self.rotation, corner.point))
    }

    /// A corner on a segment: cases 1 and 2.
    fn segment(&self, i: usize, corner: Corner) -> Option<Touch> {
        if !self.is_faced(i, corner) {
            return None;
        }
        let point = self.at(corner);
        let Claim { height, beyond, square } = self.claim(i, point)?;
        let gap = height - self.core.grown;
        let is_plain = height >= self.level && beyond <= self.level;
        let touches = gap <= self.reach && (is_plain || self.is_way_out(i, square, corner, point));
        touches.then(|| Touch { point, normal: self.line.segments()[i].normal, gap })
    }

    /// Whether the way to a segment leads out of the body about at this corner.
    fn is_faced(&self, i: usize, corner: Corner) -> bool {
        corner.faces(self.in_body(self.line.segments()[i].normal.map(|x| -x)))
    }

    /// How a point is over or behind segment `i`, if it is.
    fn claim(&self, i: usize, point: [f64; 2]) -> Option<Claim> {
        let (segment, joints) = (&self.line.segments()[i], self.line.joints());
        let (begin, end) = (&joints[i], &joints[self.line.after(i)]);
        let (from, to) = (sub(point, begin.point), sub(point, end.point));
        let way = onwards(segment.normal);
        let begun = match begin.bend {
            Bend::Straight => dot(onwards(begin.normals[0]), from) >= 0.0,
            Bend::Ridge => dot(way, from) >= -self.level,
            Bend::Valley => dot(way, from) >= -self.level || self.is_behind(self.line.before(i), point, End::Start),
        };
        let goes_on = match end.bend {
            Bend::Straight => dot(way, to) < 0.0,
            Bend::Ridge => dot(way, to) < self.level,
            Bend::Valley => dot(way, to) < self.level || self.is_behind(self.line.after(i), point, End::Stop),
        };
        let height = dot(segment.normal, from);
        let beyond = (-dot(way, from)).max(dot(way, to)).max(0.0);
        (begun && goes_on).then_some(Claim { height, beyond, square: height * height + beyond * beyond })
    }

    /// Whether a point is behind segment `i`, or behind its line on this side of one of its ends.
    fn is_behind(&self, i: usize, point: [f64; 2], end: End) -> bool {
        let Segment { start, end: stop, normal } = self.line.segments()[i];
        let from = sub(point, start);
        let within = match end {
            End::Start => dot(onwards(normal), from) >= -self.level,
            End::Stop => dot(onwards(normal), sub(point, stop)) < self.level,
        };
        within && dot(normal, from) < self.level
    }

    /// Whether a corner behind segment `i`, or beyond its end, of this square distance, is to leave through it.
    fn is_way_out(&self, i: usize, square: f64, corner: Corner, point: [f64; 2]) -> bool {
        let distance = square.sqrt();
        let (mut nearest, mut way_out) = ((square, i, false), (square, i));
        self.line.near(point.map(|x| x - distance), point.map(|x| x + distance), |k| {
            if let Some(Claim { height, square, .. }) = self.claim(k, point) {
                if square < nearest.0 {
                    nearest = (square, k, height >= self.level);
                }
                if square < way_out.0 && self.is_faced(k, corner) {
                    way_out = (square, k);
                }
            }
            for joint in [k, self.line.after(k)] {
                let between = sub(point, self.line.joints()[joint].point);
                let square = dot(between, between);
                if square < nearest.0 && self.is_over_ridge(&self.line.joints()[joint], between) {
                    nearest = (square, k, true);
                }
            }
        });
        // Before the nearest surface, it is behind none but what meets that in a valley.
        let behind = !nearest.2 || self.is_across_valley(nearest.1, i);
        behind && (way_out.1 == i || self.is_across_valley(way_out.1, i))
    }

    fn is_across_valley(&self, i: usize, k: usize) -> bool {
        let valley = |first: usize, second: usize| {
            let joint = self.line.after(first);
            joint == second && self.line.joints()[joint].bend == Bend::Valley
        };
        valley(i, k) || valley(k, i)
    }

    /// A ridge on a side or a corner of the body: cases 3 and 4.
    fn joint(&self, joint: &Joint) -> Option<Touch> {
        if joint.bend != Bend::Ridge {
            return None;
        }
        self.ridge_on_side(joint).or_else(|| self.core.corners().find_map(|corner| self.ridge_on_corner(joint, corner)))
    }

    fn ridge_on_side(&self, joint: &Joint) -> Option<Touch> {
        let place = self.in_body(sub(joint.point, self.position));
        let [before, after] = joint.normals.map(|normal| self.in_body(normal));
        // The side that it is farthest beyond, of all and of those that face it.
        let (mut farthest, mut best) = (f64::NEG_INFINITY, None);
        for side in self.core.sides {
            let height = dot(side.normal, sub(place, side.start));
            farthest = farthest.max(height);
            if faces(side.normal.map(|x| -x), [after, before]) && best.is_none_or(|(most, _)| height > most) {
                best = Some((height, side));
            }
        }
        let (height, side) = best?;
        let along_side = sub(side.end, side.start);
        let length = dot(along_side, along_side).sqrt();
        let at = dot(along_side, sub(place, side.start)) / length;
        let outside_elsewhere = farthest > height && farthest > 0.0;
        let gap = height - self.core.grown;
        if outside_elsewhere || !(gap <= self.reach && at > self.level && at < length - self.level) {
            return None;
        }
        let normal = Plane::rotate(self.rotation, side.normal.map(|x| -x));
        Some(Touch { point: along(joint.point, height, normal), normal, gap })
    }

    fn ridge_on_corner(&self, joint: &Joint, corner: Corner) -> Option<Touch> {
        let point = self.at(corner);
        let between = sub(point, joint.point);
        let distance = dot(between, between).sqrt();
        let gap = distance - self.core.grown;
        let beyond = self.is_over_ridge(joint, between);
        let nearest = corner.is_nearest(self.in_body(between.map(|x| -x)), self.level);
        (beyond && nearest && gap <= self.reach).then(|| Touch { point, normal: between.map(|x| x / distance), gap })
    }

    /// Whether what is so far from a joint is over a ridge, and over neither of its segments.
    fn is_over_ridge(&self, joint: &Joint, from: [f64; 2]) -> bool {
        let [before, after] = joint.normals.map(onwards);
        joint.bend == Bend::Ridge && dot(before, from) >= self.level && dot(after, from) < -self.level
    }

    fn in_body(&self, direction: [f64; 2]) -> [f64; 2] {
        Plane::unrotate(self.rotation, direction)
    }
}

/// One end of a segment.
#[derive(Clone, Copy)]
enum End {
    Start,
    Stop,
}

/// A corner over a segment.
struct Claim {
    /// Over its line, m.
    height: f64,
    /// Beyond its end, across a valley, m.
    beyond: f64,
    /// Square of the distance from the segment, m².
    square: f64,
}

/// The way along a segment with this normal.
fn onwards([x, y]: [f64; 2]) -> [f64; 2] {
    [y, -x]
}
