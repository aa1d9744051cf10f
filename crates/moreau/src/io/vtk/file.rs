//! Files that appear whole, and text that is safe inside an XML attribute.

use std::borrow::Cow;
use std::io::{self, Write};
use std::path::Path;

use super::VtkError;

/// Puts `parts` one after the other into a new file beside `path`, then renames it to `path`.
///
/// The rename is what makes it atomic for a reader and for a killed run. The disk is not asked to sync: these files are
/// results to look at, not checkpoints, and a sync a frame would cost more than the frame.
pub(super) fn replace(path: &Path, parts: &[&[u8]]) -> Result<(), VtkError> {
    try_replace(path, parts).map_err(|source| VtkError::io(path, source))
}

fn try_replace(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    // A bare file name has the empty path as its parent, which no system call understands.
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".vtk-").suffix(".part");
    // Temporary files are private by default; a result is as readable as any other file under the user's umask.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    for part in parts {
        file.write_all(part)?;
    }
    file.persist(path).map_err(|refused| refused.error)?;
    Ok(())
}

/// `text` with the five characters replaced that mean something in XML.
pub(super) fn escape(text: &str) -> Cow<'_, str> {
    if !text.contains(['&', '<', '>', '"', '\'']) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 8);
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&apos;",
            c => out.push(c),
        }
    }
    Cow::Owned(out)
}
