//! Small vectors for meshes.

pub(super) use crate::detect::narrow::vector::{cross, dot, sub};

/// Of the longest side squared: twice the area below which a triangle has none, because rounding decides its normal.
const FLAT: f64 = 1e-12;

/// Twice the area with the direction of the normal: (q − p) × (r − p).
pub(super) fn twice_area([p, q, r]: [[f64; 3]; 3]) -> [f64; 3] {
    cross(sub(q, p), sub(r, p))
}

pub(super) fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

/// The area of a triangle that has one, m².
pub(super) fn area(corners: [[f64; 3]; 3]) -> Option<f64> {
    let [p, q, r] = corners;
    let longest = length(sub(q, p)).max(length(sub(r, q))).max(length(sub(p, r)));
    let twice = length(twice_area(corners));
    (twice > FLAT * longest * longest).then_some(0.5 * twice)
}
