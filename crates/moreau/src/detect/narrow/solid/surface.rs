//! A surface of triangles and a body: the body against each triangle that is near it, without what the triangles' borders add.
//!
//! A point that a triangle has with the body counts where its normal is the triangle's own, or where it is on an edge or at a corner and
//! its normal is one of the surface there, between those of the triangles around it. Any other point is a trace of the subdivision: a body
//! that slides over a plane of many triangles meets their borders, and must not feel them. Where such a point lies in a plane part of the
//! surface, the points along the triangle's normal stand in for it. The same holds where the surface bends a little and the point's normal is nearly the
//! triangle's: such a body lies on the triangle and is tilted. A body that is in the surface and has traces alone,
//! because it is deeper than triangles are wide, is met by the one triangle that it leaves soonest along its normal. Points that face the back of a triangle do not
//! count: a body that is more than half through a surface in one step falls through it, and calls for a shorter step.
//!
//! What is left is thinned (`thin`), so that neighbouring triangles have a point once and a plane no more than four.

mod ball;
mod round;
mod thin;
mod triangle;

use super::Pose;
use super::curved::seen_from;
use super::facets::{self, Corners, Seen};
use crate::detect::narrow::common::{CLOSE, LEVEL, SAME, on_piece};
use crate::detect::narrow::vector::{along, dot, sub};
use crate::mesh::Aabb;
use crate::shape::solid::{Faceted, On, Surface};
use crate::space::{Solid, Space};
use ball::nearest;
use std::cell::RefCell;
use thin::{Found, thin};
use triangle::Triangle;

/// A body in the frame of the surface, which is that of the triangles.
pub(super) struct There<'a, B> {
    body: &'a B,
    pose: Pose,
    /// Its corners and normals, for a body that has such.
    corners: Corners,
}

/// A body that can touch a triangle. Directions, points and normals are in the frame of the surface.
pub(super) trait Touches: Sized {
    /// Turns what it has of corners and normals, once for all triangles.
    fn place(&self, _: &Pose, _: &mut Corners) {}

    /// Radius of the ball around its position that holds it, m.
    fn size(&self) -> f64;

    /// The box around it.
    fn around(there: &There<'_, Self>) -> Aabb;

    /// How far it goes in a direction: the greatest product of that with its points.
    fn height(there: &There<'_, Self>, direction: [f64; 3]) -> f64;

    /// Its contacts with a triangle, normals from that, by 32-bit features that ascend.
    fn touch(there: &There<'_, Self>, triangle: &Triangle, reach: f64, emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64));

    /// Those along the normal of the triangle; none for a body that has all that there are already.
    fn touch_front(_: &There<'_, Self>, _: &Triangle, _: f64, _: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64)) {}
}

/// What has flat faces meets a triangle as it meets any such body.
impl<F: Faceted> Touches for F {
    fn place(&self, pose: &Pose, corners: &mut Corners) {
        corners.place(self, pose);
    }

    fn size(&self) -> f64 {
        self.radius()
    }

    fn around(there: &There<'_, Self>) -> Aabb {
        Aabb::around(there.corners.vertices().iter().copied())
    }

    fn height(there: &There<'_, Self>, direction: [f64; 3]) -> f64 {
        facets::support(there.corners.vertices(), direction)
    }

    fn touch(there: &There<'_, Self>, triangle: &Triangle, reach: f64, emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64)) {
        facets::points(&triangle.seen(), None, &Seen::new(there.body, &there.corners), reach, emit);
    }

    fn touch_front(
        there: &There<'_, Self>,
        triangle: &Triangle,
        reach: f64,
        emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
    ) {
        facets::points(&triangle.seen(), Some(Triangle::FRONT), &Seen::new(there.body, &there.corners), reach, emit);
    }
}

/// The frame of the surface, seen from itself.
const HERE: Pose = Pose { position: [0.0; 3], rotation: Solid::IDENTITY };

thread_local! {
    /// Scratch of a query, kept from one to the next.
    static SCRATCH: RefCell<(Vec<Found>, Corners)> = RefCell::default();
}

pub(super) fn collide<B: Touches>(
    (surface, pose_a): (&Surface, &Pose),
    (body, pose_b): (&B, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let pose = seen_from(pose_a, pose_b);
    let (mut found, mut corners) = SCRATCH.take();
    found.clear();
    body.place(&pose, &mut corners);
    let there = There { body, pose, corners };
    let near = B::around(&there).grown(reach.max(0.0) + LEVEL * body.size());
    let query = Query { surface, there, reach };
    let mut deep = None;
    surface.near(&near, |triangle| query.touch(triangle as usize, &mut found, &mut deep));
    if let (true, Some((_, triangle))) = (found.is_empty(), deep) {
        query.touch_front(&query.triangle(triangle), triangle, &mut found);
    }
    thin(&mut found, LEVEL * body.size());
    for &Found { feature, point, normal, gap } in &found {
        let world = along(pose_a.position, 1.0, Solid::rotate(pose_a.rotation, point));
        emit(feature, world, Solid::rotate(pose_a.rotation, normal), gap);
    }
    SCRATCH.set((found, query.there.corners));
}

/// A surface and a body in its frame.
struct Query<'a, B> {
    surface: &'a Surface,
    there: There<'a, B>,
    reach: f64,
}

impl<B: Touches> Query<'_, B> {
    /// Adds the points that the body has with one triangle. Of triangles that have none but traces of their borders where the surface bends,
    /// `deep` gets the gap and number of the one that the body leaves soonest along its normal.
    fn touch(&self, number: usize, found: &mut Vec<Found>, deep: &mut Option<(f64, usize)>) {
        let (surface, there) = (self.surface, &self.there);
        let (corners, front) = (surface.corners(number), surface.normal(number));
        let position = there.pose.position;
        let nearest = nearest(corners, position);
        if self.is_beyond(nearest) {
            return;
        }
        let triangle = Triangle::new(corners, front, nearest);
        let level = 16.0 * LEVEL * (triangle.radius() + there.body.size());
        let first = found.len();
        let (mut flat, mut bent) = (false, false);
        // The least gap along a normal that is nearly the front's.
        let mut nearly = f64::INFINITY;
        B::touch(there, &triangle, self.reach, &mut |own, point, normal, gap| {
            let feature = on_piece(number, own);
            if surface.is_front(number, normal) {
                found.push(Found { feature, point, normal: front, gap });
                return;
            }
            if dot(normal, front) > 1.0 - SAME && gap.abs() <= CLOSE * LEVEL * there.body.size() {
                nearly = nearly.min(gap);
            }
            let on = surface.place(number, along(point, -0.5 * gap, normal), level);
            if surface.admits(number, on, normal) {
                found.push(Found { feature, point, normal, gap });
            } else if on != On::Off {
                flat |= surface.is_flat(number, on);
                bent |= gap <= level;
            }
        });
        if nearly < f64::INFINITY && self.take_front(&triangle, number, nearly + level, first, found) {
            return;
        }
        let in_front = dot(front, sub(position, triangle.corners[0])) > 0.0;
        if flat && in_front {
            found.truncate(first);
            self.touch_front(&triangle, number, found);
        } else if bent && in_front && found.is_empty() {
            let mut gap = f64::INFINITY;
            B::touch_front(there, &triangle, self.reach, &mut |_, _, _, one| gap = gap.min(one));
            if gap.is_finite() && deep.is_none_or(|(least, _)| gap > least) {
                *deep = Some((gap, number));
            }
        }
    }

    /// Replaces the points from `first` on by those along the normal of a triangle, if one of these has no greater gap than `least`. Returns
    /// whether it did.
    fn take_front(&self, triangle: &Triangle, number: usize, least: f64, first: usize, found: &mut Vec<Found>) -> bool {
        let end = found.len();
        self.touch_front(triangle, number, found);
        let is_level = found[end..].iter().any(|one| one.gap <= least);
        if is_level {
            found.drain(first..end);
        } else {
            found.truncate(end);
        }
        is_level
    }

    /// Whether the body is out of reach along the line from the point of a triangle that is `nearest` to its middle, as most are of whose box it
    /// is within reach.
    fn is_beyond(&self, nearest: [f64; 3]) -> bool {
        let way = sub(self.there.pose.position, nearest);
        let length = dot(way, way).sqrt();
        let back = way.map(|x| -x);
        // In lengths of the way; of none nothing is beyond.
        -B::height(&self.there, back) - dot(way, nearest) > self.reach.max(0.0) * length
    }

    /// Adds the points that the body has along the normal of a triangle.
    fn touch_front(&self, triangle: &Triangle, number: usize, found: &mut Vec<Found>) {
        let normal = self.surface.normal(number);
        B::touch_front(&self.there, triangle, self.reach, &mut |own, point, _, gap| {
            found.push(Found { feature: on_piece(number, own), point, normal, gap });
        });
    }

    fn triangle(&self, number: usize) -> Triangle {
        let corners = self.surface.corners(number);
        Triangle::new(corners, self.surface.normal(number), nearest(corners, self.there.pose.position))
    }
}
