//! A sun with shadows, and a sky that corners see less of.

use super::Picture;
use super::scene::Scene;
use super::surface::{NOTHING, Surface};
use super::view::{FINE, View};
use glam::{DVec3, Mat3, Vec3};
use rayon::prelude::*;

/// Samples along a side of the shadow map.
const MAP: usize = 1280;
/// Looks at the neighbourhood of a pixel for the sky, and at the map for the sun.
const LOOKS: usize = 12;
/// Radius of a half-shadow in samples of the map.
const SOFT: f32 = 5.0;
/// The pattern of looks turns from pixel to pixel and repeats after as many, over which it is averaged.
const PATTERN: usize = 4;

/// Where light comes from and what stands in its way.
pub(super) struct Light {
    /// Towards the sun.
    pub sun: Vec3,
    /// The middle of the sky.
    pub up: Vec3,
    map: Surface,
    turn: Mat3,
    shift: Vec3,
    /// Samples of the map a sample of the picture.
    scale: f32,
    /// Opacity of each body.
    opacity: Vec<f32>,
    /// How far from a place things still hide its sky, in samples.
    near: f32,
}

/// Part of the sky and of the sun that a place sees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    pub sky: f32,
    pub sun: f32,
}

impl Light {
    pub(super) fn new(picture: &Picture, scene: &Scene, view: &View, (middle, radius): (DVec3, f64)) -> Self {
        let [eye, right, _] = view.frame();
        let up = DVec3::from(picture.up).normalize();
        // From above, over the left shoulder of who looks.
        let level = (eye - up * eye.dot(up)).normalize_or(right.cross(up));
        let sun = (up * 1.0 + level * 0.42 - right * 0.52).normalize();
        let from_sun = View::square(-sun, middle, 1.02 * radius, MAP);
        let map = Surface::new(from_sun.size, &scene.bodies(picture, &from_sun, |_| true));
        let (turn, shift) = view.to(&from_sun);
        Self {
            sun: view.direction(sun),
            up: view.direction(up),
            map,
            turn,
            shift,
            scale: (from_sun.scale / view.scale) as f32,
            opacity: picture.bodies.iter().map(|b| b.opacity.min(1.0) as f32).collect(),
            near: (middle_radius(picture, scene) * view.scale).clamp(8.0, 70.0) as f32,
        }
    }

    /// What the upper left sample of each pixel sees, evened out over its neighbours on the same body.
    pub(super) fn seen(&self, surface: &Surface) -> Vec<Seen> {
        let width = surface.size[0] / FINE;
        let rough: Vec<Seen> = (0..surface.size[1] / FINE)
            .into_par_iter()
            .flat_map_iter(|y| (0..width).map(move |x| self.look(surface, x, y)))
            .collect();
        let even = |x: usize, y: usize| even(surface, &rough, x, y);
        (0..surface.size[1] / FINE).into_par_iter().flat_map_iter(|y| (0..width).map(move |x| even(x, y))).collect()
    }

    fn look(&self, surface: &Surface, x: usize, y: usize) -> Seen {
        let at = FINE * (y * surface.size[0] + x);
        if surface.owner[at] == NOTHING {
            return Seen { sky: 1.0, sun: 1.0 };
        }
        let p = Vec3::new((FINE * x) as f32 + 0.5, (FINE * y) as f32 + 0.5, surface.depth[at]);
        let n = surface.normal(at);
        // Any sixteen different angles will do, as long as neighbours differ much.
        let start = ((x % PATTERN) * 7 + (y % PATTERN) * 11) as f32 * 0.61;
        let (mut hidden, mut shade) = (0.0, 0.0);
        let q = self.turn * (p + n * (1.5 / self.scale)) + self.shift;
        for i in 0..LOOKS {
            // A spiral by the golden angle covers a disk evenly.
            let (sin, cos) = (start + i as f32 * 2.399_963).sin_cos();
            let r = ((i as f32 + 0.5) / LOOKS as f32).sqrt();
            hidden += self.hidden(surface, p, n, [cos * r * self.near, sin * r * self.near]);
            shade += self.shade(q, [cos * r * SOFT, sin * r * SOFT]);
        }
        Seen { sky: (1.0 - 1.5 * hidden / LOOKS as f32).max(0.0), sun: 1.0 - shade / LOOKS as f32 }
    }

    /// How much of the sky over `p` is hidden by what the sample at `step` from it shows.
    fn hidden(&self, surface: &Surface, p: Vec3, n: Vec3, step: [f32; 2]) -> f32 {
        let (x, y) = (p.x + step[0], p.y + step[1]);
        if x < 0.0 || y < 0.0 || x >= surface.size[0] as f32 || y >= surface.size[1] as f32 {
            return 0.0;
        }
        let (column, row) = (x as usize, y as usize);
        let depth = surface.depth[row * surface.size[0] + column];
        let v = Vec3::new(column as f32 + 0.5 - p.x, row as f32 + 0.5 - p.y, depth - p.z);
        if depth == f32::NEG_INFINITY {
            return 0.0;
        }
        ((v.dot(n) - 0.5).max(0.0) * self.near / (v.length_squared() + 0.05 * self.near * self.near)).min(2.5)
    }

    /// How much of the sun is hidden from a place of the map.
    fn shade(&self, q: Vec3, step: [f32; 2]) -> f32 {
        let (x, y) = (q.x + step[0], q.y + step[1]);
        if x < 0.0 || y < 0.0 || x >= MAP as f32 || y >= MAP as f32 {
            return 0.0;
        }
        let at = y as usize * MAP + x as usize;
        if self.map.depth[at] > q.z + SOFT { self.opacity[self.map.owner[at] as usize] } else { 0.0 }
    }
}

/// The average over the pixels that share the pattern, as far as they show the same body near the same depth.
fn even(surface: &Surface, rough: &[Seen], x: usize, y: usize) -> Seen {
    let [width, height] = surface.size.map(|n| n / FINE);
    let sample = |x: usize, y: usize| FINE * (y * surface.size[0] + x);
    let own = sample(x, y);
    let (mut sum, mut count) = (Seen { sky: 0.0, sun: 0.0 }, 0.0);
    for row in (y + 1).saturating_sub(PATTERN / 2)..(y + 1 + PATTERN / 2).min(height) {
        for column in (x + 1).saturating_sub(PATTERN / 2)..(x + 1 + PATTERN / 2).min(width) {
            if surface.owner[sample(column, row)] == surface.owner[own] {
                let seen = rough[row * width + column];
                sum = Seen { sky: sum.sky + seen.sky, sun: sum.sun + seen.sun };
                count += 1.0;
            }
        }
    }
    Seen { sky: sum.sky / count, sun: sum.sun / count }
}

/// The median radius of the bounded bodies.
fn middle_radius(picture: &Picture, scene: &Scene) -> f64 {
    let mut radii: Vec<f64> = picture.bodies.iter().filter_map(|b| scene.radius(b)).collect();
    radii.sort_unstable_by(f64::total_cmp);
    radii.get(radii.len() / 2).copied().unwrap_or(0.0)
}
