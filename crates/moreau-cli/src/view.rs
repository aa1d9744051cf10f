//! `moreau view`, and what `moreau run --view` adds to a run: a page on this machine that shows it.

use crate::failure::{Failure, say};
use crate::progress;
use moreau_view::recording::Recording;
use moreau_view::serve::{Order, Serving, Viewer};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Arguments of `moreau view`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The folder that moreau run wrote
    run: PathBuf,
    /// The port on the loopback address [default: any that is free]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    port: u16,
}

/// Serves a run that is over until Ctrl-C.
pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    // What is wrong with it is said here rather than in the browser.
    Recording::open(&args.run).map_err(Failure::file)?;
    let stop = progress::stop_on_ctrl_c()?;
    let viewer = Viewer::listen(&args.run, args.port).map_err(Failure::file)?;
    say(&format!("open {}\nCtrl-C ends\n", viewer.url()))?;
    let _serving = viewer.start(false, |_| {}).map_err(Failure::file)?;
    until(stop);
    Ok(())
}

/// Begins to serve a run that is about to begin, and prints its address. Orders go to `pace` and `stop`.
pub(crate) fn begin(folder: &Path, pace: &Arc<Pace>, stop: &'static AtomicBool) -> Result<Serving, Failure> {
    let viewer = Viewer::listen(folder, 0).map_err(Failure::file)?;
    say(&format!("open {}\n", viewer.url()))?;
    let pace = pace.clone();
    viewer.start(true, move |order| pace.order(order, stop)).map_err(Failure::file)
}

/// Waits until `stop` is set.
pub(crate) fn until(stop: &AtomicBool) {
    while !stop.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(100));
    }
}

/// Whether a run may take its next step.
#[derive(Default)]
pub(crate) struct Pace {
    waits: Mutex<Waits>,
    changed: Condvar,
}

#[derive(Default)]
struct Waits {
    paused: bool,
    /// Steps that may be taken all the same.
    steps: u64,
}

impl Pace {
    /// Takes an order.
    pub(crate) fn order(&self, order: Order, stop: &AtomicBool) {
        let mut waits = self.waits.lock().unwrap_or_else(PoisonError::into_inner);
        match order {
            Order::Pause => *waits = Waits { paused: true, steps: 0 },
            Order::Resume => waits.paused = false,
            Order::Step => *waits = Waits { paused: true, steps: waits.steps + 1 },
            Order::Stop => stop.store(true, Ordering::Relaxed),
        }
        self.changed.notify_all();
    }

    /// Waits while the run is paused and not stopped.
    pub(crate) fn wait(&self, stop: &AtomicBool) {
        let mut waits = self.waits.lock().unwrap_or_else(PoisonError::into_inner);
        while waits.paused && waits.steps == 0 && !stop.load(Ordering::Relaxed) {
            // Ctrl-C tells nobody.
            waits = self.changed.wait_timeout(waits, Duration::from_millis(100)).unwrap_or_else(PoisonError::into_inner).0;
        }
        waits.steps = waits.steps.saturating_sub(1);
    }
}
