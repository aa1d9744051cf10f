//! Signorini's condition with the tangential velocity held at zero while the contact is closed: the balls of experiment 3 on their
//! plane (section 5.3). It is Coulomb's law without a limit of friction. Whether a contact is closed is decided by its predicted gap,
//! before the solve: to let it go by the sign of u_n, inside the solve, would make the law discontinuous in the impulses of the others, and sweeps may then never settle.

use super::{Acts, Approach, LawError, NormalForm, check_restitution, impact_shift};
use crate::Cone;

/// Unilateral contact that does not slip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(deny_unknown_fields, default)
)]
pub struct Sticking {
    /// Newton's coefficient e_n, 0 (no rebound) to 1.
    pub restitution: f64,
    /// When the contact acts.
    pub acts: Acts,
}

impl Sticking {
    #[inline]
    pub(super) fn normal_form<const D: usize>(&self, contact: &Approach<D>) -> Option<NormalForm<D>> {
        let shift = impact_shift(contact, self.acts, self.restitution, 0.0)?;
        // One that acts on approach is not held before it touches.
        let cone = if contact.gap <= contact.closed_below { Cone::Sticking } else { Cone::Signorini };
        Some(NormalForm { cone, shift })
    }

    pub(super) fn check(&self) -> Result<(), LawError> {
        check_restitution("restitution", self.restitution)
    }
}
