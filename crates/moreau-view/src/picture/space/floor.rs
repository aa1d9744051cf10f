//! Half-spaces, drawn as floors that fade at their rim.

use super::scene::is_there;
use super::surface::Surface;
use super::view::View;
use super::{Picture, Shape};
use glam::{DVec3, Vec3};

/// Radius of a floor, in radii of the scene.
const FLOOR: f64 = 2.6;
/// Radius of a wall: it would hide the page to the picture's edge otherwise.
const WALL: f64 = 1.5;
/// Cosine of the angle to the vertical from which on a floor is a wall.
const STEEP: f64 = 0.7;

/// A half-space as a view sees it.
pub(super) struct Floor {
    /// Index of its body.
    pub owner: u32,
    normal: Vec3,
    /// The normal by which it is lit. Walls are lit as floors are, or one in a box would be white and the next one grey.
    pub lit: Vec3,
    /// The middle of what is drawn.
    foot: Vec3,
    /// Radius of what is drawn, in samples.
    radius: f32,
}

impl Floor {
    /// The part of the floor about a scene.
    pub(super) fn all(picture: &Picture, view: &View, (middle, radius): (DVec3, f64)) -> Vec<Self> {
        let floor = |(owner, body): (usize, &super::Body)| {
            let Shape::Plane { normal } = body.shape else { return None };
            let normal = (super::scene::rotation(body) * DVec3::from(normal)).try_normalize()?;
            let foot = middle - normal * normal.dot(middle - DVec3::from(body.position));
            let up = DVec3::from(picture.up).normalize();
            let wall = normal.dot(up).abs() < STEEP;
            Some(Self {
                owner: owner as u32,
                normal: view.direction(normal),
                lit: view.direction(if wall { up } else { normal }),
                foot: view.point(foot),
                radius: (radius * if wall { WALL } else { FLOOR } * view.scale) as f32,
            })
        };
        picture.bodies.iter().enumerate().filter(|(_, b)| is_there(b)).filter_map(floor).collect()
    }

    /// How much of it is left at a place, 1 in the middle and 0 at the rim.
    pub(super) fn strength(&self, p: Vec3) -> f32 {
        let t = ((p.distance(self.foot) / self.radius - 0.3) / 0.7).clamp(0.0, 1.0);
        1.0 - t * t * (3.0 - 2.0 * t)
    }

    /// Where a line of sight meets it.
    fn at(&self, x: f32, y: f32) -> Vec3 {
        let down = self.normal.x * (x - self.foot.x) + self.normal.y * (y - self.foot.y);
        Vec3::new(x, y, self.foot.z - down / self.normal.z)
    }

    fn reaches(&self, p: Vec3) -> bool {
        p.distance_squared(self.foot) < self.radius * self.radius
    }

    fn covers(&self, p: Vec3) -> bool {
        self.normal.dot(p - self.foot) < -1e-3 * self.radius
    }
}

/// Draws floors where they are nearer than what is there. What lies inside another half-space is left out, so that walls end at floors.
pub(super) fn draw(surface: &mut Surface, floors: &[Floor]) {
    let width = surface.size[0];
    let seen: Vec<&Floor> = floors.iter().filter(|f| f.normal.z > 1e-3).collect();
    if seen.is_empty() {
        return;
    }
    surface.bands(|band| {
        for at in 0..band.depth.len() {
            let (x, y) = ((at % width) as f32 + 0.5, (band.top + at / width) as f32 + 0.5);
            for floor in &seen {
                let p = floor.at(x, y);
                if p.z > band.depth[at] && floor.reaches(p) && !floors.iter().any(|other| other.covers(p)) {
                    band.put(at, p.z, floor.owner, || floor.normal);
                }
            }
        }
    });
}
