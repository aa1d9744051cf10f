//! A ball and a body with flat faces: one point, at the face, edge or vertex nearest to the centre of the ball.

use super::Pose;
use super::curved::{Best, Dot, Hull, Touch, contacts, hulls, seen_from};
use crate::detect::narrow::common::LEVEL;
use crate::shape::solid::{Ball, Faceted};

pub(super) fn collide<F: Faceted>(
    (ball, pose_a): (&Ball, &Pose),
    (body, pose_b): (&F, &Pose),
    reach: f64,
    emit: &mut impl FnMut(u64, [f64; 3], [f64; 3], f64),
) {
    let (a, b) = (Hull::own(&Dot), Hull { body, pose: seen_from(pose_a, pose_b) });
    let level = LEVEL * (ball.radius + body.radius());
    let touch = Touch { radii: [ball.radius, 0.0], level, reach };
    let mut best = Best::new(&a, &b, level);
    hulls(&mut best, &touch);
    contacts(&best, &touch, pose_a, emit);
}
