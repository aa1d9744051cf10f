//! Joints: what holds two bodies to each other, or one to the world, in both directions (theory, section 18).
//!
//! A joint has a point and axes on each of its two sides, given in that side's own frame. Where they are apart in a component that the
//! joint holds is its error of position c(q); the step asks for velocities that close it. Translations are along the axes of the first side, at
//! the point of the second; rotations are about the same axes. Each of the two is one block of the contact problem.

mod placed;

pub(crate) use placed::Placed;

use crate::bodies::Bodies;
use crate::space::{Pose, Space};
use moreau_solve::Row;

/// What a joint holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// All: the two move as one.
    Fixed,
    /// All but the rotation about the axis; in the plane all translations, as a pin does.
    Hinge,
    /// All but the translation along the axis.
    Slider,
    /// All translations, and no rotation.
    Ball,
    /// The distance of the two points.
    Distance,
}

/// The table of joints.
pub const JOINTS: &[(JointKind, Row)] = &[
    (JointKind::Fixed, Row { name: "fixed", about: "the two move as one" }),
    (JointKind::Hinge, Row { name: "hinge", about: "rotation about an axis through the anchor; in the plane about the anchor" }),
    (JointKind::Slider, Row { name: "slider", about: "translation along an axis, without rotation" }),
    (JointKind::Ball, Row { name: "ball", about: "rotation about the anchor; in space" }),
    (JointKind::Distance, Row { name: "distance", about: "two points keep their distance, like the ends of a rod without mass" }),
];

/// The two blocks that a joint may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// Translations along the axes.
    Translation,
    /// Rotations about them.
    Rotation,
}

impl JointKind {
    /// The components that it holds, as bits: of `D` translations, the first along the axis, or of `N` − `D` rotations.
    pub(crate) fn held<const D: usize, const N: usize>(self, part: Part) -> u8 {
        let all = match part {
            Part::Translation => (1 << D) - 1,
            Part::Rotation => (1 << (N - D)) - 1,
        };
        match (self, part) {
            (JointKind::Fixed, _) | (JointKind::Slider, Part::Rotation) => all,
            (JointKind::Hinge | JointKind::Ball, Part::Translation) => all,
            (JointKind::Slider, Part::Translation) | (JointKind::Hinge, Part::Rotation) => all & !1,
            (JointKind::Distance, Part::Translation) => 1,
            (JointKind::Ball | JointKind::Distance, Part::Rotation) => 0,
        }
    }
}

/// A joint between two sides: bodies, or a body and the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint<const D: usize> {
    /// What it holds.
    pub kind: JointKind,
    /// The bodies of its sides; none is the world. Its impulse acts on the second one, the opposite on the first.
    pub bodies: [Option<usize>; 2],
    /// Its point on each side, in that side's frame, m.
    pub anchor: [[f64; D]; 2],
    /// Its axes on each side, in that side's frame, as orthonormal rows; the first is the one that it is named after.
    pub axes: [[[f64; D]; D]; 2],
    /// The distance of the two points, m; zero but for [`JointKind::Distance`].
    pub length: f64,
    /// Whether its two bodies may touch each other.
    pub collide: bool,
}

impl<const D: usize> Joint<D> {
    /// A joint that is closed with the bodies where they are. `points` are its points on the first and the second side in the world,
    /// m, one twice but for [`JointKind::Distance`]; `axis` is a direction of length 1 in the world, which hinges in space and sliders read.
    pub fn new<S: Space<D, N>, const N: usize>(
        kind: JointKind,
        bodies: &Bodies<S, D, N>,
        sides: [Option<usize>; 2],
        points: [[f64; D]; 2],
        axis: [f64; D],
    ) -> Self {
        let pose = |side: usize| pose_of::<S, D, N>(&bodies.pose, sides[side]);
        let local = |side: usize| {
            let Pose { position, rotation } = pose(side);
            S::unrotate(rotation, std::array::from_fn(|k| points[side][k] - position[k]))
        };
        let world = S::frame(axis);
        let length = if kind == JointKind::Distance { distance(&points[0], &points[1]) } else { 0.0 };
        let axes = [0, 1].map(|side| world.map(|axis| S::unrotate(pose(side).rotation, axis)));
        Self { kind, bodies: sides, anchor: [local(0), local(1)], axes, length, collide: false }
    }

    /// The joint with its sides at these poses.
    pub(crate) fn at<S: Space<D, N>, const N: usize>(&self, poses: [Pose<S::Rotation, D>; 2]) -> Placed<D> {
        let world = |side: usize| {
            let Pose { position, rotation } = poses[side];
            let arm = S::rotate(rotation, self.anchor[side]);
            (std::array::from_fn(|k| position[k] + arm[k]), self.axes[side].map(|axis| S::rotate(rotation, axis)))
        };
        let ((a, axes_a), (b, axes_b)) = (world(0), world(1));
        Placed::new::<S, N>(self, [a, b], [axes_a, axes_b])
    }

    /// How far the joint is from closed with its bodies at these poses, m: the greatest of the lengths of what is apart in its
    /// translations and, as an angle times the length `arm`, in its rotations.
    pub fn error<S: Space<D, N>, const N: usize>(&self, poses: &[Pose<S::Rotation, D>], arm: f64) -> f64 {
        let placed = self.at::<S, N>(self.bodies.map(|body| pose_of::<S, D, N>(poses, body)));
        let length = |part: Part| placed.error::<N>(part).iter().map(|c| c * c).sum::<f64>().sqrt();
        length(Part::Translation).max(arm * length(Part::Rotation))
    }

    /// The arm at which a moment turns its bodies as an impulse moves them, √(Σ 1/m / mean Σ 1/J), m (theory (58)); 1 where nothing moves.
    pub fn arm<S: Space<D, N>, const N: usize>(&self, bodies: &Bodies<S, D, N>) -> f64 {
        let of_sides = |mobility: &dyn Fn(&[f64; N]) -> f64| -> f64 {
            self.bodies.iter().flatten().map(|&body| mobility(&bodies.inverse_mass[body])).sum()
        };
        let moves = of_sides(&|inverse| inverse[0]);
        let turns = of_sides(&|inverse| inverse[D..].iter().sum::<f64>() / (N - D) as f64);
        if moves > 0.0 && turns > 0.0 { (moves / turns).sqrt() } else { 1.0 }
    }
}

/// The pose of a side of a joint.
pub(crate) fn pose_of<S: Space<D, N>, const D: usize, const N: usize>(
    poses: &[Pose<S::Rotation, D>],
    body: Option<usize>,
) -> Pose<S::Rotation, D> {
    body.map_or(Pose { position: [0.0; D], rotation: S::IDENTITY }, |body| poses[body])
}

/// Writes the pairs of bodies that a joint keeps from touching, sorted.
pub(crate) fn parted<const D: usize>(joints: &[Joint<D>], pairs: &mut Vec<[u32; 2]>) {
    pairs.clear();
    pairs.extend(joints.iter().filter(|joint| !joint.collide).filter_map(|joint| {
        let [a, b] = joint.bodies.map(|body| body.map(|body| body as u32));
        Some([a?.min(b?), a?.max(b?)])
    }));
    pairs.sort_unstable();
}

/// ‖b − a‖.
fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).map(|k| (b[k] - a[k]) * (b[k] - a[k])).sum::<f64>().sqrt()
}
