//! The records of steps, and what they come to.

use super::Recording;
use moreau::observe::{COLUMNS, Summary};
use moreau::solve::residual::larger;
use serde_json::{Map, Value, json};

/// So many steps a chart can show; of more, the hardest of each few is taken.
const ROWS: usize = 4000;

/// Returns the numbers of a run's head, and the verdict on it: that of `summary.json`, or for a run that goes on or was killed the same
/// judgement of the steps so far.
pub(super) fn verdict(run: &Recording) -> Value {
    let column = |name: &str| run.column(name);
    let largest = |name: &str| column(name).iter().fold(0.0, |most, x| larger(most, x.abs()));
    let sum = |name: &str| column(name).iter().sum::<f64>();
    // Written at the end of a run; before it, and of one that was killed, there is none.
    let summary = std::fs::read_to_string(run.folder.join("summary.json")).ok();
    let summary: Value = summary.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    let steps = column("step").len();
    let judged = summary["steps"].as_u64() == Some(steps as u64) && summary["verdict"].is_object();
    let row = |i: usize| std::array::from_fn(|k| run.columns[k][i]);
    let now = || Summary::of_rows((0..steps).map(row)).verdict().to_json();
    let judgement = if judged { summary["verdict"].clone() } else { now() };
    json!({
        "steps": steps,
        "reliable": judgement["reliable"],
        "reasons": judgement["reasons"],
        "checks": judgement["checks"],
        "planned_steps": run.scene.time.steps,
        "unconverged_steps": column("converged").iter().filter(|&&converged| converged == 0.0).count(),
        "scaled_residual_max": largest("scaled_residual"),
        "eps_glob_max": largest("eps_glob"),
        "penetration_max": largest("penetration"),
        "balance_error_max": largest("balance_error"),
        "seconds": {
            "detect": sum("seconds_detect"),
            "localise": sum("seconds_localise"),
            "solve": sum("seconds_solve"),
            "output": summary["seconds"]["output"],
            "total": summary["seconds"]["total"],
        },
        "threads": summary["threads"],
        "version": env!("CARGO_PKG_VERSION"),
    })
}

/// The columns for charts. Of runs with many steps the one with most sweeps of each few stands for them.
pub(super) fn steps(run: &Recording) -> Value {
    let sweeps = run.column("sweeps");
    let few = sweeps.len().div_ceil(ROWS).max(1);
    let hardest =
        |bucket: &[usize]| bucket.iter().copied().fold(bucket[0], |best, i| if sweeps[i] > sweeps[best] { i } else { best });
    let rows: Vec<usize> = (0..sweeps.len()).collect::<Vec<_>>().chunks(few).map(hardest).collect();
    let column = |(name, values): (&&str, &Vec<f64>)| {
        ((*name).to_owned(), rows.iter().map(|&row| values[row]).collect::<Vec<f64>>().into())
    };
    Value::Object(COLUMNS.iter().zip(&run.columns).map(column).collect::<Map<_, _>>())
}
