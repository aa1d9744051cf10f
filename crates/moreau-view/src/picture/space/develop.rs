//! From what is where to colours.

use super::floor::{self, Floor};
use super::light::{Light, Seen, rows};
use super::outline::Outline;
use super::scene::{self, Scene};
use super::surface::{NOTHING, Surface};
use super::view::{FINE, View};
use super::{Body, Image, Picture, Segment, Shape, fit};
use crate::picture::colour::{encode, linear};
use glam::{Vec3, Vec4};

/// Steps from no light to full light in the table of sRGB values.
const STEPS: usize = 4096;

/// Draws a scene.
pub(super) fn develop(picture: &Picture, scene: &Scene, view: &View) -> Image {
    let about = fit::about(picture);
    let light = Light::new(picture, scene, view, about);
    let floors = Floor::all(picture, view, about);
    let mut opaque = Surface::new(view.size, &scene.bodies(picture, view, |b| b.opacity >= 1.0));
    floor::draw(&mut opaque, &floors);
    let glass = scene.bodies(picture, view, |b| b.opacity < 1.0);
    let chains = scene::chains(picture, view);
    let pixels = |length: f64| (length * view.scale) as f32 / FINE as f32;
    let body = |b: &Body| (scene.radius(b).map(pixels), matches!(b.shape, Shape::Mesh(_)));
    let rod = |c: &Segment| (Some(pixels(c.radius)), false);
    let bodies = Outline::new(picture.bodies.iter().map(body));
    let table: Vec<u8> = (0..=STEPS).map(|i| encode(i as f32 / STEPS as f32)).collect();
    let layers = Layers {
        colours: picture.bodies.iter().map(|b| light_of(b.colour)).collect(),
        chain_colours: picture.chains.iter().map(|c| light_of(c.colour)).collect(),
        opacity: picture.bodies.iter().map(|b| b.opacity.min(1.0) as f32).collect(),
        opaque: Layer::new(opaque, &light),
        glass: (!glass.is_empty()).then(|| Layer::new(Surface::new(view.size, &glass), &light)),
        chains: (!chains.is_empty()).then(|| Surface::new(view.size, &chains)),
        bodies,
        rods: Outline::new(picture.chains.iter().map(rod)),
        depths: [-1.0, 1.0].map(|side| view.point(about.0).z + side * (about.1 * view.scale) as f32),
        floors,
        light,
        background: light_of([picture.background[0], picture.background[1], picture.background[2]])
            .extend(1.0)
            .map(|x| x * f32::from(picture.background[3]) / 255.0),
    };
    let pixel = |x: usize, y: usize| {
        let [r, g, b, a] = layers.pixel(x, y).to_array();
        let value = |light: f32| table[((light / a.max(1e-6)).clamp(0.0, 1.0) * STEPS as f32 + 0.5) as usize];
        [value(r), value(g), value(b), (255.0 * a.clamp(0.0, 1.0) + 0.5) as u8]
    };
    let pixels = rows(picture.size, pixel);
    Image { size: picture.size, pixels }
}

/// A surface with what its pixels see of the light.
struct Layer {
    surface: Surface,
    seen: Vec<Seen>,
}

impl Layer {
    fn new(surface: Surface, light: &Light) -> Self {
        let seen = light.seen(&surface);
        Self { surface, seen }
    }

    /// What a sample sees: what its pixel's first sample does, or if that shows another body a neighbour's.
    fn seen(&self, x: usize, y: usize) -> Seen {
        let width = self.surface.size[0];
        let (px, py) = (x / FINE, y / FINE);
        let owner = self.surface.owner[y * width + x];
        let same = |x: usize, y: usize| {
            let inside = x < width / FINE && FINE * y < self.surface.size[1];
            inside && self.surface.owner[FINE * (y * width + x)] == owner
        };
        let near = [(px, py), (px + 1, py), (px, py + 1), (px + 1, py + 1), (px.wrapping_sub(1), py), (px, py.wrapping_sub(1))];
        let (qx, qy) = near.into_iter().find(|&(x, y)| same(x, y)).unwrap_or((px, py));
        self.seen[qy * (width / FINE) + qx]
    }
}

/// All that is drawn, from back to front: background, floors and opaque bodies, translucent bodies, force chains.
struct Layers {
    opaque: Layer,
    glass: Option<Layer>,
    chains: Option<Surface>,
    colours: Vec<Vec3>,
    chain_colours: Vec<Vec3>,
    opacity: Vec<f32>,
    bodies: Outline,
    rods: Outline,
    floors: Vec<Floor>,
    /// Far and near end of the scene.
    depths: [f32; 2],
    light: Light,
    background: Vec4,
}

impl Layers {
    /// The mean of a pixel's samples. Where they and those about them show one smooth surface, one of them tells it.
    fn pixel(&self, x: usize, y: usize) -> Vec4 {
        let [left, top] = [FINE * x, FINE * y];
        let [width, height] = self.opaque.surface.size;
        let inner = x > 0 && y > 0 && left + FINE < width && top + FINE < height;
        let even = |surface: &Surface| surface.is_even([left - 1, top - 1], FINE + 2, |owner| self.bodies.has_edges(owner));
        let smooth = inner
            && even(&self.opaque.surface)
            && self.glass.as_ref().is_none_or(|glass| even(&glass.surface))
            && self.chains.as_ref().is_none_or(|chains| chains.is_even([left - 1, top - 1], FINE + 2, |_| false));
        if smooth {
            return self.sample(left, top);
        }
        let samples = (0..FINE * FINE).map(|i| self.sample(left + i % FINE, top + i / FINE));
        samples.sum::<Vec4>() / (FINE * FINE) as f32
    }

    /// Light and opacity of a sample, the light multiplied by the opacity.
    fn sample(&self, x: usize, y: usize) -> Vec4 {
        let mut sum = self.body(&self.opaque, x, y, self.background, 1.0);
        let at = y * self.opaque.surface.size[0] + x;
        let hidden = self.opaque.surface.depth[at];
        if let Some(glass) = &self.glass
            && glass.surface.depth[at] > hidden
        {
            sum = self.body(glass, x, y, sum, 0.55);
        }
        if let Some(chains) = &self.chains
            && chains.depth[at] > hidden
        {
            sum = self.chain(chains, x, y, sum);
        }
        sum
    }

    /// A layer of bodies over what is behind it, with outlines of some strength.
    fn body(&self, layer: &Layer, x: usize, y: usize, behind: Vec4, lines: f32) -> Vec4 {
        let surface = &layer.surface;
        let at = y * surface.size[0] + x;
        let owner = surface.owner[at];
        let mut sum = behind;
        if owner != NOTHING {
            let place = Vec3::new(x as f32 + 0.5, y as f32 + 0.5, surface.depth[at]);
            let floor = self.floors.iter().find(|f| f.owner == owner);
            let part = self.opacity[owner as usize] * floor.map_or(1.0, |f| f.strength(place));
            let normal = floor.map_or_else(|| surface.normal(at), |f| f.lit);
            let lit = self.lit(self.colours[owner as usize], normal, layer.seen(x, y), floor.is_none());
            sum = over(lit, part, sum);
        }
        let dark = self.bodies.at(surface, x, y);
        if dark > 0.0 { over(Vec3::splat(0.012), dark * lines, sum) } else { sum }
    }

    /// The chains over what is behind them, the paler the deeper.
    fn chain(&self, chains: &Surface, x: usize, y: usize, behind: Vec4) -> Vec4 {
        let at = y * chains.size[0] + x;
        let (owner, n) = (chains.owner[at] as usize, chains.normal(at));
        let [far, near] = self.depths;
        let covered = self.glass.as_ref().is_some_and(|g| g.surface.depth[at] > chains.depth[at]);
        let deep = ((near - chains.depth[at]) / (near - far)).clamp(0.0, 1.0);
        let lit = self.lit(self.chain_colours[owner], n, Seen { sky: 1.0, sun: 1.0 }, true);
        let dark = 0.5 * self.rods.at(chains, x, y).max(0.0);
        over(lit * (1.0 - dark), if covered { 1.0 - 0.65 * deep } else { 1.0 }, behind)
    }

    fn lit(&self, colour: Vec3, n: Vec3, seen: Seen, shiny: bool) -> Vec3 {
        let sky = 0.36 + 0.2 * n.dot(self.light.up);
        let sun = n.dot(self.light.sun).max(0.0) * seen.sun;
        let middle = (self.light.sun + Vec3::Z).normalize();
        let glint = if shiny { 0.10 * seen.sun * n.dot(middle).max(0.0).powi(24) } else { 0.0 };
        colour * (sky * seen.sky + 0.62 * sun) + Vec3::splat(glint)
    }
}

/// A colour that covers part of what is behind it.
fn over(colour: Vec3, part: f32, behind: Vec4) -> Vec4 {
    colour.extend(1.0) * part + behind * (1.0 - part)
}

fn light_of(colour: [u8; 3]) -> Vec3 {
    Vec3::from(colour.map(linear))
}
