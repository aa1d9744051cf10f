//! Pictures and movies, drawn by the processor alone.
//!
//! A [`Picture`] holds bodies in space and [draws](Picture::draw) an [`Image`]; a [`flat::Drawing`] holds figures in the plane and
//! writes SVG, PDF or an [`Image`]. A [`movie::Movie`] takes images. Everything is plain data, and the same data gives the same bytes
//! on any number of threads. A file appears under its name when it is whole.
//!
//! ```
//! use moreau_view::picture::{Body, Picture, Shape, colour};
//!
//! let ball = Body { position: [0.0, 0.0, 1.0], colour: colour::category(0), ..Body::new(Shape::Ball { radius: 1.0 }) };
//! let ground = Body::new(Shape::Plane { normal: [0.0, 0.0, 1.0] });
//! let picture = Picture { bodies: vec![ground, ball], size: [64, 48], ..Picture::default() };
//! let image = picture.draw()?;
//! assert_eq!(image.size, [64, 48]);
//! # Ok::<(), moreau_view::picture::Error>(())
//! ```

pub mod colour;
mod error;
mod file;
pub mod flat;
mod image;
pub mod movie;
mod space;

pub use error::Error;
pub use image::Image;
pub use space::{Body, Camera, Mesh, Picture, Segment, Shape};
