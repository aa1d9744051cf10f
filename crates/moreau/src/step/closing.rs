//! Stage 9: the impulses, and with joints the rounds that close them.
//!
//! ```text
//! with contacts:  solve the contact problem with s = c(q_m)/h
//! repeat:  change the impulses of the joints until c(q_m⁺(v⁺)) = 0, those of contacts as they are     (Newton, theory (59))
//!          s = −H* v⁺ at what joints hold
//!          done if the impulses obey the laws with these s
//!          solve the contact problem with u + s = 0 for what joints hold
//!          done if the joints are closed
//! ```
//!
//! Without contacts the first round ends it, and nothing is swept. Where the joints are too many and too entangled for their factors, s = c(q_m)/h at first
//! and grows by c(q_m⁺)/h in each round, which multiplies what is open by something of the order (h |ω|)² times the ratio of the masses.

mod elimination;
mod newton;

pub(super) use elimination::Elimination;
pub(super) use newton::coupling;

use super::Workspace;
use super::system::Kind;
use crate::space::Space;
use crate::world::World;
use moreau_solve::{Report, Stage, Status};
use std::sync::atomic::AtomicBool;

/// How many rounds may follow the first.
const ROUNDS: u32 = 10;

/// Finds the impulses of the step. Where a joint stays open, or pulls a body so that the step cannot resolve its swing, the report says that the solve has
/// stalled, whatever the contacts do.
pub(super) fn solve<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    (kind, h): (Kind, f64),
    stop: &AtomicBool,
) -> Report {
    let settings = &world.settings.solver;
    if world.joints.is_empty() {
        return work.systems.get(kind).solve(settings, stop);
    }
    let mut report = Report { status: Status::Stalled, ..Report::default() };
    if !work.contacts.is_empty() {
        // Where the impulses of contacts are not known, closing joints asks for velocities that sticking contacts cannot have.
        report = work.systems.get(kind).solve(settings, stop);
        if report.status == Status::Interrupted {
            return report;
        }
    }
    for round in 0..=ROUNDS {
        let newton = newton::close(world, work, h);
        if newton {
            work.systems.full.shift(&work.joints.blocks);
            let residual = work.systems.full.certify();
            if residual.certifies(settings.criterion, settings.tolerance) {
                let error = residual.of(settings.criterion);
                let stage = Stage { method: settings.global, sweeps: 0, error, status: Status::Converged };
                report.stages.push(stage);
                report = Report { status: Status::Converged, residual, ..report };
                break;
            }
        } else if round > 0 {
            work.joints.shift(h);
            work.systems.full.shift(&work.joints.blocks);
        }
        let again = work.systems.get(kind).solve(settings, stop);
        report = Report { sweeps: report.sweeps + again.sweeps, ..again };
        let before = work.joints.left;
        let closed = measure(world, work, h);
        // What is left where it does not halve is the solver's tolerance.
        if closed || report.status != Status::Converged || round > 0 && !newton && work.joints.left > 0.5 * before {
            break;
        }
    }
    work.systems.full.answer_joints(&mut work.joints.blocks);
    work.joints.strain = work.joints.strained(&world.bodies, &work.middle, h);
    if report.status == Status::Converged && (work.joints.open().is_some() || work.joints.strain.is_some()) {
        report.status = Status::Stalled;
    }
    report
}

/// Measures what the current impulses leave to the next step; whether all joints are as good as closed.
fn measure<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
) -> bool {
    work.after.clone_from(&work.free);
    work.systems.get(Kind::Full).deposit(&world.bodies, &work.middle, &mut work.after);
    work.joints.measure(world, &work.middle, [&work.free, &work.after], (h, world.settings.theta))
}
