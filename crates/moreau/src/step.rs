//! One step of the Moreau-Jean scheme, stage by stage.

mod assemble;
mod closing;
mod correct;
mod created;
mod failed;
mod forces;
mod guard;
mod integrate;
mod joints;
mod localise;
mod moreau_jean;
mod recall;
mod record;
mod state;
mod system;
mod turning;
mod undo;
mod workspace;

pub use created::Created;
pub use failed::{FAILED_KEPT, FailedSolve};
pub use guard::Breach;
pub use joints::Reaction;
pub(crate) use moreau_jean::step_in;
pub use moreau_jean::{step, step_until};
pub use record::{Energy, Seconds, StepRecord};
pub(crate) use state::WorkspaceState;
pub use workspace::{Localised, Workspace};

/// Why a run cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepError {
    /// A solve reached its limit of sweeps, and the policy is to stop or halving did not help.
    #[error(
        "the contact solver did not converge in the step to t = {time} s: {sweeps} sweeps left ε_glob = {eps_glob:.3e}, scaled \
         residual {scaled:.3e}; raise solver.max_sweeps or solver.tolerance, or take a smaller time.step"
    )]
    Unconverged {
        /// Time at the end of the step, s.
        time: f64,
        /// Sweeps done.
        sweeps: u64,
        /// ε_glob reached.
        eps_glob: f64,
        /// Scaled residual reached.
        scaled: f64,
    },
    /// It was asked to stop; see [`step_until`].
    #[error("interrupted in the step to t = {time} s")]
    Interrupted {
        /// Time at the end of the step, s.
        time: f64,
    },
    /// A solve left the finite numbers.
    #[error(
        "the contact solver left the finite numbers in the step to t = {time} s after {sweeps} sweeps; take a smaller solver.rho or \
         solver.gamma, or a smaller time.step"
    )]
    SolveNotFinite {
        /// Time at the end of the step, s.
        time: f64,
        /// Sweeps done.
        sweeps: u64,
    },
    /// A joint stays open, and the policy is to stop or halving did not help.
    #[error(
        "joint {joint} stays open by {error:.3e} m in the step to t = {time} s, where {bound:.3e} m are allowed; take a smaller time.step, \
         or solver.on_failure = \"halve\""
    )]
    OpenJoint {
        /// Time at the end of the step, s.
        time: f64,
        /// Index of the joint.
        joint: usize,
        /// Its error of position at the next prediction, m; angles times the arm of its bodies.
        error: f64,
        /// What is allowed: a millionth of the joint's size.
        bound: f64,
    },
    /// Joints pull a body so hard that its swing between them is too fast for the step, and the policy is to stop or halving did not help.
    #[error(
        "the joints of body {body} pull it so hard in the step to t = {time} s that it swings by (h ω)² = {swing:.3}, where {allowed} are \
         allowed; take a smaller time.step, or solver.on_failure = \"halve\""
    )]
    StrainedBody {
        /// Time at the end of the step, s.
        time: f64,
        /// Index of the body.
        body: usize,
        /// (h ω)² of its swing.
        swing: f64,
        /// What a step resolves.
        allowed: f64,
    },
    /// A position or velocity is not a finite number.
    #[error("body {body} has a position or velocity that is not a finite number at t = {time} s; take a smaller time.step")]
    NotFinite {
        /// Index of the body.
        body: usize,
        /// Time, s.
        time: f64,
    },
    /// A number that the step reports is NaN or infinite.
    #[error("{} is not a finite number in the step to t = {time} s; take a smaller time.step, or smaller numbers", named(what, *body))]
    Overflow {
        /// The number.
        what: &'static str,
        /// Index of the first body whose number it is, where it is that of a body.
        body: Option<usize>,
        /// Time at the end of the step, s.
        time: f64,
    },
    /// A step broke a limit of [`Guard`](crate::world::Guard), and the policy is to stop or halving did not help.
    #[error("in the step to t = {time} s {breach}")]
    Breach {
        /// Time at the end of the step, s.
        time: f64,
        /// How.
        breach: Breach,
    },
}

impl StepError {
    /// The indices of the bodies that it speaks of.
    pub fn bodies(&self) -> Vec<usize> {
        match self {
            Self::StrainedBody { body, .. }
            | Self::NotFinite { body, .. }
            | Self::Breach { breach: Breach::Domain { body, .. }, .. } => vec![*body],
            Self::Overflow { body, .. } => body.iter().copied().collect(),
            Self::Breach { breach: Breach::Penetration { bodies, .. }, .. } => bodies.to_vec(),
            _ => Vec::new(),
        }
    }
}

/// Returns the words for a number of the whole step, or of one body.
fn named(what: &str, body: Option<usize>) -> String {
    body.map_or_else(|| format!("the {what}"), |body| format!("the {what} of body {body}"))
}
