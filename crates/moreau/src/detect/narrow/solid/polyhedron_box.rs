//! A convex polyhedron and a box: up to four points; see `facets`.

use super::{Pose, facets};
use crate::shape::solid::{Cuboid, Polyhedron};

pub(super) fn collide(
    a: (&Polyhedron, &Pose),
    b: (&Cuboid, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    facets::collide(a, b, reach, emit);
}
