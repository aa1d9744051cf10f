//! The plane: a velocity is (v_x, v_y, ω), a rotation a unit complex number.

use super::{Space, is_unit};
use crate::shape::PlaneShape;
use crate::step::{StepError, StepRecord, Workspace, step_in};
use crate::world::World;
use std::sync::atomic::AtomicBool;

/// Two dimensions, three degrees of freedom a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane;

impl Space<2, 3> for Plane {
    /// (cos φ, sin φ).
    type Rotation = [f64; 2];
    type Shape = PlaneShape;

    const IDENTITY: [f64; 2] = [1.0, 0.0];

    fn ball(radius: f64) -> PlaneShape {
        crate::shape::plane::Disk { radius }.into()
    }

    #[inline]
    fn rotate([c, s]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
        [c * x - s * y, s * x + c * y]
    }

    #[inline]
    fn within(frame: [f64; 2], rotation: [f64; 2]) -> [f64; 2] {
        Self::rotate(frame, rotation)
    }

    #[inline]
    fn unrotate([c, s]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
        [c * x + s * y, c * y - s * x]
    }

    fn turn([c, s]: [f64; 2], velocity: &[f64; 3], h: f64) -> [f64; 2] {
        // (1 + i a)² / (1 + a²) with a = h ω / 2 is the Cayley map of h ω.
        let a = 0.5 * h * velocity[2];
        let [dc, ds] = [1.0 - a * a, 2.0 * a];
        let [c, s] = [c * dc - s * ds, s * dc + c * ds];
        let length = (c * c + s * s).sqrt();
        [c / length, s / length]
    }

    fn turned([c, s]: [f64; 2], _: [f64; 3], angle: f64) -> [f64; 2] {
        let (sine, cosine) = libm::sincos(angle);
        [c * cosine - s * sine, s * cosine + c * sine]
    }

    #[inline]
    fn row(_: [f64; 2], [x, y]: [f64; 2], [dx, dy]: [f64; 2]) -> [f64; 3] {
        [dx, dy, x * dy - y * dx]
    }

    #[inline]
    fn frame([x, y]: [f64; 2]) -> [[f64; 2]; 2] {
        [[x, y], [-y, x]]
    }

    fn gyroscopic(_: &[f64; 3], _: &[f64; 3], _: &mut [f64; 3], _: f64) {}

    fn settle(_: &[f64; 3], _: [[f64; 2]; 3], [_, _, after]: [&[f64; 3]; 3], _: &[f64; 3]) -> [f64; 3] {
        *after
    }

    fn response(
        _: &[f64; 3],
        _: [[f64; 2]; 3],
        [v, _, after]: [&[f64; 3]; 3],
        settled: &[f64; 3],
        _: &[f64; 3],
        (h, theta): (f64, f64),
    ) -> [[f64; 3]; 3] {
        // The Cayley map turns by 2 arctan(a/2): da/(1 + a²/4).
        let slope = |a: f64| 1.0 / (1.0 + 0.25 * a * a);
        let mean = theta * after[2] + (1.0 - theta) * v[2];
        let turn = theta * slope(h * mean) + (1.0 - theta) * slope(h * (1.0 - theta) * settled[2]);
        [[0.0, 0.0, turn], [0.0; 3], [0.0; 3]]
    }

    fn load_in_body(_: [f64; 2], load: &[f64; 3]) -> [f64; 3] {
        *load
    }

    fn spin_in_world(_: [f64; 2], velocity: &[f64; 3]) -> [f64; 3] {
        [0.0, 0.0, velocity[2]]
    }

    fn quaternion([c, s]: [f64; 2]) -> [f64; 4] {
        // Half the angle: cos(φ/2) = √((1 + c)/2), the sign of sin(φ/2) is that of s.
        let half_cos = (0.5 * (1.0 + c)).max(0.0).sqrt();
        let half_sin = (0.5 * (1.0 - c)).max(0.0).sqrt().copysign(s);
        [0.0, 0.0, half_sin, half_cos]
    }

    fn numbers([c, s]: [f64; 2]) -> [f64; 4] {
        [c, s, 0.0, 0.0]
    }

    fn from_numbers([c, s, ..]: [f64; 4]) -> Option<[f64; 2]> {
        is_unit(&[c, s]).then_some([c, s])
    }

    fn step(world: &mut World<Self, 2, 3>, work: &mut Workspace<Self, 2, 3>, stop: &AtomicBool) -> Result<StepRecord, StepError> {
        step_in(world, work, stop)
    }
}
