//! One page with a run in it, that needs nothing beside it and no network.

use crate::page;
use crate::recording::{Recording, RecordingError, block};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::ops::Range;

/// About how many bytes of numbers, unpacked, a block of frames has: so much is decoded at a time.
const BLOCK: u64 = 2 << 20;

/// A page, and what is in it.
pub struct Report {
    /// The HTML.
    pub html: String,
    /// How many frames it has.
    pub frames: usize,
    /// Every how many-th frame of the trajectory that is.
    pub thinned: usize,
}

/// The page of a run: of its frames as many, evenly spaced, as fit into `limit` bytes, and the last.
///
/// # Errors
/// Where frames cannot be read.
pub fn report(run: &Recording, limit: usize) -> Result<Report, RecordingError> {
    let all = run.trajectory.frames();
    let mut thinned = 1;
    loop {
        let frames = every(all, thinned);
        let blocks = blocks(run, &frames);
        let packed = blocks.iter().map(|part| block(&run.trajectory, &frames[part.clone()])).collect::<Result<Vec<_>, _>>()?;
        let meta = page::script_safe(&run.meta(&frames, &blocks, thinned, false).to_string());
        let size = page::SIZE + meta.len() + packed.iter().map(|block| block.len().div_ceil(3) * 4 + 80).sum::<usize>();
        if size <= limit || frames.len() <= 2 {
            let blocks: Vec<String> = packed.iter().map(|block| STANDARD.encode(block)).collect();
            return Ok(Report { html: page::whole(&run.title(), &meta, &blocks), frames: frames.len(), thinned });
        }
        // As many times too large as it is, but for what is there without frames.
        thinned = (thinned + 1).max(thinned * size / limit.max(1));
    }
}

/// Every so-many-th frame, and the last.
fn every(all: usize, step: usize) -> Vec<usize> {
    let mut frames: Vec<usize> = (0..all).step_by(step).collect();
    if all > 0 && frames.last() != Some(&(all - 1)) {
        frames.push(all - 1);
    }
    frames
}

/// Frames in blocks of about one size.
pub(crate) fn blocks(run: &Recording, frames: &[usize]) -> Vec<Range<usize>> {
    let bodies = run.trajectory.header().radius.len() as u64;
    let (mut blocks, mut start, mut bytes) = (Vec::new(), 0, 0);
    for (k, &i) in frames.iter().enumerate() {
        bytes += 52 * bodies + 49 * run.trajectory.contacts(i);
        if bytes >= BLOCK {
            blocks.push(start..k + 1);
            (start, bytes) = (k + 1, 0);
        }
    }
    if start < frames.len() {
        blocks.push(start..frames.len());
    }
    blocks
}
