//! A cylinder and a body with flat faces: up to four points.

use super::Pose;
use super::curved::tube_with;
use crate::shape::solid::{Cylinder, Faceted};

pub(super) fn collide<F: Faceted>(
    cylinder: (&Cylinder, &Pose),
    body: (&F, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    tube_with(cylinder, body, 0.0, reach, emit);
}
