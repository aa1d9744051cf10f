//! The law's errors (theory (38)) in a few lines that share nothing with the library: projections by bisection, sums over all of W.

use moreau_solve::Cone;

/// W by blocks.
pub(crate) type Dense<const D: usize> = Vec<Vec<[[f64; D]; D]>>;

/// What an answer is measured by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measured {
    /// The scaled residual.
    pub(crate) scaled: f64,
    /// Mean of e_c, m/s.
    pub(crate) error: f64,
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The nearest impulse with ‖part‖ ≤ μ r_n for each part of the tangent: the normal where the slope of the distance changes its sign.
fn nearest(tau: &[f64], parts: &[(std::ops::Range<usize>, f64)]) -> Vec<f64> {
    let slope = |n: f64| {
        let pull = |(range, mu): &(std::ops::Range<usize>, f64)| mu * (norm(&tau[range.clone()]) - mu * n).max(0.0);
        n - tau[0] - parts.iter().map(pull).sum::<f64>()
    };
    let (mut low, mut high) = (0.0, tau[0].abs() + parts.iter().map(|(range, mu)| mu * norm(&tau[range.clone()])).sum::<f64>());
    if slope(0.0) >= 0.0 {
        high = 0.0;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if slope(middle) > 0.0 { high = middle } else { low = middle }
    }
    let mut image = tau.to_vec();
    image[0] = high;
    for (range, mu) in parts {
        let length = norm(&tau[range.clone()]);
        if length > mu * high {
            range.clone().for_each(|i| image[i] *= mu * high / length);
        }
    }
    image
}

/// e_c and ‖q_c‖² + ‖u_c‖² of one contact with the diagonal `w` of its block, and whether it stays open.
fn contact(cone: Cone, w: &[f64], q: &[f64], u: &[f64], r: &[f64]) -> (f64, f64, bool) {
    let size = r.len();
    let mean = |range: &[usize]| range.iter().map(|&i| w[i]).sum::<f64>() / range.len().max(1) as f64;
    let all: Vec<usize> = (0..size).collect();
    let known: Vec<usize> = match cone {
        Cone::Signorini => vec![0],
        Cone::Bilateral { held } => all.iter().copied().filter(|&i| held >> i & 1 == 1).collect(),
        _ => all.clone(),
    };
    let split = size.div_ceil(2);
    let mut scale = mean(&known);
    let mut arm = vec![1.0; size];
    if let Cone::Rolling { .. } = cone {
        scale = mean(&all[..split]);
        let length = (scale / mean(&all[split..])).sqrt();
        arm[split..].fill(length);
    }
    let of = |x: &[f64]| -> Vec<f64> { (0..size).map(|i| if known.contains(&i) { arm[i] * x[i] } else { 0.0 }).collect() };
    let (q, mut u) = (of(q), of(u));
    let r: Vec<f64> = (0..size).map(|i| r[i] / arm[i]).collect();
    let carries = matches!(cone, Cone::Bilateral { .. } | Cone::Sticking) || norm(&r) > 0.0;
    let open = !carries && q[0] > 0.0 && u[0] > 0.0;
    let speeds = norm(&q).powi(2) + norm(&u).powi(2);
    let parts = match cone {
        Cone::Signorini => vec![(1..size, 0.0)],
        Cone::Coulomb(mu) => vec![(1..size, mu)],
        Cone::Rolling { mu, mu_r } => vec![(1..split, mu), (split..size, mu_r / arm[split])],
        Cone::Sticking | Cone::Bilateral { .. } => vec![],
    };
    u[0] += parts.iter().map(|(range, mu)| mu * norm(&u[range.clone()])).sum::<f64>();
    // What impulses do not move has no impulse to measure: u must be in the dual cone.
    let (scale, step) = if scale > 0.0 { (scale, 1.0 / scale) } else { (1.0, f64::INFINITY) };
    let tau: Vec<f64> = (0..size).map(|i| if step.is_finite() { r[i] - step * u[i] } else { -u[i] }).collect();
    let image = match cone {
        Cone::Bilateral { .. } => (0..size).map(|i| if known.contains(&i) { tau[i] } else { 0.0 }).collect(),
        _ => nearest(&tau, &parts),
    };
    let apart: Vec<f64> = (0..size).map(|i| if step.is_finite() { r[i] } else { 0.0 } - image[i]).collect();
    (scale * norm(&apart), speeds, open)
}

/// The measures of a flat answer: `diagonal`, `q`, `u` and `r` have `size` numbers a contact.
pub(crate) fn flat(size: usize, cones: &[Cone], diagonal: &[f64], q: &[f64], u: &[f64], r: &[f64]) -> Measured {
    let (mut squares, mut sum) = (0.0, 0.0);
    let (mut open, mut other) = (vec![], vec![]);
    for (c, &cone) in cones.iter().enumerate() {
        let at = |x: &[f64]| x[c * size..(c + 1) * size].to_vec();
        let (error, speed, is_open) = contact(cone, &at(diagonal), &at(q), &at(u), &at(r));
        squares += error * error;
        sum += error;
        if is_open { open.push(speed) } else { other.push(speed) }
    }
    let fastest = other.iter().copied().fold(0.0, f64::max);
    let speeds = other.iter().sum::<f64>() + open.iter().sum::<f64>().min(100.0 * open.len() as f64 * fastest);
    let scaled = if squares == 0.0 { 0.0 } else { (squares / speeds).sqrt() };
    Measured { scaled, error: sum / cones.len().max(1) as f64 }
}

/// The measures of an answer to a problem in dense blocks.
#[allow(dead_code, reason = "each test uses one of the two")]
pub(crate) fn dense<const D: usize>(w: &Dense<D>, q: &[[f64; D]], cones: &[Cone], r: &[[f64; D]]) -> Measured {
    let velocity = |c: usize, i: usize| {
        let wr: f64 = (0..r.len()).map(|d| (0..D).map(|j| w[c][d][i][j] * r[d][j]).sum::<f64>()).sum();
        q[c][i] + wr
    };
    let u: Vec<f64> = (0..r.len()).flat_map(|c| (0..D).map(move |i| (c, i))).map(|(c, i)| velocity(c, i)).collect();
    let diagonal: Vec<f64> = (0..r.len()).flat_map(|c| (0..D).map(move |i| (c, i))).map(|(c, i)| w[c][c][i][i]).collect();
    flat(D, cones, &diagonal, q.as_flattened(), &u, r.as_flattened())
}
