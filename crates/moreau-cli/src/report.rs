//! `moreau report`.

use crate::failure::{Failure, say, write_whole};
use crate::outputs::Replace;
use moreau_view::recording::Recording;
use moreau_view::report::report;
use std::path::PathBuf;

/// Arguments of `moreau report`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder that moreau run wrote
    run: PathBuf,
    /// The page [default: report.html in that folder]
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
    /// The page is no larger than about so many megabytes; frames are left out for it, evenly
    #[arg(long, value_name = "MB", default_value_t = 9.5)]
    max_size: f64,
}

/// Writes the page.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let recording = Recording::open(&args.run).map_err(Failure::file)?;
    let out = args.replace.in_run(&args.run, "report.html", args.out.as_deref())?;
    let report = report(&recording, (1e6 * args.max_size).max(0.0) as usize).map_err(Failure::file)?;
    write_whole(&out, &report.html)?;
    let thinned = if report.thinned > 1 {
        format!(", one in {} of the trajectory's {}", report.thinned, recording.trajectory.frames())
    } else {
        String::new()
    };
    say(&format!("{} ({:.1} MB): {} frames{thinned}\n", out.display(), 1e-6 * report.html.len() as f64, report.frames))
}
