//! What a body with flat faces has inside a box: its boundary is clipped and integrated over; theory (72).

use super::Cell;
use crate::shape::Polygons;

/// The volume (m³; area in the plane, m²) of what a closed boundary of convex polygons holds inside the cell, exactly. Polygons are in the
/// world, counter-clockwise seen from outside; in the plane they are the bodies themselves.
pub(super) fn facets_in<const D: usize>(facets: &Polygons<D>, cell: &Cell<D>) -> f64 {
    let mut volume = 0.0;
    for polygon in facets.iter() {
        let mut part: Vec<[f64; D]> = polygon.iter().map(|&i| facets.vertices[i]).collect();
        for axis in 0..2 {
            part = clip(&clip(&part, axis, cell.min[axis], 1.0), axis, cell.max[axis], -1.0);
        }
        volume += if D == 2 { shadow(&part, |_| 1.0) } else { columns(&part, cell) };
    }
    volume.max(0.0)
}

/// In space: the columns from the floor of the cell up to a face, less what of them is above the ceiling.
fn columns<const D: usize>(face: &[[f64; D]], cell: &Cell<D>) -> f64 {
    let above = |plane: f64| shadow(&clip(face, D - 1, plane, 1.0), |vertex| vertex[D - 1] - plane);
    above(cell.min[D - 1]) - above(cell.max[D - 1])
}

/// The part of a convex polygon on the side of a plane across an axis that the sign says.
fn clip<const D: usize>(polygon: &[[f64; D]], axis: usize, at: f64, sign: f64) -> Vec<[f64; D]> {
    let height = |p: &[f64; D]| sign * (p[axis] - at);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (here, next) = (height(p), height(q));
        if here >= 0.0 {
            kept.push(*p);
        }
        if (here > 0.0 && next < 0.0) || (here < 0.0 && next > 0.0) {
            let part = here / (here - next);
            let mut crossing: [f64; D] = std::array::from_fn(|k| p[k] + part * (q[k] - p[k]));
            crossing[axis] = at;
            kept.push(crossing);
        }
    }
    kept
}

/// ∫ of a linear function over the shadow of a polygon on the first two axes, positive for one that is counter-clockwise.
fn shadow<const D: usize>(polygon: &[[f64; D]], of: impl Fn(&[f64; D]) -> f64) -> f64 {
    let Some((o, rest)) = polygon.split_first() else { return 0.0 };
    let triangle = |p: &[f64; D], q: &[f64; D]| {
        let twice = (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
        0.5 * twice * (of(o) + of(p) + of(q)) / 3.0
    };
    rest.windows(2).map(|pair| triangle(&pair[0], &pair[1])).sum()
}
