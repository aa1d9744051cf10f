//! A sun with shadows, and a sky that corners see less of.

use super::Picture;
use super::scene::Scene;
use super::surface::{NOTHING, Surface};
use super::view::{FINE, View};
use glam::{DVec3, Mat3, Vec2, Vec3};
use rayon::prelude::*;

/// Looks at the neighbourhood of a pixel for the sky, and at the map for the sun.
const LOOKS: usize = 8;
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
    /// Where to look, within a circle of one, for each pixel of the pattern.
    looks: Vec<[Vec2; LOOKS]>,
    /// How far from a place things still hide its sky, in pixels.
    near: f32,
}

/// Part of the sky and of the sun that a place sees.
#[derive(Debug, Clone, Copy, Default)]
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
        // As fine as the picture itself, about.
        let samples = (view.size[0].max(view.size[1]) / FINE).clamp(64, 2048);
        let from_sun = View::square(-sun, middle, 1.02 * radius, samples);
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
            looks: (0..PATTERN * PATTERN).map(spiral).collect(),
            near: (middle_radius(picture, scene) * view.scale / FINE as f64).clamp(4.0, 35.0) as f32,
        }
    }

    /// What the upper left sample of each pixel sees, evened out over its neighbours on the same body.
    pub(super) fn seen(&self, surface: &Surface) -> Vec<Seen> {
        let size = surface.size.map(|n| n / FINE);
        let sample = |x: usize, y: usize| FINE * (y * surface.size[0] + x);
        // Together in memory these are found sooner.
        let coarse = Coarse {
            size,
            owner: rows(size, |x, y| surface.owner[sample(x, y)]),
            depth: rows(size, |x, y| surface.depth[sample(x, y)] / FINE as f32),
        };
        let rough = rows(size, |x, y| self.look(&coarse, || surface.normal(sample(x, y)), x, y));
        rows(size, |x, y| coarse.even(&rough, x, y))
    }

    fn look(&self, coarse: &Coarse, normal: impl FnOnce() -> Vec3, x: usize, y: usize) -> Seen {
        let at = y * coarse.size[0] + x;
        if coarse.owner[at] == NOTHING {
            return Seen { sky: 1.0, sun: 1.0 };
        }
        let (p, n) = (Vec3::new(x as f32, y as f32, coarse.depth[at]), normal());
        let looks = &self.looks[PATTERN * (y % PATTERN) + x % PATTERN];
        let hidden: f32 = looks.iter().map(|&step| coarse.hidden(p, n, step, self.near)).sum();
        // What faces away from the sun is dark of itself.
        let turned = n.dot(self.sun) <= 0.0;
        let shade = if turned { 0.0 } else { self.shaded(p * FINE as f32 + n * (1.5 / self.scale), looks) };
        Seen { sky: (1.0 - 1.5 * hidden / LOOKS as f32).max(0.0), sun: 1.0 - shade }
    }

    /// How much of the sun is hidden from a place in samples.
    fn shaded(&self, p: Vec3, looks: &[Vec2; LOOKS]) -> f32 {
        let q = self.turn * p + self.shift;
        looks.iter().map(|&step| self.shade(q, step * SOFT)).sum::<f32>() / LOOKS as f32
    }

    /// How much of the sun is hidden from a place of the map.
    fn shade(&self, q: Vec3, step: Vec2) -> f32 {
        let (x, y) = (q.x + step.x, q.y + step.y);
        let side = self.map.size[0];
        if x < 0.0 || y < 0.0 || x >= side as f32 || y >= side as f32 {
            return 0.0;
        }
        let at = y as usize * side + x as usize;
        if self.map.depth[at] > q.z + SOFT { self.opacity[self.map.owner[at] as usize] } else { 0.0 }
    }
}

/// A value for each pixel, rows in parallel.
pub(super) fn rows<T: Copy + Default + Send>([width, height]: [usize; 2], each: impl Fn(usize, usize) -> T + Sync) -> Vec<T> {
    let mut values = vec![T::default(); width * height];
    let fill = |(y, row): (usize, &mut [T])| row.iter_mut().enumerate().for_each(|(x, value)| *value = each(x, y));
    values.par_chunks_mut(width).enumerate().for_each(fill);
    values
}

/// A spiral by the golden angle, which covers a disk evenly. Neighbours in the pattern begin it at angles that differ much.
fn spiral(pattern: usize) -> [Vec2; LOOKS] {
    let start = (pattern * 7 % (PATTERN * PATTERN)) as f32 * 0.61;
    std::array::from_fn(|i| Vec2::from_angle(start + i as f32 * 2.399_963) * ((i as f32 + 0.5) / LOOKS as f32).sqrt())
}

/// The first sample of each pixel; depths in pixels.
struct Coarse {
    size: [usize; 2],
    owner: Vec<u32>,
    depth: Vec<f32>,
}

impl Coarse {
    /// How much of the sky over `p` is hidden by what is seen at a part of the distance `near` from it.
    fn hidden(&self, p: Vec3, n: Vec3, step: Vec2, near: f32) -> f32 {
        let at = p.truncate() + step * near + 0.5;
        if at.min_element() < 0.0 || at.x >= self.size[0] as f32 || at.y >= self.size[1] as f32 {
            return 0.0;
        }
        let (column, row) = (at.x as usize, at.y as usize);
        let depth = self.depth[row * self.size[0] + column];
        if depth == f32::NEG_INFINITY {
            return 0.0;
        }
        let v = Vec3::new(column as f32, row as f32, depth) - p;
        ((v.dot(n) - 0.25).max(0.0) * near / (v.length_squared() + 0.05 * near * near)).min(2.5)
    }

    /// The average over the pixels about one that share the pattern and show the same body.
    fn even(&self, rough: &[Seen], x: usize, y: usize) -> Seen {
        let [width, height] = self.size;
        let owner = self.owner[y * width + x];
        if owner == NOTHING {
            return rough[y * width + x];
        }
        let about = |x: usize, end: usize| (x + 1).saturating_sub(PATTERN / 2)..(x + 1 + PATTERN / 2).min(end);
        let (mut sky, mut sun, mut count) = (0.0, 0.0, 0.0);
        for row in about(y, height) {
            for at in about(x, width).map(|column| row * width + column) {
                if self.owner[at] == owner {
                    (sky, sun, count) = (sky + rough[at].sky, sun + rough[at].sun, count + 1.0);
                }
            }
        }
        Seen { sky: sky / count, sun: sun / count }
    }
}

/// The median radius of the bounded bodies.
fn middle_radius(picture: &Picture, scene: &Scene) -> f64 {
    let mut radii: Vec<f64> = picture.bodies.iter().filter_map(|b| scene.radius(b)).collect();
    radii.sort_unstable_by(f64::total_cmp);
    radii.get(radii.len() / 2).copied().unwrap_or(0.0)
}
