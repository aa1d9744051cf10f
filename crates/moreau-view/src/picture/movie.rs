//! Movies: images one after the other.
//!
//! A name that ends in `.gif` makes a GIF, which needs nothing else and plays everywhere; `.mp4` makes a smaller and finer movie with
//! the program ffmpeg, which must be on the PATH.

mod gif;
mod mp4;
mod palette;

use super::image::check_size;
use super::{Error, Image};
use std::path::{Path, PathBuf};

/// A movie that is being made. It appears under its name when it is [finished](Movie::finish), and not at all if it is dropped before.
#[derive(Debug)]
pub struct Movie {
    path: PathBuf,
    size: [usize; 2],
    images: usize,
    format: Format,
}

#[derive(Debug)]
enum Format {
    Gif(Box<gif::Gif>),
    Mp4(mp4::Mp4),
}

impl Movie {
    /// Begins a movie of `rate` images a second.
    ///
    /// # Errors
    /// [`Error::Format`] for another name than `.gif` or `.mp4`, [`Error::Size`] or [`Error::Rate`] for what cannot be made,
    /// [`Error::Write`] when the folder cannot be written, [`Error::NoFfmpeg`].
    pub fn open(path: impl AsRef<Path>, size: [usize; 2], rate: f64) -> Result<Self, Error> {
        let path = path.as_ref().to_owned();
        check_size(size)?;
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let most = match ending.as_deref() {
            Some("gif") => gif::MAX_RATE,
            Some("mp4") => mp4::MAX_RATE,
            _ => return Err(Error::Format { path, known: ".gif or .mp4" }),
        };
        if !(1.0..=most).contains(&rate) {
            return Err(Error::Rate(rate, most));
        }
        let format = match ending.as_deref() {
            Some("gif") => Format::Gif(Box::new(gif::Gif::open(&path, size, rate)?)),
            _ => Format::Mp4(mp4::Mp4::open(mp4::PROGRAM, &path, size, rate)?),
        };
        Ok(Self { path, size, images: 0, format })
    }

    /// Adds an image. What is transparent becomes white.
    ///
    /// # Errors
    /// [`Error::Frame`] for an image of another size, [`Error::Write`] or [`Error::Ffmpeg`] when it cannot be written.
    pub fn add(&mut self, image: &Image) -> Result<(), Error> {
        if image.size != self.size {
            return Err(Error::Frame { image: image.size, movie: self.size });
        }
        let colours: Vec<[u8; 3]> = image.pixels.iter().map(|&p| on_white(p)).collect();
        self.images += 1;
        match &mut self.format {
            Format::Gif(gif) => gif.add(&colours),
            Format::Mp4(mp4) => mp4.add(&colours),
        }
    }

    /// Completes the file and gives it its name.
    ///
    /// # Errors
    /// [`Error::Empty`] without any image, [`Error::Write`] or [`Error::Ffmpeg`] when it cannot be written.
    pub fn finish(self) -> Result<(), Error> {
        if self.images == 0 {
            return Err(Error::Empty(self.path));
        }
        match self.format {
            Format::Gif(gif) => gif.finish(),
            Format::Mp4(mp4) => mp4.finish(),
        }
    }
}

fn on_white([r, g, b, a]: [u8; 4]) -> [u8; 3] {
    let a = u32::from(a);
    [r, g, b].map(|x| ((u32::from(x) * a + 255 * (255 - a) + 127) / 255) as u8)
}
