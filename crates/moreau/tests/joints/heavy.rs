//! Chains whose end is many times heavier than their links: they stay closed and create no energy, or the step says that it failed.

use super::{head, solid};
use moreau::space::Solid;
use moreau::step::{StepError, Workspace, step};
use moreau::world::World;
use std::fmt::Write;

const LINKS: usize = 10;
const STEPS: u64 = 1000;

/// Ten links of 0.1 m held level, and a ball `ratio` times as heavy as a link at their end; `joint` writes the kind of a joint at x.
fn chain(ratio: f64, policy: &str, joint: &dyn Fn(f64) -> String) -> String {
    let mut text = head(3, 1e-3).replace("tolerance = 1e-12", "tolerance = 1e-9").replace("\"stop\"", policy);
    // A link weighs 0.04 kg; the ball has a radius of 0.05 m.
    let density = ratio * 0.04 / (4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3));
    let _ = writeln!(text, "materials.end.density = {density:?}\ndefault_law.frictionless = {{}}");
    for i in 0..LINKS {
        let x = 0.1 * i as f64 + 0.05;
        let _ = writeln!(
            text,
            "[[bodies]]\nname = \"l{i}\"\nshape.box = {{ size = [0.1, 0.02, 0.02] }}\nmaterial = \"steel\"\nposition = [{x:?}, 0.0, 0.0]"
        );
    }
    text += "[[bodies]]\nname = \"end\"\nshape.ball = { radius = 0.05 }\nmaterial = \"end\"\nposition = [1.05, 0.0, 0.0]\n";
    for i in 0..=LINKS {
        let between = match i {
            0 => "\"l0\"".to_owned(),
            LINKS => format!("\"l{}\", \"end\"", i - 1),
            _ => format!("\"l{}\", \"l{i}\"", i - 1),
        };
        let _ = writeln!(text, "[[joints]]\nkind = {{ {} }}\nbetween = [{between}]", joint(0.1 * i as f64));
    }
    text
}

/// What a run came to: failed steps, the largest opening of a joint in a step that converged (m), and the energy created and lost at most, as parts of the
/// largest kinetic energy.
fn swing(world: &mut World<Solid, 3, 6>) -> Result<(u64, f64, f64), StepError> {
    let (mut work, mut failed, mut open) = (Workspace::default(), 0, 0.0_f64);
    let (mut energy, mut kinetic) = (0.0_f64, 0.0_f64);
    for _ in 0..STEPS {
        let record = step(world, &mut work)?;
        failed += u64::from(!record.converged());
        if record.converged() {
            open = open.max(record.joint_error);
        }
        energy = energy.max((record.energy.kinetic + record.energy.potential).abs());
        kinetic = kinetic.max(record.energy.kinetic);
    }
    Ok((failed, open, energy / kinetic))
}

fn ball(x: f64) -> String {
    format!("ball = {{ anchor = [{x:?}, 0.0, 0.0] }}")
}

fn hinge(x: f64) -> String {
    format!("hinge = {{ anchor = [{x:?}, 0.0, 0.0], axis = [0.0, 1.0, 0.0] }}")
}

/// Near its lowest point the end pulls each link so that a step of 1 ms does not resolve how it swings. Steps in halves do.
#[test]
fn a_chain_with_an_end_a_thousand_times_heavier_keeps_its_energy() {
    for joint in [&ball as &dyn Fn(f64) -> String, &hinge] {
        let (failed, open, energy) = swing(&mut solid(&chain(1e3, "\"halve\"", joint))).unwrap();
        assert_eq!(failed, 0, "{}", joint(0.0));
        assert!(open < 1e-6 && energy < 1e-3, "{}: open by {open} m, energy off by {energy}", joint(0.0));
    }
}

/// Steps that are too long are counted as failed, and those that count as converged have their joints closed.
#[test]
fn steps_that_are_too_long_for_a_heavy_end_say_so() {
    for ratio in [1e3, 1e4, 1e6] {
        // A run that goes on counts its failed steps, or ends because its energy overflows.
        match swing(&mut solid(&chain(ratio, "\"warn\"", &ball))) {
            Ok((failed, open, _)) => assert!(failed > 0 && open < 1e-6, "ratio {ratio}: {failed} steps failed, open by {open} m"),
            Err(error) => {
                assert!(matches!(error, StepError::Overflow { .. } | StepError::SolveNotFinite { .. }), "ratio {ratio}: {error}");
            }
        }
        let error = swing(&mut solid(&chain(ratio, "\"stop\"", &ball))).expect_err("too long a step");
        let named = matches!(error, StepError::OpenJoint { .. } | StepError::StrainedBody { .. });
        assert!(named, "ratio {ratio}: {error:?}");
    }
}
