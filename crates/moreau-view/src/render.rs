//! Pictures of the frames of a run.

use crate::picture::flat::{Drawing, Figure, Link, Outline, Window};
use crate::picture::{Body, Camera, Error, Image, Mesh, Picture, Segment, Shape as Form, colour};
use crate::recording::{Drawn, Recording, RecordingError};
use moreau::scene::AnyWorld;
use moreau::solve::block::norm;
use moreau::space::{Plane, Solid, Space};
use moreau::trajectory::TrajectoryFrame;
use moreau::world::World;
use std::path::Path;

/// What is shown, and how.
#[derive(Clone, Copy, Debug, Default)]
pub struct Look {
    /// Width and height in pixels; of the plane the height follows from the bodies.
    pub size: [usize; 2],
    /// Whether forces are drawn, as rods from body to body.
    pub chains: bool,
    /// What bodies' colours tell.
    pub colour: Colour,
    /// From where one looks, in space.
    pub camera: Camera,
    /// What part of the plane is seen; by default all bounded bodies.
    pub window: Option<Window>,
}

/// What bodies' colours tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colour {
    /// The material; what is not free is grey.
    #[default]
    Material,
    /// The speed, from none to the greatest of the frame.
    Speed,
}

/// A frame, ready to be drawn.
#[derive(Clone, Debug)]
pub enum Shot {
    /// In space.
    Space(Picture),
    /// In the plane, with its width in pixels.
    Plane(Drawing, usize),
}

impl Shot {
    /// Frame `i` of a run.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn of(run: &Recording, i: usize, look: &Look) -> Result<Self, RecordingError> {
        let frame = run.trajectory.frame(i)?;
        Ok(match &run.world {
            AnyWorld::Solid(world) => Self::Space(space(run, world, &frame, look)),
            AnyWorld::Plane(world) => Self::Plane(plane(run, world, &frame, look), look.size[0]),
        })
    }

    /// Its pixels.
    ///
    /// # Errors
    /// Where its size or camera make no picture.
    pub fn image(&self) -> Result<Image, Error> {
        match self {
            Self::Space(picture) => picture.draw(),
            Self::Plane(drawing, across) => drawing.image(*across),
        }
    }

    /// Writes it: a `.png`, of the plane also an `.svg` or a `.pdf`.
    ///
    /// # Errors
    /// Where it cannot be written, or the name ends in something else.
    pub fn save(&self, path: &Path) -> Result<(), Error> {
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        match self {
            Self::Plane(drawing, _) if !is_png => drawing.save(path),
            Self::Space(_) if !is_png => {
                Err(Error::Format { path: path.to_owned(), known: ".png; .svg and .pdf are for scenes in the plane" })
            }
            _ => self.image()?.save(path),
        }
    }
}

/// A part of the plane that holds all bounded bodies in each of these frames, for a movie.
///
/// # Errors
/// Where they cannot be read.
pub fn window(run: &Recording, frames: &[usize]) -> Result<Option<Window>, RecordingError> {
    let radius = &run.trajectory.header().radius;
    let (mut min, mut max) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for &i in frames {
        let frame = run.trajectory.frame(i)?;
        let (places, _) = frame.position.as_chunks::<2>();
        for (place, r) in places.iter().zip(radius).filter(|(place, r)| r.is_finite() && place.iter().all(|x| x.is_finite())) {
            for k in 0..2 {
                min[k] = min[k].min(place[k] - r);
                max[k] = max[k].max(place[k] + r);
            }
        }
    }
    Ok((min[0] < max[0] && min[1] < max[1]).then_some(Window { min, max }))
}

/// A rod from one body to the other.
struct Rod<const D: usize> {
    ends: [[f64; D]; 2],
    /// Part of the widest.
    width: f64,
    colour: [u8; 3],
}

/// So many times the mean force has the widest rod.
const WIDEST: f64 = 5.0;

/// The contacts with an impulse. Of a body without bounds a rod begins at the contact.
fn rods<const D: usize>(run: &Recording, frame: &TrajectoryFrame) -> Vec<Rod<D>> {
    let (radius, (points, _)) = (&run.trajectory.header().radius, frame.point.as_chunks::<D>());
    let (places, _) = frame.position.as_chunks::<D>();
    let impulses = lengths::<D>(&frame.impulse);
    let pressed = impulses.iter().filter(|&&p| p > 0.0);
    let mean = pressed.clone().sum::<f64>() / pressed.count().max(1) as f64;
    let rod = |(c, &impulse): (usize, &f64)| {
        let end = |side: usize| {
            let body = frame.pairs[side][c] as usize;
            if radius[body].is_finite() { places[body] } else { points[c] }
        };
        let colour = colour::category(if frame.status[c] == 2 { 1 } else { 0 });
        Rod { ends: [end(0), end(1)], width: (impulse / (WIDEST * mean)).min(1.0), colour }
    };
    impulses.iter().enumerate().filter(|&(_, &impulse)| impulse > 0.0).map(rod).collect()
}

/// The lengths of vectors that follow on each other.
fn lengths<const D: usize>(numbers: &[f64]) -> Vec<f64> {
    numbers.as_chunks::<D>().0.iter().map(norm).collect()
}

/// The mean bounding radius, m.
fn size(run: &Recording) -> f64 {
    let header = run.trajectory.header();
    let free = header.radius.iter().zip(&header.free).filter(|&(r, &free)| free && r.is_finite()).map(|(r, _)| *r);
    let count = free.clone().count();
    if count == 0 { 1.0 } else { free.sum::<f64>() / count as f64 }
}

/// The colour of each body.
fn colours<const D: usize>(run: &Recording, frame: &TrajectoryFrame, look: &Look) -> Vec<[u8; 3]> {
    let header = run.trajectory.header();
    let speed = lengths::<D>(&frame.velocity);
    let moving = (0..speed.len()).filter(|&i| frame.is_free(i) && speed[i].is_finite());
    let most = moving.map(|i| speed[i]).fold(0.0, f64::max);
    let of = |i: usize| match look.colour {
        _ if !frame.is_free(i) => [200, 203, 208],
        Colour::Speed => colour::sequential(if most > 0.0 { speed[i] / most } else { 0.0 }),
        Colour::Material if look.chains => [222, 226, 232],
        Colour::Material => colour::mix(colour::category(usize::from(header.material[i])), [255; 3], 0.25),
    };
    (0..header.radius.len()).map(of).collect()
}

fn space(run: &Recording, world: &World<Solid, 3, 6>, frame: &TrajectoryFrame, look: &Look) -> Picture {
    let (mut bodies, mut meshes) = (Vec::new(), Vec::new());
    let ((places, _), (turns, _)) = (frame.position.as_chunks::<3>(), frame.rotation.as_chunks::<4>());
    for (i, (shape, colour)) in world.bodies.shape.iter().zip(colours::<3>(run, frame, look)).enumerate() {
        let form = match Drawn::of::<Solid, 6>(shape) {
            Drawn::Ball(radius) => Form::Ball { radius },
            Drawn::Plane(normal) => Form::Plane { normal },
            Drawn::Polygons(polygons) => {
                let faces = polygons.iter().filter(|polygon| polygon.len() > 2).map(<[usize]>::to_vec).collect();
                meshes.push(Mesh { polygons: faces, vertices: polygons.vertices });
                Form::Mesh(meshes.len() - 1)
            }
        };
        let opacity = if look.chains && run.trajectory.header().free[i] { 0.25 } else { 1.0 };
        let colour = if matches!(form, Form::Plane { .. }) { Body::new(form).colour } else { colour };
        bodies.push(Body { shape: form, position: places[i], rotation: turns[i], colour, opacity });
    }
    let widest = 0.4 * size(run);
    let segment = |rod: Rod<3>| Segment { from: rod.ends[0], to: rod.ends[1], radius: widest * rod.width, colour: rod.colour };
    let chains = if look.chains { rods(run, frame).into_iter().map(segment).collect() } else { Vec::new() };
    Picture { bodies, meshes, chains, size: look.size, camera: look.camera, up: up(&run.scene.gravity), ..Picture::default() }
}

/// Against gravity.
fn up(gravity: &[f64]) -> [f64; 3] {
    match gravity {
        &[x, y, z] if [x, y, z] != [0.0; 3] => [-x, -y, -z],
        _ => [0.0, 0.0, 1.0],
    }
}

fn plane(run: &Recording, world: &World<Plane, 2, 3>, frame: &TrajectoryFrame, look: &Look) -> Drawing {
    let ((places, _), (turns, _)) = (frame.position.as_chunks::<2>(), frame.rotation.as_chunks::<2>());
    let figure = |(i, (shape, colour)): (usize, (&<Plane as Space<2, 3>>::Shape, [u8; 3]))| {
        let outline = match Drawn::of::<Plane, 3>(shape) {
            Drawn::Ball(radius) => Outline::Disk { radius },
            Drawn::Plane(normal) => Outline::HalfPlane { normal },
            Drawn::Polygons(polygons) => {
                let corners = |polygon: &[usize]| polygon.iter().map(|&k| polygons.vertices[k]).collect();
                Outline::Polygons(polygons.iter().map(corners).collect())
            }
        };
        let base = Figure::new(outline);
        let colour = if matches!(base.outline, Outline::HalfPlane { .. }) { base.colour } else { colour };
        Figure { position: places[i], angle: turns[i][1].atan2(turns[i][0]), colour, ..base }
    };
    let figures = world.bodies.shape.iter().zip(colours::<2>(run, frame, look)).enumerate().map(figure).collect();
    let widest = 0.8 * size(run);
    let link = |rod: Rod<2>| Link { from: rod.ends[0], to: rod.ends[1], width: widest * rod.width, colour: rod.colour };
    let links = if look.chains { rods(run, frame).into_iter().map(link).collect() } else { Vec::new() };
    let window = look.window;
    Drawing { title: run.title(), figures, links, window, spokes: !look.chains, background: Some([255; 3]), ..Drawing::default() }
}
