//! Remainders of several points of one pair as those of one rigid motion (theory (86)).
//!
//! Two rigid bodies that touch at several points stick at all of them or slip: of the velocities at two points those along the line between them are equal. Remainders
//! differ from that by what is of second order, and a law that asks for velocities that no rigid motion has leaves impulses along that line without a limit. So the
//! remainders of the points that carry a pair become the nearest ones, by least squares, that a rigid motion δ has.

use crate::contacts::{Contact, ContactKey};
use crate::space::Space;
use moreau_solve::block::{axpy, dot, solve, sub};

/// Part of the mean square of arms that is added to the matrix, where points on one line leave the spin about it open.
const OPEN: f64 = 1e-13;

/// Fits one motion to the remainders of each pair of bodies, at those of its contacts that had an impulse in the step before.
pub(super) fn one_motion<S: Space<D, N>, const D: usize, const N: usize>(
    found: &[Contact<D>],
    previous: &[(ContactKey, [f64; D])],
    remainders: &mut [[f64; D]],
) {
    let mut first = 0;
    for pair in found.chunk_by(|a, b| (a.key.a, a.key.b) == (b.key.a, b.key.b)) {
        let part = &mut remainders[first..first + pair.len()];
        first += pair.len();
        if pair.len() > 1 && part.iter().any(|remainder| *remainder != [0.0; D]) {
            fit::<S, D, N>(pair, previous, part);
        }
    }
}

/// Fits one motion to the remainders of one pair.
fn fit<S: Space<D, N>, const D: usize, const N: usize>(
    pair: &[Contact<D>],
    previous: &[(ContactKey, [f64; D])],
    remainders: &mut [[f64; D]],
) -> Option<()> {
    let start = previous.partition_point(|(key, _)| *key < pair[0].key);
    let carries = |contact: &Contact<D>| {
        let before = previous[start..].iter().take_while(|(key, _)| *key <= contact.key).find(|(key, _)| *key == contact.key);
        before.is_some_and(|(_, impulse)| *impulse != [0.0; D])
    };
    let origin = &pair.iter().find(|contact| carries(contact))?.point;
    let row = |contact: &Contact<D>, k: usize| {
        S::row(S::IDENTITY, sub(&contact.point, origin), std::array::from_fn(|i| f64::from(u8::from(i == k))))
    };
    let (mut matrix, mut right, mut count) = ([[0.0; N]; N], [0.0; N], 0);
    for (contact, remainder) in pair.iter().zip(remainders.iter()).filter(|(contact, _)| carries(contact)) {
        count += 1;
        for k in 0..D {
            let row = row(contact, k);
            (0..N).for_each(|i| matrix[i] = axpy(&matrix[i], row[i], &row));
            right = axpy(&right, remainder[k], &row);
        }
    }
    if count < 2 {
        return None;
    }
    let mean = (D..N).map(|i| matrix[i][i]).sum::<f64>() / (N - D) as f64;
    (D..N).for_each(|i| matrix[i][i] += OPEN * mean);
    let motion = solve(&matrix, &right)?;
    for (contact, remainder) in pair.iter().zip(remainders).filter(|(contact, _)| carries(contact)) {
        *remainder = std::array::from_fn(|k| dot(&row(contact, k), &motion));
    }
    Some(())
}
