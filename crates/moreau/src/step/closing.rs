//! Stage 9: the impulses, and with joints the rounds that close them.
//!
//! ```text
//! s = c(q_m)/h
//! repeat:  solve the problem with u + s = 0 for what joints hold
//!          c = the error of position at the next prediction, where v⁺ leads;  enough if it is closed
//!          s ← s + c/h                                                        (theory (59))
//! ```
//!
//! The rows of a solve are straight, the paths of bodies that turn are not: the first round leaves an error of the order h² |v|², each further one
//! multiplies it by something of the order (h |ω|)².

use super::Workspace;
use super::system::Kind;
use crate::space::Space;
use crate::world::World;
use moreau_solve::{Report, Status};

/// How many rounds may follow the first.
const ROUNDS: u32 = 4;

/// Finds the impulses of the step.
pub(super) fn solve<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    kind: Kind,
    h: f64,
) -> Report {
    let mut report = work.systems.get(kind).solve(&world.settings.solver);
    if world.joints.is_empty() {
        return report;
    }
    let mut closed = measure(world, work, h);
    for _ in 0..ROUNDS {
        if closed || report.status != Status::Converged {
            break;
        }
        work.joints.shift(h);
        work.systems.full.shift(&work.joints.blocks);
        let again = work.systems.get(kind).solve(&world.settings.solver);
        report = Report { sweeps: report.sweeps + again.sweeps, ..again };
        let before = work.joints.left;
        closed = measure(world, work, h);
        // What is left is the solver's tolerance.
        if work.joints.left > 0.5 * before {
            break;
        }
    }
    report
}

/// Measures what the impulses of now leave to the next step; whether all joints are as good as closed.
fn measure<S: Space<D, N>, const D: usize, const N: usize>(
    world: &World<S, D, N>,
    work: &mut Workspace<S, D, N>,
    h: f64,
) -> bool {
    work.after.clone_from(&work.free);
    work.systems.get(Kind::Full).deposit(&world.bodies, &work.middle, &mut work.after);
    work.joints.measure(world, &work.middle, [&work.free, &work.after], (h, world.settings.theta))
}
