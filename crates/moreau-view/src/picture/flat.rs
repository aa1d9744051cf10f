//! Pictures of the plane: lines and areas, for print as SVG or PDF, for the screen as an [`Image`].
//!
//! A [`Drawing`] becomes marks on a page once, and each format writes the same marks.

mod mark;
mod pdf;
mod raster;
mod svg;

use super::{Error, Image, file};
use std::io::Write;
use std::path::Path;

/// What a figure looks like, about its own origin.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// A disk.
    Disk {
        /// Its radius.
        radius: f64,
    },
    /// Polygons by their corners, in any direction.
    Polygons(Vec<Vec<[f64; 2]>>),
    /// All on the side of a line away from its normal: a line with hatches.
    HalfPlane {
        /// Points out of the half-plane; any length but zero.
        normal: [f64; 2],
    },
}

/// A body of the plane. One whose position or angle is not finite is left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// What it looks like.
    pub outline: Outline,
    /// Where the origin of the outline is.
    pub position: [f64; 2],
    /// How far it is turned counter-clockwise, in radians.
    pub angle: f64,
    /// Colour of its area in sRGB; of its line, for a half-plane.
    pub colour: [u8; 3],
    /// Opacity of its area.
    pub opacity: f64,
}

impl Figure {
    /// A light grey figure at the origin; a half-plane is dark.
    #[must_use]
    pub fn new(outline: Outline) -> Self {
        let colour = if matches!(outline, Outline::HalfPlane { .. }) { [70, 74, 80] } else { [222, 226, 232] };
        Self { outline, position: [0.0; 2], angle: 0.0, colour, opacity: 1.0 }
    }
}

/// A piece of a force chain, drawn over all figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// One end.
    pub from: [f64; 2],
    /// The other end.
    pub to: [f64; 2],
    /// How broad it is, a length of the plane.
    pub width: f64,
    /// Colour in sRGB.
    pub colour: [u8; 3],
}

/// A part of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Its lower left corner.
    pub min: [f64; 2],
    /// Its upper right corner.
    pub max: [f64; 2],
}

/// A picture of the plane; x goes to the right and y up.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// What it shows, for those who hear it and as the title in a browser.
    pub title: String,
    /// The bodies.
    pub figures: Vec<Figure>,
    /// Force chains.
    pub links: Vec<Link>,
    /// Whether each disk has a line from its centre that turns with it.
    pub spokes: bool,
    /// What is shown; by default all bounded figures.
    pub window: Option<Window>,
    /// Width of the page in points, of which an inch has 72; the height follows from the window.
    pub width: f64,
    /// Colour of the page; none is transparent.
    pub background: Option<[u8; 3]>,
}

impl Default for Drawing {
    /// An empty drawing as wide as a page's text, 360 points, without a background.
    fn default() -> Self {
        Self {
            title: String::new(),
            figures: Vec::new(),
            links: Vec::new(),
            spokes: false,
            window: None,
            width: 360.0,
            background: None,
        }
    }
}

impl Drawing {
    /// The text of an SVG file.
    ///
    /// # Errors
    /// [`Error::Camera`] when the window or the page has no area or is not finite.
    pub fn svg(&self) -> Result<String, Error> {
        Ok(svg::write(&mark::Page::new(self)?, &self.title))
    }

    /// The bytes of a PDF file of one page.
    ///
    /// # Errors
    /// As [`Drawing::svg`].
    pub fn pdf(&self) -> Result<Vec<u8>, Error> {
        Ok(pdf::write(&mark::Page::new(self)?, &self.title))
    }

    /// Pixels, as many across as asked for.
    ///
    /// # Errors
    /// As [`Drawing::svg`], and [`Error::Size`] when a side would be zero or too long.
    pub fn image(&self, across: usize) -> Result<Image, Error> {
        raster::draw(&mark::Page::new(self)?, across)
    }

    /// Writes a file whose name ends in `.svg`, `.pdf` or `.png`, the last with three pixels a point.
    ///
    /// # Errors
    /// As the formats, [`Error::Format`] for another name, [`Error::Write`] when the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let content = match ending.as_deref() {
            Some("svg") => self.svg()?.into_bytes(),
            Some("pdf") => self.pdf()?,
            Some("png") => return self.image((3.0 * self.width).round() as usize)?.save(path),
            _ => return Err(Error::Format { path: path.to_owned(), known: ".svg, .pdf or .png" }),
        };
        file::write(path, |out| out.write_all(&content))
    }
}
