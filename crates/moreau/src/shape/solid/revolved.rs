//! Polygons of what is round about the z axis: balls, cylinders, capsules.

use crate::shape::polygons::{Polygons, SIDES};
use std::f64::consts::PI;

/// The surface that a profile sweeps about the z axis, by 24 sides. Its points (radius and height, m) go from below to above; where it does
/// not begin or end on the axis, it is closed by a flat end. Vertices lie on the surface: what is between them lies inside where it bulges.
pub(crate) fn revolved(profile: impl IntoIterator<Item = [f64; 2]>) -> Polygons<3> {
    let mut all = Polygons::default();
    let rings: Vec<Ring> = profile.into_iter().map(|point| Ring::of(point, &mut all)).collect();
    for pair in rings.windows(2) {
        let [below, above] = [&pair[0], &pair[1]];
        for side in 0..SIDES {
            // On the axis two corners are one.
            let lower = [below.vertex(side), below.vertex(side + 1)].into_iter().take(below.width());
            let upper = [above.vertex(side + 1), above.vertex(side)].into_iter().take(above.width());
            all.push(lower.chain(upper));
        }
    }
    if let Some(lowest) = rings.first().filter(|ring| ring.count > 1) {
        all.push((0..SIDES).rev().map(|side| lowest.vertex(side)));
    }
    if let Some(highest) = rings.last().filter(|ring| ring.count > 1) {
        all.push((0..SIDES).map(|side| highest.vertex(side)));
    }
    all
}

/// Half a circle of this radius about a centre on the axis, or the part of it between two twelfths: 0 is its lowest point, 12 its highest.
pub(crate) fn arc(radius: f64, centre: f64, twelfths: std::ops::RangeInclusive<usize>) -> impl Iterator<Item = [f64; 2]> {
    twelfths.map(move |i| {
        let angle = PI * i as f64 / 12.0;
        // The poles lie on the axis exactly.
        let out = if i == 0 || i == 12 { 0.0 } else { radius * libm::sin(angle) };
        [out, centre - radius * libm::cos(angle)]
    })
}

/// The vertices at one height: on the axis one, elsewhere one a side.
struct Ring {
    first: usize,
    count: usize,
}

impl Ring {
    fn of([radius, height]: [f64; 2], all: &mut Polygons<3>) -> Self {
        let (first, count) = (all.vertices.len(), if radius == 0.0 { 1 } else { SIDES });
        all.vertices.extend((0..count).map(|side| {
            let (sine, cosine) = libm::sincos(2.0 * PI * side as f64 / SIDES as f64);
            [radius * cosine, radius * sine, height]
        }));
        Self { first, count }
    }

    fn vertex(&self, side: usize) -> usize {
        self.first + side % self.count
    }

    /// How many corners a side has at this height.
    fn width(&self) -> usize {
        self.count.min(2)
    }
}
