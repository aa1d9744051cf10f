use super::{Error, file};
use std::io::{self, Write};
use std::path::Path;

/// Pixels, rows from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Width and height.
    pub size: [usize; 2],
    /// Red, green, blue and opacity of each pixel, the colours in sRGB and not multiplied by the opacity.
    pub pixels: Vec<[u8; 4]>,
}

impl Image {
    /// The bytes of a PNG file.
    #[must_use]
    pub fn png(&self) -> Vec<u8> {
        let mut out = Vec::new();
        // Writing to memory fails only for sizes that no `draw` makes.
        if self.encode(&mut out).is_err() {
            out.clear();
        }
        out
    }

    /// Writes a PNG file.
    ///
    /// # Errors
    /// [`Error::Write`] when the file cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        file::write(path.as_ref(), |out| self.encode(out))
    }

    fn encode(&self, out: &mut impl Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(out, self.size[0] as u32, self.size[1] as u32);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        Ok(writer.finish()?)
    }
}

/// An error unless each side has from 1 to 16384 pixels.
pub(super) fn check_size(size: [usize; 2]) -> Result<(), Error> {
    if size.iter().all(|side| (1..=16384).contains(side)) { Ok(()) } else { Err(Error::Size(size)) }
}
