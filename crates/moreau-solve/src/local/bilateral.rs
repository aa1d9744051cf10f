//! Bilateral constraints: u_i = 0 for the components that are held, r_i = 0 for the others (theory (55)).
//!
//! What is not held has no part in the visit. Its row and column of W are cut out (set to zero), and the methods see the held components
//! alone: the projection leaves them as they are, so SBP and SAL take plain gradient steps and EBP and EAL end in one round of Newton's
//! method. PDAS and Exact solve W_hh Δr_h = −u_h at once: with no inequality there are no sets to find.

use super::{IMMOVABLE, Visit, exact, moved, separated};
use crate::Cone;
use crate::block::{Matrix, Vector, axpy, dot, row_sum_norm, solve_definite, sub, velocity_after};
use crate::cone::is_held;

/// `visit` in the held components alone. Out of line and by value, for the sake of the other laws' visits.
#[cold]
#[inline(never)]
pub(super) fn cut<const D: usize>(
    w: Matrix<D>,
    held: u8,
    u: Vector<D>,
    r: Vector<D>,
    visit: impl FnOnce(&Matrix<D>, Cone, &Vector<D>, &Vector<D>) -> Visit<D>,
) -> Visit<D> {
    let only = |a: &Vector<D>| std::array::from_fn(|i| if is_held(held, i) { a[i] } else { 0.0 });
    let block = std::array::from_fn(|i| if is_held(held, i) { only(&w[i]) } else { [0.0; D] });
    let visit = visit(&block, Cone::Bilateral { held }, &only(&u), &only(&r));
    // What is not held moves with the impulse all the same.
    let after = velocity_after(&w, &u, &r, &visit.r);
    Visit { u: std::array::from_fn(|i| if is_held(held, i) { visit.u[i] } else { after[i] }), ..visit }
}

/// The visit that brings what is held to rest.
pub(super) fn hold<const D: usize>(w: Matrix<D>, held: u8, u: Vector<D>, r: Vector<D>) -> Visit<D> {
    cut(w, held, u, r, |w, cone, u, r| {
        let size = row_sum_norm(w);
        if size < IMMOVABLE {
            let still = *u == [0.0; D];
            return Visit { converged: still, ..separated(w, u, r) };
        }
        // A one in the place of each zero row, so that the block is regular where the held part is.
        let mut regular = *w;
        (0..D).filter(|&i| !is_held(held, i)).for_each(|i| regular[i][i] = size);
        let plain = solve_definite(&regular, u).filter(|change| dot(change, change).is_finite());
        let r_new = plain.map(|change| sub(r, &change)).or_else(|| Some(axpy(r, 1.0, &exact::at_rest(regular, *u)?)));
        match r_new {
            Some(r) => Visit { r, u: [0.0; D], converged: true },
            // Nothing brings it to rest: a step of the gradient goes as far as there is to go.
            None => Visit { converged: false, ..moved(w, u, r, cone.nearest(&axpy(r, -1.0 / size, u))) },
        }
    })
}
