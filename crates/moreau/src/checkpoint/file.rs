//! One checkpoint, one file.

use super::digest::{Digest, LENGTH};
use super::{Checkpoint, CheckpointError};
use crate::io::whole;
use std::path::Path;

/// The first bytes.
const MAGIC: &[u8] = b"moreau checkpoint\n";

/// The version of the layout: of all that [`Checkpoint`] is made of. Whoever changes that counts on.
const VERSION: u32 = 2;

/// Writes a checkpoint; when this returns it is on the disk, and whatever happens before, it is not there at all.
///
/// # Errors
/// Where the system refuses.
pub fn write(path: &Path, checkpoint: &Checkpoint) -> Result<(), CheckpointError> {
    let content = postcard::to_stdvec(checkpoint).map_err(|error| CheckpointError::unreadable(path, error))?;
    let version = VERSION.to_le_bytes();
    let Digest(sum) = Digest::of(&[MAGIC, &version, &content]);
    whole::write_to_disk(path, &[MAGIC, &version, &content, &sum]).map_err(CheckpointError::io("write", path))
}

/// Reads a checkpoint.
///
/// # Errors
/// Where it cannot be read, is none, is of another version, or is damaged.
pub fn read(path: &Path) -> Result<Checkpoint, CheckpointError> {
    let bytes = std::fs::read(path).map_err(CheckpointError::io("read", path))?;
    parse(&bytes).map_err(|reason| CheckpointError::unreadable(path, reason))
}

/// The checkpoint that is in these bytes.
fn parse(bytes: &[u8]) -> Result<Checkpoint, String> {
    let rest = bytes.strip_prefix(MAGIC).ok_or("it is no checkpoint: it does not begin with `moreau checkpoint`")?;
    let cut = || "it is cut off: it is shorter than any checkpoint";
    let (version, rest) = rest.split_first_chunk().ok_or_else(cut)?;
    let version = u32::from_le_bytes(*version);
    if version != VERSION {
        let by = "run it on with the version of moreau that wrote it, or begin anew from scene.toml";
        return Err(format!("it is of version {version}; this program reads version {VERSION}; {by}"));
    }
    let (content, sum) = rest.split_last_chunk::<LENGTH>().ok_or_else(cut)?;
    if Digest::of(&[MAGIC, &version.to_le_bytes(), content]) != Digest(*sum) {
        return Err("it is damaged: its checksum is wrong".to_owned());
    }
    postcard::from_bytes(content).map_err(|error| format!("its content is none of a checkpoint: {error}"))
}
