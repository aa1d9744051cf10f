//! `moreau convert`: problem files from one format into the other.

use crate::failure::{Failure, say};
use crate::outputs::Replace;
use crate::problem::{self, Format};
use moreau::solve::files::{self, Equations, ProblemFile};
use std::path::PathBuf;

/// Arguments of `moreau convert`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The problem file to read
    from: PathBuf,
    /// The file to write: .hdf5 or .h5 for FCLIB's format, .dat or .txt for the text of Siconos
    to: PathBuf,
    #[command(flatten)]
    replace: Replace,
}

/// Writes the problem of one file into another and reads it back.
pub(crate) fn convert(args: &Args) -> Result<(), Failure> {
    let to = args.to.display();
    let Some(format) = problem::format(&args.to) else {
        return Err(Failure::usage(format!(
            "{to}: the ending names no format; .hdf5 and .h5 are FCLIB's, .dat and .txt are text"
        )));
    };
    let same = |a: &PathBuf, b: &PathBuf| matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if same(&args.from, &args.to) {
        return Err(Failure::usage(format!("{to}: this is the file to read, which would be overwritten; give another name")));
    }
    let problem = problem::read(&args.from)?;
    args.replace.allows(&args.to)?;
    let lost = files::write(&args.to, &problem).map_err(Failure::file)?;
    let back = problem::read(&args.to)?;
    back.same_as(&problem).map_err(|what| Failure::file(format!("{to}: does not read back as it was written: {what}")))?;
    say(&format!(
        "{}: {}; {to}: {}, read back the same{}\n",
        args.from.display(),
        describe(&problem),
        name(format),
        remarks(&problem, &lost)
    ))
}

fn describe(problem: &ProblemFile) -> String {
    let form = if matches!(problem.equations, Equations::Global { .. }) { "global" } else { "local" };
    let rolling = if problem.mu_r.is_some() { " with rolling friction" } else { "" };
    format!("a {form} problem, contacts: {}, components of each: {}{rolling}", problem.contacts(), problem.dimension)
}

fn name(format: Format) -> &'static str {
    match format {
        Format::Fclib => "the same in FCLIB's format",
        Format::Text => "the same as text",
    }
}

/// What the reader noticed and the new format lacks.
fn remarks(problem: &ProblemFile, lost: &[String]) -> String {
    problem.notes.iter().chain(lost).map(|remark| format!("; {remark}")).collect()
}
