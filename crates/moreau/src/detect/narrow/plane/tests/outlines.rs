//! What tests know of shapes without asking the narrow phase: outlines of cores, and distances between them by trying all.

use super::*;

/// A core as the segments of its outline, in the world, and by how much it is grown.
pub(super) struct Outline {
    pub(super) segments: Vec<[[f64; 2]; 2]>,
    pub(super) grown: f64,
}

pub(super) fn world(pose: &Pose, v: [f64; 2]) -> [f64; 2] {
    let v = Plane::rotate(pose.rotation, v);
    [pose.position[0] + v[0], pose.position[1] + v[1]]
}

impl Outline {
    pub(super) fn of(shape: &PlaneShape, pose: &Pose) -> Self {
        let side = |p: [f64; 2], q: [f64; 2]| [world(pose, p), world(pose, q)];
        match shape {
            PlaneShape::Disk(disk) => Self { segments: vec![side([0.0; 2], [0.0; 2])], grown: disk.radius },
            PlaneShape::Capsule(capsule) => {
                let [p, q] = capsule.ends();
                Self { segments: vec![side(p, q)], grown: capsule.radius() }
            }
            PlaneShape::Polygon(polygon) => {
                Self { segments: polygon.sides().iter().map(|s| side(s.start, s.end)).collect(), grown: 0.0 }
            }
            PlaneShape::Polyline(line) => {
                Self { segments: line.segments().iter().map(|s| side(s.start, s.end)).collect(), grown: 0.0 }
            }
            PlaneShape::HalfPlane(_) | PlaneShape::Compound(_) => unreachable!("no core"),
        }
    }

    /// Distance of a point from the grown outline; negative inside the growth.
    pub(super) fn distance(&self, p: [f64; 2]) -> f64 {
        self.segments.iter().map(|&s| point_segment(p, s)).fold(f64::INFINITY, f64::min) - self.grown
    }

    /// The least distance between two grown outlines that do not cross.
    pub(super) fn apart(&self, other: &Self) -> f64 {
        let one_way = |a: &Self, b: &Self| {
            let ends = a.segments.iter().flatten();
            ends.map(|&p| b.segments.iter().map(|&s| point_segment(p, s)).fold(f64::INFINITY, f64::min))
                .fold(f64::INFINITY, f64::min)
        };
        one_way(self, other).min(one_way(other, self)) - self.grown - other.grown
    }

    /// Whether two outlines cross.
    pub(super) fn crosses(&self, other: &Self) -> bool {
        let left = |[p, q]: [[f64; 2]; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0.0;
        self.segments
            .iter()
            .any(|&a| other.segments.iter().any(|&b| left(a, b[0]) != left(a, b[1]) && left(b, a[0]) != left(b, a[1])))
    }
}

fn point_segment(p: [f64; 2], [s, e]: [[f64; 2]; 2]) -> f64 {
    let (d, w) = ([e[0] - s[0], e[1] - s[1]], [p[0] - s[0], p[1] - s[1]]);
    let square = d[0] * d[0] + d[1] * d[1];
    let t = if square > 0.0 { ((d[0] * w[0] + d[1] * w[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    (w[0] - t * d[0]).hypot(w[1] - t * d[1])
}

/// The contacts in the order given, features ascending.
pub(super) fn contacts(a: &PlaneShape, pose_a: &Pose, b: &PlaneShape, pose_b: &Pose, reach: f64) -> Vec<Found> {
    let mut found = Vec::new();
    PlaneShape::collide((a, pose_a), (b, pose_b), reach, &mut |f, p, n, g| found.push((f, p, n, g)));
    assert!(found.is_sorted_by(|a, b| a.0 < b.0), "features must ascend: {found:?}");
    found
}

/// Features of a hundred placements that differ by rounding; they must all be these.
pub(super) fn assert_steady(a: &PlaneShape, pose_a: &Pose, b: &PlaneShape, pose_b: &Pose, features: &[u64]) {
    for k in 0..200 {
        let tiny = |seed: i32| f64::from((k * 7919 + seed * 104_729) % 1000 - 500_i32) * 2e-15;
        let moved = |pose: &Pose, seed: i32| {
            let [c, s] = pose.rotation;
            let rotation = [c - s * tiny(seed), s + c * tiny(seed)];
            at([pose.position[0] + tiny(seed + 1), pose.position[1] + tiny(seed + 2)], rotation)
        };
        let found = contacts(a, &moved(pose_a, 1), b, &moved(pose_b, 4), 1e-9);
        assert_eq!(found.iter().map(|contact| contact.0).collect::<Vec<_>>(), features, "{found:?}");
    }
}
