//! Two bodies that are round along the lines at which they meet: one point at each end of a line that lies beside the other.
//!
//! Cylinders or capsules that lie side by side are never quite parallel. The one point where their lines cross would run from end to end as they
//! tremble, so the ends carry them, each with the distance and the normal that it has by itself; where the crossing is nearer than both ends it is
//! added by `overlap`.

use super::Touch;
use super::patch::Patch;
use super::points::{Point, Points, feature};
use crate::detect::narrow::vector::{along, dot, sub};

/// Cosine of the angle by which the normal at an end may differ from that of the contact.
const ASKEW: f64 = 0.5;

pub(super) fn ends(patches: &[Patch; 2], normal: [f64; 3], touch: &Touch, points: &mut Points) {
    let [Some(first), Some(second)] = [patches[0].axis, patches[1].axis] else { return };
    // Where two ends are beside each other that of the first body counts.
    beside(&patches[0], touch.radii[0], second, touch.radii[1], 1.0, (normal, touch, -touch.level), points);
    beside(&patches[1], touch.radii[1], first, touch.radii[0], -1.0, (normal, touch, touch.level), points);
}

/// The ends of a line, grown by `own`, beside the axis from p to q of a body of radius `around`, grown by `other`; not those less than `inset`
/// within the ends of the axis. `sign` is 1 for the first body's line, else −1.
fn beside(
    line: &Patch,
    own: f64,
    ([p, q], around): ([[f64; 3]; 2], f64),
    other: f64,
    sign: f64,
    (normal, touch, inset): ([f64; 3], &Touch, f64),
    points: &mut Points,
) {
    let way = sub(q, p);
    let length = dot(way, way).sqrt();
    let way = way.map(|x| x / length);
    for end in line.corners() {
        let place = dot(way, sub(end.at, p));
        if !(place >= inset && place <= length - inset) {
            continue;
        }
        let foot = along(p, place, way);
        let across = sub(foot, end.at);
        let distance = dot(across, across).sqrt();
        let outward = across.map(|x| x / distance);
        let gap = distance - around - own - other;
        // Not below what the bodies are apart: then the end lies beyond the other's axis.
        if distance > touch.level && sign * dot(outward, normal) >= ASKEW && points.allows(gap) {
            let at = along(end.at, own + 0.5 * gap, outward);
            let feature = if sign > 0.0 { feature(0, end.id, 0) } else { feature(1, 0, end.id) };
            points.add(Point { feature, at, normal: outward.map(|x| sign * x), gap });
        }
    }
}
