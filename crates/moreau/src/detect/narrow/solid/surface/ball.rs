//! A ball and a triangle: one point, where the triangle is nearest to the centre.

use super::{There, Touches, Triangle};
use crate::detect::narrow::vector::{NO_DIRECTION, along, dot, sub};
use crate::mesh::Aabb;
use crate::shape::solid::{Ball, Faceted};

impl Touches for Ball {
    fn around(There { body, pose, .. }: &There<'_, Self>) -> Aabb {
        Aabb::around([pose.position]).grown(body.radius)
    }

    fn size(&self) -> f64 {
        self.radius
    }

    fn height(There { body, pose, .. }: &There<'_, Self>, direction: [f64; 3]) -> f64 {
        dot(direction, pose.position) + body.radius * dot(direction, direction).sqrt()
    }

    fn touch(
        There { body, pose, .. }: &There<'_, Self>,
        triangle: &Triangle,
        reach: f64,
        emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
    ) {
        let between = sub(pose.position, triangle.nearest);
        let square = dot(between, between);
        let distance = square.sqrt();
        // A centre on the surface has the normal of the face.
        let normal = if square > NO_DIRECTION { between.map(|x| x / distance) } else { triangle.normal(Triangle::FRONT) };
        let gap = distance - body.radius;
        if gap <= reach {
            emit(0, along(pose.position, -(body.radius + 0.5 * gap), normal), normal, gap);
        }
    }
}

/// The point of a triangle nearest to another point, by the region in which that lies (Ericson 2005, section 5.1.5).
pub(super) fn nearest([a, b, c]: [[f64; 3]; 3], point: [f64; 3]) -> [f64; 3] {
    let (ab, ac) = (sub(b, a), sub(c, a));
    let towards = |from: [f64; 3]| [dot(ab, sub(point, from)), dot(ac, sub(point, from))];
    let ([a_b, a_c], [b_b, b_c], [c_b, c_c]) = (towards(a), towards(b), towards(c));
    if a_b <= 0.0 && a_c <= 0.0 {
        return a;
    }
    if b_b >= 0.0 && b_c <= b_b {
        return b;
    }
    if c_c >= 0.0 && c_b <= c_c {
        return c;
    }
    let over_c = a_b * b_c - b_b * a_c;
    if over_c <= 0.0 && a_b >= 0.0 && b_b <= 0.0 {
        return along(a, a_b / (a_b - b_b), ab);
    }
    let over_b = c_b * a_c - a_b * c_c;
    if over_b <= 0.0 && a_c >= 0.0 && c_c <= 0.0 {
        return along(a, a_c / (a_c - c_c), ac);
    }
    let over_a = b_b * c_c - c_b * b_c;
    if over_a <= 0.0 && b_c >= b_b && c_b >= c_c {
        let part = (b_c - b_b) / ((b_c - b_b) + (c_b - c_c));
        return along(b, part, sub(c, b));
    }
    let whole = over_a + over_b + over_c;
    along(along(a, over_b / whole, ab), over_c / whole, ac)
}
