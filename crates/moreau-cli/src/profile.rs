//! `moreau profile`: many problems by many solvers, and performance profiles of them.

mod curves;

use crate::chart::{Form, profile as draw};
use crate::failure::{Failure, say, write_whole};
use crate::outputs::Replace;
use crate::solve::How;
use crate::table::aligned;
use crate::{names, problem, progress};
use curves::Measure;
use indicatif::ProgressBar;
use moreau::solve::{GlobalMethod, LocalMethod, Report, Status};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Arguments of `moreau profile`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder of the problem files: .hdf5, .h5, .dat and .txt
    folder: PathBuf,
    /// Global solvers
    #[arg(long, value_delimiter = ',', value_parser = names::global, default_value = names::default_global())]
    global: Vec<GlobalMethod>,
    /// Local solvers
    #[arg(long, value_delimiter = ',', value_parser = names::local, default_value = "pdas")]
    local: Vec<LocalMethod>,
    #[command(flatten)]
    how: How,
    /// The folder for results.csv and the profiles
    #[arg(long)]
    out: PathBuf,
    #[command(flatten)]
    replace: Replace,
    /// What the figures are written as
    #[arg(long, value_enum, default_value = "svg")]
    figures: Form,
    /// No progress bar
    #[arg(long)]
    quiet: bool,
}

/// What one pair of methods did with one problem.
struct Cell {
    seconds: f64,
    report: Report,
}

/// One problem with what each pair of methods did, in their order; fewer where the work was interrupted.
struct Row {
    file: String,
    dimension: usize,
    contacts: usize,
    cells: Vec<Cell>,
}

type Methods = (GlobalMethod, LocalMethod);

/// Solves all and writes tables and figures.
pub(crate) fn profile(args: &Args) -> Result<(), Failure> {
    let files = problem_files(&args.folder)?;
    prepare(args)?;
    let methods: Vec<Methods> = args.global.iter().flat_map(|&g| args.local.iter().map(move |&l| (g, l))).collect();
    let stop = progress::stop_on_ctrl_c()?;
    let bar = progress::bar_of("solves", (files.len() * methods.len()) as u64, args.quiet);
    let (mut rows, mut failures): (Vec<Row>, _) = (Vec::new(), Vec::new());
    for path in &files {
        if stop.load(Ordering::Relaxed) {
            break;
        }
        bar.set_message(path.file_name().unwrap_or_default().to_string_lossy().into_owned());
        match row(args, path, &methods, stop, &bar) {
            Ok(row) => rows.push(row),
            Err(failure) => {
                let _ = bar.suspend(|| failure.report());
                failures.push(failure);
                bar.inc(methods.len() as u64);
            }
        }
    }
    bar.finish_and_clear();
    write_whole(&args.out.join("results.csv"), results(&rows, &methods))?;
    // Curves over problems that not all methods have tried would mislead.
    let interrupted = stop.load(Ordering::Relaxed) && rows.len() + failures.len() < files.len()
        || rows.last().is_some_and(|row| row.cells.len() < methods.len());
    rows.retain(|row| row.cells.len() == methods.len());
    let measures = measures(&rows, &methods);
    for measure in &measures {
        write_profile(args, measure)?;
    }
    say(&summary(args, &measures, rows.len()))?;
    if interrupted {
        return Err(Failure::interrupted(format!("the results until then are in {}", args.out.display())));
    }
    match (failures.len(), failures.into_iter().next()) {
        (count, Some(first)) => Err(first.again(format!("{count} of {} files could not be solved, as said above", files.len()))),
        _ => Ok(()),
    }
}

/// The problem files of a folder by name.
fn problem_files(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let entries = std::fs::read_dir(folder).map_err(|error| {
        let hint = "give a folder of problem files, .hdf5 or .dat";
        Failure::file(format!("{}: cannot be read: {error}; {hint}", folder.display()))
    })?;
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.retain(|path| problem::format(path).is_some() && path.is_file());
    files.sort();
    if files.is_empty() {
        let what = "has no problem files, whose names end with .hdf5, .h5, .dat or .txt";
        return Err(Failure::file(format!("{}: {what}", folder.display())));
    }
    Ok(files)
}

/// The names of the files that are written.
fn outputs(figures: Form) -> impl Iterator<Item = String> {
    let profiles =
        ["time", "sweeps"].into_iter().flat_map(move |what| ["csv", figures.ending()].map(|ending| profile_file(what, ending)));
    std::iter::once("results.csv".to_owned()).chain(profiles)
}

fn profile_file(what: &str, ending: &str) -> String {
    format!("profile-{what}.{ending}")
}

/// Makes the folder and finds out whether all can be written, before the long work.
fn prepare(args: &Args) -> Result<(), Failure> {
    let out = &args.out;
    std::fs::create_dir_all(out)
        .map_err(|error| Failure::file(format!("cannot write into {}: {error}; choose another --out", out.display())))?;
    outputs(args.figures).try_for_each(|name| args.replace.allows(&out.join(name)))
}

/// Solves one problem by all methods.
fn row(args: &Args, path: &Path, methods: &[Methods], stop: &AtomicBool, bar: &ProgressBar) -> Result<Row, Failure> {
    let file = problem::read(path)?;
    let reduced = problem::reduce(path, &file)?;
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut row = Row { file: name, dimension: file.dimension, contacts: file.contacts(), cells: Vec::new() };
    for &(global, local) in methods {
        if stop.load(Ordering::Relaxed) {
            break;
        }
        let solved = problem::run(&reduced, &args.how.settings(global, local), (None, args.how.repeat), stop);
        if solved.report.status == Status::Interrupted {
            break;
        }
        row.cells.push(Cell { seconds: solved.seconds, report: solved.report });
        bar.inc(1);
    }
    Ok(row)
}

fn name((global, local): Methods) -> String {
    format!("{}+{}", global.name(), local.name())
}

/// A row of text for each problem and method.
fn results(rows: &[Row], methods: &[Methods]) -> String {
    let mut text = "file,dimension,contacts,global,local,status,sweeps,seconds,scaled,siconos,eps_glob\n".to_owned();
    for row in rows {
        // A name of a file may hold what separates columns.
        let file =
            if row.file.contains([',', '"', '\n']) { format!("\"{}\"", row.file.replace('"', "\"\"")) } else { row.file.clone() };
        for (&(global, local), Cell { seconds, report }) in methods.iter().zip(&row.cells) {
            let residual = &report.residual;
            let _ = writeln!(
                text,
                "{file},{},{},{},{},{},{},{seconds:.6},{:e},{:e},{:e}",
                row.dimension,
                row.contacts,
                global.name(),
                local.name(),
                report.status.name(),
                report.sweeps,
                residual.scaled,
                residual.siconos,
                residual.eps_glob.total()
            );
        }
    }
    text
}

/// Seconds and sweeps of all methods on all problems.
fn measures(rows: &[Row], methods: &[Methods]) -> [Measure; 2] {
    let names = || methods.iter().map(|&methods| name(methods)).collect::<Vec<_>>();
    let costs = |cost: &dyn Fn(&Cell) -> f64| {
        let converged = |cell: &Cell| (cell.report.status == Status::Converged).then(|| cost(cell));
        rows.iter().map(|row| row.cells.iter().map(converged).collect()).collect::<Vec<Vec<_>>>()
    };
    // Nothing takes no time at all, and what needs no sweep is as good as what needs one.
    let seconds = Measure::new("time", names(), &costs(&|cell| cell.seconds.max(1e-9)));
    [seconds, Measure::new("sweeps", names(), &costs(&|cell| cell.report.sweeps.max(1) as f64))]
}

fn write_profile(args: &Args, measure: &Measure) -> Result<(), Failure> {
    let file = |ending: &str| args.out.join(profile_file(measure.what, ending));
    write_whole(&file("csv"), measure.csv())?;
    let title = format!("part of the problems solved within τ times the least {}", measure.what);
    write_whole(&file(args.figures.ending()), draw(&title, &measure.curves()).draw(args.figures)?)
}

/// The table of all methods.
fn summary(args: &Args, measures: &[Measure; 2], problems: usize) -> String {
    let header = ["method", "solved", "fastest on", "time ratio", "fewest sweeps on", "sweeps ratio"];
    let mut cells = vec![header.map(str::to_owned).to_vec()];
    let [time, sweeps] = measures;
    for (m, method) in time.methods.iter().enumerate() {
        let ratio = |measure: &Measure| measure.mean_ratio(m).map_or("-".to_owned(), |ratio| format!("{ratio:.2}"));
        cells.push(vec![
            method.clone(),
            time.solved(m).to_string(),
            time.best_on(m).to_string(),
            ratio(time),
            sweeps.best_on(m).to_string(),
            ratio(sweeps),
        ]);
    }
    let how = &args.how;
    format!(
        "{problems} problems to {} = {:e}, one thread\n\n{}\n\
         ratio: geometric mean of time or sweeps over the least of any method, over the problems that the method solved\n\
         results in {}\n",
        how.criterion.name(),
        how.tolerance,
        aligned(&cells),
        args.out.display(),
    )
}
