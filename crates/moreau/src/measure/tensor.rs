//! Numbers of a tensor.

use crate::symmetric::diagonal;
use moreau_solve::block::Matrix;

/// Eigenvalues of the symmetric part, the greatest first, and its unit eigenvectors in the same order.
pub fn principal<const D: usize>(tensor: &Matrix<D>) -> ([f64; D], [[f64; D]; D]) {
    let symmetric = std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (tensor[i][j] + tensor[j][i])));
    let (values, axes) = diagonal(symmetric);
    let mut order: [usize; D] = std::array::from_fn(|k| k);
    order.sort_by(|&i, &j| values[j].total_cmp(&values[i]));
    (order.map(|k| values[k]), order.map(|k| axes[k]))
}

/// The mean of the principal values: of a stress the pressure.
pub fn mean_stress<const D: usize>(tensor: &Matrix<D>) -> f64 {
    (0..D).map(|k| tensor[k][k]).sum::<f64>() / D as f64
}

/// The size of what differs from the isotropic part, of the symmetric part, theory (77): where all principal values but one are equal, the
/// difference between that one and the others. Of a stress the deviator q, of a fabric tensor its anisotropy.
pub fn deviator<const D: usize>(tensor: &Matrix<D>) -> f64 {
    let mean = mean_stress(tensor);
    let mut square = 0.0;
    for i in 0..D {
        for j in 0..D {
            let s = 0.5 * (tensor[i][j] + tensor[j][i]) - if i == j { mean } else { 0.0 };
            square += s * s;
        }
    }
    (square * D as f64 / (D - 1) as f64).sqrt()
}
