//! From space to samples.

use super::Camera;
use glam::{DMat3, DVec3, Mat3, Vec3};

/// Samples along each side of a pixel.
pub(super) const FINE: usize = 2;

/// Parallel projection to samples: x to the right, y down, z towards the eye, all in samples.
#[derive(Debug, Clone)]
pub(super) struct View {
    /// Rows: right, up and towards the eye.
    axes: DMat3,
    target: DVec3,
    /// Samples a length of one.
    pub scale: f64,
    /// Samples across and down.
    pub size: [usize; 2],
}

impl View {
    /// The view of a camera in which nothing is open.
    pub(super) fn new(camera: &Camera, up: [f64; 3], pixels: [usize; 2]) -> Self {
        let direction = DVec3::from(camera.direction.unwrap_or([0.0, 1.0, 0.0]));
        let size = pixels.map(|n| n * FINE);
        let width = camera.width.unwrap_or(1.0);
        Self {
            axes: axes(direction, DVec3::from(up)),
            target: camera.target.unwrap_or_default().into(),
            scale: size[0] as f64 / width,
            size,
        }
    }

    /// A square view along `direction` of all within `radius` of `target`.
    pub(super) fn square(direction: DVec3, target: DVec3, radius: f64, samples: usize) -> Self {
        let axes = axes(direction, direction.any_orthogonal_vector());
        Self { axes, target, scale: samples as f64 / (2.0 * radius), size: [samples; 2] }
    }

    /// Where a point of space is.
    pub(super) fn point(&self, p: DVec3) -> Vec3 {
        let q = self.axes * (p - self.target) * self.scale;
        DVec3::new(0.5 * self.size[0] as f64 + q.x, 0.5 * self.size[1] as f64 - q.y, q.z).as_vec3()
    }

    /// A direction of space.
    pub(super) fn direction(&self, d: DVec3) -> Vec3 {
        let q = self.axes * d;
        DVec3::new(q.x, -q.y, q.z).as_vec3()
    }

    /// Towards the eye, to the right and up.
    pub(super) fn frame(&self) -> [DVec3; 3] {
        [self.axes.row(2), self.axes.row(0), self.axes.row(1)]
    }

    /// The map from these samples to those of another view: `turn * p + shift`.
    pub(super) fn to(&self, other: &View) -> (Mat3, Vec3) {
        let flip = DMat3::from_diagonal(DVec3::new(1.0, -1.0, 1.0));
        let turn = flip * other.axes * self.axes.transpose() * flip * (other.scale / self.scale);
        let middle = |v: &View| DVec3::new(0.5 * v.size[0] as f64, 0.5 * v.size[1] as f64, 0.0);
        let shift = middle(other) + flip * other.axes * (self.target - other.target) * other.scale - turn * middle(self);
        (turn.as_mat3(), shift.as_vec3())
    }
}

/// Right, up and towards the eye as rows, for a look along `direction`. Straight up or down, any direction is up.
pub(super) fn axes(direction: DVec3, up: DVec3) -> DMat3 {
    let toward = -direction.normalize();
    let across = up.normalize().cross(toward);
    let right = if across.length() > 1e-6 { across.normalize() } else { toward.any_orthonormal_vector() };
    DMat3::from_cols(right, toward.cross(right), toward).transpose()
}
