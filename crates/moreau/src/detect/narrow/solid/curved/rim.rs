//! Directions in which the rim of a cap can meet a line or another rim.

use super::tube::FIXED;
use super::unit;
use crate::detect::narrow::vector::{along, cross, dot, sub};
use crate::space::{Solid, Space};

/// The edge of a cap: a circle.
#[derive(Clone, Copy)]
pub(in crate::detect::narrow::solid) struct Rim {
    pub(in crate::detect::narrow::solid) centre: [f64; 3],
    /// Out of the cap, a unit vector.
    pub(in crate::detect::narrow::solid) outward: [f64; 3],
    /// Unit vectors across it, right-handed with it.
    pub(super) tangents: [[f64; 3]; 2],
    pub(in crate::detect::narrow::solid) radius: f64,
}

/// Square of the sine of the angle below which a line and an axis are parallel.
const PARALLEL: f64 = 1e-24;

/// More steps than Newton's or the secant method takes.
const STEPS: usize = 64;

impl Rim {
    /// The direction from the axis to a point, if it is not on the axis.
    fn radial(&self, point: [f64; 3]) -> Option<[f64; 3]> {
        let out = sub(point, self.centre);
        unit(along(out, -dot(out, self.outward), self.outward))
    }

    /// The point farthest along a vector that is not along the axis.
    pub(super) fn farthest(&self, way: [f64; 3]) -> Option<[f64; 3]> {
        self.nearest(along(self.centre, 1.0, way))
    }

    /// The nearest point of the rim to a point that is not on the axis.
    pub(super) fn nearest(&self, point: [f64; 3]) -> Option<[f64; 3]> {
        Some(along(self.centre, self.radius, self.radial(point)?))
    }
}

/// The unit vector out of the cylinder and of the cap of `rim`, across the line through `point` along the unit vector `way`, along which rim and
/// line are nearest or least through each other, if there is one.
///
/// Seen along the line the rim is an ellipse and the line a point. In the axes of the ellipse, with half axes a ≥ b and c = a² − b², the nearest
/// point to (x, y) has the normal (x/(μ + c), y/μ), where μ solves
///
///   F(μ) = (a x/(μ + c))² + (b y/μ)² = 1
///
/// (Eberly, Distance from a Point to an Ellipse, an Ellipsoid, or a Hyperellipsoid, 2013). F is convex between its poles, so Newton's
/// method runs to the root from one side. Only the half of the ellipse counts that lies on the side of the cap: if the point is on the other one
/// the root is the greatest below zero, which need not be.
pub(in crate::detect::narrow::solid) fn over_line(rim: &Rim, point: [f64; 3], way: [f64; 3]) -> Option<[f64; 3]> {
    let between = sub(point, rim.centre);
    let minor = along(rim.outward, -dot(rim.outward, way), way);
    let sine = dot(minor, minor);
    if sine <= PARALLEL {
        // Along its axis it is a circle, and around the middle of that each direction is as good as another.
        return Some(unit(along(between, -dot(between, way), way)).unwrap_or(Solid::frame(way)[1]));
    }
    let minor = minor.map(|x| x / sine.sqrt());
    // Once more across: of a small angle the difference above has few digits.
    let minor = along(minor, -dot(minor, way), way);
    let major = cross(minor, way);
    let (x, y) = (dot(between, major), dot(between, minor));
    let (side, x) = (1.0_f64.copysign(x), x.abs());
    let cosine = dot(rim.outward, way).abs();
    let (a, b, c) = (rim.radius, rim.radius * cosine, rim.radius * rim.radius * sine);
    let root = if y >= 0.0 { root(a * x, b * y, c, (b * y).max(a * x - c)) } else { root(a * x, b * y, c, b * y) }?;
    let (p, q) = if root == 0.0 {
        // On the major axis, within the ellipse: (a x/c, ·) on the unit circle.
        let u = (a * x / c).min(1.0);
        (cosine * u, (1.0 - u * u).sqrt())
    } else {
        (x / (root + c), y / root)
    };
    unit(along(major.map(|m| side * p * m), q, minor))
}

/// The root of (p/(μ + c))² + (q/μ)² = 1 to which Newton's method runs from `start`, where the left side is not less.
fn root(p: f64, q: f64, c: f64, start: f64) -> Option<f64> {
    let mut root = start;
    if root == 0.0 {
        return Some(0.0);
    }
    for _ in 0..STEPS {
        let (u, v) = (p / (root + c), q / root);
        let (square_u, square_v) = (u * u, v * v);
        let slope = -2.0 * (square_u / (root + c) + square_v / root);
        let step = (square_u + square_v - 1.0) / slope;
        let next = root - step;
        // Below zero there may be no root: then the method leaves the branch.
        if start < 0.0 && !(slope > 0.0 && u < 1.0 && next > -c) {
            return None;
        }
        let moves = if start < 0.0 { next < root } else { next > root };
        if !moves {
            break;
        }
        root = next;
    }
    Some(root)
}

/// Into how many parts a rim is cut.
const PARTS: usize = 32;

/// Directions in which two rims are nearest or least through each other, up to their sign: at all local minima of the distance of
/// a point of the smaller rim from the larger one, with the points, one of each.
///
/// Bodies that overlap part there too. With the tangents τ₁ and τ₂ of the rims, c = τ₁·τ₂, the depth d and the parts k of the rims'
/// curvatures along the normal, both the distance between the rims and the depth have a local minimum where the matrix
/// (1 − d k₁, c; c, 1 − d k₂) is positive.
pub(in crate::detect::narrow::solid) fn rims(a: &Rim, b: &Rim, mut found: impl FnMut([f64; 3], [[f64; 3]; 2])) {
    let (small, large) = if a.radius <= b.radius { (a, b) } else { (b, a) };
    // A place on the rim from 0 to PARTS, along the chords of eighths.
    let out = |place: f64| {
        let eighth = 0.25 * place;
        let (k, x) = (eighth as usize, eighth.fract());
        let (p, q) = (FIXED[k % 8], FIXED[(k + 1) % 8]);
        let [u, v] = [0, 1].map(|i| p[i] + x * (q[i] - p[i]));
        let length = (u * u + v * v).sqrt();
        along(small.tangents[0].map(|t| u / length * t), v / length, small.tangents[1])
    };
    // There, the way to it from the nearest point of the other.
    let way = |place: f64| {
        let here = along(small.centre, small.radius, out(place));
        (sub(here, large.nearest(here).unwrap_or(here)), here)
    };
    // Half the change of the squared distance along the rim.
    let slope = |place: f64| dot(way(place).0, cross(small.outward, out(place)));
    let slopes: [f64; PARTS] = std::array::from_fn(|k| slope(k as f64));
    for k in 0..PARTS {
        let [before, here, after] = [PARTS - 1, 0, 1].map(|step| slopes[(k + step) % PARTS]);
        let place = k as f64;
        let root = if here < 0.0 && after >= 0.0 {
            Some(zero(slope, (place, here), (place + 1.0, after)))
        } else {
            // The place before 0 is that before PARTS.
            let place = if k == 0 { PARTS as f64 } else { place };
            hidden(slope, place, [before, here, after])
        };
        let Some(place) = root else { continue };
        let (way, here) = way(place);
        let on_large = sub(here, way);
        let across =
            large.radial(here).map_or([0.0; 3], |radial| cross(cross(small.outward, out(place)), cross(large.outward, radial)));
        // The way has few digits where it is short, what is across both rims where they run alike.
        let is_short = dot(way, way) < dot(across, across) * small.radius * small.radius;
        let pair = if a.radius <= b.radius { [here, on_large] } else { [on_large, here] };
        found(if is_short { across } else { way }, pair);
    }
}

/// A zero from below of a function that has one sign at three neighbouring places and might have the other between them: where it comes
/// nearest to zero the second time, if it does.
fn hidden(f: impl Fn(f64) -> f64, place: f64, [before, here, after]: [f64; 3]) -> Option<f64> {
    let sign = 1.0_f64.copysign(here);
    let [left, middle, right] = [before, here, after].map(|x| sign * x);
    let (fall, bend) = (right - left, left + right - 2.0 * middle);
    // A parabola through the three stays well away from zero.
    if !(middle > 0.0 && left > middle && right >= middle && 2.0 * bend * middle <= fall * fall) {
        return None;
    }
    let (mut low, mut high) = (place - 1.0, place + 1.0);
    for _ in 0..STEPS {
        let third = (high - low) / 3.0;
        let [p, q] = [low + third, high - third].map(|x| (x, sign * f(x)));
        let nearest = if p.1 < q.1 { p } else { q };
        if nearest.1 < 0.0 {
            let (from, to) = if sign > 0.0 { (nearest.0, place + 1.0) } else { (place - 1.0, nearest.0) };
            return Some(zero(&f, (from, f(from)), (to, f(to))));
        }
        if p.1 < q.1 { high = q.0 } else { low = p.0 }
    }
    None
}

/// Where between two places a function that is negative at the first and not at the second is zero: false position with the Illinois rule.
fn zero(f: impl Fn(f64) -> f64, (mut low, mut below): (f64, f64), (mut high, mut above): (f64, f64)) -> f64 {
    let mut last = 0.0;
    for _ in 0..STEPS {
        let x = (low * above - high * below) / (above - below);
        if !(x > low && x < high) {
            break;
        }
        let value = f(x);
        if value < 0.0 {
            (low, below) = (x, value);
            above *= if last < 0.0 { 0.5 } else { 1.0 };
        } else {
            (high, above) = (x, value);
            below *= if last > 0.0 { 0.5 } else { 1.0 };
        }
        last = 1.0_f64.copysign(value);
    }
    if -below < above { low } else { high }
}
