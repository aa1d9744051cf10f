//! The program `moreau`.

mod chart;
mod check;
mod compare;
mod convert;
mod failure;
mod list;
mod marker;
mod names;
mod new;
mod outputs;
mod plot;
mod problem;
mod profile;
mod progress;
mod render;
mod report;
mod rho;
mod run;
mod scene;
mod solve;
mod table;
mod view;

use clap::{Parser, Subcommand};
use failure::Failure;
use std::process::ExitCode;

/// Nonsmooth contact dynamics: how many rigid bodies move when they touch.
#[derive(Parser)]
#[command(name = "moreau", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Run a scene and write summary.json, steps.csv and files for ParaView
    Run(run::Args),
    /// Make one page of a run that plays it in a browser, with charts and a verdict
    Report(report::Args),
    /// Serve the page of a run to a browser on this machine, frame by frame, for runs that are too large for one page
    View(view::Args),
    /// Make pictures or a movie of a run, without a display
    Render(render::Args),
    /// Plot what a run's steps tell: sweeps, residuals, energies, as SVG, PNG or PDF
    Plot(plot::Args),
    /// Run a scene with several solvers from the same start and print the paper's table
    Compare(compare::Args),
    /// Solve problem files, FCLIB's .hdf5 or Siconos's .dat, and say how good the answers are
    Solve(solve::Args),
    /// Solve a folder of problem files by many solvers: results.csv and performance profiles
    Profile(profile::Args),
    /// Write a problem file in the other format
    Convert(convert::Args),
    /// Write a commented scene to start from
    New(new::Args),
    /// Say what a scene would run, without running it
    Check(check::Args),
    /// List what scenes can name
    List(list::Args),
    /// Print the JSON schema of scene files, for editors
    Schema,
}

fn main() -> ExitCode {
    let command = Cli::parse().command;
    if let Err(failure) = progress::outlive_file_limits() {
        return failure.report();
    }
    let outcome = match command {
        Command::Run(args) => run::run(&args),
        Command::Report(args) => report::run(&args),
        Command::View(args) => view::run(&args),
        Command::Render(args) => render::run(&args),
        Command::Plot(args) => plot::run(&args),
        Command::Compare(args) => compare::compare(&args),
        Command::Solve(args) => solve::solve(&args),
        Command::Profile(args) => profile::profile(&args),
        Command::Convert(args) => convert::convert(&args),
        Command::New(args) => new::new(&args),
        Command::Check(args) => check::check(&args),
        Command::List(args) => list::list(&args),
        Command::Schema => list::schema(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
