//! Capsules and cylinders and a triangle.

use super::super::curved::{Convex, Hull, Segment, Touch, Tube, contacts_along, seen_from};
use super::super::{Pose, capsule_facets, cylinder_facets};
use super::{HERE, LEVEL, There, Touches, Triangle};
use crate::detect::narrow::vector::{along, dot};
use crate::mesh::Aabb;
use crate::shape::solid::{Capsule, Cylinder, Faceted};
use crate::space::{Solid, Space};

impl Touches for Capsule {
    fn around(There { body, pose, .. }: &There<'_, Self>) -> Aabb {
        let axis = Solid::rotate(pose.rotation, [0.0, 0.0, body.half]);
        Aabb::around([1.0, -1.0].map(|end| along(pose.position, end, axis))).grown(body.radius)
    }

    fn size(&self) -> f64 {
        self.half + self.radius
    }

    fn height(There { body, pose, .. }: &There<'_, Self>, direction: [f64; 3]) -> f64 {
        let axis = Solid::rotate(pose.rotation, [0.0, 0.0, body.half]);
        dot(direction, pose.position) + dot(direction, axis).abs() + body.radius * dot(direction, direction).sqrt()
    }

    fn touch(
        There { body, pose, .. }: &There<'_, Self>,
        triangle: &Triangle,
        reach: f64,
        emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
    ) {
        capsule_facets::collide((*body, pose), (triangle, &HERE), reach, &mut turned(emit));
    }

    fn touch_front(
        There { body, pose, .. }: &There<'_, Self>,
        triangle: &Triangle,
        reach: f64,
        emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
    ) {
        front(*body, (&Hull::own(&Segment { half: body.half }), body.radius), pose, triangle, reach, emit);
    }
}

impl Touches for Cylinder {
    fn around(There { body, pose, .. }: &There<'_, Self>) -> Aabb {
        let tube = Tube::new(body, pose);
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let high = [x, y, z].map(|axis| tube.height(axis));
        let low = [x, y, z].map(|axis| -tube.height(axis.map(|k| -k)));
        Aabb { low, high }
    }

    fn size(&self) -> f64 {
        self.half + self.radius
    }

    fn height(There { body, pose, .. }: &There<'_, Self>, direction: [f64; 3]) -> f64 {
        Convex::height(&Tube::new(body, pose), direction)
    }

    fn touch(
        There { body, pose, .. }: &There<'_, Self>,
        triangle: &Triangle,
        reach: f64,
        emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
    ) {
        cylinder_facets::collide((*body, pose), (triangle, &HERE), reach, &mut turned(emit));
    }

    fn touch_front(
        There { body, pose, .. }: &There<'_, Self>,
        triangle: &Triangle,
        reach: f64,
        emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
    ) {
        front(*body, (&Tube::own(body), 0.0), pose, triangle, reach, emit);
    }
}

/// Contacts of a body that come first in their pair, as those of a triangle that does.
fn turned(emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64)) -> impl FnMut(u64, [f64; 3], [f64; 3], f64) {
    move |feature, point, normal, gap| emit(feature, point, normal.map(|x| -x), gap)
}

/// What a body that is a core grown by a radius has along the normal of a triangle.
fn front(
    body: &impl Touches,
    (core, radius): (&impl Convex, f64),
    pose: &Pose,
    triangle: &Triangle,
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let other = Hull { body: triangle, pose: seen_from(pose, &HERE) };
    let into = Solid::unrotate(pose.rotation, triangle.normal(Triangle::FRONT).map(|x| -x));
    let touch = Touch { radii: [radius, 0.0], level: LEVEL * (body.size() + triangle.radius()), reach };
    contacts_along((core, &other), into, &touch, pose, &mut turned(emit));
}
