//! What two patches share, seen along the normal of the contact.

use super::Touch;
use super::patch::{MOST, Patch};
use super::points::{Point, Points, feature};
use crate::detect::narrow::common::LEVEL;
use crate::detect::narrow::vector::{along, dot, sub};
use crate::space::{Solid, Space};

/// Numbers of the points where a line goes into a disk and out of it, beyond those of a cylinder's corners.
const INTO: u64 = 64;

/// A plane on which both patches are drawn along the normal: that of a disk, if there is one, so that it is a circle.
struct View {
    normal: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl View {
    /// Place on the plane and height along the normal.
    fn of(&self, point: [f64; 3]) -> ([f64; 2], f64) {
        let [s, t, out] = self.axes;
        let height = dot(out, point) / dot(out, self.normal);
        let flat = along(point, -height, self.normal);
        ([dot(s, flat), dot(t, flat)], height)
    }

    fn back(&self, [x, y]: [f64; 2], height: f64) -> [f64; 3] {
        along(along(self.normal.map(|n| height * n), x, self.axes[0]), y, self.axes[1])
    }
}

/// A corner on the plane, its height and its number.
type Mark = ([f64; 2], f64, u64);

/// A patch as drawn on the plane.
struct Drawn {
    marks: [Mark; MOST],
    count: usize,
    /// 1 where the corners run counter-clockwise, else −1.
    turn: f64,
    /// How the height of a face rises along both axes.
    slope: Option<[f64; 2]>,
    /// Centre and radius of the disk of which it is a part.
    disc: Option<([f64; 2], f64)>,
    /// 1 for the lower of the two patches, else −1.
    upward: f64,
    level: f64,
}

impl Drawn {
    fn new(patch: &Patch, view: &View, is_disc: bool, upward: f64, level: f64) -> Self {
        let (marks, count) = ([([0.0; 2], 0.0, 0); MOST], patch.corners().len());
        let mut drawn = Self { marks, count, turn: 1.0, slope: None, disc: None, upward, level };
        for (mark, corner) in drawn.marks.iter_mut().zip(patch.corners()) {
            let (place, height) = view.of(corner.at);
            *mark = (place, height, corner.id);
        }
        let area: f64 = (1..drawn.count).map(|k| wedge(sub(drawn.at(k), drawn.at(0)), sub(drawn.at(k + 1), drawn.at(0)))).sum();
        drawn.turn = 1.0_f64.copysign(area);
        drawn.slope = patch.normal.map(|n| [0, 1].map(|k| -dot(n, view.axes[k]) / dot(n, view.normal)));
        drawn.disc = patch.disc.filter(|_| is_disc).map(|disc| (view.of(disc.centre).0, disc.radius));
        drawn
    }

    fn marks(&self) -> &[Mark] {
        &self.marks[..self.count]
    }

    fn at(&self, k: usize) -> [f64; 2] {
        self.marks[k % self.count].0
    }

    /// The sides, by the numbers of the corners at their ends.
    fn sides(&self) -> impl Iterator<Item = [Mark; 2]> {
        let count = if self.count < 3 { self.count - 1 } else { self.count };
        (0..count).map(|k| [self.marks[k], self.marks[(k + 1) % self.count]])
    }

    /// Whether a place lies over it, by less than what is level beyond its sides.
    fn covers(&self, place: [f64; 2]) -> bool {
        let level = self.level;
        if let Some((centre, radius)) = self.disc {
            return length(sub(place, centre)) <= radius + level;
        }
        let (p, q) = (self.at(0), self.at(1));
        let (way, out) = (sub(q, p), sub(place, p));
        match self.count {
            1 => length(out) <= level,
            2 if length(way) <= level => length(out) <= level,
            2 => {
                let (side, along) = (length(way), dot(way, out) / length(way));
                wedge(way, out).abs() <= level * side && along >= -level && along <= side + level
            }
            _ => (0..self.count).all(|k| {
                let (way, out) = (sub(self.at(k + 1), self.at(k)), sub(place, self.at(k)));
                self.turn * wedge(way, out) >= -level * length(way)
            }),
        }
    }

    /// Its height over a place; of a line that is seen end on that of the end which is nearer to the other body.
    fn height(&self, place: [f64; 2]) -> f64 {
        let ((p, low, _), (q, high, _)) = (self.marks[0], self.marks[1]);
        let out = sub(place, p);
        if let Some(slope) = self.slope {
            return low + dot(slope, out);
        }
        let way = sub(q, p);
        if self.count < 2 {
            return low;
        }
        if length(way) <= self.level {
            return if self.upward * (high - low) > 0.0 { high } else { low };
        }
        low + (dot(way, out) / dot(way, way)).clamp(0.0, 1.0) * (high - low)
    }
}

/// The corners of what the two patches share.
pub(super) fn overlap(patches: &[Patch; 2], normal: [f64; 3], touch: &Touch, points: &mut Points) {
    // Of two disks the one that is seen less from the side stays whole: the other one's lowest point is a corner.
    let cosines = patches.each_ref().map(|patch| patch.disc.map_or(-1.0, |disc| dot(disc.axes[2], normal).abs()));
    let whole = usize::from(cosines[1] > cosines[0] + 0.1 * LEVEL);
    // Both are circles where that makes no difference.
    let alike = cosines[0].min(cosines[1]) > 1.0 - 0.25 * LEVEL;
    let [out, s, t] = Solid::frame(normal);
    let view = View { normal, axes: patches[whole].disc.map_or([s, t, out], |disc| disc.axes) };
    let [a, b] = [(0, 1.0), (1, -1.0)].map(|(k, up)| Drawn::new(&patches[k], &view, alike || k == whole, up, touch.level));
    let add = |points: &mut Points, feature: u64, place: [f64; 2], on_a: f64, on_b: f64| {
        let (on_a, on_b) = (on_a + touch.radii[0], on_b - touch.radii[1]);
        points.add_seen(Point { feature, at: view.back(place, 0.5 * (on_a + on_b)), normal, gap: on_b - on_a });
    };
    if let (Some(disc_a), Some(disc_b)) = (a.disc, b.disc) {
        lens(disc_a, disc_b, touch.level, |feature, place| add(points, feature, place, a.height(place), b.height(place)));
        if points.have_least(1.0) {
            return;
        }
    }
    for &(place, height, id) in a.marks().iter().filter(|mark| b.covers(mark.0)) {
        add(points, feature(0, id, 0), place, height, b.height(place));
    }
    for &(place, height, id) in b.marks().iter().filter(|mark| a.covers(mark.0)) {
        add(points, feature(1, 0, id), place, a.height(place), height);
    }
    if a.disc.is_some() && b.disc.is_some() {
        return;
    }
    if let Some(disc) = b.disc {
        crossings_with(disc, &a, |id, way, place, height| add(points, feature(3, id, way), place, height, b.height(place)));
    } else if let Some(disc) = a.disc {
        crossings_with(disc, &b, |id, way, place, height| add(points, feature(3, way, id), place, a.height(place), height));
    } else {
        for side_a in a.sides() {
            for side_b in b.sides() {
                if let Some([s, t]) = crossing(side_a, side_b, touch.level) {
                    let (place, on_a) = between(side_a, s);
                    add(points, feature(3, side_a[0].2, side_b[0].2), place, on_a, between(side_b, t).1);
                }
            }
        }
    }
}

/// The corners of what two disks share, and the middles of its arcs; nothing where one holds the other.
fn lens((p, a): ([f64; 2], f64), (q, b): ([f64; 2], f64), level: f64, mut found: impl FnMut(u64, [f64; 2])) {
    let way = sub(q, p);
    let distance = length(way);
    if !(distance > (a - b).abs() + level && distance <= a + b) {
        return;
    }
    let [x, y] = way.map(|x| x / distance);
    let along_way = 0.5 * (distance + (a - b) * (a + b) / distance);
    let across = ((a - along_way) * (a + along_way)).max(0.0).sqrt();
    let middle = along(p, along_way, [x, y]);
    found(feature(0, INTO, 0), along(p, a, [x, y]));
    found(feature(1, 0, INTO), along(q, -b, [x, y]));
    found(feature(3, INTO, INTO), along(middle, -across, [-y, x]));
    found(feature(3, INTO, INTO + 1), along(middle, across, [-y, x]));
}

/// Where a polygon's sides go into a circle and out of it, with the height of the side.
fn crossings_with((centre, radius): ([f64; 2], f64), polygon: &Drawn, mut found: impl FnMut(u64, u64, [f64; 2], f64)) {
    for side in polygon.sides() {
        // |o + x w|² = r²
        let (o, w) = (sub(side[0].0, centre), sub(side[1].0, side[0].0));
        let (a, b, c) = (dot(w, w), dot(o, w), dot(o, o) - radius * radius);
        let square = b * b - a * c;
        if !(square > 0.0 && a > 0.0) {
            continue;
        }
        // Without the difference that loses digits.
        let sum = -(b + square.sqrt().copysign(b));
        let (x, y) = (sum / a, c / sum);
        for (way, x) in [(INTO, x.min(y)), (INTO + 1, x.max(y))] {
            if x > 0.0 && x < 1.0 {
                let (place, height) = between(side, x);
                found(side[0].2, way, place, height);
            }
        }
    }
}

/// A point of a side, from 0 to 1, and its height.
fn between([(p, low, _), (q, high, _)]: [Mark; 2], x: f64) -> ([f64; 2], f64) {
    (along(p, x, sub(q, p)), low + x * (high - low))
}

/// Where on each of two sides they cross, from 0 to 1, if they do by more than `level`: a side that ends on the other has its corner covered.
fn crossing([(p, ..), (q, ..)]: [Mark; 2], [(r, ..), (e, ..)]: [Mark; 2], level: f64) -> Option<[f64; 2]> {
    let (u, v) = (sub(q, p), sub(e, r));
    let (before, after) = (wedge(u, sub(r, p)), wedge(u, sub(e, p)));
    let (start, end) = (wedge(v, sub(p, r)), wedge(v, sub(q, r)));
    let opposite = |x: f64, y: f64, least: f64| x.min(y) < -least && x.max(y) > least;
    let crosses = opposite(before, after, level * length(u)) && opposite(start, end, level * length(v));
    crosses.then(|| [start / (start - end), before / (before - after)])
}

fn wedge(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn length(a: [f64; 2]) -> f64 {
    dot(a, a).sqrt()
}
