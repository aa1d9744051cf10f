//! `moreau new`: a scene to start from.

use crate::failure::{Failure, say, write_whole};
use moreau::scene::template;
use std::path::Path;

/// Arguments of `moreau new`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Name of the scene; NAME.toml is written here
    name: String,
}

/// Writes NAME.toml, never over a file that is there.
pub(crate) fn new(args: &Args) -> Result<(), Failure> {
    let stem = args.name.strip_suffix(".toml").unwrap_or(&args.name);
    if stem.is_empty() {
        return Err(Failure::usage("the scene needs a name"));
    }
    let file = format!("{stem}.toml");
    if Path::new(&file).exists() {
        return Err(Failure::file(format!("{file} exists already and is left as it is; choose another name")));
    }
    write_whole(Path::new(&file), template(stem))?;
    say(&format!("{file} written; run it with: moreau run {file}\n"))
}
