//! Contact laws: each becomes data, a normal form, before the solve.
//!
//! A law reads what a contact looks like before the step (gap, relative velocity, step length) and says which cone holds and by
//! which shift of the velocity. Newton's restitution through Moreau's formal velocity (eq. 21, times 1 + e) is the shift e·u⁻; acting
//! on approach is the shift max(0, gap)/h, by which the contact closes exactly.

mod coulomb;
mod frictionless;
mod sticking;

pub use coulomb::Coulomb;
pub use frictionless::Frictionless;
pub use sticking::Sticking;

use crate::{Cone, Row, block::Vector};

/// A law with its parameters. Adding one is a file, and a row here and in [`LAWS`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Law {
    /// Signorini's condition without friction.
    Frictionless(Frictionless),
    /// Signorini's condition with Coulomb friction.
    Coulomb(Coulomb),
    /// Signorini's condition with the tangential velocity held while the contact is closed.
    Sticking(Sticking),
}

/// The table of laws.
pub const LAWS: &[Row] = &[
    Row { name: "frictionless", about: "unilateral contact without friction (Signorini), with restitution" },
    Row { name: "coulomb", about: "unilateral contact with Coulomb friction, normal and tangential restitution" },
    Row { name: "sticking", about: "unilateral contact whose tangential velocity is held while it is closed" },
];

/// When a contact takes part in the step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Acts {
    /// When its predicted gap is closed (eqs. 4-5), as in the paper; or where it would get deeper than a tenth of the smaller body in the step, which
    /// would go through.
    Closed,
    /// Also before: u_n + max(0, gap)/h ≥ 0, so that the gap at the next predicted configuration closes and is not overshot.
    #[default]
    Approach,
}

/// What a law makes of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalForm<const D: usize> {
    /// The set that holds.
    pub cone: Cone,
    /// Added to the velocity, m/s: the law is written on u + shift.
    pub shift: Vector<D>,
}

/// What a law reads of one contact before the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach<const D: usize> {
    /// The predicted gap, m.
    pub gap: f64,
    /// Below this gap a contact counts as closed, m; rounding of positions must not open it.
    pub closed_below: f64,
    /// How deep a contact that acts when closed may be going to get in the step, m; one that would get deeper acts on approach. Infinite is the paper's rule.
    pub deepest: f64,
    /// The relative velocity u⁻ at the beginning of the step, m/s.
    pub before: Vector<D>,
    /// What rows of the end of the step add to the velocity at the end, and take from that at the beginning, m/s; zeros where the contact does not turn.
    pub remainder: Vector<D>,
    /// The length of the step, s.
    pub step: f64,
}

/// A parameter outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{parameter} = {value} is out of range: {range}")]
pub struct LawError {
    /// The parameter's name in scene files.
    pub parameter: &'static str,
    /// What was given.
    pub value: f64,
    /// What would be right.
    pub range: &'static str,
}

impl Law {
    /// The name of its row in [`LAWS`].
    pub fn name(&self) -> &'static str {
        match self {
            Law::Frictionless(_) => LAWS[0].name,
            Law::Coulomb(_) => LAWS[1].name,
            Law::Sticking(_) => LAWS[2].name,
        }
    }

    /// Normal form of one contact, or `None` where it takes no part in this step.
    #[inline]
    pub fn normal_form<const D: usize>(&self, contact: &Approach<D>) -> Option<NormalForm<D>> {
        match self {
            Law::Frictionless(law) => law.normal_form(contact),
            Law::Coulomb(law) => law.normal_form(contact),
            Law::Sticking(law) => law.normal_form(contact),
        }
    }

    /// When it acts.
    pub fn acts(&self) -> Acts {
        match self {
            Law::Frictionless(law) => law.acts,
            Law::Coulomb(law) => law.acts,
            Law::Sticking(law) => law.acts,
        }
    }

    /// Whether no contact of it ever carries a tangential impulse.
    pub fn is_frictionless(&self) -> bool {
        match self {
            Law::Frictionless(_) => true,
            Law::Coulomb(law) => law.friction == 0.0,
            Law::Sticking(_) => false,
        }
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// Names the first parameter outside its range: 0 ≤ e ≤ 1, μ ≥ 0 and finite.
    pub fn check(&self) -> Result<(), LawError> {
        match self {
            Law::Frictionless(law) => law.check(),
            Law::Coulomb(law) => law.check(),
            Law::Sticking(law) => law.check(),
        }
    }
}

/// The shift of all three laws: restitution where the contact is closed or would be crossed, else the gap that is left.
#[inline]
fn impact_shift<const D: usize>(contact: &Approach<D>, acts: Acts, e_n: f64, e_t: f64) -> Option<Vector<D>> {
    let closed = contact.gap <= contact.closed_below;
    // A body that would go through another in one step is never found closed.
    if !closed && acts == Acts::Closed && contact.gap + contact.step * contact.before[0] >= -contact.deepest {
        return None;
    }
    // On approach, Newton's law waits for the contact that its own velocity would close within the step: a body that
    // rebounds does so at full speed, not slowed by the gap that is left.
    let crossed = contact.gap + contact.step * contact.before[0] < 0.0;
    let mut shift = contact.remainder;
    if closed || (e_n > 0.0 && crossed) {
        // u⁻ in the rows of the beginning.
        shift[0] += e_n * (contact.before[0] - contact.remainder[0]);
        for i in 1..D {
            shift[i] += e_t * (contact.before[i] - contact.remainder[i]);
        }
    } else {
        shift[0] += contact.gap / contact.step;
    }
    Some(shift)
}

fn check_restitution(parameter: &'static str, value: f64) -> Result<(), LawError> {
    if (0.0..=1.0).contains(&value) { Ok(()) } else { Err(LawError { parameter, value, range: "a number from 0 to 1" }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FALLING: Approach<2> =
        Approach { gap: -1e-6, closed_below: 1e-12, deepest: 1e-2, before: [-2.0, 1.0], remainder: [0.0; 2], step: 1e-3 };

    #[test]
    fn newtons_law_is_a_shift() {
        let law =
            Law::Coulomb(Coulomb { friction: 0.3, restitution: 0.5, tangential_restitution: Some(0.25), acts: Acts::Closed });
        let form = law.normal_form(&FALLING).unwrap();
        assert_eq!(form, NormalForm { cone: Cone::Coulomb(0.3), shift: [-1.0, 0.25] });
        assert_eq!(law.normal_form(&Approach { gap: 1e-6, ..FALLING }), None);
    }

    #[test]
    fn the_tangential_coefficient_is_the_normal_one_where_none_is_given() {
        let law = Law::Coulomb(Coulomb { friction: 0.3, restitution: 0.5, ..Coulomb::default() });
        assert_eq!(law.normal_form(&FALLING).unwrap().shift, [-1.0, 0.5]);
    }

    #[test]
    fn on_approach_the_gap_is_closed_exactly() {
        let law = Law::Frictionless(Frictionless { restitution: 0.0, acts: Acts::Approach });
        let form = law.normal_form(&Approach { gap: 1e-3, ..FALLING }).unwrap();
        assert_eq!(form.shift, [1.0, 0.0]);
    }

    #[test]
    fn what_acts_when_closed_acts_earlier_where_it_would_get_too_deep() {
        let law = Law::Frictionless(Frictionless { restitution: 0.0, acts: Acts::Closed });
        let fast = Approach { gap: 1e-3, before: [-20.0, 1.0], ..FALLING };
        assert_eq!(law.normal_form(&fast).unwrap().shift, [1.0, 0.0]);
        assert_eq!(law.normal_form(&Approach { deepest: 1e-1, ..fast }), None);
    }

    #[test]
    fn each_law_is_in_the_table() {
        let laws = [
            Law::Frictionless(Frictionless { restitution: 0.0, acts: Acts::Closed }),
            Law::Coulomb(Coulomb { friction: 1.0, restitution: 0.0, tangential_restitution: None, acts: Acts::Closed }),
            Law::Sticking(Sticking { restitution: 0.0, acts: Acts::Closed }),
        ];
        assert_eq!(laws.map(|law| law.name()).as_slice(), LAWS.iter().map(|row| row.name).collect::<Vec<_>>());
    }
}
