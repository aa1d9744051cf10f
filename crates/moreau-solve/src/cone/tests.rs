//! Projections: closed forms, Moreau's decomposition, and derivatives against differences.

use super::*;
use crate::block::dot;
use proptest::prelude::*;

#[test]
fn a_cone_without_friction_does_not_pull() {
    for tau in [[-1.0, 0.0, 0.0], [-1.0, 0.5, 0.0], [0.0; 3]] {
        assert_eq!(Cone::Coulomb(0.0).project(&tau).0, [0.0; 3]);
    }
    assert_eq!(Cone::Coulomb(0.0).project(&[2.0, 0.5, 0.0]).0, [2.0, 0.0, 0.0]);
}

proptest! {
    /// Moreau's decomposition: τ = P + (τ − P), with τ − P in the polar cone and orthogonal to P.
    #[test]
    fn projection_splits_orthogonally(mu in 0.0..3.0f64, tau in prop::array::uniform3(-5.0..5.0f64)) {
        let (p, _) = Cone::Coulomb(mu).project(&tau);
        let rest = sub(&tau, &p);
        prop_assert!(tangent_norm(&p) <= mu * p[0] + 1e-12);
        prop_assert!(dot(&p, &rest).abs() < 1e-12);
        prop_assert!(mu * tangent_norm(&rest) <= -rest[0] + 1e-12);
    }

    #[test]
    fn derivatives_match_differences(mu in 0.05..2.0f64, tau in prop::array::uniform3(-5.0..5.0f64), k in 0usize..3) {
        derivative_matches(Cone::Coulomb(mu), tau, k)?;
    }

    #[test]
    fn rolling_projection_splits_orthogonally(m in limits(), tau in prop::array::uniform5(-5.0..5.0f64)) {
        splits(m, tau)?;
        splits(m, [tau[0], tau[1], tau[2]])?;
        // The apex, each part without length, and no contact at all.
        splits(m, [tau[0], 0.0, 0.0, tau[3], tau[4]])?;
        splits(m, [tau[0], tau[1], tau[2], 0.0, 0.0])?;
        splits(m, [tau[0], 0.0, 0.0])?;
        splits(m, [0.0; 5])?;
        // Neither dimension has a rolling contact; they have a meaning all the same.
        splits(m, [tau[0]])?;
        splits(m, [tau[0], tau[1]])?;
        splits(m, [tau[0], tau[1], tau[2], tau[3]])?;
    }

    #[test]
    fn rolling_derivatives_match_differences(m in limits(), tau in prop::array::uniform5(-5.0..5.0f64), k in 0usize..15) {
        derivative_matches(rolling(m), tau, k % 5)?;
        derivative_matches(rolling(m), [tau[0], tau[1], tau[2]], k % 3)?;
    }

    /// A subspace and its orthogonal complement: what is held of an impulse, and what is not of a velocity.
    #[test]
    fn a_bilateral_projection_splits_orthogonally(held in 0u8..8, tau in prop::array::uniform3(-5.0..5.0f64), k in 0usize..3) {
        let cone = Cone::Bilateral { held };
        let (p, dual) = (cone.nearest(&tau), cone.project_dual(&tau));
        let kept: Vector<3> = std::array::from_fn(|i| if held >> i & 1 == 1 { tau[i] } else { 0.0 });
        prop_assert!(p == kept && (0..3).all(|i| p[i] + dual[i] == tau[i]), "{p:?} and {dual:?} of {tau:?}");
        prop_assert!(cone.distance(&p) == 0.0 && cone.hat(&tau) == tau && dot(&p, &dual) == 0.0);
        derivative_matches(cone, tau, k)?;
    }

    /// Without rolling it is Coulomb's cone, with a bound for the rest that nothing reaches or that holds it at zero.
    #[test]
    fn rolling_contains_coulomb(mu in 0.0..3.0f64, tau in prop::array::uniform3(-5.0..5.0f64)) {
        let (p, _) = Cone::Coulomb(mu).project(&tau);
        let (x, _) = Cone::Rolling { mu, mu_r: 0.0 }.project(&[tau[0], tau[1], tau[2], 0.5, -0.5]);
        prop_assert!(norm(&sub(&x, &[p[0], p[1], p[2], 0.0, 0.0])) < 1e-12);
        let (x, _) = Cone::Rolling { mu: 0.0, mu_r: mu }.project(&[tau[0], 0.5, -0.5, tau[1], tau[2]]);
        prop_assert!(norm(&sub(&x, &[p[0], 0.0, 0.0, p[1], p[2]])) < 1e-12);
    }

    /// û lifts the normal by what makes û·r the power that the law leaves over, and its derivative is that of the formula.
    #[test]
    fn hat_and_its_derivative(m in limits(), u in prop::array::uniform5(-5.0..5.0f64), k in 0usize..5) {
        let cone = rolling(m);
        let lift = m[0] * u[1].hypot(u[2]) + m[1] * u[3].hypot(u[4]);
        prop_assert!((cone.hat(&u)[0] - u[0] - lift).abs() < 1e-12 && cone.hat(&u)[1..] == u[1..]);
        let step = 1e-6;
        let moved = |s: f64| { let mut v = u; v[k] += s; cone.hat(&v) };
        let d = cone.hat_derivative(&u);
        prop_assume!(u[1].hypot(u[2]) > 1e-2 && u[3].hypot(u[4]) > 1e-2);
        let (ahead, behind) = (moved(step), moved(-step));
        for i in 0..5 {
            prop_assert!(((ahead[i] - behind[i]) / (2.0 * step) - d[i][k]).abs() < 1e-4);
        }
    }
}

/// Coefficients, each zero in one case of four.
fn limits() -> impl Strategy<Value = [f64; 2]> {
    prop::array::uniform2(prop_oneof![1 => Just(0.0), 3 => 0.05..2.0f64])
}

fn rolling(m: [f64; 2]) -> Cone {
    Cone::Rolling { mu: m[0], mu_r: m[1] }
}

/// The projection and the rest are in the cone and in its polar cone, and orthogonal; that makes it the nearest point.
fn splits<const D: usize>(m: [f64; 2], tau: Vector<D>) -> Result<(), TestCaseError> {
    let cone = rolling(m);
    let (p, d) = cone.project(&tau);
    let (inside, rest) = (part_norms(&p), sub(&tau, &p));
    let outside = part_norms(&rest);
    prop_assert!(d.iter().flatten().all(|x| x.is_finite()), "{d:?}");
    prop_assert!((0..2).all(|k| inside[k] <= m[k] * p[0] + 1e-12), "{p:?} of {tau:?}");
    prop_assert!(dot(&p, &rest).abs() < 1e-11, "{p:?} of {tau:?}");
    prop_assert!(m[0] * outside[0] + m[1] * outside[1] <= -rest[0] + 1e-12, "{p:?} of {tau:?}");
    prop_assert!(norm(&sub(&cone.project_dual(&rest.map(|x| -x)), &rest.map(|x| -x))) < 1e-12);
    prop_assert!(cone.distance(&p) < 1e-12);
    Ok(())
}

/// Both projections against central differences, where no kink lies between the two points.
fn derivative_matches<const D: usize>(cone: Cone, tau: Vector<D>, k: usize) -> Result<(), TestCaseError> {
    for map in [Cone::project::<D>, Cone::project_cylinder::<D>] {
        let step = 1e-6;
        let moved = |s: f64| {
            let mut t = tau;
            t[k] += s;
            map(cone, &t)
        };
        let ((ahead, d1), (behind, d0)) = (moved(step), moved(-step));
        if (0..D).any(|i| (0..D).any(|j| (d1[i][j] - d0[i][j]).abs() >= 1e-3)) {
            continue;
        }
        let (_, d) = map(cone, &tau);
        for i in 0..D {
            prop_assert!(((ahead[i] - behind[i]) / (2.0 * step) - d[i][k]).abs() < 1e-4);
        }
    }
    Ok(())
}
