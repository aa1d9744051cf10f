//! What two faces share, seen along the normal of one of them.

use super::{Point, Points, Seen, feature};
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::Faceted;
use crate::space::{Solid, Space};

/// A face in the plane of one of the two: its corners, counter-clockwise or, of a face that is seen from behind, clockwise.
struct Flat<'a, F> {
    seen: &'a Seen<'a, F>,
    face: usize,
    /// Its corners in the plane.
    corners: &'a [[f64; 2]],
    /// 1 or −1.
    turn: f64,
}

impl<'a, F: Faceted> Flat<'a, F> {
    fn new(seen: &'a Seen<'a, F>, face: usize, [s, t]: [[f64; 3]; 2], turn: f64, corners: &'a mut Vec<[f64; 2]>) -> Self {
        corners.clear();
        corners.extend((0..seen.body.face(face).len()).map(|k| seen.corner(face, k)).map(|p| [dot(s, p), dot(t, p)]));
        Self { seen, face, corners, turn }
    }

    fn len(&self) -> usize {
        self.corners.len()
    }

    fn index(&self, k: usize) -> usize {
        usize::from(self.seen.body.face(self.face)[k])
    }

    fn corner(&self, k: usize) -> [f64; 3] {
        self.seen.corner(self.face, k % self.len())
    }

    fn side(&self, k: usize) -> [[f64; 2]; 2] {
        [self.corners[k], self.corners[(k + 1) % self.len()]]
    }

    /// Whether a point lies over it, by less than `level` beyond its sides.
    fn covers(&self, point: [f64; 2], level: f64) -> bool {
        (0..self.len()).all(|k| {
            let [p, q] = self.side(k);
            let (side, way) = (sub(q, p), sub(point, p));
            self.turn * (side[0] * way[1] - side[1] * way[0]) >= -level * dot(side, side).sqrt()
        })
    }
}

/// The corners of what face `face` of `own` shares with the face of `other` that faces it. `first` says whether `own` is the first body.
pub(super) fn overlap<A: Faceted, B: Faceted>(
    own: &Seen<'_, A>,
    face: usize,
    other: &Seen<'_, B>,
    first: bool,
    level: f64,
    [flat_ours, flat_theirs]: &mut [Vec<[f64; 2]>; 2],
    points: &mut Points,
) {
    let normal = own.normals[face];
    let [_, s, t] = Solid::frame(normal);
    let facing = other.facing(normal, level);
    let ours = Flat::new(own, face, [s, t], 1.0, flat_ours);
    let theirs = Flat::new(other, facing, [s, t], -1.0, flat_theirs);
    let (base, their_normal) = (ours.corner(0), other.normals[facing]);
    let mut take = |feature: u64, on_other: [f64; 3], gap: f64| {
        // On the surface of the second body, with the normal from the first.
        let (at, normal) = if first { (on_other, normal) } else { (along(on_other, -gap, normal), normal.map(|x| -x)) };
        points.add_apart(Point { feature, at, normal, gap }, [dot(s, on_other), dot(t, on_other)], 4.0 * level);
    };
    // Vertices of the first body count before those of the second, and both before crossings.
    for turn in [first, !first] {
        if turn {
            for k in (0..ours.len()).filter(|&k| theirs.covers(ours.corners[k], level)) {
                let corner = ours.corner(k);
                let gap = dot(their_normal, sub(theirs.corner(0), corner)) / dot(their_normal, normal);
                let feature = if first { feature(0, ours.index(k), 0) } else { feature(1, 0, ours.index(k)) };
                take(feature, along(corner, gap, normal), gap);
            }
        } else {
            for k in (0..theirs.len()).filter(|&k| ours.covers(theirs.corners[k], level)) {
                let feature = if first { feature(1, 0, theirs.index(k)) } else { feature(0, theirs.index(k), 0) };
                take(feature, theirs.corner(k), dot(normal, sub(theirs.corner(k), base)));
            }
        }
    }
    for i in 0..ours.len() {
        for j in 0..theirs.len() {
            if let Some(place) = crossing(ours.side(i), theirs.side(j), level) {
                let (r, e) = (theirs.corner(j), theirs.corner(j + 1));
                let at = along(r, place, sub(e, r));
                let (i, j) = (ours.index(i), theirs.index(j));
                let feature = if first { feature(3, i, j) } else { feature(3, j, i) };
                take(feature, at, dot(normal, sub(at, base)));
            }
        }
    }
}

/// Where on the second segment the first one crosses it, from 0 to 1. An end that is within `level` of the other's line is a point itself, and
/// where two sides lie on one line rounding alone says where they cross.
fn crossing([p, q]: [[f64; 2]; 2], [r, e]: [[f64; 2]; 2], level: f64) -> Option<f64> {
    let side = |from: [f64; 2], to: [f64; 2], x: [f64; 2]| {
        let (way, out) = (sub(to, from), sub(x, from));
        way[0] * out[1] - way[1] * out[0]
    };
    let crosses = |[r, e]: [[f64; 2]; 2], before: f64, after: f64| {
        let least = level * dot(sub(e, r), sub(e, r)).sqrt();
        before * after < 0.0 && before.abs() > least && after.abs() > least
    };
    let (before, after) = (side(p, q, r), side(p, q, e));
    (crosses([p, q], before, after) && crosses([r, e], side(r, e, p), side(r, e, q))).then(|| before / (before - after))
}
