//! How forces are distributed over contacts; theory (78).

use super::{MeasureError, Touch};
use crate::step::Localised;
use moreau_solve::block::tangent_norm;

/// A tangential force this near to μ times the normal one, as a part of it, is sliding: a solver leaves its tolerance.
const NEAR: f64 = 1e-3;

/// The normal forces (N) of the contacts that carry one, which acted for the time `h` (s).
pub fn normal_forces<const D: usize>(contacts: &[Localised<D>], h: f64) -> Vec<f64> {
    Touch::Loaded.among(contacts).map(|c| c.impulse[0] / h).collect()
}

/// The mean; zero of nothing.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// A probability density of forces over their mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Width of a bin, in means.
    pub width: f64,
    /// Density by bin, the first from zero: width times the sum is the part of forces within the bins.
    pub density: Vec<f64>,
    /// The part of forces beyond the last bin.
    pub beyond: f64,
}

/// The histogram of forces over their mean, in bins of equal width from zero to `top` means; all zero where there are no forces.
///
/// # Errors
/// Where there are no bins, or `top` is not positive and finite.
pub fn histogram(forces: &[f64], bins: usize, top: f64) -> Result<Histogram, MeasureError> {
    super::cell::check_range(0, [0.0, top])?;
    if bins == 0 {
        return Err(MeasureError::NoParts { what: "bins of a histogram" });
    }
    let (mean, width) = (mean(forces), top / bins as f64);
    let (mut density, mut beyond) = (vec![0.0; bins], 0.0);
    for force in forces {
        match density.get_mut((force / mean / width) as usize) {
            Some(bin) => *bin += 1.0 / (width * forces.len() as f64),
            None => beyond += 1.0 / forces.len() as f64,
        }
    }
    Ok(Histogram { width, density, beyond })
}

/// Which part of the contacts that carry a force and have friction slides, or is about to: their tangential force is the most that friction
/// gives. Zero where there are none. Where forces are not unique, as of the points of a face, it is that of the forces that were found.
pub fn sliding_share<const D: usize>(contacts: &[Localised<D>]) -> f64 {
    let (mut sliding, mut all) = (0_u64, 0_u64);
    for c in Touch::Loaded.among(contacts) {
        let most = c.form.cone.friction() * c.impulse[0];
        if most > 0.0 {
            all += 1;
            sliding += u64::from(tangent_norm(&c.impulse) >= (1.0 - NEAR) * most);
        }
    }
    sliding as f64 / all.max(1) as f64
}
