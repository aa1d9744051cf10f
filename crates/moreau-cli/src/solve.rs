//! `moreau solve`: problem files.

mod show;

use crate::failure::{Failure, say};
use crate::outputs::Replace;
use crate::problem::{self, Format, Solved};
use crate::{names, progress};
use moreau::solve::files::{self, Iterate, ProblemFile};
use moreau::solve::{Criterion, GlobalMethod, LocalMethod, Settings, Status};
use show::Row;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Arguments of `moreau solve`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The problem files: FCLIB's .hdf5 or Siconos's .dat; what is in a file tells which
    #[arg(required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    how: How,
    /// Global solver
    #[arg(long, value_parser = names::global, default_value = names::default_global())]
    global: GlobalMethod,
    /// Local solver
    #[arg(long, value_parser = names::local, default_value = "pdas")]
    local: LocalMethod,
    /// The impulses to start from
    #[arg(long, value_enum, default_value = "zero")]
    start: Start,
    /// Print an object of JSON for each file in place of the table
    #[arg(long)]
    json: bool,
    /// Print the certificate of each answer; of a single file it is printed anyway
    #[arg(long, conflicts_with = "json")]
    certificate: bool,
    /// Write the problem with the solution to an .hdf5 file (of a single problem)
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    replace: Replace,
}

/// How long and how far: what `solve` and `profile` share.
#[derive(Clone, Copy, clap::Args)]
pub(crate) struct How {
    /// What has to be reached
    #[arg(long, default_value_t = 1e-8, value_parser = names::positive)]
    pub(crate) tolerance: f64,
    /// Of which measure: see `moreau list criteria`
    #[arg(long, value_parser = names::criterion, default_value = "strict")]
    pub(crate) criterion: Criterion,
    /// After how many sweeps a solve is given up
    #[arg(long, default_value_t = 100_000, value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) max_sweeps: u64,
    /// After how many seconds a solve is given up [default: never]
    #[arg(long, value_parser = names::positive)]
    pub(crate) seconds: Option<f64>,
    /// Solves of each problem by each method, of which the median of the seconds counts
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) repeat: u16,
}

impl How {
    /// The settings of a solve by these methods.
    pub(crate) fn settings(self, global: GlobalMethod, local: LocalMethod) -> Settings {
        let Self { tolerance, criterion, max_sweeps, seconds, .. } = self;
        Settings { global, local, criterion, tolerance, max_sweeps, max_seconds: seconds, ..Settings::default() }
    }
}

/// Where a solve begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Start {
    /// Zero impulses
    Zero,
    /// The first guess of the file, if it has one
    Guess,
}

/// Solves file by file; one that is wrong does not stop the others.
pub(crate) fn solve(args: &Args) -> Result<(), Failure> {
    if let Some(path) = &args.out {
        check_out(path, args.files.len(), args.replace)?;
    }
    let stop = progress::stop_on_ctrl_c()?;
    let bar = progress::bar_of("problems", args.files.len() as u64, args.files.len() < 2);
    let (mut rows, mut failures) = (Vec::new(), Vec::new());
    let (mut interrupted, mut passed_over) = (false, 0);
    for path in &args.files {
        if stop.load(Ordering::Relaxed) {
            interrupted = true;
            break;
        }
        bar.set_message(path.display().to_string());
        match one(args, path, stop) {
            Ok(row) if args.json => {
                bar.suspend(|| say(&format!("{}\n", row.json())))?;
                rows.push(row);
            }
            Ok(row) => rows.push(row),
            Err(failure) if args.files.len() > 1 && other_kind(path) => {
                bar.suspend(|| failure.note("passed over"));
                passed_over += 1;
            }
            Err(failure) => {
                if args.files.len() > 1 {
                    let _ = bar.suspend(|| failure.report());
                }
                failures.push(failure);
            }
        }
        bar.inc(1);
    }
    interrupted |= rows.last().is_some_and(|row| row.report.status == Status::Interrupted);
    bar.finish_and_clear();
    if !args.json && !rows.is_empty() {
        say(&show::report(&rows, args.certificate || args.files.len() == 1))?;
    }
    if interrupted {
        return Err(Failure::interrupted("what is above was done"));
    }
    if passed_over == args.files.len() {
        return Err(Failure::scene("none of the files is a problem file".to_owned()));
    }
    verdict(args.files.len() - passed_over, &rows, failures)
}

/// Whether a file that holds no problem does not claim to: `moreau solve folder/*` also names what explains the folder.
fn other_kind(path: &Path) -> bool {
    path.is_file() && problem::format(path).is_none()
}

/// Finds out before the solve whether the answer can be written.
fn check_out(path: &Path, files: usize, replace: Replace) -> Result<(), Failure> {
    let name = path.display();
    if files > 1 {
        return Err(Failure::usage(format!("--out {name} has place for one problem, and {files} are to be solved")));
    }
    match problem::format(path) {
        Some(Format::Fclib) => replace.allows(path),
        Some(Format::Text) => {
            let other = path.with_extension("hdf5");
            let what = "the text format has no place for a solution";
            Err(Failure::usage(format!("--out {name}: {what}; FCLIB's has: --out {}", other.display())))
        }
        None => Err(Failure::usage(format!("--out {name}: the ending names no format with a place for a solution; .hdf5 does"))),
    }
}

/// Reads, solves and, if asked, writes one problem.
fn one(args: &Args, path: &Path, stop: &AtomicBool) -> Result<Row, Failure> {
    let mut file = problem::read(path)?;
    let reduced = problem::reduce(path, &file)?;
    let mut notes = std::mem::take(&mut file.notes);
    let guess = file.guesses.first().filter(|_| args.start == Start::Guess);
    if guess.is_none() && args.start == Start::Guess {
        notes.push("there is no guess in the file; the solve began from zero".to_owned());
    }
    let settings = args.how.settings(args.global, args.local);
    let Solved { report, seconds, answer } =
        problem::run(&reduced, &settings, (guess.map(|guess| guess.r.as_slice()), args.how.repeat), stop);
    let row = Row {
        file: path.display().to_string(),
        dimension: file.dimension,
        contacts: file.contacts(),
        settings,
        report,
        seconds,
        notes,
    };
    if let Some(out) = &args.out {
        write(out, &mut file, answer)?;
    }
    Ok(row)
}

/// Writes the problem with its solution, to which the global velocities are added if there are any.
fn write(out: &Path, file: &mut ProblemFile, answer: Iterate) -> Result<(), Failure> {
    let v = file.velocities(&answer.r).map_err(|error| Failure::scene(format!("{}: {error}", out.display())))?;
    file.solution = Some(Iterate { v, ..answer });
    files::write(out, file).map(drop).map_err(Failure::file)
}

/// The end of it all: a wrong file outweighs a solve that did not converge.
fn verdict(files: usize, rows: &[Row], mut failures: Vec<Failure>) -> Result<(), Failure> {
    let unconverged: Vec<&Row> = rows.iter().filter(|row| row.report.status != Status::Converged).collect();
    match (failures.len(), unconverged.as_slice()) {
        (0, []) => Ok(()),
        (0, [row]) => Err(Failure::computation(row.complaint())),
        (0, many) => Err(Failure::computation(format!("{} of {files} problems did not converge: {}", many.len(), listed(many)))),
        (1, _) if files == 1 => Err(failures.remove(0)),
        (count, many) => {
            let also = match many.len() {
                0 => String::new(),
                more => format!("; {more} did not converge: {}", listed(many)),
            };
            Err(failures.swap_remove(0).again(format!("{count} of {files} files could not be solved, as said above{also}")))
        }
    }
}

/// The first few names.
fn listed(rows: &[&Row]) -> String {
    let names: Vec<&str> = rows.iter().take(5).map(|row| row.file.as_str()).collect();
    let more = if rows.len() > names.len() { ", …" } else { "" };
    format!("{}{more}", names.join(", "))
}
