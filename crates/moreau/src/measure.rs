//! Granular measures of a world and the contacts of its last step, in the plane and in space; theory, section 22.
//!
//! They are pure functions. Contacts are those of [`Workspace::contacts`](crate::step::Workspace::contacts), sorted by key, and were found at
//! the predicted configuration, half a step before the world's positions. Impulses become forces by the time `h` in which they acted, see
//! [`StepRecord::h`](crate::step::StepRecord::h). Measures are of free bodies: driven ones are walls.
//!
//! Which contacts count is said by a [`Touch`]; a part of space is a [`Cell`] or a [`Grid`] of cells. Where a function takes contacts as an
//! iterator, any choice among them may be measured, as those of one region or one direction.

mod ball;
mod branch;
mod cell;
mod coordination;
mod fabric;
mod facets;
mod forces;
mod profile;
mod stress;
mod tensor;
mod touch;
mod volume;

pub use ball::ball_in;
pub use branch::branch;
pub use cell::{Cell, Grid};
pub use coordination::{Coordination, coordination};
pub use fabric::{branch_fabric, fabric};
pub use forces::{Histogram, histogram, mean, normal_forces, sliding_share};
pub use profile::{Slab, profile};
pub use stress::{stress_in, stress_of_bodies};
pub use tensor::{deviator, mean_stress, principal};
pub use touch::Touch;
pub use volume::{extent, solid_fraction, solid_fractions, volume, volume_in};

/// Why something cannot be measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasureError {
    /// A region without an inside.
    #[error("the region goes from {from} to {to} m along axis {axis}; both must be finite and the second greater")]
    Region {
        /// The axis, from 0.
        axis: usize,
        /// Its lower end, m.
        from: f64,
        /// Its upper end, m.
        to: f64,
    },
    /// A division into no parts.
    #[error("0 {what}; expected 1 or more")]
    NoParts {
        /// Of what there are none.
        what: &'static str,
    },
    /// An axis that is not there.
    #[error("axis {axis} in {dimension} dimensions; expected 0 to {}", dimension - 1)]
    Axis {
        /// The axis that was asked for.
        axis: usize,
        /// How many there are.
        dimension: usize,
    },
}
