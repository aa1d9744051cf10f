//! How good an answer is: one place, used by all solvers and owned by none.
//!
//! Three measures. The paper's ε_glob (eq. 42) is the mean over the contacts of
//!
//! - ε_motion = ‖ũ_c − u_c‖, the velocity ũ that the local solver claims against u = W r + q recomputed from all impulses; zero for
//!   methods that claim none (SBP and SAL);
//! - ε_bipotential = |ũ·r + μ r_n ‖ũ_T‖|, which vanishes if (ũ, r) obeys the law;
//! - ε_penetration = −min(0, ũ_n), with ‖ũ_T‖ added for a sticking contact, whose tangential velocity must vanish; the length of what is
//!   held of a bilateral constraint;
//!
//! and of a fourth part that the paper does not need, as its methods project:
//!
//! - ε_cone = w_c dist(r, K), the distance of the impulse from its cone as a velocity. It is zero for methods that project.
//!
//! It adds velocities and an energy, so its meaning changes with the units. The scaled residual does not:
//!
//! ```text
//! e_c = w_c ‖r − P_K(r − û/w_c)‖,  w_c = tr(W_cc)/D,  û = u + μ‖u_T‖ n,    scaled = √(Σ e_c²) / √(Σ' ‖q_c‖² + ‖u_c‖²)
//! ```
//!
//! with P_K the projection on the cone of impulses: e_c is a velocity, zero exactly at a solution, and the velocities without and with
//! impulses (of which only the normal part counts where there is no friction) are what it is compared with. Σ' limits what contacts
//! that stay open add: a wide gap divided by a short step would make any error small. Velocities here are those of the normal form, with
//! the shift added; with restitution they are 1 + e times the formal ones of eq. 21, so with one coefficient e ε_glob is never smaller than the paper's.
//! Of a rolling contact, spins and moments are first turned into velocities and impulses by an arm (theory (52)), for the same reason.
//!
//! The residual that Siconos reports takes 1 in the place of w_c, and so depends on the units:
//!
//! ```text
//! siconos = √(Σ ‖r − P_K(r − û)‖²) / max(‖q‖, ‖r‖, ‖u‖)
//! ```

mod certificate;
mod speeds;

pub use certificate::{EpsGlob, MOST_ERRORS, MOST_SCALED, Residual, Worst, larger};

use crate::block::{Matrix, Vector, axpy, dot, norm, sub, tangent_norm};
use crate::tasks::fold;
use crate::{Cone, Criterion, Operator, Problem};
use speeds::Speeds;
use std::ops::Range;

/// The four terms of ε_glob at contact `c`.
#[inline]
fn eps_glob<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    c: usize,
    claimed: &Vector<D>,
    u: &Vector<D>,
    r: &Vector<D>,
) -> EpsGlob {
    let cone = problem.cones[c];
    let slip = tangent_norm(claimed);
    let held = if cone == Cone::Sticking { slip } else { 0.0 };
    // A contact without friction has no law for its tangent.
    let (power, motion) = match cone {
        Cone::Signorini => (claimed[0] * r[0], (claimed[0] - u[0]).abs()),
        Cone::Coulomb(mu) => (dot(claimed, r) + mu * r[0] * slip, norm(&sub(claimed, u))),
        Cone::Sticking => (dot(claimed, r), norm(&sub(claimed, u))),
        Cone::Rolling { .. } => (dot(&cone.hat(claimed), r), norm(&sub(claimed, u))),
        Cone::Bilateral { .. } => return EpsGlob { cone: outside(problem, c, r), ..eps_glob_bilateral(cone, claimed, u, r) },
    };
    let cone = if is_within(cone, r) { 0.0 } else { outside(problem, c, r) };
    EpsGlob { motion, bipotential: power.abs(), penetration: positive(-claimed[0]) + held, cone }
}

/// True if `r` is in its cone but for the rounding of a projection. For the cones that are seldom it may say no.
#[inline(always)]
fn is_within<const D: usize>(cone: Cone, r: &Vector<D>) -> bool {
    const ROUNDED: f64 = 1.0 + 4.0 * f64::EPSILON;
    match cone {
        Cone::Signorini => r[0] >= 0.0 && r[1..].iter().all(|&x| x == 0.0),
        Cone::Coulomb(mu) => {
            r[0] >= 0.0 && r[1..].iter().map(|x| x * x).sum::<f64>() <= (ROUNDED * mu * r[0]) * (ROUNDED * mu * r[0])
        }
        Cone::Sticking => r[0] >= 0.0,
        Cone::Rolling { .. } | Cone::Bilateral { .. } => false,
    }
}

/// Returns w_c dist(r, K), m/s.
#[cold]
#[inline(never)]
fn outside<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, c: usize, r: &Vector<D>) -> f64 {
    let Measured { cone, w, r, .. } = in_one_unit(problem, c, &[0.0; D], r);
    w * cone.distance(&r)
}

/// The positive part; NaN stays NaN, which `f64::max` would hide.
#[inline(always)]
fn positive(x: f64) -> f64 {
    if x < 0.0 { 0.0 } else { x }
}

/// The same of a bilateral constraint: only what is held counts, and its velocity in whichever direction is a violation.
#[cold]
fn eps_glob_bilateral<const D: usize>(cone: Cone, claimed: &Vector<D>, u: &Vector<D>, r: &Vector<D>) -> EpsGlob {
    let (claimed, u) = (seen(cone, claimed), seen(cone, u));
    EpsGlob { motion: norm(&sub(&claimed, &u)), bipotential: dot(&claimed, r).abs(), penetration: norm(&claimed), cone: 0.0 }
}

/// The components that a bilateral constraint holds. Such constraints are few: kept out of the way of the many contacts.
#[cold]
fn held<const D: usize>(cone: Cone, u: &Vector<D>) -> Vector<D> {
    std::array::from_fn(|i| if cone.binds(i) { u[i] } else { 0.0 })
}

/// u, or of it what the law speaks of: the normal part without friction, the held components of a bilateral constraint.
#[inline]
fn seen<const D: usize>(cone: Cone, u: &Vector<D>) -> Vector<D> {
    match cone {
        Cone::Signorini => std::array::from_fn(|i| if i == 0 { u[0] } else { 0.0 }),
        Cone::Bilateral { .. } => held(cone, u),
        Cone::Coulomb(_) | Cone::Rolling { .. } | Cone::Sticking => *u,
    }
}

/// w ‖r − P_K(r − û/w)‖ at one contact.
#[inline(always)]
fn natural<const D: usize>(cone: Cone, w: f64, u: &Vector<D>, r: &Vector<D>) -> f64 {
    if matches!(cone, Cone::Signorini) && w > 0.0 && r[1..].iter().all(|&x| x == 0.0) {
        return (w * (r[0] - positive(r[0] - u[0] / w))).abs();
    }
    natural_in_cone(cone, w, u, r)
}

/// The same in any cone. A contact that impulses do not move, w = 0, leaves of it the distance of û to K*.
fn natural_in_cone<const D: usize>(cone: Cone, w: f64, u: &Vector<D>, r: &Vector<D>) -> f64 {
    let hat = cone.hat(&seen(cone, u));
    if w > 0.0 { w * norm(&sub(r, &cone.nearest(&axpy(r, -1.0 / w, &hat)))) } else { norm(&cone.nearest(&hat.map(|x| -x))) }
}

/// All measures at the impulses `r` for which `state` stands; `claimed` are the velocities that local solvers gave, if they do.
pub fn measure<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
    claimed: Option<&[Vector<D>]>,
) -> Residual {
    let parts = fold(0..problem.len(), &|range| measured(problem, state, r, claimed, range), &Measures::with);
    let Measures { eps, plain, motion, outside, power, speeds, pushes, errors, error, worst } = parts;
    let speeds = speeds.total();
    Residual {
        eps_glob: eps.mean(problem.len()),
        scaled: ratio(errors, speeds),
        error: error / problem.len().max(1) as f64,
        rounding: 64.0 * f64::EPSILON * if speeds > 0.0 { (pushes / speeds).sqrt() } else { 0.0 },
        siconos: plain.ratio(),
        motion: ratio(motion, speeds),
        cone: ratio(outside, speeds),
        complementarity: ratio(power, speeds),
        worst,
    }
}

/// The sums of all measures over some contacts.
#[derive(Clone, Copy, Default)]
struct Measures {
    eps: EpsGlob,
    plain: Plain,
    motion: f64,
    outside: f64,
    power: f64,
    speeds: Speeds,
    /// Σ (w_c ‖r_c‖)².
    pushes: f64,
    /// Σ e_c² and Σ e_c.
    errors: f64,
    error: f64,
    worst: Option<Worst>,
}

impl Measures {
    /// Both together.
    fn with(mut self, other: Self) -> Self {
        self.eps.add(&other.eps);
        self.plain.with(&other.plain);
        self.motion += other.motion;
        self.outside += other.outside;
        self.power += other.power;
        self.speeds.with(&other.speeds);
        self.pushes += other.pushes;
        self.errors += other.errors;
        self.error += other.error;
        other.worst.into_iter().for_each(|worst| self.meet(worst));
        self
    }

    /// Keeps the worse of two: also where one is no number, which no comparison would find.
    #[inline]
    fn meet(&mut self, other: Worst) {
        if self.worst.is_none_or(|worst| !worst.error.is_nan() && (other.error.is_nan() || other.error > worst.error)) {
            self.worst = Some(other);
        }
    }
}

fn measured<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
    claimed: Option<&[Vector<D>]>,
    range: Range<usize>,
) -> Measures {
    let mut all = Measures::default();
    for c in range {
        let velocity = problem.velocity(state, c);
        all.eps.add(&eps_glob(problem, c, claimed.map_or(&velocity, |claimed| &claimed[c]), &velocity, &r[c]));
        all.plain.add(problem, c, &velocity, &r[c]);
        let one = in_one_unit(problem, c, &velocity, &r[c]);
        if stays_open(&one) {
            all.speeds.add_open(&one.q, &one.u);
            all.meet(Worst { contact: c, error: 0.0 });
            continue;
        }
        let Measured { cone, w, q, u, r } = one;
        all.speeds.add(&q, &u);
        all.pushes += w * w * squared(&r);
        all.motion += claimed.map_or(0.0, |claimed| squared(&sub(&in_one_unit(problem, c, &claimed[c], &r).u, &u)));
        let half_line = D == 1 && !matches!(cone, Cone::Bilateral { .. });
        let (beyond, normalised) = if half_line { pair_of_one(w, u[0], r[0]) } else { pair_of_cones(cone, w, &u, &r) };
        all.outside += beyond * beyond;
        all.power += normalised * normalised;
        // A projection may turn NaN into zero; zero times what is not finite is NaN.
        let error = natural(cone, w, &u, &r) + 0.0 * (u.iter().sum::<f64>() + r.iter().sum::<f64>());
        all.errors += error * error;
        all.error += error;
        all.meet(Worst { contact: c, error });
    }
    all
}

/// w dist(r, K) + dist(û, K*), and w |û·r| / (w ‖r‖ + ‖û‖).
#[inline]
fn pair_of_cones<const D: usize>(cone: Cone, w: f64, u: &Vector<D>, r: &Vector<D>) -> (f64, f64) {
    let hat = cone.hat(u);
    let beyond = w * cone.distance(r) + norm(&cone.nearest(&hat.map(|x| -x)));
    let sizes = w * norm(r) + norm(&hat);
    // A size that is NaN is not zero.
    (beyond, if sizes == 0.0 { 0.0 } else { w * dot(&hat, r) / sizes })
}

/// The same of numbers: what is outside of a half line, and a product.
#[inline]
fn pair_of_one(w: f64, u: f64, r: f64) -> (f64, f64) {
    let sizes = w * r.abs() + u.abs();
    (w * positive(-r) + positive(-u), if sizes == 0.0 { 0.0 } else { w * u * r / sizes })
}

/// The sums of Siconos's residual.
#[derive(Clone, Copy, Default)]
struct Plain {
    errors: f64,
    qq: f64,
    rr: f64,
    uu: f64,
}

impl Plain {
    #[inline(always)]
    fn add<O: Operator<D>, const D: usize>(&mut self, problem: &Problem<'_, O, D>, c: usize, u: &Vector<D>, r: &Vector<D>) {
        let cone = problem.cones[c];
        let error = natural(cone, 1.0, u, r);
        self.errors += error * error;
        self.qq += squared(&seen(cone, &problem.q[c]));
        self.rr += squared(r);
        self.uu += squared(&seen(cone, u));
    }

    fn with(&mut self, other: &Self) {
        self.errors += other.errors;
        self.qq += other.qq;
        self.rr += other.rr;
        self.uu += other.uu;
    }

    fn ratio(&self) -> f64 {
        ratio(self.errors, larger(self.qq, larger(self.rr, self.uu)))
    }
}

/// The one number that is compared with the tolerance.
pub fn criterion<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
    claimed: Option<&[Vector<D>]>,
    which: Criterion,
) -> f64 {
    match which {
        Criterion::EpsGlob => mean_eps_glob(problem, state, r, claimed).total(),
        Criterion::Scaled => naturals::<O, D, true, false>(problem, state, r).0,
        Criterion::Siconos => naturals::<O, D, false, true>(problem, state, r).1,
        Criterion::Strict => {
            let (scaled, siconos) = naturals::<O, D, true, true>(problem, state, r);
            larger(scaled, siconos)
        }
    }
}

/// ε_glob (eq. 42) in its parts.
fn mean_eps_glob<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
    claimed: Option<&[Vector<D>]>,
) -> EpsGlob {
    let mut sum = EpsGlob::default();
    for c in 0..problem.len() {
        let u = problem.velocity(state, c);
        sum.add(&eps_glob(problem, c, claimed.map_or(&u, |claimed| &claimed[c]), &u, &r[c]));
    }
    sum.mean(problem.len())
}

/// The scaled residual and that of Siconos, those that are asked for.
fn naturals<O: Operator<D>, const D: usize, const SCALED: bool, const SICONOS: bool>(
    problem: &Problem<'_, O, D>,
    state: &O::State,
    r: &[Vector<D>],
) -> (f64, f64) {
    let (mut errors, mut speeds, mut plain) = (0.0, Speeds::default(), Plain::default());
    for c in 0..problem.len() {
        let velocity = problem.velocity(state, c);
        if SCALED {
            let one = in_one_unit(problem, c, &velocity, &r[c]);
            if stays_open(&one) {
                speeds.add_open(&one.q, &one.u);
            } else {
                let Measured { cone, w, q, u, r } = one;
                let error = natural(cone, w, &u, &r);
                errors += error * error;
                speeds.add(&q, &u);
            }
        }
        if SICONOS {
            plain.add(problem, c, &velocity, &r[c]);
        }
    }
    (ratio(errors, speeds.total()), plain.ratio())
}

/// √(a/b), zero where a is, NaN where one is not finite: a projection may make zero of what is no number, the sizes still show it.
fn ratio(a: f64, b: f64) -> f64 {
    match (a.is_finite() && b.is_finite(), a == 0.0) {
        (false, _) => f64::NAN,
        (true, true) => 0.0,
        (true, false) => (a / b).sqrt(),
    }
}

/// ‖a‖².
#[inline]
fn squared<const D: usize>(a: &Vector<D>) -> f64 {
    dot(a, a)
}

/// True if a contact carries nothing and is open without impulses and with them: it obeys its law whatever its gap is.
#[inline(always)]
fn stays_open<const D: usize>(Measured { cone, q, u, r, .. }: &Measured<D>) -> bool {
    let open = cone.may_open() && q[0] > 0.0 && u[0] > 0.0 && r.iter().all(|&x| x == 0.0);
    // What is no finite number is to be seen.
    open && squared(q) + squared(u) < f64::INFINITY
}

/// One contact as the scaled residual sees it.
struct Measured<const D: usize> {
    cone: Cone,
    w: f64,
    q: Vector<D>,
    u: Vector<D>,
    r: Vector<D>,
}

/// Only what the law knows of q, u and r, with w_c; of a rolling contact in velocities and impulses alone (theory (52)).
#[inline(always)]
fn in_one_unit<O: Operator<D>, const D: usize>(
    problem: &Problem<'_, O, D>,
    c: usize,
    u: &Vector<D>,
    r: &Vector<D>,
) -> Measured<D> {
    let (cone, q, block) = (problem.cones[c], &problem.q[c], problem.operator.diagonal(c));
    match cone {
        Cone::Signorini => Measured { cone, w: block[0][0], q: seen(cone, q), u: seen(cone, u), r: *r },
        Cone::Bilateral { .. } => Measured { cone, w: mean_diagonal(problem, c), q: seen(cone, q), u: seen(cone, u), r: *r },
        Cone::Rolling { mu, mu_r } => {
            let (w, arm) = arm(&block);
            let turned = |a: &Vector<D>, by: f64| std::array::from_fn(|i| if i >= D.div_ceil(2) { by * a[i] } else { a[i] });
            let cone = Cone::Rolling { mu, mu_r: mu_r / arm };
            Measured { cone, w, q: turned(q, arm), u: turned(u, arm), r: turned(r, 1.0 / arm) }
        }
        _ => Measured { cone, w: mean_diagonal(problem, c), q: *q, u: *u, r: *r },
    }
}

/// w_c, the mean diagonal of what the law knows of the block.
#[inline]
pub(crate) fn mean_diagonal<O: Operator<D>, const D: usize>(problem: &Problem<'_, O, D>, c: usize) -> f64 {
    let block = problem.operator.diagonal(c);
    if let cone @ Cone::Bilateral { .. } = problem.cones[c] {
        let held = (0..D).filter(|&i| cone.binds(i));
        return held.clone().map(|i| block[i][i]).sum::<f64>() / held.count().max(1) as f64;
    }
    let known = if problem.cones[c] == Cone::Signorini { 1 } else { D };
    (0..known).map(|i| block[i][i]).sum::<f64>() / known as f64
}

/// The mean diagonal of the normal and the sliding part, and the arm √(w/w_R) at which moments act like impulses.
fn arm<const D: usize>(block: &Matrix<D>) -> (f64, f64) {
    let first = D.div_ceil(2);
    let w = (0..first).map(|i| block[i][i]).sum::<f64>() / first as f64;
    let w_rolling = (first..D).map(|i| block[i][i]).sum::<f64>() / (D - first).max(1) as f64;
    (w, if w > 0.0 && w_rolling > 0.0 { (w / w_rolling).sqrt() } else { 1.0 })
}
