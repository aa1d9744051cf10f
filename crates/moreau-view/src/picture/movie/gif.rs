//! GIF.
//!
//! All images share one palette, so that nothing flickers. It is known only at the end; until then the images wait in a file. Colours
//! are not dithered: shaded bodies need few of them, dots would be seen, and the file would grow by a third.

use super::palette::{Census, Palette};
use crate::picture::{Error, file};
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// Programs show an image for at least two hundredths of a second.
pub(super) const MAX_RATE: f64 = 50.0;
/// Colours of the palette. One more entry means that nothing changes.
const COLOURS: usize = 255;

#[derive(Debug)]
pub(super) struct Gif {
    path: PathBuf,
    size: [usize; 2],
    rate: f64,
    census: Census,
    /// The images so far, each compressed.
    waiting: BufWriter<File>,
    /// The length of each.
    lengths: Vec<u64>,
}

impl Gif {
    pub(super) fn open(path: &Path, size: [usize; 2], rate: f64) -> Result<Self, Error> {
        // Nameless, and beside the movie: where temporary files are there may be little room.
        let waiting = file::beside(path)?.into_file();
        Ok(Self {
            path: path.to_owned(),
            size,
            rate,
            census: Census::new(),
            waiting: BufWriter::new(waiting),
            lengths: Vec::new(),
        })
    }

    pub(super) fn add(&mut self, colours: &[[u8; 3]]) -> Result<(), Error> {
        self.census.count(colours);
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
        let written = encoder.write_all(colours.as_flattened()).and_then(|()| encoder.finish());
        let written = written.and_then(|bytes| self.waiting.write_all(&bytes).map(|()| bytes.len() as u64));
        self.lengths.push(written.map_err(|e| file::failed(&self.path, e))?);
        Ok(())
    }

    pub(super) fn finish(self) -> Result<(), Error> {
        let Self { path, size, rate, census, waiting, lengths } = self;
        let palette = census.palette(COLOURS);
        let mut waiting = waiting.into_inner().map_err(|e| file::failed(&path, e.into_error()))?;
        file::write(&path, |out| {
            waiting.rewind()?;
            encode(out, BufReader::new(&mut waiting), size, rate, &lengths, palette)
        })
    }
}

fn encode(
    out: impl Write,
    mut waiting: impl Read,
    size: [usize; 2],
    rate: f64,
    lengths: &[u64],
    mut palette: Palette,
) -> io::Result<()> {
    let unchanged = palette.colours.len() as u8;
    let entries = [palette.colours.as_flattened(), &[0; 3]].concat();
    let mut encoder = Encoder::new(out, size[0] as u16, size[1] as u16, &entries).map_err(io::Error::other)?;
    encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
    let mut shown: Option<Vec<u8>> = None;
    for (i, &length) in lengths.iter().enumerate() {
        let mut colours = vec![[0; 3]; size[0] * size[1]];
        let mut part = ZlibDecoder::new(waiting.by_ref().take(length));
        part.read_exact(colours.as_flattened_mut())?;
        // What the decoder's buffer has not asked for yet.
        io::copy(part.get_mut(), &mut io::sink())?;
        let indices: Vec<u8> = colours.iter().map(|&c| palette.nearest(c)).collect();
        let mut frame = changed(&indices, shown.as_deref(), size, unchanged);
        // Hundredths of a second, rounded so that the movie as a whole takes its time.
        let end = |images: usize| (images as f64 * 100.0 / rate).round();
        frame.delay = (end(i + 1) - end(i)) as u16;
        encoder.write_frame(&frame).map_err(io::Error::other)?;
        shown = Some(indices);
    }
    encoder.into_inner().map_err(io::Error::other)?.flush()
}

/// The part of an image that differs from the one before; what is equal within it is said to be so.
fn changed(indices: &[u8], shown: Option<&[u8]>, [width, height]: [usize; 2], unchanged: u8) -> Frame<'static> {
    let differs = |x: usize, y: usize| shown.is_none_or(|s| s[y * width + x] != indices[y * width + x]);
    let rows = ends((0..height).filter(|&y| (0..width).any(|x| differs(x, y))));
    let columns = ends((0..width).filter(|&x| (rows.0..=rows.1).any(|y| differs(x, y))));
    let mut buffer = Vec::new();
    for y in rows.0..=rows.1 {
        let pixel = |x: usize| if differs(x, y) { indices[y * width + x] } else { unchanged };
        buffer.extend((columns.0..=columns.1).map(pixel));
    }
    Frame {
        dispose: DisposalMethod::Keep,
        transparent: Some(unchanged),
        left: columns.0 as u16,
        top: rows.0 as u16,
        width: (columns.1 - columns.0 + 1) as u16,
        height: (rows.1 - rows.0 + 1) as u16,
        buffer: buffer.into(),
        ..Frame::default()
    }
}

/// The first and last of some numbers; zero for none, since a frame has at least one pixel.
fn ends(numbers: impl Iterator<Item = usize>) -> (usize, usize) {
    numbers.fold(None, |ends, n| Some((ends.map_or(n, |(first, _)| first), n))).unwrap_or((0, 0))
}
