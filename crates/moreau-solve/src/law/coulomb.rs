//! Signorini's condition with Coulomb friction, ‖r_T‖ ≤ μ r_n, and Newton's restitution in both directions.

use super::{Acts, Approach, LawError, NormalForm, check_restitution, impact_shift};
use crate::Cone;

/// Unilateral contact with friction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "schema", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), serde(deny_unknown_fields))]
pub struct Coulomb {
    /// Coefficient of friction μ ≥ 0.
    pub friction: f64,
    /// Newton's coefficient e_n, 0 (no rebound) to 1.
    #[cfg_attr(feature = "schema", serde(default))]
    pub restitution: f64,
    /// Tangential coefficient e_t, 0 to 1; that of the normal where none is given, so that an impact makes no energy. 0 stops the tangent where it sticks, and an impact with
    /// restitution may then make energy.
    #[cfg_attr(feature = "schema", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tangential_restitution: Option<f64>,
    /// When the contact acts.
    #[cfg_attr(feature = "schema", serde(default))]
    pub acts: Acts,
}

impl Coulomb {
    #[inline]
    pub(super) fn normal_form<const D: usize>(&self, contact: &Approach<D>) -> Option<NormalForm<D>> {
        let tangential = self.tangential_restitution.unwrap_or(self.restitution);
        let shift = impact_shift(contact, self.acts, self.restitution, tangential)?;
        let cone = if self.friction == 0.0 { Cone::Signorini } else { Cone::Coulomb(self.friction) };
        Some(NormalForm { cone, shift })
    }

    pub(super) fn check(&self) -> Result<(), LawError> {
        if !(self.friction >= 0.0 && self.friction.is_finite()) {
            return Err(LawError { parameter: "friction", value: self.friction, range: "a finite number, 0 or more" });
        }
        check_restitution("restitution", self.restitution)?;
        check_restitution("tangential_restitution", self.tangential_restitution.unwrap_or(0.0))
    }
}
