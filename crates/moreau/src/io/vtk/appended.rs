//! The appended section: arrays as zlib blocks, in the format of VTK's `vtkZLibDataCompressor`.
//!
//! Each array starts at its offset (counted from the byte after the underscore) with `UInt64` words, little-endian:
//!
//! ```text
//! number of blocks · bytes of a full block · bytes of the last block, 0 if it is full · compressed bytes of each block
//! ```
//!
//! and the compressed blocks follow, one after the other. The sizes of blocks are those before compression. An array
//! without numbers has no blocks.
//!
//! Compression is nearly all that a file costs, so two things are not done: an array that is what it was in the file before
//! (radii, masses, spins of a run without friction) is not compressed again, and numbers that do not shrink (positions: their
//! last digits are noise) are put into blocks as they are, which zlib's format allows.

use std::io;
use std::mem::swap;

use flate2::{Compress, Compression, FlushCompress, Status};

use super::noise::is_noise;

/// Bytes of a full block before compression. A whole number of words of any kind fits, as VTK wants; larger blocks
/// hardly shrink the file, since zlib looks back no further than 32 KiB.
pub(super) const BLOCK: usize = 1 << 17;

/// The bytes of the section so far, and what the file before had in the same places.
#[derive(Debug, Default)]
pub(super) struct Appended {
    bytes: Vec<u8>,
    places: Vec<Packed>,
    /// The number of arrays so far.
    filled: usize,
    /// The array at hand, until it is known to be new.
    next: Packed,
    blocks: Blocks,
}

/// An array as it is and as it stands in the file.
#[derive(Debug, Default)]
struct Packed {
    plain: Vec<u8>,
    packed: Vec<u8>,
}

impl Appended {
    /// Begins the section of another file.
    pub(super) fn clear(&mut self) {
        self.bytes.clear();
        self.filled = 0;
    }

    /// Compresses an array given word by word, and returns its offset.
    pub(super) fn push<const N: usize>(&mut self, words: impl Iterator<Item = [u8; N]>) -> io::Result<usize> {
        if self.filled == self.places.len() {
            self.places.push(Packed::default());
        }
        let (before, next) = (&mut self.places[self.filled], &mut self.next);
        next.plain.clear();
        words.for_each(|word| next.plain.extend_from_slice(&word));
        if before.packed.is_empty() || before.plain != next.plain {
            self.blocks.array(&next.plain, &mut next.packed)?;
            swap(before, next);
        }
        self.filled += 1;
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(&self.places[self.filled - 1].packed);
        Ok(offset)
    }

    /// All of it.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

/// Makes compressed blocks.
#[derive(Debug)]
struct Blocks {
    shrink: Compress,
    keep: Compress,
}

impl Default for Blocks {
    fn default() -> Self {
        // Doubles hardly compress: a higher level gains a per cent at twice the cost, and the level below loses fifteen.
        Self { shrink: Compress::new(Compression::new(2), true), keep: Compress::new(Compression::none(), true) }
    }
}

impl Blocks {
    /// Puts the sizes and the blocks of an array in place of what is in `packed`.
    fn array(&mut self, plain: &[u8], packed: &mut Vec<u8>) -> io::Result<()> {
        packed.clear();
        for n in [plain.len().div_ceil(BLOCK), BLOCK, plain.len() % BLOCK] {
            packed.extend_from_slice(&(n as u64).to_le_bytes());
        }
        let mut size = packed.len();
        packed.resize(size + 8 * plain.len().div_ceil(BLOCK), 0);
        for block in plain.chunks(BLOCK) {
            let start = packed.len();
            let encoder = if is_noise(block) { &mut self.keep } else { &mut self.shrink };
            deflate(encoder, block, packed)?;
            let bytes = (packed.len() - start) as u64;
            packed[size..size + 8].copy_from_slice(&bytes.to_le_bytes());
            size += 8;
        }
        Ok(())
    }
}

/// Adds `plain` to `packed` as one whole zlib stream.
fn deflate(encoder: &mut Compress, plain: &[u8], packed: &mut Vec<u8>) -> io::Result<()> {
    encoder.reset();
    loop {
        let rest = &plain[encoder.total_in() as usize..];
        // What cannot be compressed grows by a few bytes in some thousand.
        packed.reserve(rest.len() + rest.len() / 512 + 64);
        if encoder.compress_vec(rest, packed, FlushCompress::Finish)? == Status::StreamEnd {
            return Ok(());
        }
    }
}
