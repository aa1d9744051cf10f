//! What a contact does, as files tell it.

use crate::step::Localised;
use moreau_solve::Cone;
use moreau_solve::block::tangent_norm;

/// Status of a contact in the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ContactStatus {
    /// No impulse.
    Open = 0,
    /// Pressed, without slip, or without friction at all.
    Sticking = 1,
    /// Pressed, on the edge of Coulomb's cone.
    Sliding = 2,
}

/// That of a solved contact.
pub(crate) fn status<const D: usize>(c: &Localised<D>) -> ContactStatus {
    if c.impulse == [0.0; D] {
        return ContactStatus::Open;
    }
    match c.form.cone {
        Cone::Coulomb(mu) if tangent_norm(&c.impulse) >= (1.0 - 1e-9) * mu * c.impulse[0] => ContactStatus::Sliding,
        _ => ContactStatus::Sticking,
    }
}
