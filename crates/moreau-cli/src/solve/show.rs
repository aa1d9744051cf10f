//! What `moreau solve` prints: the table, the certificates, the lines of JSON.

use crate::table::aligned;
use moreau::solve::{Report, Settings};
use serde_json::{Value, json};

/// One solved problem.
pub(super) struct Row {
    pub(super) file: String,
    pub(super) dimension: usize,
    pub(super) contacts: usize,
    pub(super) settings: Settings,
    pub(super) report: Report,
    pub(super) seconds: f64,
    /// What the reader and the start noticed.
    pub(super) notes: Vec<String>,
}

impl Row {
    /// The line of the table.
    fn cells(&self) -> Vec<String> {
        let residual = &self.report.residual;
        vec![
            self.file.clone(),
            self.dimension.to_string(),
            self.contacts.to_string(),
            self.report.status.name().to_owned(),
            self.report.sweeps.to_string(),
            format!("{:.1e}", residual.scaled),
            format!("{:.1e}", residual.siconos),
            format!("{:.1e}", residual.eps_glob.total()),
            format!("{:.1e}", self.seconds),
            self.methods(),
        ]
    }

    /// `nlgs+pdas`, or `auto(accelerated, nlgs)+pdas` where the method chose among others.
    fn methods(&self) -> String {
        let Settings { global, local, .. } = self.settings;
        let stages: Vec<&str> = self.report.stages.iter().map(|stage| stage.method.name()).collect();
        let chosen = match stages.as_slice() {
            [] => String::new(),
            [one] if *one == global.name() => String::new(),
            _ => format!("({})", stages.join(", ")),
        };
        format!("{}{chosen}+{}", global.name(), local.name())
    }

    /// The object of JSON.
    pub(super) fn json(&self) -> Value {
        let Report { status, sweeps, stages, residual, .. } = &self.report;
        let stage = |stage: &moreau::solve::Stage| {
            json!({
                "method": stage.method.name(),
                "sweeps": stage.sweeps,
                "error": stage.error,
                "status": stage.status.name(),
            })
        };
        json!({
            "file": self.file,
            "dimension": self.dimension,
            "contacts": self.contacts,
            "status": status.name(),
            "sweeps": sweeps,
            "residual_scaled": residual.scaled,
            "residual_siconos": residual.siconos,
            "seconds": self.seconds,
            "global": self.settings.global.name(),
            "local": self.settings.local.name(),
            "eps_glob": residual.eps_glob.total(),
            "eps_glob_cone": residual.eps_glob.cone,
            "mean_error": residual.error,
            "motion": residual.motion,
            "cone": residual.cone,
            "complementarity": residual.complementarity,
            "worst_contact": residual.worst.map(|worst| worst.contact),
            "worst_error": residual.worst.map(|worst| worst.error),
            "stages": stages.iter().map(stage).collect::<Vec<_>>(),
            "notes": self.notes,
        })
    }

    /// Where the errors are and what was done, line by line.
    fn certificate(&self) -> String {
        let Report { status, sweeps, stages, residual, unfinished_visits, .. } = &self.report;
        let eps = &residual.eps_glob;
        let criterion = self.settings.criterion;
        let row = |name: &str, value: String| vec![format!("  {name}"), value];
        let reached = format!("{} {:.3e}, wanted {:.1e}", criterion.name(), residual.of(criterion), self.settings.tolerance);
        let mut rows = vec![
            row("status", format!("{}, sweeps or steps: {sweeps}, {reached}", status.name())),
            row("scaled", format!("{:.3e}, without units", residual.scaled)),
            row("error", format!("{:.3e}, a velocity: the mean over the contacts", residual.error)),
            row("siconos", format!("{:.3e}, as Siconos measures", residual.siconos)),
            row(
                "eps_glob",
                format!(
                    "{:.3e} = motion {:.1e} + bipotential {:.1e} + penetration {:.1e} + cone {:.1e}, in the file's units",
                    eps.total(),
                    eps.motion,
                    eps.bipotential,
                    eps.penetration,
                    eps.cone
                ),
            ),
            row("motion", format!("{:.3e}, claimed velocities from W r + q", residual.motion)),
            row("cone", format!("{:.3e}, impulses and velocities from their cones", residual.cone)),
            row("complementarity", format!("{:.3e}, impulses and velocities from being orthogonal", residual.complementarity)),
        ];
        if let Some(worst) = residual.worst {
            rows.push(row("worst contact", format!("{} with {:.3e}, a velocity", worst.contact, worst.error)));
        }
        for stage in stages {
            let done = format!("{}, sweeps or steps: {}, error {:.3e}", stage.status.name(), stage.sweeps, stage.error);
            rows.push(row("method", format!("{}: {done}", stage.method.name())));
        }
        if *unfinished_visits > 0 {
            rows.push(row("visits", format!("{unfinished_visits} of the last sweep did not reach their own end")));
        }
        rows.extend(self.notes.iter().map(|note| row("note", note.clone())));
        format!("{}\n{}", self.file, aligned(&rows))
    }

    /// What is wrong and what may help, of a solve that did not converge.
    pub(super) fn complaint(&self) -> String {
        let Report { status, sweeps, residual, .. } = &self.report;
        let left = residual.of(self.settings.criterion);
        format!(
            "{}: {} did not converge ({}): sweeps or steps: {sweeps}, {} {left:.3e}, wanted {:e}; \
             try more --max-sweeps or --seconds, another --global, or a looser --tolerance",
            self.file,
            self.methods(),
            status.name(),
            self.settings.criterion.name(),
            self.settings.tolerance,
        )
    }
}

/// The table, and under it the certificates if they are wanted.
pub(super) fn report(rows: &[Row], certificates: bool) -> String {
    let header = ["file", "dimension", "contacts", "status", "sweeps", "scaled", "siconos", "eps_glob", "seconds", "method"];
    let mut cells = vec![header.map(str::to_owned).to_vec()];
    cells.extend(rows.iter().map(Row::cells));
    let mut text = aligned(&cells);
    for row in rows.iter().filter(|_| certificates) {
        text += &format!("\n{}", row.certificate());
    }
    text
}
