//! A camera that shows all bounded bodies.

use super::scene::{is_there, rotation};
use super::view::axes;
use super::{Body, Camera, Error, Picture, Shape};
use glam::{DMat3, DVec3};

/// Room about the bodies, as a part of the picture.
const MARGIN: f64 = 0.08;

/// The picture's camera with nothing open.
pub(super) fn fit(picture: &Picture) -> Result<Camera, Error> {
    let up = proper(picture.up, "up")?.normalize();
    let direction = match picture.camera.direction {
        Some(direction) => proper(direction, "direction")?,
        None => oblique(up),
    };
    let axes = axes(direction, up);
    let (low, high) = extent(picture, axes);
    let middle = axes.transpose() * (0.5 * (low + high));
    let target = match picture.camera.target {
        Some(target) if target.iter().all(|x| x.is_finite()) => target.into(),
        Some(_) => return Err(Error::Camera("target")),
        None => middle,
    };
    let width = match picture.camera.width {
        Some(width) if width.is_finite() && width > 0.0 => width,
        Some(_) => return Err(Error::Camera("width")),
        None => {
            // Twice what lies farther from the target, on either side.
            let half = (high - axes * target).max(axes * target - low);
            let aspect = picture.size[0] as f64 / picture.size[1].max(1) as f64;
            let width = 2.0 * half.x.max(half.y * aspect) / (1.0 - 2.0 * MARGIN);
            if width > 0.0 { width } else { 1.0 }
        }
    };
    Ok(Camera { direction: Some(direction.into()), target: Some(target.into()), width: Some(width) })
}

fn proper(v: [f64; 3], name: &'static str) -> Result<DVec3, Error> {
    let length = DVec3::from(v).length();
    if length.is_finite() && length > 0.0 { Ok(v.into()) } else { Err(Error::Camera(name)) }
}

/// Down by 24°, and 28° to the left of straight into the picture.
fn oblique(up: DVec3) -> DVec3 {
    // The horizontal axis that is nearest to y, so that x goes to the right in a picture with z up.
    let ahead = if up.y.abs() < 0.9 { DVec3::Y } else { -DVec3::Z };
    let ahead = (ahead - up * ahead.dot(up)).normalize();
    let left = up.cross(ahead);
    let (down, aside) = (24_f64.to_radians(), 28_f64.to_radians());
    (ahead * aside.cos() + left * aside.sin()) * down.cos() - up * down.sin()
}

/// Least and greatest coordinates along the axes, of the bounded bodies or else of the chains.
fn extent(picture: &Picture, axes: DMat3) -> (DVec3, DVec3) {
    let mut bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut hold = |p: DVec3, radius: f64| {
        let q = axes * p;
        if q.is_finite() {
            bounds = (bounds.0.min(q - radius), bounds.1.max(q + radius));
        }
    };
    for body in picture.bodies.iter().filter(|b| is_there(b)) {
        let position = DVec3::from(body.position);
        match body.shape {
            Shape::Ball { radius } => hold(position, radius),
            Shape::Mesh(mesh) => {
                let turn = rotation(body);
                picture.meshes[mesh].vertices.iter().for_each(|&v| hold(position + turn * DVec3::from(v), 0.0));
            }
            Shape::Plane { .. } => {}
        }
    }
    let bounded = |b: &Body| is_there(b) && !matches!(b.shape, Shape::Plane { .. });
    if !picture.bodies.iter().any(bounded) {
        for chain in &picture.chains {
            hold(chain.from.into(), chain.radius);
            hold(chain.to.into(), chain.radius);
        }
    }
    if bounds.0.is_finite() && bounds.1.is_finite() { bounds } else { (DVec3::splat(-0.5), DVec3::splat(0.5)) }
}

/// Middle and radius of a ball about the bounded bodies, or the chains.
pub(super) fn about(picture: &Picture) -> (DVec3, f64) {
    let (low, high) = extent(picture, DMat3::IDENTITY);
    (0.5 * (low + high), 0.5 * (high - low).length().max(f64::MIN_POSITIVE))
}
