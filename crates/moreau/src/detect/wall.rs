//! Bodies without a bounding ball: held against all others, or against those that are not far outside their half-space.

use super::broad::Sphere;
use super::{SLACK, Scene};
use crate::shape::Shape;
use crate::space::Space;

/// A body without a bounding ball, as it was when the list of nearby pairs was made.
#[derive(Clone, Debug)]
pub(super) struct Wall<const D: usize> {
    pub(super) body: u32,
    position: [f64; D],
    /// Outward unit normal of the half-space that holds the body; without one it is near everything.
    normal: Option<[f64; D]>,
    /// How high over the half-space a ball's surface may be and still count as near, m.
    height: f64,
    /// The distance, at least, from the position to the farthest point of any ball, m.
    far: f64,
}

impl<const D: usize> Wall<D> {
    pub(super) fn new<S: Space<D, N>, const N: usize>(scene: &Scene<'_, S, D, N>, body: u32) -> Self {
        let index = body as usize;
        let pose = &scene.poses[index];
        let normal = scene.shapes[index].bounding_normal(pose.rotation);
        // A rotation that is not one gives a normal with which heights are not distances.
        let normal = normal.filter(|n| (n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < SLACK);
        Self { body, position: pose.position, normal, height: scene.reach[index].max(0.0), far: 0.0 }
    }

    /// Lets its boundary come nearer by `skin` (m) before the list is made anew.
    pub(super) fn allow(&mut self, skin: f64) {
        self.height += skin;
    }

    /// Hands over the bodies whose balls are near.
    pub(super) fn near(&mut self, spheres: &[Sphere<D>], mut found: impl FnMut(u32)) {
        let Some(normal) = self.normal else {
            return spheres.iter().for_each(|sphere| found(sphere.body));
        };
        for sphere in spheres {
            let (mut height, mut far) = (0.0, sphere.radius);
            for k in 0..D {
                let between = sphere.centre[k] - self.position[k];
                height += normal[k] * between;
                far += between.abs();
            }
            self.far = self.far.max(far);
            // Turned round, so that what is not a number is found.
            let outside = height - SLACK * far > sphere.radius + self.height;
            if !outside {
                found(sphere.body);
            }
        }
    }

    /// By how much its boundary has come nearer, at most, to any point of the balls, m: by the shift along the normal, and by
    /// the turn of the normal times the distance of the point.
    pub(super) fn approach<S: Space<D, N>, const N: usize>(&self, scene: &Scene<'_, S, D, N>) -> f64 {
        let index = self.body as usize;
        let pose = &scene.poses[index];
        let Some(before) = self.normal else { return 0.0 };
        let Some(now) = scene.shapes[index].bounding_normal(pose.rotation) else { return f64::INFINITY };
        let (mut shift, mut size, mut turn) = (0.0, 0.0, 0.0);
        for k in 0..D {
            let between = pose.position[k] - self.position[k];
            shift += now[k] * between;
            size += between.abs();
            turn += (now[k] - before[k]).abs();
        }
        shift + SLACK * size + turn * self.far
    }

    /// Whether all that it can reach is among the bodies that were near.
    pub(super) fn holds<S: Space<D, N>, const N: usize>(&self, scene: &Scene<'_, S, D, N>) -> bool {
        let index = self.body as usize;
        scene.poses[index].position.iter().all(|x| x.is_finite())
            && self.approach(scene) + scene.reach[index].max(0.0) <= self.height
    }
}
