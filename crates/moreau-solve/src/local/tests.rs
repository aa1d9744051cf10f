//! Conformance: every row of the table of local solvers, in every dimension, with every law, against the exact reference.

mod built;
mod degenerate;

use super::*;
use crate::block::{dot, mul, norm, tangent_norm};
use crate::{Criterion, Delassus, Parameter, Problem, Status, solve};
use proptest::prelude::*;

/// A positive definite block from a lower triangle with a positive diagonal; `coupling` scales what lies off it.
fn block<const D: usize>(numbers: &[f64], coupling: f64) -> Matrix<D> {
    let l: Matrix<D> = std::array::from_fn(|i| {
        std::array::from_fn(|j| match i.cmp(&j) {
            std::cmp::Ordering::Equal => 0.3 + numbers[i].abs(),
            std::cmp::Ordering::Greater => coupling * numbers[3 + i + j],
            std::cmp::Ordering::Less => 0.0,
        })
    });
    std::array::from_fn(|i| std::array::from_fn(|j| dot(&l[i], &l[j])))
}

/// A coefficient of friction below W_nn/‖W_nT‖, from which a contact can jam (Painlevé): two answers may then hold at once.
fn jamming<const D: usize>(w: &Matrix<D>) -> f64 {
    0.9 * w[0][0] / tangent_norm(&w[0])
}

fn numbers() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0f64, 9)
}

/// One contact, solved by repeated visits.
fn one_contact<const D: usize>(method: LocalMethod, w: Matrix<D>, q: Vector<D>, cone: Cone) -> (Status, u64, Vector<D>) {
    let operator = Delassus::dense(&[vec![w]]);
    let problem = Problem { operator: &operator, q: &[q], cones: &[cone] };
    let settings =
        Settings { local: method, criterion: Criterion::Scaled, tolerance: 1e-12, max_sweeps: 20_000, ..Settings::default() };
    let mut r = [[0.0; D]];
    let report = solve(&problem, &settings, &mut r, &mut Scratch::default());
    (report.status, report.sweeps, r[0])
}

use crate::Scratch;

fn agrees_with_exact<const D: usize>(w: Matrix<D>, q: Vector<D>, cone: Cone) -> Result<(), TestCaseError> {
    let (status, sweeps, reference) = one_contact(LocalMethod::Exact, w, q, cone);
    prop_assert_eq!((status, sweeps), (Status::Converged, 1), "the reference must end in one visit");
    for &(method, row) in LOCAL_METHODS {
        let (status, _, r) = one_contact(method, w, q, cone);
        prop_assert_eq!(status, Status::Converged, "{}", row.name);
        let distance = norm(&mul(&w, &crate::block::sub(&r, &reference)));
        prop_assert!(distance <= 1e-9 * norm(&q), "{}: {r:?} is not {reference:?}", row.name);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn without_friction_all_are_exact(n in numbers()) {
        agrees_with_exact::<1>(block(&n, 1.0), [n[8]], Cone::Signorini)?;
        agrees_with_exact::<2>(block(&n, 1.0), [n[8], n[7]], Cone::Signorini)?;
        agrees_with_exact::<3>(block(&n, 1.0), [n[8], n[7], n[6]], Cone::Signorini)?;
    }

    #[test]
    fn with_friction_all_agree(n in numbers(), q in prop::array::uniform3(-1.0..1.0f64), mu in 0.0..1.0f64) {
        let (plane, space) = (block(&n, 0.3), block(&n, 0.3));
        agrees_with_exact::<2>(plane, [q[0], q[1]], Cone::Coulomb(mu.min(jamming(&plane))))?;
        agrees_with_exact::<3>(space, q, Cone::Coulomb(mu.min(jamming(&space))))?;
    }

    #[test]
    fn sticking_all_agree(n in numbers(), q in prop::array::uniform3(-1.0..1.0f64)) {
        agrees_with_exact::<2>(block(&n, 0.3), [q[0], q[1]], Cone::Sticking)?;
        agrees_with_exact::<3>(block(&n, 0.3), q, Cone::Sticking)?;
    }

    #[test]
    fn bilateral_all_agree(n in numbers(), q in prop::array::uniform3(-1.0..1.0f64), held in 0u8..8) {
        agrees_with_exact::<1>(block(&n, 1.0), [q[0]], Cone::Bilateral { held: held % 2 })?;
        agrees_with_exact::<2>(block(&n, 0.3), [q[0], q[1]], Cone::Bilateral { held: held % 4 })?;
        agrees_with_exact::<3>(block(&n, 0.3), q, Cone::Bilateral { held })?;
    }

    /// What is held comes to rest, by the solution of the held rows alone; what is not held gets nothing.
    #[test]
    fn the_reference_solves_the_held_rows(n in numbers(), q in prop::array::uniform3(-1.0..1.0f64)) {
        let w = block::<3>(&n, 0.5);
        let Visit { r, u, converged } = Exact.visit(&w, Cone::Bilateral { held: 0b101 }, &q, &[0.0; 3]);
        let det = w[0][0] * w[2][2] - w[0][2] * w[2][0];
        let wanted = [(w[0][2] * q[2] - w[2][2] * q[0]) / det, 0.0, (w[2][0] * q[0] - w[0][0] * q[2]) / det];
        prop_assert!(converged && norm(&crate::block::sub(&r, &wanted)) < 1e-9 * (1.0 + norm(&wanted)), "{r:?} is not {wanted:?}");
        prop_assert!(u[0] == 0.0 && u[2] == 0.0 && (u[1] - q[1] - dot(&w[1], &r)).abs() < 1e-9 * (1.0 + norm(&wanted)));
    }

    #[test]
    fn the_reference_obeys_coulombs_law(n in numbers(), q in prop::array::uniform3(-1.0..1.0f64), mu in 0.0..3.0f64) {
        let w = block::<3>(&n, 1.0);
        let Visit { r, .. } = Exact.visit(&w, Cone::Coulomb(mu), &q, &[0.0; 3]);
        let wr = mul(&w, &r);
        let u: Vector<3> = std::array::from_fn(|i| q[i] + wr[i]);
        let slip = tangent_norm(&u);
        // Strong coupling may ask for a large impulse, and W r rounds with it.
        let size = 1.0 + norm(&r);
        prop_assert!(u[0] > -1e-12 * size && r[0] >= 0.0 && (u[0] * r[0]).abs() < 1e-12 * size * size);
        prop_assert!(tangent_norm(&r) <= mu * r[0] + 1e-12 * size);
        prop_assert!((dot(&u, &r) + mu * r[0] * slip).abs() < 1e-10 * size * size, "maximal dissipation");
    }

    /// A diagonal block, as balls and disks have: PDAS ends in one visit, EBP and EAL too.
    #[test]
    fn a_diagonal_block_takes_one_visit(d in prop::array::uniform2(0.1..10.0f64), q in prop::array::uniform3(-1.0..1.0f64), mu in 0.0..2.0f64) {
        let w = [[d[0], 0.0, 0.0], [0.0, d[1], 0.0], [0.0, 0.0, d[1]]];
        for method in [LocalMethod::Pdas, LocalMethod::Ebp, LocalMethod::Eal, LocalMethod::Exact] {
            let (status, sweeps, _) = one_contact(method, w, q, Cone::Coulomb(mu));
            prop_assert_eq!((status, sweeps), (Status::Converged, 1), "{}", method.name());
        }
    }
}

#[test]
fn standard_methods_contract_by_one_minus_rho_w() {
    let w = [[2.0]];
    for rho in [0.25, 0.5, 0.75] {
        let sbp = Sbp { rho: Parameter::Relative(rho).resolve() };
        let visit = sbp.visit(&w, Cone::Signorini, &[-1.0], &[0.0]);
        assert!((visit.u[0] + (1.0 - rho)).abs() < 1e-15);
    }
}

#[test]
fn names_are_unique_and_found() {
    for &(method, row) in LOCAL_METHODS {
        assert_eq!(LocalMethod::from_name(row.name), Some(method));
        assert_eq!(method.name(), row.name);
    }
    assert_eq!(LocalMethod::from_name("none"), None);
}
