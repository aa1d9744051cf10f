//! The files that commands write. None is replaced that somebody else may have made: a file that exists is refused unless `--force` is given.
//! Files with a name of the program's own (report.html, plot.svg, picture.png) in a folder that run.json marks as a run's are the exception.

use crate::failure::{Failure, writable};
use crate::marker::Marker;
use std::path::{Path, PathBuf};

/// The option that lets a command replace files.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct Replace {
    /// Replace a file that exists [default: refuse it and leave it as it is]
    #[arg(long)]
    force: bool,
}

impl Replace {
    /// Makes sure, before long work, that `path` can be written and that nothing is lost by it.
    ///
    /// # Errors
    /// Where it cannot be written, or is there and `--force` is not given.
    pub(crate) fn allows(self, path: &Path) -> Result<(), Failure> {
        writable(path)?;
        if self.force || path.symlink_metadata().is_err() {
            return Ok(());
        }
        let what = "it exists already and is left as it is; give another name, or --force to replace it";
        Err(Failure::file(format!("cannot write {}: {what}", path.display())))
    }

    /// Returns the file of a command that looks at the run in a folder: `out`, or `name` in that folder.
    ///
    /// # Errors
    /// As [`Self::allows`]; a file `name` in a marked folder is the program's own and may be replaced.
    pub(crate) fn in_run(self, folder: &Path, name: &str, out: Option<&Path>) -> Result<PathBuf, Failure> {
        let path = out.map_or_else(|| folder.join(name), Path::to_owned);
        let is_own = out.is_none() && Marker::read(folder).is_some_and(|marker| marker.lists(name));
        if is_own {
            writable(&path)?;
        } else {
            self.allows(&path)?;
        }
        Ok(path)
    }
}
