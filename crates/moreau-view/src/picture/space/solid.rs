//! What is drawn, in samples: x to the right, y down, z towards the eye.

use glam::{Vec2, Vec3};

/// A surface that gives its depth and normal at a sample.
#[derive(Debug, Clone, Copy)]
pub(super) enum Solid {
    Ball { centre: Vec3, radius: f32 },
    Triangle { corners: [Vec3; 3], normals: [Vec3; 3] },
    Rod { from: Vec3, to: Vec3, radius: f32 },
}

impl Solid {
    /// A triangle of vertices and normals, if one sees its outside.
    pub(super) fn facing(corners: [(Vec3, Vec3); 3]) -> Option<Self> {
        let [a, b, c] = corners.map(|(v, _)| v);
        // With y down a counter-clockwise triangle has a negative area.
        let facing = (b - a).truncate().perp_dot((c - a).truncate()) < 0.0;
        (facing && (a + b + c).is_finite())
            .then(|| Self::Triangle { corners: corners.map(|(v, _)| v), normals: corners.map(|(_, n)| n) })
    }

    /// Least and greatest coordinates.
    pub(super) fn bounds(&self) -> (Vec3, Vec3) {
        match *self {
            Self::Ball { centre, radius } => (centre - radius, centre + radius),
            Self::Triangle { corners: [a, b, c], .. } => (a.min(b).min(c), a.max(b).max(c)),
            Self::Rod { from, to, radius } => (from.min(to) - radius, from.max(to) + radius),
        }
    }
}

/// Height of a ball above its centre, at a place from its centre.
pub(super) fn ball(at: Vec2, radius: f32) -> Option<f32> {
    let rest = radius * radius - at.length_squared();
    (rest >= 0.0).then(|| rest.sqrt())
}

/// A triangle ready to be asked for many samples.
pub(super) struct Plane {
    corners: [Vec2; 3],
    depths: Vec3,
    /// One over twice the area, less than zero.
    scale: f32,
}

impl Plane {
    pub(super) fn new([a, b, c]: [Vec3; 3]) -> Self {
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        Self { corners: [a, b, c].map(Vec3::truncate), depths: Vec3::new(a.z, b.z, c.z), scale: area.recip() }
    }

    /// Depth and weights of the corners. A hair beyond the edges still belongs, so that no gap shows between neighbours.
    pub(super) fn at(&self, p: Vec2) -> Option<(f32, Vec3)> {
        let [a, b, c] = self.corners;
        let weights = Vec3::new((c - b).perp_dot(p - b), (a - c).perp_dot(p - c), (b - a).perp_dot(p - a)) * self.scale;
        (weights.min_element() >= -1e-4).then(|| (weights.dot(self.depths), weights))
    }
}

/// Depth and normal of a rod with round ends.
pub(super) fn rod(p: Vec2, from: Vec3, to: Vec3, radius: f32) -> Option<(f32, Vec3)> {
    let (axis, length) = ((to - from).normalize_or_zero(), (to - from).length());
    let q = (p - from.truncate()).extend(0.0);
    // The line of sight q + t e meets the cylinder where t² (1 - e²) - 2 m e t + q² - m² = r², with m and e along the axis.
    let (m, e) = (q.dot(axis), axis.z);
    let steep = 1.0 - e * e;
    let root = m * m * e * e - steep * (q.length_squared() - m * m - radius * radius);
    if steep > 1e-6 && root >= 0.0 {
        let t = (m * e + root.sqrt()) / steep;
        let along = m + t * e;
        if (0.0..=length).contains(&along) {
            return Some((from.z + t, (q + Vec3::Z * t - axis * along) / radius));
        }
    }
    let end = |centre: Vec3| {
        let at = p - centre.truncate();
        ball(at, radius).map(|height| (centre.z + height, at.extend(height) / radius))
    };
    match (end(from), end(to)) {
        (Some(a), Some(b)) => Some(if a.0 >= b.0 { a } else { b }),
        (a, b) => a.or(b),
    }
}
