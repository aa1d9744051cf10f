//! What two faces share, seen along the normal of one of them.

use super::{Point, Seen, feature};
use crate::detect::narrow::vector::{along, dot, sub};
use crate::shape::solid::Faceted;
use crate::space::{Solid, Space};

/// Points of contact, as many as two faces of sixteen corners can have.
pub(super) struct Points {
    all: [Point; 32],
    count: usize,
}

impl Default for Points {
    fn default() -> Self {
        Self { all: [Point { feature: 0, at: [0.0; 3], normal: [0.0; 3], gap: 0.0 }; 32], count: 0 }
    }
}

impl Points {
    pub(super) fn all(&self) -> &[Point] {
        &self.all[..self.count]
    }

    pub(super) fn add(&mut self, point: Point) {
        if let Some(place) = self.all.get_mut(self.count) {
            *place = point;
            self.count += 1;
        }
    }

    /// Keeps those within reach, of more than four the ones farthest out in four directions and the deepest, in the order of their features.
    pub(super) fn spread(&mut self, level: f64, reach: f64) {
        let mut kept = 0;
        for i in 0..self.count {
            if self.all[i].gap <= reach {
                self.all[kept] = self.all[i];
                kept += 1;
            }
        }
        self.count = kept;
        self.all[..kept].sort_unstable_by_key(|point| point.feature);
        if kept > 4 {
            self.four(level);
        }
    }

    fn four(&mut self, level: f64) {
        let [_, s, t] = Solid::frame(self.all[0].normal);
        let mut chosen = [usize::MAX; 4];
        for (corner, [x, y]) in [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]].into_iter().enumerate() {
            let out = |i: usize| x * dot(s, self.all[i].at) + y * dot(t, self.all[i].at);
            chosen[corner] = (0..self.count).fold(0, |best, i| if out(i) > out(best) + level { i } else { best });
        }
        let deepest = (0..self.count).fold(0, |best, i| if self.all[i].gap < self.all[best].gap - level { i } else { best });
        if !chosen.contains(&deepest) {
            let apart = |i: usize| {
                let between = sub(self.all[i].at, self.all[deepest].at);
                dot(between, between)
            };
            let nearest = (1..4).fold(0, |best, k| if apart(chosen[k]) < apart(chosen[best]) { k } else { best });
            chosen[nearest] = deepest;
        }
        chosen.sort_unstable();
        self.count = 0;
        for (k, &i) in chosen.iter().enumerate() {
            if k == 0 || chosen[k - 1] != i {
                self.all[self.count] = self.all[i];
                self.count += 1;
            }
        }
    }
}

/// A face in its plane: its corners, counter-clockwise or, of a face that is seen from behind, clockwise.
struct Flat<'a, F> {
    seen: &'a Seen<'a, F>,
    face: usize,
    axes: [[f64; 3]; 2],
    /// 1 or −1.
    turn: f64,
}

impl<F: Faceted> Flat<'_, F> {
    fn len(&self) -> usize {
        self.seen.body.face(self.face).len()
    }

    fn index(&self, k: usize) -> usize {
        usize::from(self.seen.body.face(self.face)[k])
    }

    fn corner(&self, k: usize) -> [f64; 3] {
        self.seen.corner(self.face, k % self.len())
    }

    fn flat(&self, point: [f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| dot(axis, point))
    }

    /// Whether a point lies over it, by less than `level` beyond its sides.
    fn covers(&self, point: [f64; 2], level: f64) -> bool {
        (0..self.len()).all(|k| {
            let (p, q) = (self.flat(self.corner(k)), self.flat(self.corner(k + 1)));
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
    points: &mut Points,
) {
    let normal = own.normal(face);
    let [_, s, t] = Solid::frame(normal);
    let facing = other.facing(normal);
    let ours = Flat { seen: own, face, axes: [s, t], turn: 1.0 };
    let theirs = Flat { seen: other, face: facing, axes: [s, t], turn: -1.0 };
    let (base, their_normal) = (ours.corner(0), other.normal(facing));
    let mut taken: [[f64; 2]; 32] = [[0.0; 2]; 32];
    let mut take = |feature: u64, on_other: [f64; 3], gap: f64| {
        let flat = ours.flat(on_other);
        let near = |&p: &[f64; 2]| dot(sub(p, flat), sub(p, flat)) <= 16.0 * level * level;
        if points.count < taken.len() && !taken[..points.count].iter().any(near) {
            taken[points.count] = flat;
            // On the surface of the second body, with the normal from the first.
            let (at, normal) = if first { (on_other, normal) } else { (along(on_other, -gap, normal), normal.map(|x| -x)) };
            points.add(Point { feature, at, normal, gap });
        }
    };
    // Vertices of the first body count before those of the second, and both before crossings.
    for turn in [first, !first] {
        if turn {
            for k in (0..ours.len()).filter(|&k| theirs.covers(ours.flat(ours.corner(k)), level)) {
                let corner = ours.corner(k);
                let gap = dot(their_normal, sub(theirs.corner(0), corner)) / dot(their_normal, normal);
                let feature = if first { feature(0, ours.index(k), 0) } else { feature(1, 0, ours.index(k)) };
                take(feature, along(corner, gap, normal), gap);
            }
        } else {
            for k in (0..theirs.len()).filter(|&k| ours.covers(ours.flat(theirs.corner(k)), level)) {
                let feature = if first { feature(1, 0, theirs.index(k)) } else { feature(0, theirs.index(k), 0) };
                take(feature, theirs.corner(k), dot(normal, sub(theirs.corner(k), base)));
            }
        }
    }
    for i in 0..ours.len() {
        for j in 0..theirs.len() {
            let (p, q) = (ours.flat(ours.corner(i)), ours.flat(ours.corner(i + 1)));
            let (r, e) = (theirs.corner(j), theirs.corner(j + 1));
            if let Some(place) = crossing([p, q], [ours.flat(r), ours.flat(e)]) {
                let at = along(r, place, sub(e, r));
                let (i, j) = (ours.index(i), theirs.index(j));
                let feature = if first { feature(3, i, j) } else { feature(3, j, i) };
                take(feature, at, dot(normal, sub(at, base)));
            }
        }
    }
}

/// Where on the second segment the first one crosses it, from 0 to 1.
fn crossing([p, q]: [[f64; 2]; 2], [r, e]: [[f64; 2]; 2]) -> Option<f64> {
    let side = |from: [f64; 2], to: [f64; 2], x: [f64; 2]| {
        let (way, out) = (sub(to, from), sub(x, from));
        way[0] * out[1] - way[1] * out[0]
    };
    let (before, after) = (side(p, q, r), side(p, q, e));
    let crosses = before * after < 0.0 && side(r, e, p) * side(r, e, q) < 0.0;
    crosses.then(|| before / (before - after))
}
