//! The sets of pairs (u, r) that a contact allows, and the projections that the methods are made of.

mod rolling;
#[cfg(test)]
mod tests;

pub(crate) use rolling::{part, part_norms};

use crate::block::{Matrix, Vector, axpy, identity, norm, sub, tangent_norm};

/// The law of one contact in normal form: which pairs of velocity u and impulse r it allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cone {
    /// Without friction: 0 ≤ u_n ⊥ r_n ≥ 0 and r_T = 0 (eqs. 2 and 5).
    Signorini,
    /// Coulomb's friction with the coefficient μ ≥ 0: K* ∋ u + μ‖u_T‖ n ⊥ r ∈ K_μ (eqs. 27-29).
    Coulomb(f64),
    /// Coulomb's friction with rolling friction: components `[n, t₁, t₂, ρ₁, ρ₂]` in space and `[n, t, ρ]` in the plane, of which the
    /// last are relative spins and the moments' impulses. K = {r : ‖r_T‖ ≤ μ r_n, ‖r_R‖ ≤ μ_r r_n} and
    /// K* ∋ u + (μ‖u_T‖ + μ_r‖u_R‖) n ⊥ r ∈ K (Acary & Bourrier 2021; theory (48)). With D components T is 1 … (D+1)/2 − 1 and R the
    /// rest: one component is Signorini's law, two are a normal and a moment.
    Rolling {
        /// The coefficient μ ≥ 0 of sliding.
        mu: f64,
        /// The coefficient μ_r ≥ 0 of rolling, a length where R are moments.
        mu_r: f64,
    },
    /// The tangential velocity is held: u_T = 0 and 0 ≤ u_n ⊥ r_n ≥ 0, the impulses being a half space. It is Coulomb's cone for
    /// μ → ∞, and convex; the law that uses it decides by the gap whether a contact is held.
    Sticking,
    /// A bilateral constraint, as of a joint: u_i = 0 and r_i free for each component i that is held, r_i = 0 and u_i free for the
    /// others. K is the subspace of the held components and K* that of the others (theory (55)).
    Bilateral {
        /// Bit i says that component i is held.
        held: u8,
    },
}

impl Cone {
    /// The coefficient μ in front of ‖u_T‖ n; zero where the law has no such term.
    #[inline]
    pub fn friction(self) -> f64 {
        match self {
            Cone::Coulomb(mu) | Cone::Rolling { mu, .. } => mu,
            Cone::Signorini | Cone::Sticking | Cone::Bilateral { .. } => 0.0,
        }
    }

    /// Whether the law says anything of component i of the velocity; if not, that component of the impulse is zero.
    #[inline]
    pub fn binds(self, i: usize) -> bool {
        match self {
            Cone::Signorini => i == 0,
            Cone::Bilateral { held } => is_held(held, i),
            Cone::Coulomb(_) | Cone::Rolling { .. } | Cone::Sticking => true,
        }
    }

    /// Whether a contact that carries nothing obeys the law at any velocity that opens it; what is held never does.
    #[inline]
    pub(crate) fn may_open(self) -> bool {
        matches!(self, Cone::Signorini | Cone::Coulomb(_) | Cone::Rolling { .. })
    }

    /// û, the velocity with de Saxcé's correction, m/s: the law is K* ∋ û ⊥ r ∈ K. It is u + μ‖u_T‖ n for Coulomb (eq. 28),
    /// u + (μ‖u_T‖ + μ_r‖u_R‖) n with rolling, and u itself for the laws whose cone needs none.
    #[inline(always)]
    pub fn hat<const D: usize>(self, u: &Vector<D>) -> Vector<D> {
        let mut hat = *u;
        match self {
            Cone::Coulomb(mu) => hat[0] += mu * tangent_norm(u),
            Cone::Rolling { mu, mu_r } => hat[0] += rolling::lift(mu, mu_r, *u),
            Cone::Signorini | Cone::Sticking | Cone::Bilateral { .. } => {}
        }
        hat
    }

    /// g in ∂û/∂u = I + n ⊗ g. At rest the direction is free, and none is taken.
    #[inline(always)]
    pub fn hat_gradient<const D: usize>(self, u: &Vector<D>) -> Vector<D> {
        match self {
            Cone::Coulomb(mu) => {
                let slip = tangent_norm(u);
                std::array::from_fn(|j| if j > 0 && slip > 0.0 { mu * u[j] / slip } else { 0.0 })
            }
            Cone::Rolling { mu, mu_r } => rolling::hat_gradient(mu, mu_r, *u),
            Cone::Signorini | Cone::Sticking | Cone::Bilateral { .. } => [0.0; D],
        }
    }

    /// ∂û/∂u; see [`hat_gradient`](Self::hat_gradient).
    #[inline]
    pub fn hat_derivative<const D: usize>(self, u: &Vector<D>) -> Matrix<D> {
        let mut derivative = identity();
        derivative[0] = axpy(&derivative[0], 1.0, &self.hat_gradient(u));
        derivative
    }

    /// The projection on the cone of impulses, of K_μ for Coulomb (eq. 29), with an element of its generalised
    /// derivative, which is the derivative where there is one.
    #[inline(always)]
    pub fn project<const D: usize>(self, tau: &Vector<D>) -> (Vector<D>, Matrix<D>) {
        match self {
            Cone::Coulomb(mu) if D > 1 => project_second_order(mu, tau),
            Cone::Coulomb(_) | Cone::Signorini => project_normal(tau, 0.0),
            Cone::Rolling { mu, mu_r } => {
                let (value, derivative) = rolling::project(mu, mu_r, *tau);
                (value, derivative)
            }
            Cone::Sticking => project_normal(tau, 1.0),
            Cone::Bilateral { held } => project_held(held, tau),
        }
    }

    /// The projection on C(μ max(0, τ_n)), the half cylinder of eq. 23 whose radius follows the normal part, with its derivative. With
    /// rolling two disks follow it.
    #[inline(always)]
    pub fn project_cylinder<const D: usize>(self, tau: &Vector<D>) -> (Vector<D>, Matrix<D>) {
        match self {
            Cone::Coulomb(mu) if D > 1 => project_disk(mu, tau),
            Cone::Rolling { mu, mu_r } => {
                let (value, derivative) = rolling::project_cylinder(mu, mu_r, *tau);
                (value, derivative)
            }
            _ => self.project(tau),
        }
    }

    /// The projection of [`project`](Self::project) alone: what is not asked for is not computed.
    #[inline(always)]
    pub fn nearest<const D: usize>(self, tau: &Vector<D>) -> Vector<D> {
        match self {
            Cone::Coulomb(mu) if D > 1 => project_second_order(mu, tau).0,
            Cone::Coulomb(_) | Cone::Signorini => project_normal(tau, 0.0).0,
            Cone::Rolling { mu, mu_r } => rolling::project(mu, mu_r, *tau).0,
            Cone::Sticking => project_normal(tau, 1.0).0,
            Cone::Bilateral { held } => project_held(held, tau).0,
        }
    }

    /// The projection of [`project_cylinder`](Self::project_cylinder) alone.
    #[inline(always)]
    pub fn nearest_in_cylinder<const D: usize>(self, tau: &Vector<D>) -> Vector<D> {
        match self {
            Cone::Coulomb(mu) if D > 1 => project_disk(mu, tau).0,
            Cone::Rolling { mu, mu_r } => rolling::project_cylinder(mu, mu_r, *tau).0,
            _ => self.nearest(tau),
        }
    }

    /// The projection of a velocity on the dual cone K*, by Moreau's decomposition: x + P_K(−x).
    #[inline(always)]
    pub fn project_dual<const D: usize>(self, x: &Vector<D>) -> Vector<D> {
        axpy(x, 1.0, &self.nearest(&x.map(|x| -x)))
    }

    /// The distance of an impulse to the cone K, N·s.
    #[inline]
    pub fn distance<const D: usize>(self, r: &Vector<D>) -> f64 {
        norm(&sub(r, &self.nearest(r)))
    }
}

/// ([τ_n]₊, keep·τ_T): the half line (keep = 0) or the half space (keep = 1).
#[inline(always)]
fn project_normal<const D: usize>(tau: &Vector<D>, keep: f64) -> (Vector<D>, Matrix<D>) {
    let closed = f64::from(u8::from(tau[0] > 0.0));
    let weight = |i: usize| if i == 0 { closed } else { keep };
    let derivative = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { weight(i) } else { 0.0 }));
    (std::array::from_fn(|i| if weight(i) > 0.0 { tau[i] } else { 0.0 }), derivative)
}

/// Whether bit i of `held` is set.
#[inline]
pub(crate) fn is_held(held: u8, i: usize) -> bool {
    held.checked_shr(i as u32).is_some_and(|bits| bits & 1 == 1)
}

/// The projection on the subspace of the held components.
#[inline]
fn project_held<const D: usize>(held: u8, tau: &Vector<D>) -> (Vector<D>, Matrix<D>) {
    let keep = |i: usize| f64::from(u8::from(is_held(held, i)));
    let derivative = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { keep(i) } else { 0.0 }));
    (std::array::from_fn(|i| if is_held(held, i) { tau[i] } else { 0.0 }), derivative)
}

/// The orthogonal projection on K_μ.
#[inline(always)]
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
#[inline(always)]
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
