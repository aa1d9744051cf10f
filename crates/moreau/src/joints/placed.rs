//! A joint in the world: its directions, its rows of H*, and its error of position.

use super::{Joint, JointKind, Part, distance};
use crate::space::{Pose, Space};
use moreau_solve::block::dot;

/// A joint with its sides somewhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<const D: usize> {
    kind: JointKind,
    /// The points of the two sides, m.
    points: [[f64; D]; 2],
    /// The axes of the two sides.
    axes: [[[f64; D]; D]; 2],
    /// The directions of the translations.
    directions: [[f64; D]; D],
    length: f64,
}

impl<const D: usize> Placed<D> {
    pub(super) fn new<S: Space<D, N>, const N: usize>(joint: &Joint<D>, points: [[f64; D]; 2], axes: [[[f64; D]; D]; 2]) -> Self {
        let directions = if joint.kind == JointKind::Distance {
            let far = distance(&points[0], &points[1]);
            S::frame(std::array::from_fn(|k| (points[1][k] - points[0][k]) / far))
        } else {
            axes[0]
        };
        Self { kind: joint.kind, points, axes, directions, length: joint.length }
    }

    /// Where its impulse acts on both bodies: the point of the second side, m.
    pub(crate) fn point(&self) -> &[f64; D] {
        &self.points[1]
    }

    /// The row of H* of component `i` for a body, which sees it with a plus if it is the second side's (theory (56), (57)): a
    /// velocity along the direction i at the joint's point, or a spin about it.
    pub(crate) fn row<S: Space<D, N>, const N: usize>(&self, part: Part, i: usize, pose: &Pose<S::Rotation, D>) -> [f64; N] {
        match part {
            Part::Translation => {
                let arm = std::array::from_fn(|k| self.points[1][k] - pose.position[k]);
                S::row(pose.rotation, arm, self.directions[i])
            }
            // A spin is turned into the body as a torque is, whose components come last.
            Part::Rotation => {
                let axis = self.spin_axis(i);
                S::load_in_body(pose.rotation, &std::array::from_fn(|k| if k < D { 0.0 } else { axis[3 + k - N] }))
            }
        }
    }

    /// The exact derivative of the error of position in component `i`: with respect to the place (m) and to a small turn in the world
    /// (rad) of the body on one side, whose centre is at `centre`. Unlike the row of H* it stays exact where the joint is open.
    pub(crate) fn gradient(&self, part: Part, i: usize, side: usize, centre: &[f64; D]) -> ([f64; D], [f64; 3]) {
        let sign = if side == 0 { -1.0 } else { 1.0 };
        match part {
            Part::Translation => {
                let arm: [f64; D] = std::array::from_fn(|k| self.points[1][k] - centre[k]);
                (self.directions[i].map(|x| sign * x), cross(&arm, &self.directions[i]).map(|x| sign * x))
            }
            Part::Rotation => ([0.0; D], self.turn_gradient(i, side)),
        }
    }

    /// The derivative of e_i · c of (57) with respect to a turn of one side: (u × v) × w = v (u·w) − u (v·w), and e_i turns with the
    /// first side.
    fn turn_gradient(&self, i: usize, side: usize) -> [f64; 3] {
        let [a, b] = &self.axes;
        let (e, turned) = (self.spin_axis(i), self.turned());
        let (used, share) = if self.kind == JointKind::Hinge { (1, 1.0) } else { (D, 0.5) };
        let mut sum = if side == 0 { cross(&e, &turned) } else { [0.0; 3] };
        for (a, b) in a.iter().zip(b).take(used) {
            let (one, other, sign) = if side == 0 { (a, b, -1.0) } else { (b, a, 1.0) };
            let along = (0..D).map(|k| one[k] * e[k]).sum::<f64>();
            let cosine = dot(a, b);
            (0..3).for_each(|k| sum[k] += sign * share * (cosine * e[k] - if k < D { other[k] * along } else { 0.0 }));
        }
        sum
    }

    /// The error of position c: m, or the sine of an angle; zero in what is not held.
    pub(crate) fn error<const N: usize>(&self, part: Part) -> [f64; D] {
        let held = self.kind.held::<D, N>(part);
        let [a, b] = &self.points;
        let (turned, apart) = (self.turned(), std::array::from_fn(|k| b[k] - a[k]));
        std::array::from_fn(|i| match part {
            _ if held >> i & 1 == 0 => 0.0,
            Part::Translation => dot(&self.directions[i], &apart) - self.length,
            Part::Rotation => dot(&self.spin_axis(i), &turned),
        })
    }

    /// What has turned the second side against the first, as a vector: of a hinge what turns its axis.
    fn turned(&self) -> [f64; 3] {
        let [a, b] = &self.axes;
        if self.kind == JointKind::Hinge {
            return cross(&a[0], &b[0]);
        }
        let mut sum = [0.0; 3];
        for (a, b) in a.iter().zip(b) {
            let cross = cross(a, b);
            (0..3).for_each(|k| sum[k] += 0.5 * cross[k]);
        }
        sum
    }

    /// The axis of rotation `i`; the plane has one, which points out of it.
    fn spin_axis(&self, i: usize) -> [f64; 3] {
        if D < 3 { [0.0, 0.0, 1.0] } else { std::array::from_fn(|k| self.axes[0][i][k]) }
    }

    /// The components of an impulse along the directions, in the world.
    pub(crate) fn impulse_in_world(&self, r: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|k| (0..D).map(|i| self.directions[i][k] * r[i]).sum())
    }

    /// The components of a moment about the axes, in the world.
    pub(crate) fn moment_in_world(&self, r: &[f64; D]) -> [f64; 3] {
        std::array::from_fn(|k| (0..D).map(|i| self.spin_axis(i)[k] * r[i]).sum())
    }
}

/// a × b, in the plane its third component.
fn cross<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; 3] {
    let at = |v: &[f64; D], k: usize| if k < D { v[k] } else { 0.0 };
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        at(a, i) * at(b, j) - at(a, j) * at(b, i)
    })
}
