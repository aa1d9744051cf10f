//! The polyline: ground or wall by points, solid on one side.

use super::boundary::{check_finite, dot, meet, sub, turn};
use crate::shape::{Contour, Figure, Polygons, ShapeError, is_same};
use crate::space::Plane;
use std::sync::Arc;
use tree::Tree;

mod tree;

/// Sine of the turn below which two segments count as one straight piece of ground.
const STRAIGHT: f64 = 1e-9;

/// The most segments that there can be: their numbers have 22 bits in the feature of a contact, and an open chain has a joint more.
const MOST_SEGMENTS: usize = (1 << 22) - 1;

/// A chain of segments, open or closed. The solid lies to the right of the way along it, so that the normal out of it is to the left: a
/// ground by points from left to right is solid below, a closed one run clockwise is a solid island, counter-clockwise a vessel. It has
/// no mass and must be driven. Copies share their points.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    chain: Arc<Chain>,
}

#[derive(Debug, PartialEq)]
struct Chain {
    segments: Vec<Segment>,
    /// One where each segment begins, and of an open chain one more at its end.
    joints: Vec<Joint>,
    tree: Tree,
}

/// One segment, in the body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Its beginning, m.
    pub start: [f64; 2],
    /// Its end, m.
    pub end: [f64; 2],
    /// The unit normal out of the solid, to the left of the way from start to end.
    pub normal: [f64; 2],
}

/// Where two segments meet, or where an open chain ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// The place, m.
    pub point: [f64; 2],
    /// Which way the chain turns here.
    pub bend: Bend,
    /// The normals of the segment before and of that after. An open end is a ridge: what would be the segment before it falls off behind,
    /// at a right angle, and so does what would be that after the last.
    pub normals: [[f64; 2]; 2],
}

/// Which way a chain turns at a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bend {
    /// Not at all: the ground goes on as if there were no joint.
    Straight,
    /// To the right: the solid has a corner.
    Ridge,
    /// To the left: the solid has a notch.
    Valley,
}

impl Polyline {
    /// The chain through these points (m), in order; a closed one goes on from the last to the first. It may not touch or cross itself.
    pub fn new(points: &[[f64; 2]], closed: bool) -> Result<Self, ShapeError> {
        let least = if closed { 3 } else { 2 };
        if points.len() < least {
            return Err(ShapeError::TooFewPoints { what: "polyline", count: points.len(), least });
        }
        check_finite(points)?;
        let count = if closed { points.len() } else { points.len() - 1 };
        if count > MOST_SEGMENTS {
            return Err(ShapeError::TooMany { what: "segments of a polyline", count, most: MOST_SEGMENTS });
        }
        let next = |i: usize| (i + 1) % points.len();
        if let Some(first) = (0..count).find(|&i| !is_long(sub(points[next(i)], points[i]))) {
            return Err(ShapeError::RepeatedVertex { first, second: next(first) });
        }
        let segments: Vec<_> = (0..count).map(|i| segment(points[i], points[next(i)])).collect();
        let tree = Tree::new(&segments);
        let joints = joints(&segments, closed)?;
        let chain = Chain { segments, joints, tree };
        chain.check_simple(closed)?;
        Ok(Self { chain: Arc::new(chain) })
    }

    /// Its segments.
    #[inline]
    pub fn segments(&self) -> &[Segment] {
        &self.chain.segments
    }

    /// Its joints: joint `i` is where segment `i` begins; see [`Polyline::after`].
    #[inline]
    pub fn joints(&self) -> &[Joint] {
        &self.chain.joints
    }

    /// The number of the joint in which segment `i` ends.
    #[inline]
    pub fn after(&self, i: usize) -> usize {
        if i + 1 == self.chain.joints.len() { 0 } else { i + 1 }
    }

    /// The number of the segment before segment `i` of a closed chain, or of an open one but for its first.
    #[inline]
    pub fn before(&self, i: usize) -> usize {
        if i == 0 { self.chain.segments.len() - 1 } else { i - 1 }
    }

    /// Hands over the numbers of the segments whose boxes meet the box between two corners, ascending.
    #[inline]
    pub fn near(&self, low: [f64; 2], high: [f64; 2], mut found: impl FnMut(usize)) {
        let chain = &*self.chain;
        chain.tree.each(low, high, &mut |i| {
            let Segment { start, end, .. } = chain.segments[i];
            if (0..2).all(|k| start[k].min(end[k]) <= high[k] && low[k] <= start[k].max(end[k])) {
                found(i);
            }
        });
    }
}

impl Chain {
    /// Refuses segments that have a point in common without being neighbours.
    fn check_simple(&self, closed: bool) -> Result<(), ShapeError> {
        let count = self.segments.len();
        for (first, a) in self.segments.iter().enumerate() {
            let (low, high) = bounds(a);
            let mut found = None;
            self.tree.each(low, high, &mut |second| {
                let b = &self.segments[second];
                let neighbours = second <= first + 1 || (closed && first == 0 && second + 1 == count);
                if found.is_none() && !neighbours && meet((a.start, a.end), (b.start, b.end)) {
                    found = Some(second);
                }
            });
            if let Some(second) = found {
                return Err(ShapeError::SelfIntersecting { first, second });
            }
        }
        Ok(())
    }
}

impl Figure<Plane, 2, 3> for Polyline {
    /// None, as of a half-plane: it is held against every body, which its own tree makes quick, and its size is no measure of anything.
    #[inline]
    fn bounding_radius(&self) -> Option<f64> {
        None
    }

    fn contour(&self, at: [f64; 2], outward: [f64; 2], piece: usize) -> Contour<2> {
        let is_flat = self.segments().get(piece).is_some_and(|segment| is_same(segment.normal, outward));
        if is_flat { Contour::Flat { at, outward } } else { Contour::corner(at) }
    }

    /// Its segments as lines: what lies behind them has no end.
    fn polygons(&self) -> Polygons<2> {
        let mut all = Polygons::on(self.segments().iter().flat_map(|segment| [segment.start, segment.end]).collect());
        (0..self.segments().len()).for_each(|i| all.push([2 * i, 2 * i + 1]));
        all
    }

    fn mass(&self, _: f64) -> [f64; 3] {
        [f64::INFINITY; 3]
    }
}

/// Whether a vector has a direction.
fn is_long(v: [f64; 2]) -> bool {
    dot(v, v).is_normal()
}

fn segment(start: [f64; 2], end: [f64; 2]) -> Segment {
    let along = sub(end, start);
    let length = dot(along, along).sqrt();
    Segment { start, end, normal: [-along[1] / length, along[0] / length] }
}

/// The lowest and the highest corner of the box around a segment.
fn bounds(segment: &Segment) -> ([f64; 2], [f64; 2]) {
    let Segment { start, end, .. } = segment;
    ([start[0].min(end[0]), start[1].min(end[1])], [start[0].max(end[0]), start[1].max(end[1])])
}

fn joints(segments: &[Segment], closed: bool) -> Result<Vec<Joint>, ShapeError> {
    let count = segments.len();
    let mut joints = Vec::with_capacity(count + 1);
    for (vertex, after) in segments.iter().enumerate() {
        let (n, point) = (after.normal, after.start);
        if vertex == 0 && !closed {
            // Against the way: [n₁, −n₀] is the direction of the segment.
            joints.push(Joint { point, bend: Bend::Ridge, normals: [[-n[1], n[0]], n] });
            continue;
        }
        let before = &segments[(vertex + count - 1) % count];
        let (sine, on) = turn([before.start, point, after.end]);
        let bend = match sine {
            _ if sine.abs() <= STRAIGHT && !on => return Err(ShapeError::TurnsBack { vertex }),
            _ if sine.abs() <= STRAIGHT => Bend::Straight,
            _ if sine < 0.0 => Bend::Ridge,
            _ => Bend::Valley,
        };
        joints.push(Joint { point, bend, normals: [before.normal, n] });
    }
    if let (Some(last), false) = (segments.last(), closed) {
        let n = last.normal;
        joints.push(Joint { point: last.end, bend: Bend::Ridge, normals: [n, [n[1], -n[0]]] });
    }
    Ok(joints)
}

#[cfg(test)]
mod tests;
