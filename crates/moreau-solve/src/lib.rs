//! Solvers for friction-contact problems, free of bodies, shapes, clocks and files.
//!
//! For contacts c = 1 … N, find impulses r and velocities u with
//!
//! ```text
//! u = W r + q,      (u_c, r_c) in the contact law of c
//! ```
//!
//! where W is the Delassus operator (eq. 17 of Barboteu & Dumont 2017). Components are ordered normal first: `[n, t]` for `D = 2`,
//! `[n, t₁, t₂]` for `D = 3`. `D = 1` is a problem without friction, of which only the normals are left. With rolling friction the
//! relative spins follow: `[n, t, ρ]` for `D = 3`, `[n, t₁, t₂, ρ₁, ρ₂]` for `D = 5`. u_n > 0 separates, r_n ≥ 0
//! pushes. [`Cone`] names the laws, [`Problem`] holds one problem, [`solve`] solves it and returns a [`Report`].
//!
//! ```
//! use moreau_solve::{Cone, Delassus, Problem, Settings, Status, solve};
//!
//! // One contact: a body of mass 2 falls at 3 m/s onto a rough floor while it slides at 1 m/s.
//! let w = Delassus::dense(&[vec![[[0.5, 0.0], [0.0, 0.5]]]]);
//! let problem = Problem { operator: &w, q: &[[-3.0, 1.0]], cones: &[Cone::Coulomb(0.1)] };
//! let mut r = [[0.0, 0.0]];
//! let report = solve(&problem, &Settings::default(), &mut r, &mut Default::default());
//! assert_eq!(report.status, Status::Converged);
//! assert!((r[0][0] - 6.0).abs() < 1e-12 && (r[0][1] + 0.6).abs() < 1e-12);
//! ```

// Bits must not depend on the system's mathematics library; see docs/determinism.md.
#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod block;
mod cone;
#[cfg(feature = "files")]
pub mod files;
pub mod global;
pub mod law;
pub mod local;
pub mod operator;
mod order;
mod problem;
mod report;
pub mod residual;
mod settings;
pub mod tasks;
mod wide;

pub use cone::Cone;
pub use global::{GlobalMethod, Scratch, certify, solve, solve_until};
pub use law::{Acts, Law, NormalForm};
pub use local::LocalMethod;
pub use operator::{Balls, Delassus, MatrixFree, Operator};
pub use order::Order;
pub use problem::Problem;
pub use report::{HistoryRow, Report, Stage, Status};
pub use residual::{EpsGlob, Residual, Worst};
pub use settings::{CRITERIA, Criterion, Parameter, Resolved, Settings, SettingsError};
pub use wide::Kernels;

/// One line of a table of what can be named in a scene: laws, solvers, shapes, outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// The name in scene files and on the command line.
    pub name: &'static str,
    /// What it is, in one line.
    pub about: &'static str,
}

// The program of the README is run with the tests.
#[cfg(all(doctest, feature = "files"))]
#[doc = include_str!("../README.md")]
struct Readme;
