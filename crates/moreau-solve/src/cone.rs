//! The sets of pairs (u, r) that a contact allows, and the projections that the methods are made of.

use crate::block::{Matrix, Vector, identity, tangent_norm};

/// The law of one contact in normal form: which pairs of velocity u and impulse r it allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cone {
    /// Without friction: 0 ≤ u_n ⊥ r_n ≥ 0 and r_T = 0 (eqs. 2 and 5).
    Signorini,
    /// Coulomb's friction with the coefficient μ ≥ 0: K* ∋ u + μ‖u_T‖ n ⊥ r ∈ K_μ (eqs. 27-29).
    Coulomb(f64),
    /// The tangential velocity is held: u_T = 0 and 0 ≤ u_n ⊥ r_n ≥ 0, the impulses being a half space. It is Coulomb's cone for
    /// μ → ∞, and convex; the law that uses it decides by the gap whether a contact is held.
    Sticking,
}

impl Cone {
    /// The coefficient μ in front of ‖u_T‖ n; zero where the law has no such term.
    #[inline]
    pub fn friction(self) -> f64 {
        match self {
            Cone::Coulomb(mu) => mu,
            Cone::Signorini | Cone::Sticking => 0.0,
        }
    }

    /// The projection on the cone of impulses, of K_μ for Coulomb (eq. 29), with its derivative.
    #[inline]
    pub fn project<const D: usize>(self, tau: &Vector<D>) -> (Vector<D>, Matrix<D>) {
        match self {
            Cone::Coulomb(mu) if D > 1 => project_second_order(mu, tau),
            Cone::Coulomb(_) | Cone::Signorini => project_normal(tau, 0.0),
            Cone::Sticking => project_normal(tau, 1.0),
        }
    }

    /// The projection on C(μ max(0, τ_n)), the half cylinder of eq. 23 whose radius follows the normal part, with its derivative.
    #[inline]
    pub fn project_cylinder<const D: usize>(self, tau: &Vector<D>) -> (Vector<D>, Matrix<D>) {
        match self {
            Cone::Coulomb(mu) if D > 1 => project_disk(mu, tau),
            _ => self.project(tau),
        }
    }
}

/// ([τ_n]₊, keep·τ_T): the half line (keep = 0) or the half space (keep = 1).
#[inline]
fn project_normal<const D: usize>(tau: &Vector<D>, keep: f64) -> (Vector<D>, Matrix<D>) {
    let closed = f64::from(u8::from(tau[0] > 0.0));
    let weight = |i: usize| if i == 0 { closed } else { keep };
    let derivative = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { weight(i) } else { 0.0 }));
    (std::array::from_fn(|i| if weight(i) > 0.0 { tau[i] } else { 0.0 }), derivative)
}

/// The orthogonal projection on K_μ.
#[inline]
fn project_second_order<const D: usize>(mu: f64, tau: &Vector<D>) -> (Vector<D>, Matrix<D>) {
    let length = tangent_norm(tau);
    // The polar cone first: for μ = 0 and τ_T = 0 both tests hold of a pull.
    if mu * length <= -tau[0] {
        return ([0.0; D], [[0.0; D]; D]);
    }
    if length <= mu * tau[0] {
        return (*tau, identity());
    }
    // On the boundary: the component α along (1, μ s), s = τ_T/‖τ_T‖.
    let alpha = (tau[0] + mu * length) / (1.0 + mu * mu);
    let along: Vector<D> = std::array::from_fn(|i| if i == 0 { 1.0 } else { mu * tau[i] / length });
    let turn = mu * alpha / length;
    (along.map(|x| alpha * x), boundary_derivative(tau, length, turn, &along, |j| along[j] / (1.0 + mu * mu)))
}

/// The projection of τ_T on the disk of radius μ [τ_n]₊.
#[inline]
fn project_disk<const D: usize>(mu: f64, tau: &Vector<D>) -> (Vector<D>, Matrix<D>) {
    if tau[0] <= 0.0 {
        return ([0.0; D], [[0.0; D]; D]);
    }
    let length = tangent_norm(tau);
    if length <= mu * tau[0] {
        return (*tau, identity());
    }
    let along: Vector<D> = std::array::from_fn(|i| if i == 0 { 1.0 } else { mu * tau[i] / length });
    let turn = mu * tau[0] / length;
    (along.map(|x| tau[0] * x), boundary_derivative(tau, length, turn, &along, |j| f64::from(u8::from(j == 0))))
}

/// along ⊗ gradient + turn (I_T − s ⊗ s): moving along the boundary's ray, and turning with the direction of τ_T.
#[inline]
fn boundary_derivative<const D: usize>(
    tau: &Vector<D>,
    length: f64,
    turn: f64,
    along: &Vector<D>,
    gradient: impl Fn(usize) -> f64,
) -> Matrix<D> {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let ray = along[i] * gradient(j);
            if i == 0 || j == 0 {
                return ray;
            }
            let same = f64::from(u8::from(i == j));
            ray + turn * (same - tau[i] * tau[j] / (length * length))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::{dot, sub};
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
            for map in [Cone::project::<3>, Cone::project_cylinder::<3>] {
                let cone = Cone::Coulomb(mu);
                let step = 1e-6;
                let moved = |s: f64| { let mut t = tau; t[k] += s; map(cone, &t) };
                let ((ahead, d1), (behind, d0)) = (moved(step), moved(-step));
                let smooth = (0..3).all(|i| (0..3).all(|j| (d1[i][j] - d0[i][j]).abs() < 1e-3));
                prop_assume!(smooth); // no kink between the two points
                let (_, d) = map(cone, &tau);
                for i in 0..3 {
                    prop_assert!(((ahead[i] - behind[i]) / (2.0 * step) - d[i][k]).abs() < 1e-4);
                }
            }
        }
    }
}
