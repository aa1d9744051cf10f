//! The verdict on a run: each fault is a reason of its own, and the bounds are those of `moreau::observe::verdict`.

use moreau::observe::verdict::{CREATED, GAINED, JOINT, OVERLAP, ROUNDING};
use moreau::observe::{Summary, Verdict, numbers};
use moreau::solve::Status;
use moreau::step::{Breach, Energy, StepRecord};

/// A step of a body that falls and bounces: nothing is wrong with it.
fn sound(step: u64) -> StepRecord {
    let potential = 10.0 - step as f64;
    let energy = Energy { kinetic: step as f64, potential, balance_error: 1e-15, ..Energy::default() };
    StepRecord { step, time: 1e-3 * step as f64, lift: 1.0, penetration: 1e-5, overlap: 1e-4, energy, ..StepRecord::default() }
}

/// The verdict on five steps, of which the third is changed.
fn judge(change: impl Fn(&mut StepRecord)) -> Verdict {
    let mut summary = Summary::default();
    for step in 1..=5 {
        let mut record = sound(step);
        if step == 3 {
            change(&mut record);
        }
        summary.add(&record);
    }
    summary.verdict()
}

/// The names of the checks that failed.
fn failed(verdict: &Verdict) -> Vec<&'static str> {
    assert_eq!(verdict.reliable(), verdict.reasons().is_empty());
    verdict.checks.iter().filter(|check| !check.passed).map(|check| check.name).collect()
}

#[test]
fn a_sound_run_passes_and_each_fault_is_a_reason_of_its_own() {
    assert!(judge(|_| {}).reliable(), "{:?}", judge(|_| {}));
    assert_eq!(failed(&judge(|r| r.status = Status::MaxSweeps)), ["Convergence"]);
    assert_eq!(failed(&judge(|r| r.overlap = 1.01 * OVERLAP)), ["Overlap"]);
    assert!(judge(|r| r.overlap = 0.99 * OVERLAP).reliable());
    let open = |part: f64| judge(move |r| (r.joint_error, r.joint_gap) = (0.1 * part, part));
    assert_eq!(failed(&open(1.01 * JOINT)), ["Joints"]);
    assert!(open(0.99 * JOINT).reliable());
    // The largest number of the ledger is the potential energy of 9 J.
    assert_eq!(failed(&judge(|r| r.energy.balance_error = -9.1 * ROUNDING)), ["Ledger"]);
    assert!(judge(|r| r.energy.balance_error = 8.9 * ROUNDING).reliable());
    let breach = Breach::Energy { created: 2.0, allowed: 1.0 };
    let verdict = judge(|r| r.breach = Some(breach.clone()));
    assert_eq!(failed(&verdict), ["Limits"]);
    assert!(verdict.reasons()[0].contains("1 steps broke a limit of [guard]; the first: step 3"), "{:?}", verdict.reasons());
}

#[test]
fn a_number_that_is_nan_is_never_hidden_by_a_maximum() {
    assert_eq!(failed(&judge(|r| r.residual.scaled = f64::NAN)), ["Convergence"]);
    assert_eq!(failed(&judge(|r| r.residual.eps_glob.motion = f64::NAN)), ["Convergence"]);
    assert_eq!(failed(&judge(|r| r.overlap = f64::NAN)), ["Overlap"]);
    assert_eq!(failed(&judge(|r| r.penetration = f64::NAN)), ["Overlap"]);
    assert_eq!(failed(&judge(|r| (r.joint_error, r.joint_gap) = (f64::NAN, f64::NAN))), ["Joints"]);
    assert_eq!(failed(&judge(|r| r.energy.balance_error = f64::NAN)), ["Ledger"]);
    assert_eq!(failed(&judge(|r| r.created.joints = f64::NAN)), ["Energy"]);
    assert_eq!(failed(&judge(|r| r.energy.kinetic = f64::NAN)), ["Energy", "Ledger"]);
}

#[test]
fn energy_is_judged_by_what_is_gained_and_by_what_is_created() {
    // At hand: a fall of 4 J and 5 J of kinetic energy; turned over: 9 J.
    let gained = |energy: f64| judge(move |r| r.energy.dissipated = -energy);
    assert_eq!(failed(&gained(5.1 * GAINED)), ["Energy"]);
    assert!(gained(4.9 * GAINED).reliable());
    let created = |energy: f64| judge(move |r| r.created.contacts = energy);
    let verdict = created(9.1 * CREATED);
    assert_eq!(failed(&verdict), ["Energy"]);
    assert!(verdict.reasons()[0].contains("0.091 J by contacts (most in step 3: 0.091 J)"), "{:?}", verdict.reasons());
    assert!(created(8.9 * CREATED).reliable());
    // Energy that was dissipated later was gained all the same.
    let mut summary = Summary::default();
    for (step, dissipated) in (1..).zip([0.0, 2.0, 1.0, 5.0]) {
        let mut record = sound(step);
        record.energy.dissipated = dissipated;
        summary.add(&record);
    }
    assert_eq!(failed(&summary.verdict()), ["Energy"]);
    assert!(summary.verdict().reasons()[0].contains("on balance 1.00 J were gained"), "{:?}", summary.verdict().reasons());
}

#[test]
fn energy_created_is_reported_from_rounding_on() {
    let with = |energy: f64| {
        let mut summary = Summary::default();
        for step in 1..=5 {
            let mut record = sound(step);
            record.created.scheme = if step == 2 { energy } else { 0.0 };
            summary.add(&record);
        }
        summary
    };
    assert_eq!(with(8.9 * ROUNDING).energy_created(), None);
    let small = with(9.1 * ROUNDING);
    assert!(small.energy_created().expect("it is beyond rounding").contains("by the scheme"));
    assert!(small.verdict().reliable(), "it is little");
}

#[test]
fn a_failed_run_is_not_to_be_relied_on() {
    let mut summary = Summary::default();
    summary.add(&sound(1));
    summary.fail("a step failed".to_owned());
    assert_eq!(summary.verdict().reasons(), ["the run failed: a step failed"]);
}

#[test]
fn rows_of_the_table_give_the_same_verdict() {
    let mut summary = Summary::default();
    let mut rows = Vec::new();
    for step in 1..=6 {
        let mut record = sound(step);
        record.overlap = 0.0625;
        record.created.contacts = 0.5;
        record.energy.dissipated = -0.5 * step as f64;
        record.joint_error = 0.25;
        record.joint_gap = 0.125;
        if step == 4 {
            record.status = Status::Stalled;
            record.breach = Some(Breach::Energy { created: 2.0, allowed: 1.0 });
        }
        rows.push(numbers(&record));
        summary.add(&record);
    }
    let read = Summary::of_rows(rows).verdict();
    let ours = summary.verdict();
    assert_eq!(failed(&read), failed(&ours));
    assert_eq!(failed(&ours), ["Convergence", "Limits", "Overlap", "Joints", "Energy"]);
    // The table does not say which limit was broken; all else is the same to the letter.
    let but_limits =
        |verdict: &Verdict| verdict.checks.iter().filter(|check| check.name != "Limits").cloned().collect::<Vec<_>>();
    assert_eq!(but_limits(&read), but_limits(&ours));
}
