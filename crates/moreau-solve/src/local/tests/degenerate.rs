//! Blocks as problem files hold them: without freedoms, singular, not quite symmetric. Finite numbers come out of every visit.

use super::*;
use proptest::test_runner::RngSeed;

const CONES: [Cone; 8] = [
    Cone::Signorini,
    Cone::Coulomb(0.0),
    Cone::Coulomb(0.3),
    Cone::Sticking,
    Cone::Rolling { mu: 0.3, mu_r: 0.1 },
    Cone::Rolling { mu: 0.0, mu_r: 0.0 },
    Cone::Bilateral { held: 0b111 },
    Cone::Bilateral { held: 0b010 },
];

/// Visits the contact ten times with every method, from nothing and from some impulse.
fn stays_finite<const D: usize>(w: &Matrix<D>, q: &Vector<D>) {
    for cone in CONES {
        for &(method, row) in LOCAL_METHODS {
            for start in [0.0, 1.0] {
                let mut r = [start; D];
                for round in 0..10 {
                    let wr = mul(w, &r);
                    let u: Vector<D> = std::array::from_fn(|i| q[i] + wr[i]);
                    let visit = one_visit(method, w, cone, &u, &r);
                    let numbers = visit.r.iter().chain(&visit.u);
                    assert!(numbers.into_iter().all(|x| x.is_finite()), "{} {cone:?} {w:?} {q:?} {round}: {visit:?}", row.name);
                    r = visit.r;
                }
            }
        }
    }
}

struct One<'a, const D: usize>(&'a Matrix<D>, Cone, &'a Vector<D>, &'a Vector<D>);

impl<const D: usize> WithLocal for One<'_, D> {
    type Output = Visit<D>;
    fn run<L: LocalSolver>(self, local: L) -> Visit<D> {
        local.visit(self.0, self.1, self.2, self.3)
    }
}

pub(super) fn one_visit<const D: usize>(
    method: LocalMethod,
    w: &Matrix<D>,
    cone: Cone,
    u: &Vector<D>,
    r: &Vector<D>,
) -> Visit<D> {
    with_local(Settings { local: method, ..Settings::default() }, One(w, cone, u, r))
}

/// The cases of one dimension: what moves (by component), and the velocities without impulse.
fn every_case<const D: usize>() {
    let velocities = [[0.0; D], [-1.0; D], [1.0; D], std::array::from_fn(|i| if i == 0 { -1.0 } else { 0.0 })];
    let moves = [
        [0.0; D],
        std::array::from_fn(|i| f64::from(u8::from(i == 0))),
        std::array::from_fn(|i| f64::from(u8::from(i > 0))),
        std::array::from_fn(|i| f64::from(u8::from(i < 2))),
        [1e-310; D],
        [1e-100; D],
        [1e-200; D],
    ];
    for q in velocities {
        for m in moves {
            stays_finite(&std::array::from_fn(|i| std::array::from_fn(|j| if i == j { m[i] } else { 0.0 })), &q);
            // Rank one: all components move as one.
            stays_finite(&std::array::from_fn(|i| std::array::from_fn(|j| m[i] * m[j])), &q);
        }
    }
}

#[test]
fn no_visit_makes_numbers_that_are_none() {
    every_case::<1>();
    every_case::<2>();
    every_case::<3>();
    every_case::<5>();
}

/// A tangent that nothing moves slides at the bound, against its velocity.
#[test]
fn a_tangent_without_freedom_slides() {
    let w = [[2.0, 0.0, 0.0], [0.0; 3], [0.0; 3]];
    for &(method, row) in LOCAL_METHODS {
        let (status, _, r) = one_contact(method, w, [-1.0, 0.3, -0.4], Cone::Coulomb(0.5));
        assert_eq!(status, Status::Converged, "{}", row.name);
        assert!(norm(&crate::block::sub(&r, &[0.5, -0.15, 0.2])) < 1e-9, "{}: {r:?}", row.name);
    }
}

/// A singular block can stick all the same.
#[test]
fn a_singular_block_sticks() {
    let w = [[2.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, 1.0]];
    for &(method, row) in LOCAL_METHODS {
        let operator = Delassus::dense(&[vec![w]]);
        let problem = Problem { operator: &operator, q: &[[-1.0, 0.1, 0.1]], cones: &[Cone::Coulomb(0.5)] };
        let settings = Settings { local: method, criterion: Criterion::Scaled, tolerance: 1e-12, ..Settings::default() };
        let mut r = [[0.0; 3]];
        let report = solve(&problem, &settings, &mut r, &mut Scratch::default());
        assert_eq!(report.status, Status::Converged, "{}", row.name);
        assert!((r[0][1] + r[0][2] + 0.1).abs() < 1e-9 && (r[0][0] - 0.5).abs() < 1e-9, "{}: {r:?}", row.name);
    }
}

/// Rows that say the same twice hold as one does; of rows that contradict each other a visit says that it did not end.
#[test]
fn redundant_bilateral_rows_hold() {
    let (w, cone) = ([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 2.0]], Cone::Bilateral { held: 0b111 });
    for &(method, row) in LOCAL_METHODS {
        let (status, _, r) = one_contact(method, w, [0.3, 0.3, -1.0], cone);
        assert_eq!(status, Status::Converged, "{}", row.name);
        assert!((r[0] + r[1] + 0.3).abs() < 1e-9 && (r[2] - 0.5).abs() < 1e-9, "{}: {r:?}", row.name);
    }
    for method in [LocalMethod::Pdas, LocalMethod::Exact] {
        let visit = one_visit(method, &w, cone, &[0.3, -0.3, -1.0], &[0.0; 3]);
        assert!(!visit.converged && visit.r[0] == -visit.r[1], "{}: {visit:?}", method.name());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    /// A block that is symmetric to some digits only, as files hold them: all methods still end in the law.
    #[test]
    fn a_block_need_not_be_symmetric(n in numbers(), q in prop::array::uniform3(-1.0..1.0f64), skew in -5e-3..5e-3f64) {
        let mut w = block::<3>(&n, 0.3);
        w[1][2] += skew;
        w[0][1] += skew;
        for &(method, row) in LOCAL_METHODS {
            let (status, _, _) = one_contact(method, w, q, Cone::Coulomb(0.5));
            prop_assert_eq!(status, Status::Converged, "{}", row.name);
            let (status, _, _) = one_contact(method, w, q, Cone::Sticking);
            prop_assert_eq!(status, Status::Converged, "{} held", row.name);
            let (status, _, _) = one_contact(method, w, q, Cone::Rolling { mu: 0.5, mu_r: 0.1 });
            prop_assert_eq!(status, Status::Converged, "{} rolling", row.name);
            let (status, _, _) = one_contact(method, w, q, Cone::Bilateral { held: 0b111 });
            prop_assert_eq!(status, Status::Converged, "{} bilateral", row.name);
        }
    }
}
