//! Kinematics of the plane and of space: all that differs between the two dimensions in one step.
//!
//! A generalised velocity is `[f64; N]`: first the velocity of the centre of mass in the world frame (`D` numbers, m/s), then the
//! spin in the body's own principal frame (rad/s; one number in the plane, three in space). In that frame the mass matrix is
//! diagonal and constant. Positions are updated from the start of the step by θ-averaged velocities (eq. 13 of Barboteu & Dumont
//! 2017), rotations by the Cayley map, which needs no trigonometry and keeps the angular momentum of a free body exactly.

pub(crate) mod curve;
mod plane;
mod solid;

pub use plane::Plane;
pub use solid::Solid;

use crate::shape::Shape;
use crate::step::{StepError, StepRecord, Workspace};
use crate::world::World;
use std::sync::atomic::AtomicBool;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Plane {}
    impl Sealed for super::Solid {}
}

/// Where a body is: its centre of mass and its orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<R, const D: usize> {
    /// Centre of mass in the world, m.
    pub position: [f64; D],
    /// Rotation from the body's principal frame to the world.
    pub rotation: R,
}

/// A place that is given in the frame of another, in the world of that.
#[inline]
pub(crate) fn placed<S: Space<D, N>, const D: usize, const N: usize>(
    frame: &Pose<S::Rotation, D>,
    inner: &Pose<S::Rotation, D>,
) -> Pose<S::Rotation, D> {
    let offset = S::rotate(frame.rotation, inner.position);
    Pose { position: std::array::from_fn(|k| frame.position[k] + offset[k]), rotation: S::within(frame.rotation, inner.rotation) }
}

/// The kinematics of one dimension: `Plane` is `Space<2, 3>`, `Solid` is `Space<3, 6>`.
pub trait Space<const D: usize, const N: usize>: sealed::Sealed + Copy + Default + Send + Sync + 'static {
    /// Orientation: a unit complex number in the plane, a unit quaternion in space.
    type Rotation: Copy + PartialEq + std::fmt::Debug + Send + Sync + 'static;
    /// The shapes of this dimension.
    type Shape: Shape<Self, D, N>;

    /// The orientation in which the body's frame is the world's.
    const IDENTITY: Self::Rotation;

    /// A ball (2D: a disk) of this radius (m).
    fn ball(radius: f64) -> Self::Shape;

    /// Turns a vector of the body's frame into the world's.
    fn rotate(rotation: Self::Rotation, v: [f64; D]) -> [f64; D];

    /// Turns a vector of the world's frame into the body's.
    fn unrotate(rotation: Self::Rotation, v: [f64; D]) -> [f64; D];

    /// An orientation in a frame that is itself turned, as the world sees it.
    fn within(frame: Self::Rotation, rotation: Self::Rotation) -> Self::Rotation;

    /// The orientation after turning for the time `h` with the spin of `velocity` (Cayley map, normalised).
    fn turn(rotation: Self::Rotation, velocity: &[f64; N], h: f64) -> Self::Rotation;

    /// The orientation after a turn by `angle` (rad) about `axis` (world, of length 1); the plane turns about its third axis.
    fn turned(rotation: Self::Rotation, axis: [f64; 3], angle: f64) -> Self::Rotation;

    /// One row of H* (eq. 15): the generalised direction whose product with a body's velocity is the velocity, along `direction`
    /// (world), of the body's point at `arm` (world, from the centre of mass).
    fn row(rotation: Self::Rotation, arm: [f64; D], direction: [f64; D]) -> [f64; N];

    /// Orthonormal frame of a contact, rows n, t₁ (, t₂), continuous in `normal` almost everywhere.
    fn frame(normal: [f64; D]) -> [[f64; D]; D];

    /// Adds to `free` (which holds v + h M⁻¹ f) what the gyroscopic torque does in the time `h`: solves the implicit midpoint rule
    /// J(ω⁺ − ω) = h (J ω_m) × ω_m + J Δω, which keeps energy (for θ = 1/2) and the length of the angular momentum.
    fn gyroscopic(mass: &[f64; N], velocity: &[f64; N], free: &mut [f64; N], h: f64);

    /// The spin at the end of a step, in the body's frame there, from the balance of angular momentum in the world:
    /// L⁺ = R J ω + h τ + R_m J (ω⁺ − ω_free), ω⁺ having been found in the frame of the predicted rotation R_m. Momentum is then
    /// kept to rounding, whatever the contacts do to the axis of rotation. `rotations` are R, R_m and R⁺, `velocities` are v,
    /// v_free and v⁺; `torque` is h τ in the world, as the last part of a load.
    fn settle(mass: &[f64; N], rotations: [Self::Rotation; 3], velocities: [&[f64; N]; 3], torque: &[f64; N]) -> [f64; N];

    /// The derivative of the rotation of the next prediction, R⁺ cay(h (1 − θ) ω_s), with respect to the spin ω⁺ in `velocities`: for each
    /// component of ω⁺ the turn in the world (rad) that it makes, over h. The arguments are those of [`settle`](Self::settle), with
    /// what it gives in `settled`.
    fn response(
        mass: &[f64; N],
        rotations: [Self::Rotation; 3],
        velocities: [&[f64; N]; 3],
        settled: &[f64; N],
        torque: &[f64; N],
        step: (f64, f64),
    ) -> [[f64; 3]; 3];

    /// A load given in the world (force, then torque) as seen in generalised coordinates of a body so turned.
    fn load_in_body(rotation: Self::Rotation, load: &[f64; N]) -> [f64; N];

    /// The spin of `velocity` in the world frame; the plane's only component is the third.
    fn spin_in_world(rotation: Self::Rotation, velocity: &[f64; N]) -> [f64; 3];

    /// The orientation as a unit quaternion (x, y, z, w), for files.
    fn quaternion(rotation: Self::Rotation) -> [f64; 4];

    /// The orientation as it is, bit by bit, in up to four numbers; the others are zeros.
    fn numbers(rotation: Self::Rotation) -> [f64; 4];

    /// The orientation that has these numbers, if they are some.
    fn from_numbers(numbers: [f64; 4]) -> Option<Self::Rotation>;

    /// [`crate::step::step_until`] in this dimension: all that a step is made of is compiled here, once, and not in every program that
    /// calls it.
    ///
    /// # Errors
    /// As there.
    fn step(world: &mut World<Self, D, N>, work: &mut Workspace<Self, D, N>, stop: &AtomicBool) -> Result<StepRecord, StepError>;
}

/// Whether numbers are those of an orientation: of length 1.
fn is_unit(numbers: &[f64]) -> bool {
    (numbers.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-6
}

/// ω × arm.
#[inline]
pub(crate) fn swept<const D: usize>(spin: &[f64; 3], arm: &[f64; D]) -> [f64; D] {
    let arm: [f64; 3] = std::array::from_fn(|k| if k < D { arm[k] } else { 0.0 });
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        spin[i] * arm[j] - spin[j] * arm[i]
    })
}
