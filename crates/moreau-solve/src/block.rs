//! Small fixed vectors and blocks: the arithmetic of one contact.

/// Velocity or impulse of a contact, normal first.
pub type Vector<const D: usize> = [f64; D];

/// A block of the Delassus operator, by rows.
pub type Matrix<const D: usize> = [[f64; D]; D];

/// a · b.
#[inline]
pub fn dot<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    // From the first product, not from zero: in a sweep each addition is waited for.
    let mut sum = a[0] * b[0];
    for i in 1..D {
        sum += a[i] * b[i];
    }
    sum
}

/// a + s b.
#[inline]
pub fn axpy<const D: usize>(a: &Vector<D>, s: f64, b: &Vector<D>) -> Vector<D> {
    std::array::from_fn(|i| a[i] + s * b[i])
}

/// a − b.
#[inline]
pub fn sub<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> Vector<D> {
    std::array::from_fn(|i| a[i] - b[i])
}

/// ‖a‖.
#[inline]
pub fn norm<const D: usize>(a: &Vector<D>) -> f64 {
    dot(a, a).sqrt()
}

/// ‖a_T‖, the length of the tangential part.
#[inline]
pub fn tangent_norm<const D: usize>(a: &Vector<D>) -> f64 {
    let mut sum = 0.0;
    for i in 1..D {
        sum += a[i] * a[i];
    }
    sum.sqrt()
}

/// W r.
#[inline]
pub fn mul<const D: usize>(w: &Matrix<D>, r: &Vector<D>) -> Vector<D> {
    std::array::from_fn(|i| dot(&w[i], r))
}

/// u + W (r⁺ − r): the velocity after the impulse of this contact alone has changed.
#[inline]
pub fn velocity_after<const D: usize>(w: &Matrix<D>, u: &Vector<D>, r: &Vector<D>, r_new: &Vector<D>) -> Vector<D> {
    let change = sub(r_new, r);
    std::array::from_fn(|i| u[i] + dot(&w[i], &change))
}

/// The greatest absolute row sum: a bound of the spectral radius.
#[inline]
pub fn row_sum_norm<const D: usize>(w: &Matrix<D>) -> f64 {
    w.iter().map(|row| row.iter().map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max)
}

/// The same bound for the tangential block alone.
#[inline]
pub fn tangent_row_sum_norm<const D: usize>(w: &Matrix<D>) -> f64 {
    w.iter().skip(1).map(|row| row.iter().skip(1).map(|x| x.abs()).sum::<f64>()).fold(0.0, f64::max)
}

/// The solution x of A x = b by elimination with partial pivoting; `None` where A is singular.
#[inline(always)]
pub fn solve<const D: usize>(a: &Matrix<D>, b: &Vector<D>) -> Option<Vector<D>> {
    let (mut a, mut b) = (*a, *b);
    for k in 0..D {
        let pivot = (k..D).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        a.swap(k, pivot);
        b.swap(k, pivot);
        if a[k][k] == 0.0 || !a[k][k].is_finite() {
            return None;
        }
        for i in k + 1..D {
            let factor = a[i][k] / a[k][k];
            for j in k..D {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..D).rev() {
        for j in k + 1..D {
            b[k] -= a[k][j] * b[j];
        }
        b[k] /= a[k][k];
    }
    Some(b)
}

/// The solution x of W x = b for a positive definite block, by L D Lᵀ without pivots; `None` where a pivot is not positive.
#[inline]
pub fn solve_definite<const D: usize>(w: &Matrix<D>, b: &Vector<D>) -> Option<Vector<D>> {
    let mut l = [[0.0; D]; D];
    let mut inverse = [0.0; D];
    let mut x = *b;
    for i in 0..D {
        let mut pivot = w[i][i];
        for j in 0..i {
            // l[i][j] holds L_ij d_j until it is divided.
            let mut scaled = w[i][j];
            for k in 0..j {
                scaled -= l[j][k] * l[i][k];
            }
            l[i][j] = scaled;
        }
        for j in 0..i {
            let scaled = l[i][j];
            l[i][j] = scaled * inverse[j];
            pivot -= scaled * l[i][j];
            x[i] -= l[i][j] * x[j];
        }
        if pivot <= 0.0 || pivot.is_nan() {
            return None;
        }
        inverse[i] = 1.0 / pivot;
    }
    for i in (0..D).rev() {
        x[i] *= inverse[i];
        for k in i + 1..D {
            x[i] -= l[k][i] * x[k];
        }
    }
    Some(x)
}

/// The identity.
pub fn identity<const D: usize>() -> Matrix<D> {
    std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_solutions_solve() {
        let w = [[4.0, -1.0, 0.5], [-1.0, 3.0, 0.25], [0.5, 0.25, 2.0]];
        let b = [1.0, -2.0, 3.0];
        for x in [solve(&w, &b), solve_definite(&w, &b)] {
            let error = sub(&mul(&w, &x.expect("regular")), &b);
            assert!(norm(&error) < 1e-14, "{error:?}");
        }
        assert_eq!(solve_definite(&[[1.0, 2.0], [2.0, 1.0]], &[1.0, 1.0]), None);
        assert_eq!(solve(&[[1.0, 2.0], [2.0, 4.0]], &[1.0, 1.0]), None);
    }
}
