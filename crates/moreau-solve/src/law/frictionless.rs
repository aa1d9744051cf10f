//! Signorini's condition without friction: 0 ≤ u_n + e u_n⁻ ⊥ r_n ≥ 0, r_T = 0 (eqs. 2, 5 and 21).

use super::{Acts, Approach, LawError, NormalForm, check_restitution, impact_shift};
use crate::Cone;

/// Unilateral contact without friction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "schema",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(deny_unknown_fields, default)
)]
pub struct Frictionless {
    /// Newton's coefficient e_n, 0 (no rebound) to 1.
    pub restitution: f64,
    /// When the contact acts.
    pub acts: Acts,
}

impl Frictionless {
    #[inline]
    pub(super) fn normal_form<const D: usize>(&self, contact: &Approach<D>) -> Option<NormalForm<D>> {
        let shift = impact_shift(contact, self.acts, self.restitution, 0.0)?;
        Some(NormalForm { cone: Cone::Signorini, shift })
    }

    pub(super) fn check(&self) -> Result<(), LawError> {
        check_restitution("restitution", self.restitution)
    }
}
