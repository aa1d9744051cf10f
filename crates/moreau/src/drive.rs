//! Drives: motions and forces that are imposed on a body as functions of time (theory, section 19).
//!
//! A driven body is where its functions say at the end of each step, to rounding, and has their velocities at its beginning and end;
//! the θ-method of a step takes both, as it does of free bodies. A force acts by its mean over the step, so that its impulse is exact.

mod function;

pub use function::{Function, Ramp, Sine, Table};

use crate::space::{Pose, Space};

/// What a body does from some time on.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive<const D: usize, const N: usize> {
    /// It is free, and pushed by a force (N) and a torque (N·m) in the world beside its constant load.
    Free(Box<[Function; N]>),
    /// It moves as given, whatever touches it.
    Imposed(Imposed<D>),
}

/// An imposed motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Imposed<const D: usize> {
    /// Of the centre, component by component, m.
    pub centre: Box<[Course; D]>,
    /// About the centre; `None` for a body that does not turn.
    pub turn: Option<Turning>,
}

/// An imposed turn about an axis that stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Turning {
    /// The axis in the world, of length 1; unused in the plane.
    pub axis: [f64; 3],
    /// The angle, rad.
    pub angle: Course,
}

/// A coordinate as it changes with time, given by its rate or by itself. Only its change counts: a body moves on from where it is.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// By the rate, per second.
    Rate(Function),
    /// By itself.
    Itself(Function),
}

impl Course {
    /// At rest.
    pub const REST: Self = Course::Rate(Function::Constant(0.0));

    /// The change from time `a` to time `b`, theory (61).
    fn way(&self, a: f64, b: f64) -> f64 {
        match self {
            Course::Rate(rate) => rate.integral(a, b),
            Course::Itself(value) => value.value(b) - value.value(a),
        }
    }

    /// The rate at time `t`; of two, where it jumps, the one at `t + aside`.
    fn rate(&self, t: f64, aside: f64) -> f64 {
        match self {
            Course::Rate(rate) => rate.value(t),
            Course::Itself(value) => value.slope(t, aside),
        }
    }
}

impl<const D: usize> Imposed<D> {
    /// The pose at time `t` of a body that was at `start` at time `since`.
    pub fn pose<S: Space<D, N>, const N: usize>(&self, start: &Pose<S::Rotation, D>, since: f64, t: f64) -> Pose<S::Rotation, D> {
        let position = std::array::from_fn(|k| start.position[k] + self.centre[k].way(since, t));
        let rotation = match &self.turn {
            Some(Turning { axis, angle }) => S::turned(start.rotation, *axis, angle.way(since, t)),
            None => start.rotation,
        };
        Pose { position, rotation }
    }

    /// The generalised velocity at time `t` of a body that is turned by `rotation`; where it jumps, that at `t + aside`.
    pub fn velocity<S: Space<D, N>, const N: usize>(&self, rotation: S::Rotation, t: f64, aside: f64) -> [f64; N] {
        let mut velocity = [0.0; N];
        for k in 0..D {
            velocity[k] = self.centre[k].rate(t, aside);
        }
        let Some(Turning { axis, angle }) = &self.turn else { return velocity };
        let rate = angle.rate(t, aside);
        // The plane's only spin is about the third axis. Spins turn into the body's frame as torques do.
        let axis = if N - D == 1 { [0.0, 0.0, 1.0] } else { *axis };
        for k in D..N {
            velocity[k] = rate * axis[3 + k - N];
        }
        S::load_in_body(rotation, &velocity)
    }
}

/// The mean over the time from `t` to `t + h` of a force and a torque, theory (64).
pub(crate) fn mean<const N: usize>(load: &[Function; N], t: f64, h: f64) -> [f64; N] {
    std::array::from_fn(|k| load[k].integral(t, t + h) / h)
}
