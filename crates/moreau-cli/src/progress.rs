//! A progress bar on a terminal, silence in a pipe, and Ctrl-C.

use crate::Failure;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use moreau::step::StepRecord;
use std::io::IsTerminal;
#[cfg(unix)]
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by Ctrl-C, and on Unix by the signals that ask a program to end (SIGTERM) or tell that its terminal is gone (SIGHUP).
static STOP: AtomicBool = AtomicBool::new(false);

/// Makes Ctrl-C end runs with the last whole step; a second one ends the program at once.
pub(crate) fn stop_on_ctrl_c() -> Result<&'static AtomicBool, Failure> {
    let handler = || {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    };
    ctrlc::set_handler(handler).map_err(|error| Failure::file(format!("cannot listen to Ctrl-C: {error}")))?;
    Ok(&STOP)
}

/// Makes a write beyond the limit of file sizes (`ulimit -f`) an error of that write. Unless the signal that comes with it is caught, it ends
/// the program, without a message and with files half written.
#[cfg(unix)]
pub(crate) fn outlive_file_limits() -> Result<(), Failure> {
    // Nobody looks at the flag: the write says what is wrong.
    let caught = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    caught.map(drop).map_err(|error| Failure::file(format!("cannot catch SIGXFSZ: {error}")))
}

/// Systems without signals answer the write.
#[cfg(not(unix))]
pub(crate) fn outlive_file_limits() -> Result<(), Failure> {
    Ok(())
}

/// A bar over `steps` steps, hidden if `quiet` or if nobody looks.
pub(crate) fn bar(steps: u64, quiet: bool) -> ProgressBar {
    bar_of("steps", steps, quiet)
}

/// The same over `count` of `what`.
pub(crate) fn bar_of(what: &str, count: u64, quiet: bool) -> ProgressBar {
    if quiet || !std::io::stderr().is_terminal() {
        return ProgressBar::with_draw_target(Some(count), ProgressDrawTarget::hidden());
    }
    let bar = ProgressBar::new(count);
    let template = format!("{{prefix}} {{wide_bar}} {{pos}}/{{len}} {what} {{per_sec}} eta {{eta}} {{msg}}");
    if let Ok(style) = ProgressStyle::with_template(&template) {
        bar.set_style(style);
    }
    bar
}

/// Moves the bar by one step.
pub(crate) fn tick(bar: &ProgressBar, record: &StepRecord) {
    bar.inc(1);
    if !bar.is_hidden() && record.step.is_multiple_of(16) {
        bar.set_message(format!("{} contacts, {} sweeps", record.contacts, record.sweeps));
    }
}
