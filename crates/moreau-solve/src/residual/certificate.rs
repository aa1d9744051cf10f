//! The certificate of an answer, and the rule by which it counts as one.

use crate::Criterion;

/// Multiple of the tolerance that bounds the error in the law (theory (54a)) under a criterion that does not measure it: the mean of e_c
/// under ε_glob, and the scaled residual under Siconos's.
pub const MOST_ERRORS: f64 = 10.0;

/// Bound of the scaled residual under ε_glob and Siconos's criterion, whatever the tolerance. Both depend on units, and a tolerance may be
/// large for the velocities of a problem.
pub const MOST_SCALED: f64 = 1e-2;

/// The four parts of ε_glob, each a mean over the contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EpsGlob {
    /// Error in the equation of motion, m/s.
    pub motion: f64,
    /// Value of the bipotential, J.
    pub bipotential: f64,
    /// Velocity of interpenetration, m/s.
    pub penetration: f64,
    /// Distance of the impulses from their cones times w_c, m/s: zero for methods that project.
    pub cone: f64,
}

impl EpsGlob {
    /// Returns ε_glob itself, NaN where a part is not finite.
    pub fn total(&self) -> f64 {
        let total = self.motion + self.bipotential + self.penetration + self.cone;
        if total.is_finite() { total } else { f64::NAN }
    }

    #[inline]
    pub(super) fn add(&mut self, part: &Self) {
        self.motion += part.motion;
        self.bipotential += part.bipotential;
        self.penetration += part.penetration;
        self.cone += part.cone;
    }

    pub(super) fn mean(&self, contacts: usize) -> Self {
        let share = 1.0 / contacts.max(1) as f64;
        Self {
            motion: self.motion * share,
            bipotential: self.bipotential * share,
            penetration: self.penetration * share,
            cone: self.cone * share,
        }
    }
}

/// The contact with the largest e_c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Its index in the problem.
    pub contact: usize,
    /// Its e_c, m/s.
    pub error: f64,
}

/// The certificate of one answer: all measures of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// The paper's criterion in its parts.
    pub eps_glob: EpsGlob,
    /// The scaled residual, without units.
    pub scaled: f64,
    /// Mean of e_c over the contacts, m/s.
    pub error: f64,
    /// What rounding alone may make of the scaled residual: 64 ε √(Σ (w_c ‖r_c‖)²) / √(Σ' ‖q_c‖² + ‖u_c‖²). It is large where impulses hold
    /// each other in balance and nothing moves.
    pub rounding: f64,
    /// The residual that Siconos reports.
    pub siconos: f64,
    /// How far claimed velocities are from W r + q, in the scale of the scaled residual: √(Σ ‖ũ − u‖²) / √(Σ' ‖q‖² + ‖u‖²).
    pub motion: f64,
    /// How far impulses and velocities are from their cones, in the same scale: of w dist(r, K) + dist(û, K*).
    pub cone: f64,
    /// How far they are from being orthogonal, in the same scale: of w |û·r| / (w ‖r‖ + ‖û‖).
    pub complementarity: f64,
    /// Where the error is largest; `None` where there is no contact.
    pub worst: Option<Worst>,
}

impl Residual {
    /// Returns the number that `criterion` looks at.
    pub fn of(&self, criterion: Criterion) -> f64 {
        match criterion {
            Criterion::EpsGlob => self.eps_glob.total(),
            Criterion::Scaled => self.scaled,
            Criterion::Siconos => self.siconos,
            Criterion::Strict => larger(self.scaled, self.siconos),
        }
    }

    /// True if the answer counts as a solution: the rule behind [`Status::Converged`](crate::Status::Converged), theory (54a).
    ///
    /// The criterion is at most the tolerance, all measures are finite, and the law holds as computed from the impulses alone:
    ///
    /// - under `scaled` and `strict` that is what the criterion says;
    /// - under `siconos` the scaled residual is at most [`MOST_ERRORS`] times the tolerance, and at most [`MOST_SCALED`];
    /// - under `eps_glob` the mean of e_c is at most [`MOST_ERRORS`] times the tolerance, a velocity like it, and the scaled residual
    ///   is at most [`MOST_SCALED`], or at most what rounding makes of it.
    ///
    /// A tolerance above [`MOST_SCALED`] takes its place under `siconos`, which has no unit either.
    pub fn certifies(&self, criterion: Criterion, tolerance: f64) -> bool {
        self.is_finite() && self.hurdle(criterion, tolerance) <= tolerance
    }

    /// True if all measures are finite.
    pub fn is_finite(&self) -> bool {
        let Self { eps_glob, scaled, error, siconos, motion, cone, complementarity, worst, rounding: _ } = self;
        let worst = worst.map_or(0.0, |worst| worst.error);
        [eps_glob.total(), *scaled, *error, *siconos, *motion, *cone, *complementarity, worst].iter().all(|x| x.is_finite())
    }

    /// Returns the number that the rule compares with the tolerance: the criterion, or what the law says where that is larger.
    pub(crate) fn hurdle(&self, criterion: Criterion, tolerance: f64) -> f64 {
        let by_ceiling = self.scaled * (tolerance / MOST_SCALED);
        let law = match criterion {
            Criterion::EpsGlob if self.scaled <= self.rounding => self.error / MOST_ERRORS,
            Criterion::EpsGlob => larger(self.error / MOST_ERRORS, by_ceiling),
            Criterion::Siconos => larger(self.scaled / MOST_ERRORS, by_ceiling.min(self.scaled)),
            Criterion::Scaled | Criterion::Strict => 0.0,
        };
        larger(self.of(criterion), law)
    }
}

/// Returns the larger number, or NaN if one of them is NaN; `f64::max` would hide it.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
