//! What is said of a run at its end.

use crate::failure::Failure;
use moreau::checkpoint;
use moreau::run::{End, Outcome};
use moreau::scene::Scene;
use moreau::step::FAILED_KEPT;
use moreau::world::StepSettings;
use std::path::Path;

/// A few lines for a person.
pub(super) fn describe(outcome: &Outcome, bodies: usize, settings: &StepSettings, folder: &Path) -> String {
    let summary = &outcome.summary;
    let unconverged = match summary.unconverged() {
        0 if matches!(outcome.end, End::Failed(_)) => "then a step failed".to_owned(),
        0 => "every step converged".to_owned(),
        count => format!("{count} steps did NOT converge"),
    };
    format!(
        "{} steps, {bodies} bodies, {} inside {}: {:.1} sweeps a step, {unconverged}\n\
         {:.2} s in all, {:.2} s for contact impulses, {:.2} s for files\n\
         {}results in {}\n{}",
        summary.steps(),
        settings.solver.local.name(),
        settings.solver.global.name(),
        summary.sweeps_mean(),
        summary.seconds_total(),
        summary.seconds_solve(),
        summary.seconds_output(),
        failed_problems(outcome, folder),
        folder.display(),
        verdict(outcome),
    )
}

/// The lines that judge the run: the energy created, if there is some, and the verdict with its reasons.
fn verdict(outcome: &Outcome) -> String {
    let (verdict, created) = (outcome.summary.verdict(), outcome.summary.energy_created());
    if verdict.reliable() {
        let energy = created.map(|text| format!("energy: {text}\n")).unwrap_or_default();
        return format!("{energy}verdict: all checks passed\n");
    }
    // Energy that is no reason against the run is reported all the same.
    let reasons = verdict.reasons();
    let energy = created.filter(|text| !reasons.contains(text)).map(|text| format!("energy: {text}\n")).unwrap_or_default();
    let reasons: String = reasons.iter().map(|reason| format!("  - {reason}\n")).collect();
    format!("{energy}verdict: NOT TO BE RELIED ON\n{reasons}")
}

/// Fails under `--strict` if the run is not to be relied on; under `--quiet` says so where nothing else does.
pub(super) fn judge(outcome: &Outcome, args: &super::Args) -> Result<(), Failure> {
    let verdict = outcome.summary.verdict();
    if verdict.reliable() {
        return Ok(());
    }
    let failure = Failure::unreliable(format!("the run is not to be relied on: {}", verdict.reasons().join("; ")));
    if args.strict {
        return Err(failure);
    }
    if args.quiet {
        failure.note("kept the results");
    }
    Ok(())
}

/// Where the problems of failed solves are, under the policy `dump`.
fn failed_problems(outcome: &Outcome, folder: &Path) -> String {
    let summary = &outcome.summary;
    let mut text = String::new();
    if let [first, ..] = summary.failed_problems() {
        let count = summary.failed_problems().len();
        let more =
            if summary.unconverged() > FAILED_KEPT { format!(", of the first {FAILED_KEPT} that failed") } else { String::new() };
        text += &format!(
            "problems of {count} failed solves{more}; solve again with: moreau solve {}\n",
            folder.join(first).display()
        );
    }
    if let Some(reason) = summary.refused_problem() {
        text += &format!("no problem file could be made of {reason}\n");
    }
    text
}

/// What a run that ended early has kept, and how it goes on.
fn kept(outcome: &Outcome, folder: &Path) -> String {
    format!("the {} steps before are kept in {}; {}", outcome.summary.steps(), folder.display(), go_on(folder))
}

/// The same of a run that could not write: rows and frames after the checkpoint may be missing.
pub(super) fn whole(outcome: &Outcome, folder: &Path) -> String {
    let steps = outcome.summary.steps();
    match checkpoint::last_step(folder) {
        Some(step) => {
            format!("of the {steps} steps that were done the first {step} are kept in {}; {}", folder.display(), go_on(folder))
        }
        None => {
            format!("{steps} steps were done, and their files in {} may lack the last ones; {}", folder.display(), go_on(folder))
        }
    }
}

fn go_on(folder: &Path) -> String {
    match checkpoint::last_step(folder) {
        Some(step) => format!("to go on from step {step}: moreau run --resume {}", folder.display()),
        None => "there is no checkpoint to go on from: begin again with --force".to_owned(),
    }
}

/// Fails if the run did not come to its end.
pub(super) fn ending(outcome: &Outcome, scene: &Scene, folder: &Path) -> Result<(), Failure> {
    if let (count @ 1.., Some(first)) = outcome.summary.breaches() {
        Failure::computation(first).note(&format!("{count} steps broke a limit of [guard]; the first"));
    }
    let kept = kept(outcome, folder);
    match &outcome.end {
        End::Done | End::Unwritten => Ok(()),
        End::Interrupted => Err(Failure::interrupted(kept)),
        End::Failed(error) => {
            let who: String = error.bodies().iter().map(|&i| format!("; body {i} is {}", scene.body_label(i))).collect();
            Err(Failure::computation(format!("{error}{who}; {}{kept}", failed_problems(outcome, folder).replace('\n', "; "))))
        }
    }
}
