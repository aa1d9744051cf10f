//! Eigenvalues of small symmetric matrices.

/// Of the diagonal: what is smaller beside it is rounding. Bodies with equal moments would be turned by it.
const NONE: f64 = 1e-13;

/// Eigenvalues and the right-handed unit eigenvectors of a symmetric matrix, by Jacobi's rotations. A matrix that is diagonal already keeps
/// its order.
pub(crate) fn diagonal<const D: usize>(mut s: [[f64; D]; D]) -> ([f64; D], [[f64; D]; D]) {
    let smallest = NONE * (0..D).map(|k| s[k][k].abs()).sum::<f64>();
    let mut axes = moreau_solve::block::identity();
    let pairs = (0..D).flat_map(|p| (p + 1..D).map(move |q| (p, q)));
    // Each round squares the error; six are more than enough.
    for (p, q) in std::iter::repeat_n(pairs, 8).flatten() {
        if s[p][q].abs() <= smallest {
            continue;
        }
        // The smaller root of t² + 2 t cot 2φ − 1 = 0.
        let cot = (s[q][q] - s[p][p]) / (2.0 * s[p][q]);
        let t = 1.0_f64.copysign(cot) / (cot.abs() + (cot * cot + 1.0).sqrt());
        let c = 1.0 / (t * t + 1.0).sqrt();
        let turn = |x: f64, y: f64| (c * (x - t * y), c * (y + t * x));
        for k in 0..D {
            (s[k][p], s[k][q]) = turn(s[k][p], s[k][q]);
        }
        for k in 0..D {
            (s[p][k], s[q][k]) = turn(s[p][k], s[q][k]);
            (axes[p][k], axes[q][k]) = turn(axes[p][k], axes[q][k]);
        }
    }
    (std::array::from_fn(|k| s[k][k]), axes)
}
