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

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Bytes of a full block before compression. A whole number of words of any kind fits, as VTK wants; larger blocks
/// hardly shrink the file, since zlib looks back no further than 32 KiB.
pub(super) const BLOCK: usize = 1 << 17;

/// The bytes of the section so far.
#[derive(Default)]
pub(super) struct Appended {
    bytes: Vec<u8>,
}

impl Appended {
    /// Compresses an array given word by word, and returns its offset.
    pub(super) fn push<const N: usize>(&mut self, words: impl Iterator<Item = [u8; N]>) -> io::Result<usize> {
        let mut blocks = Blocks::default();
        let mut plain = Vec::new();
        for word in words {
            plain.extend_from_slice(&word);
            if plain.len() == BLOCK {
                blocks.push(&plain)?;
                plain.clear();
            }
        }
        let last = plain.len();
        if last > 0 {
            blocks.push(&plain)?;
        }
        let offset = self.bytes.len();
        for n in [blocks.sizes.len(), BLOCK, last].into_iter().chain(blocks.sizes) {
            self.bytes.extend_from_slice(&(n as u64).to_le_bytes());
        }
        self.bytes.append(&mut blocks.packed);
        Ok(offset)
    }

    /// All of it.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

/// The compressed blocks of one array, kept apart until all sizes are known because the sizes come first in the file.
#[derive(Default)]
struct Blocks {
    packed: Vec<u8>,
    sizes: Vec<usize>,
}

impl Blocks {
    fn push(&mut self, plain: &[u8]) -> io::Result<()> {
        let start = self.packed.len();
        // The fastest level: doubles hardly compress, and more effort gains a few per cent at several times the cost.
        let mut encoder = ZlibEncoder::new(&mut self.packed, Compression::fast());
        encoder.write_all(plain)?;
        encoder.finish()?;
        self.sizes.push(self.packed.len() - start);
        Ok(())
    }
}
