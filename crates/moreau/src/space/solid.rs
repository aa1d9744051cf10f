//! Space: a velocity is (v_x, v_y, v_z) in the world and (ω₁, ω₂, ω₃) in the body, a rotation a unit quaternion.

use super::{Space, is_unit};
use crate::shape::SolidShape;
use crate::step::{StepError, StepRecord, Workspace, step_in};
use crate::world::World;
use glam::{DMat3, DQuat, DVec3};
use std::sync::atomic::AtomicBool;

/// Three dimensions, six degrees of freedom a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Solid;

/// The spin part of a generalised velocity or mass.
fn spin(v: &[f64; 6]) -> DVec3 {
    DVec3::new(v[3], v[4], v[5])
}

impl Space<3, 6> for Solid {
    type Rotation = DQuat;
    type Shape = SolidShape;

    const IDENTITY: DQuat = DQuat::IDENTITY;

    fn ball(radius: f64) -> SolidShape {
        crate::shape::solid::Ball { radius }.into()
    }

    #[inline]
    fn rotate(rotation: DQuat, v: [f64; 3]) -> [f64; 3] {
        (rotation * DVec3::from(v)).into()
    }

    #[inline]
    fn within(frame: DQuat, rotation: DQuat) -> DQuat {
        frame * rotation
    }

    #[inline]
    fn unrotate(rotation: DQuat, v: [f64; 3]) -> [f64; 3] {
        (rotation.conjugate() * DVec3::from(v)).into()
    }

    fn turn(rotation: DQuat, velocity: &[f64; 6], h: f64) -> DQuat {
        // The unit quaternion along (1, h ω / 2) is the Cayley map of h ω; ω lives in the body, so it acts from the right.
        let half = 0.5 * h * spin(velocity);
        if half == DVec3::ZERO {
            return rotation;
        }
        (rotation * DQuat::from_xyzw(half.x, half.y, half.z, 1.0)).normalize()
    }

    fn turned(rotation: DQuat, axis: [f64; 3], angle: f64) -> DQuat {
        let (sine, cosine) = libm::sincos(0.5 * angle);
        let [x, y, z] = axis.map(|x| sine * x);
        (DQuat::from_xyzw(x, y, z, cosine) * rotation).normalize()
    }

    #[inline]
    fn row(rotation: DQuat, arm: [f64; 3], direction: [f64; 3]) -> [f64; 6] {
        let torque = rotation.conjugate() * DVec3::from(arm).cross(DVec3::from(direction));
        [direction[0], direction[1], direction[2], torque.x, torque.y, torque.z]
    }

    /// Branchless basis after Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
    #[inline]
    fn frame([x, y, z]: [f64; 3]) -> [[f64; 3]; 3] {
        let sign = 1.0_f64.copysign(z);
        let a = -1.0 / (sign + z);
        let b = x * y * a;
        [[x, y, z], [1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
    }

    fn gyroscopic(mass: &[f64; 6], velocity: &[f64; 6], free: &mut [f64; 6], h: f64) {
        let inertia = spin(mass);
        if inertia.x == inertia.y && inertia.y == inertia.z {
            return;
        }
        let before = spin(velocity);
        let pushed = spin(free); // ω + h J⁻¹ τ
        let mut after = pushed;
        // Newton on g(ω⁺) = J (ω⁺ − pushed) − h (J ω_m) × ω_m with ω_m = (ω + ω⁺)/2: a handful of rounds reach rounding.
        for _ in 0..20 {
            let middle = 0.5 * (before + after);
            let g = inertia * (after - pushed) - h * (inertia * middle).cross(middle);
            // d[(J m) × m] = (J dm) × m + (J m) × dm, with dm = dω⁺/2.
            let column = |e: DVec3| inertia * e - 0.5 * h * ((inertia * e).cross(middle) + (inertia * middle).cross(e));
            let jacobian = DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z));
            let change = jacobian.inverse() * g;
            if !change.is_finite() {
                break;
            }
            after -= change;
            if change.length() <= 1e-15 * after.length() {
                break;
            }
        }
        free[3..].copy_from_slice(&after.to_array());
    }

    fn settle(
        mass: &[f64; 6],
        [before, middle, end]: [DQuat; 3],
        [v, free, after]: [&[f64; 6]; 3],
        torque: &[f64; 6],
    ) -> [f64; 6] {
        let inertia = spin(mass);
        let round = inertia.x == inertia.y && inertia.y == inertia.z;
        if round && spin(torque) == DVec3::ZERO && spin(after) == spin(free) && spin(free) == spin(v) {
            return *after;
        }
        let momentum = before * (inertia * spin(v)) + spin(torque) + middle * (inertia * (spin(after) - spin(free)));
        let settled = (end.conjugate() * momentum) / inertia;
        [after[0], after[1], after[2], settled.x, settled.y, settled.z]
    }

    fn response(
        mass: &[f64; 6],
        [before, middle, end]: [DQuat; 3],
        [v, free, after]: [&[f64; 6]; 3],
        settled: &[f64; 6],
        torque: &[f64; 6],
        (h, theta): (f64, f64),
    ) -> [[f64; 3]; 3] {
        let inertia = spin(mass);
        let momentum = before * (inertia * spin(v)) + spin(torque) + middle * (inertia * (spin(after) - spin(free)));
        let (first, second) = (h * (theta * spin(after) + (1.0 - theta) * spin(v)), h * (1.0 - theta) * spin(settled));
        // cay(a + δ) = exp(κ) cay(a) with κ = (δ + ½ a × δ)/(1 + |a|²/4).
        let cayley = |a: DVec3, d: DVec3| (d + 0.5 * a.cross(d)) / (1.0 + 0.25 * a.length_squared());
        let column = |e: DVec3| -> [f64; 3] {
            let turned = before * cayley(first, theta * e);
            let change = middle * (inertia * e) + h * momentum.cross(turned);
            let spun = (end.conjugate() * change) / inertia;
            (turned + end * cayley(second, (1.0 - theta) * spun)).into()
        };
        [column(DVec3::X), column(DVec3::Y), column(DVec3::Z)]
    }

    fn load_in_body(rotation: DQuat, load: &[f64; 6]) -> [f64; 6] {
        let torque = rotation.conjugate() * spin(load);
        [load[0], load[1], load[2], torque.x, torque.y, torque.z]
    }

    fn spin_in_world(rotation: DQuat, velocity: &[f64; 6]) -> [f64; 3] {
        (rotation * spin(velocity)).into()
    }

    fn quaternion(rotation: DQuat) -> [f64; 4] {
        rotation.to_array()
    }

    fn numbers(rotation: DQuat) -> [f64; 4] {
        rotation.to_array()
    }

    fn from_numbers(numbers: [f64; 4]) -> Option<DQuat> {
        is_unit(&numbers).then(|| DQuat::from_array(numbers))
    }

    fn step(world: &mut World<Self, 3, 6>, work: &mut Workspace<Self, 3, 6>, stop: &AtomicBool) -> Result<StepRecord, StepError> {
        step_in(world, work, stop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_asymmetric_body_keeps_energy_and_the_length_of_its_momentum() {
        let mass = [1.0, 1.0, 1.0, 1.0, 2.0, 3.0];
        let mut v = [0.0, 0.0, 0.0, 0.01, 5.0, 0.02];
        let energy = |v: &[f64; 6]| spin(v).dot(spin(&mass) * spin(v));
        let momentum = |v: &[f64; 6]| (spin(&mass) * spin(v)).length();
        let (e0, l0) = (energy(&v), momentum(&v));
        let mut flipped = false;
        for _ in 0..20_000 {
            let mut free = v;
            Solid::gyroscopic(&mass, &v, &mut free, 1e-3);
            v = free;
            flipped |= v[4] < -4.9;
        }
        assert!(flipped, "the intermediate axis must flip");
        assert!((energy(&v) / e0 - 1.0).abs() < 1e-11);
        assert!((momentum(&v) / l0 - 1.0).abs() < 1e-11);
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed() {
        for n in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, 0.0, 0.8], [-0.48, 0.6, -0.64]] {
            let [n, s, t] = Solid::frame(n).map(DVec3::from);
            assert!((n.cross(s) - t).length() < 1e-15 && n.dot(s).abs() < 1e-15 && (s.length() - 1.0).abs() < 1e-15);
        }
    }
}
