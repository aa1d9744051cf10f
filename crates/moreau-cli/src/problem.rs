//! Problem files: read, solved and measured, whatever their dimension.

use crate::Failure;
use moreau::solve::files::{self, AnyProblem, Iterate, ProblemFile, StoredProblem};
use moreau::solve::{Report, Scratch, Settings, solve_until};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Reads a problem file. That it cannot be read is one kind of failure, that it holds no problem another.
pub(crate) fn read(path: &Path) -> Result<ProblemFile, Failure> {
    let bytes = std::fs::read(path).map_err(|error| {
        let hint = "give the path of a problem file, FCLIB's .hdf5 or Siconos's .dat";
        Failure::file(format!("{}: cannot be read: {error}; {hint}", path.display()))
    })?;
    files::read_bytes(&bytes).map_err(|error| wrong(path, &error))
}

/// The problem to solve; a global one is reduced.
pub(crate) fn reduce(path: &Path, file: &ProblemFile) -> Result<AnyProblem, Failure> {
    file.any_problem().map_err(|error| wrong(path, &error))
}

fn wrong(path: &Path, error: &files::FileError) -> Failure {
    Failure::scene(format!("{}: {error}", path.display()))
}

/// What the ending of a file that is to be written stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// FCLIB's HDF5.
    Fclib,
    /// The text of Siconos.
    Text,
}

/// The format of the file `path`, by its ending; `None` where it stands for none.
pub(crate) fn format(path: &Path) -> Option<Format> {
    match path.extension().and_then(|ending| ending.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("hdf5" | "h5") => Some(Format::Fclib),
        Some("dat" | "txt") => Some(Format::Text),
        _ => None,
    }
}

/// How one problem was solved.
pub(crate) struct Solved {
    pub(crate) report: Report,
    /// Seconds of the solve alone; the median where it was repeated.
    pub(crate) seconds: f64,
    /// Impulses and velocities.
    pub(crate) answer: Iterate,
}

/// A first guess of the impulses, zero where there is none, and how often the solve is repeated.
type Guessed<'a> = (Option<&'a [f64]>, u16);

/// Solves `problem` from its guess, as often as is asked, until `stop` is set.
pub(crate) fn run(problem: &AnyProblem, settings: &Settings, guessed: Guessed<'_>, stop: &AtomicBool) -> Solved {
    match problem {
        AnyProblem::Plane(stored) => run_stored(stored, settings, guessed, stop),
        AnyProblem::Solid(stored) | AnyProblem::PlaneRolling(stored) => run_stored(stored, settings, guessed, stop),
        AnyProblem::SolidRolling(stored) => run_stored(stored, settings, guessed, stop),
    }
}

fn run_stored<const D: usize>(
    stored: &StoredProblem<D>,
    settings: &Settings,
    (start, repeat): Guessed<'_>,
    stop: &AtomicBool,
) -> Solved {
    let problem = stored.problem();
    let first: Vec<[f64; D]> = match start {
        Some(r) => r.as_chunks().0.to_vec(),
        None => vec![[0.0; D]; problem.len()],
    };
    let (mut r, mut scratch) = (first.clone(), Scratch::default());
    let mut report = Report::default();
    let mut seconds = Vec::new();
    for _ in 0..repeat.max(1) {
        r.clone_from(&first);
        let clock = Instant::now();
        report = solve_until(&problem, settings, stop, &mut r, &mut scratch);
        seconds.push(clock.elapsed().as_secs_f64());
    }
    seconds.sort_by(f64::total_cmp);
    let u: Vec<[f64; D]> = (0..problem.len()).map(|c| problem.velocity(scratch.state(), c)).collect();
    let answer = Iterate { r: r.as_flattened().to_vec(), u: u.as_flattened().to_vec(), v: None };
    Solved { report, seconds: seconds[seconds.len() / 2], answer }
}
