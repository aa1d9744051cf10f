//! Bodies in space, and how they are drawn.
//!
//! A [`Picture`] becomes [`solid::Solid`]s as the [`view::View`] sees them, these a [`surface::Surface`] that knows depth, normal and
//! body of each sample, and [`develop`] gives the samples their colours. Samples are half a pixel apart.

mod develop;
mod fit;
mod floor;
mod light;
mod outline;
mod scene;
mod solid;
mod surface;
mod view;

use super::image::check_size;
use super::{Error, Image};

/// What a body looks like, about its own origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// A ball.
    Ball {
        /// Its radius.
        radius: f64,
    },
    /// One of the picture's meshes.
    Mesh(usize),
    /// All on the side of a plane away from its normal. It is drawn as a faint floor about the bounded bodies that fades at its rim,
    /// and not at all when seen from within.
    Plane {
        /// Points out of the half-space; any length but zero.
        normal: [f64; 3],
    },
}

/// A surface of polygons.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Corners.
    pub vertices: Vec<[f64; 3]>,
    /// Convex polygons by the indices of their vertices, counter-clockwise when seen from outside. They are drawn on that side only.
    /// Where neighbours meet at less than 28° and share vertices, the edge is smoothed.
    pub polygons: Vec<Vec<usize>>,
}

/// A body. One with a position, a rotation or a radius that is not finite is left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// What it looks like.
    pub shape: Shape,
    /// Where the origin of the shape is.
    pub position: [f64; 3],
    /// How the shape is turned, a unit quaternion `[x, y, z, w]`.
    pub rotation: [f64; 4],
    /// Colour in sRGB.
    pub colour: [u8; 3],
    /// 1 hides what is behind, 0 cannot be seen. Of all translucent bodies only the nearest surface is drawn.
    pub opacity: f64,
}

impl Body {
    /// A light grey body at the origin; a plane is nearly white.
    #[must_use]
    pub fn new(shape: Shape) -> Self {
        let colour = if matches!(shape, Shape::Plane { .. }) { [240, 241, 243] } else { [222, 224, 228] };
        Self { shape, position: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0], colour, opacity: 1.0 }
    }
}

/// A piece of a force chain: a rod with round ends. Translucent bodies do not hide it but let it fade with depth; opaque ones do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// One end.
    pub from: [f64; 3],
    /// The other end.
    pub to: [f64; 3],
    /// Radius of the rod.
    pub radius: f64,
    /// Colour in sRGB.
    pub colour: [u8; 3],
}

/// From where a picture is taken. Lines of sight are parallel, so equal lengths at any depth are equal in the picture.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Camera {
    /// The direction in which one looks; by default down on the scene from the front, a little from the right.
    pub direction: Option<[f64; 3]>,
    /// The point in the middle of the picture; by default the middle of what is seen of the bounded bodies.
    pub target: Option<[f64; 3]>,
    /// Length that the picture's width shows; by default wide enough for all bounded bodies.
    pub width: Option<f64>,
}

/// A picture of bodies in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The bodies.
    pub bodies: Vec<Body>,
    /// The meshes that they share.
    pub meshes: Vec<Mesh>,
    /// Force chains.
    pub chains: Vec<Segment>,
    /// The direction that is up in the picture.
    pub up: [f64; 3],
    /// From where it is taken.
    pub camera: Camera,
    /// Width and height in pixels. Drawing takes some hundred bytes of memory a pixel.
    pub size: [usize; 2],
    /// Colour and opacity where nothing is.
    pub background: [u8; 4],
}

impl Default for Picture {
    /// An empty white picture of 1280 × 960 pixels, up along z.
    fn default() -> Self {
        Self {
            bodies: Vec::new(),
            meshes: Vec::new(),
            chains: Vec::new(),
            up: [0.0, 0.0, 1.0],
            camera: Camera::default(),
            size: [1280, 960],
            background: [255; 4],
        }
    }
}

impl Picture {
    /// Draws it.
    ///
    /// # Errors
    /// When the size or the camera makes no picture, or a mesh or vertex is not there.
    pub fn draw(&self) -> Result<Image, Error> {
        let scene = scene::Scene::new(self)?;
        let view = self.view()?;
        Ok(develop::develop(self, &scene, &view))
    }

    /// The camera with all that was left open filled in from the bodies as they are: what keeps still through a movie.
    ///
    /// # Errors
    /// As [`Picture::draw`].
    pub fn fitted_camera(&self) -> Result<Camera, Error> {
        scene::check(self)?;
        fit::fit(self)
    }

    fn view(&self) -> Result<view::View, Error> {
        check_size(self.size)?;
        let camera = fit::fit(self)?;
        Ok(view::View::new(&camera, self.up, self.size))
    }
}
