//! A cylinder and a body with flat faces or a segment.

use super::rim::Rim;
use super::{Best, Convex, Hull, Touch, Tube, contacts, over_line, seen_from, unit};
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::solid::Pose;
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::{Cylinder, Faceted};

/// Contacts of a cylinder and a body that is grown by `radius`.
pub(in crate::detect::narrow::solid) fn tube_with<F: Faceted>(
    (cylinder, pose_a): (&Cylinder, &Pose),
    (body, pose_b): (&F, &Pose),
    radius: f64,
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let (a, b) = (Tube::own(cylinder), Hull { body, pose: seen_from(pose_a, pose_b) });
    let level = LEVEL * (cylinder.half + cylinder.radius + body.radius() + radius);
    let touch = Touch { radii: [0.0, radius], level, reach };
    let mut best = Best::new(&a, &b, level);
    directions(&mut best, &touch);
    contacts(&best, &touch, pose_a, emit);
}

/// Tries the faces and caps, then side and rims with edges and with vertices.
fn directions<F: Faceted>(best: &mut Best<'_, Tube, Hull<'_, F>>, touch: &Touch) {
    let (a, b) = (best.a, best.b);
    for face in 0..b.body.faces() {
        let (outward, height) = b.face(face);
        let normal = outward.map(|x| -x);
        best.take_face(normal, -height - a.height(normal));
    }
    best.offer_caps(a.axis());
    if best.is_beyond(touch) {
        return;
    }
    for edge in b.body.edges() {
        side_with_edge(best, b.ends(edge));
        a.rims().iter().for_each(|rim| rim_with_edge(best, rim, b.ends(edge)));
    }
    for vertex in (0..b.body.vertices()).map(|i| b.vertex(i)) {
        let is_beside = vertex[2].abs() <= a.half + best.level;
        if let Some(normal) = unit([vertex[0], vertex[1], 0.0]).filter(|_| is_beside) {
            best.take_pair(normal, [beside(a.radius, normal, vertex), vertex]);
        }
        a.rims().iter().filter_map(|rim| rim.nearest(vertex)).for_each(|on_rim| best.offer_between([on_rim, vertex]));
    }
}

/// The point of the side, in the cylinder's own frame, in a direction across the axis and at the height of a point.
fn beside(radius: f64, [x, y, _]: [f64; 3], [_, _, z]: [f64; 3]) -> [f64; 3] {
    [radius * x, radius * y, z]
}

/// Tries the directions across axis and edge, where these are nearest within both.
fn side_with_edge<F: Faceted>(best: &mut Best<'_, Tube, Hull<'_, F>>, [p, q]: [[f64; 3]; 2]) {
    let way = sub(q, p);
    let Some(normal) = unit([-way[1], way[0], 0.0]) else { return };
    let nearest = -(p[0] * way[0] + p[1] * way[1]) / (way[0] * way[0] + way[1] * way[1]);
    // What of the edge is beside the cylinder: of a parallel one any part is as near as another.
    let (top, half) = (1.0_f64.copysign(way[2]), best.a.half);
    let [from, to] = [-half, half].map(|end| if way[2] == 0.0 { end * f64::INFINITY } else { (top * end - p[2]) / way[2] });
    let on_edge = along(p, nearest.min(to).min(1.0).max(from).max(0.0), way);
    let beyond = normal[1] * on_edge[0] - normal[0] * on_edge[1];
    if beyond.abs() > best.level || on_edge[2].abs() > half + best.level {
        return;
    }
    for normal in [normal, normal.map(|x| -x)] {
        best.take_pair(normal, [beside(best.a.radius, normal, on_edge), on_edge]);
    }
}

/// Tries the direction in which a rim and an edge are nearest or least through each other.
fn rim_with_edge<F: Faceted>(best: &mut Best<'_, Tube, Hull<'_, F>>, rim: &Rim, [p, q]: [[f64; 3]; 2]) {
    let edge = sub(q, p);
    let Some(way) = unit(edge) else { return };
    let Some(normal) = over_line(rim, p, way) else { return };
    let Some(on_rim) = rim.farthest(normal) else { return };
    let place = dot(sub(on_rim, p), way);
    let is_within = place >= -best.level && place <= dot(edge, way) + best.level;
    let on_edge = along(p, place, way);
    // No farther than two of their points are.
    if is_within && dot(normal, sub(on_edge, on_rim)) > best.best.apart {
        best.take_pair(normal, [on_rim, on_edge]);
    }
}
