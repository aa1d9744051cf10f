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

/// Directions in which two rims are nearest or least through each other, up to their sign: all local minima of the distance of
/// a point of the smaller rim from the larger one.
pub(in crate::detect::narrow::solid) fn rims(a: &Rim, b: &Rim, mut found: impl FnMut([f64; 3])) {
    let (small, large) = if a.radius <= b.radius { (a, b) } else { (b, a) };
    // An eighth of a rim in four parts, along its chord.
    let part = |k: usize| {
        let (p, q, x) = (FIXED[k / 4 % 8], FIXED[(k / 4 + 1) % 8], 0.25 * (k % 4) as f64);
        [0, 1].map(|i| p[i] + x * (q[i] - p[i]))
    };
    let out = |[x, y]: [f64; 2]| {
        let length = (x * x + y * y).sqrt();
        along(small.tangents[0].map(|t| x / length * t), y / length, small.tangents[1])
    };
    // Half the change of the squared distance along the rim, with the way to the other.
    let slope = |place: [f64; 2]| {
        let out = out(place);
        let tangent = cross(small.outward, out);
        let here = along(small.centre, small.radius, out);
        let way = sub(here, large.nearest(here).unwrap_or(here));
        (dot(way, tangent), way, tangent)
    };
    let mut before = slope(part(0)).0;
    for k in 0..32 {
        let after = slope(part(k + 1)).0;
        if before < 0.0 && after >= 0.0 {
            let place = zero(|place| slope(place).0, (part(k), before), (part(k + 1), after));
            let (_, way, tangent) = slope(place);
            let across = large
                .radial(along(small.centre, small.radius, out(place)))
                .map_or([0.0; 3], |radial| cross(tangent, cross(large.outward, radial)));
            // The way has few digits where it is short, what is across both rims where they run alike.
            let is_short = dot(way, way) < dot(across, across) * small.radius * small.radius;
            found(if is_short { across } else { way });
        }
        before = after;
    }
}

/// Where on a chord a function that is negative at its beginning becomes zero: false position with the Illinois rule.
fn zero(f: impl Fn([f64; 2]) -> f64, (p, mut below): ([f64; 2], f64), (q, mut above): ([f64; 2], f64)) -> [f64; 2] {
    let (mut low, mut high) = (0.0, 1.0);
    let mut last = 0.0;
    let at = |x: f64| [0, 1].map(|i| p[i] + x * (q[i] - p[i]));
    for _ in 0..STEPS {
        let x = (low * above - high * below) / (above - below);
        if !(x > low && x < high) {
            break;
        }
        let value = f(at(x));
        if value < 0.0 {
            (low, below) = (x, value);
            above *= if last < 0.0 { 0.5 } else { 1.0 };
        } else {
            (high, above) = (x, value);
            below *= if last > 0.0 { 0.5 } else { 1.0 };
        }
        last = 1.0_f64.copysign(value);
    }
    at(if -below < above { low } else { high })
}
