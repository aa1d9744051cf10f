//! Every global method against problems built backwards from a solution: impulses and velocities that obey the laws are drawn, and
//! q = u − W r makes a problem of them.

use moreau_solve::global::GLOBAL_METHODS;
use moreau_solve::{Cone, Criterion, Delassus, GlobalMethod, Problem, Report, Scratch, Settings, Status, solve};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

type Vector<const D: usize> = [f64; D];
type Block<const D: usize> = [[f64; D]; D];

/// A problem with one of its solutions.
struct Built<const D: usize> {
    w: Vec<Vec<Block<D>>>,
    q: Vec<Vector<D>>,
    cones: Vec<Cone>,
    u: Vec<Vector<D>>,
}

/// A number between −1 and 1.
fn draw(rng: &mut Pcg64Mcg) -> f64 {
    rng.random_range(-1.0..1.0)
}

/// A direction of the components `range`, the others zero.
fn direction<const D: usize>(rng: &mut Pcg64Mcg, range: std::ops::Range<usize>) -> Vector<D> {
    let drawn: Vector<D> = std::array::from_fn(|i| if range.contains(&i) { draw(rng) } else { 0.0 });
    let length = drawn.iter().map(|x| x * x).sum::<f64>().sqrt();
    drawn.map(|x| if length > 0.0 { x / length } else { 0.0 })
}

/// A pair (u, r) of the law: open, or pushing with each part of the tangent held or slipping.
fn pair<const D: usize>(rng: &mut Pcg64Mcg, cone: Cone) -> (Vector<D>, Vector<D>) {
    let (mut u, mut r) = ([0.0; D], [0.0; D]);
    if let Cone::Bilateral { held } = cone {
        (0..D).for_each(|i| *(if held >> i & 1 == 1 { &mut r[i] } else { &mut u[i] }) = draw(rng));
        return (u, r);
    }
    let open = rng.random_bool(0.3);
    if open {
        u[0] = rng.random_range(0.1..1.0);
    } else {
        r[0] = rng.random_range(0.1..1.0);
    }
    let split = if matches!(cone, Cone::Rolling { .. }) { D.div_ceil(2) } else { D };
    let parts = match cone {
        Cone::Coulomb(mu) => vec![(1..split, mu)],
        Cone::Rolling { mu, mu_r } => vec![(1..split, mu), (split..D, mu_r)],
        Cone::Signorini => vec![(1..D, 0.0)],
        Cone::Sticking => {
            (1..D).for_each(|i| r[i] = draw(rng));
            vec![]
        }
        Cone::Bilateral { .. } => vec![],
    };
    for (range, mu) in parts {
        let (way, slips) = (direction::<D>(rng, range.clone()), rng.random_bool(0.5));
        for i in range {
            if open {
                u[i] = draw(rng);
            } else if slips || mu == 0.0 {
                (u[i], r[i]) = (-way[i], mu * r[0] * way[i]);
            } else {
                r[i] = 0.7 * mu * r[0] * way[i];
            }
        }
    }
    (u, r)
}

/// W = J M⁻¹ Jᵀ of a chain of bodies from the ground, or of all contacts between few bodies, which makes it rank deficient.
fn delassus<const D: usize>(rng: &mut Pcg64Mcg, contacts: usize, deficient: bool) -> Vec<Vec<Block<D>>> {
    let bodies = if deficient { contacts / 8 + 1 } else { contacts };
    let freedoms = D + 1;
    let masses: Vec<f64> = (0..bodies).map(|_| rng.random_range(0.3..3.0)).collect();
    let mut rows = vec![vec![0.0; bodies * freedoms]; contacts * D];
    for c in 0..contacts {
        let one = c % bodies;
        let other = if deficient { rng.random_range(0..bodies + 1) } else { c.wrapping_sub(1) };
        for (body, sign) in [(one, 1.0), (other, -1.0)] {
            if body >= bodies || (body == one && sign < 0.0) {
                continue;
            }
            for i in 0..D {
                for k in 0..freedoms {
                    let main = if i == k { sign } else { 0.0 };
                    rows[c * D + i][body * freedoms + k] = (main + 0.3 * draw(rng)) / masses[body].sqrt();
                }
            }
        }
    }
    let product = |i: usize, j: usize| rows[i].iter().zip(&rows[j]).map(|(x, y)| x * y).sum();
    let block = |c: usize, d: usize| std::array::from_fn(|i| std::array::from_fn(|j| product(c * D + i, d * D + j)));
    (0..contacts).map(|c| (0..contacts).map(|d| block(c, d)).collect()).collect()
}

/// W r.
fn times<const D: usize>(w: &[Vec<Block<D>>], r: &[Vector<D>]) -> Vec<Vector<D>> {
    let row = |c: usize, i: usize| -> f64 { (0..r.len()).map(|d| (0..D).map(|j| w[c][d][i][j] * r[d][j]).sum::<f64>()).sum() };
    (0..r.len()).map(|c| std::array::from_fn(|i| row(c, i))).collect()
}

fn build<const D: usize>(seed: u64, cone: Cone, contacts: usize, deficient: bool) -> Built<D> {
    build_of(seed, vec![cone; contacts], deficient)
}

/// The same with a law for each contact.
fn build_of<const D: usize>(seed: u64, cones: Vec<Cone>, deficient: bool) -> Built<D> {
    let (rng, contacts) = (&mut Pcg64Mcg::seed_from_u64(seed), cones.len());
    let w = delassus(rng, contacts, deficient);
    let (u, r): (Vec<_>, Vec<_>) = cones.iter().map(|&cone| pair(rng, cone)).unzip();
    let wr = times(&w, &r);
    let q = u.iter().zip(&wr).map(|(u, wr)| std::array::from_fn(|i| u[i] - wr[i])).collect();
    Built { w, q, cones, u }
}

fn settings(global: GlobalMethod) -> Settings {
    Settings { global, criterion: Criterion::Scaled, tolerance: 1e-8, max_sweeps: 200_000, ..Settings::default() }
}

fn solved<const D: usize>(built: &Built<D>, settings: &Settings) -> (Report, Vec<Vector<D>>) {
    let operator = Delassus::dense(&built.w);
    let problem = Problem { operator: &operator, q: &built.q, cones: &built.cones };
    let mut r = vec![[0.0; D]; built.q.len()];
    let report = solve(&problem, settings, &mut r, &mut Scratch::default());
    (report, r)
}

/// Whether the method says of itself that it is not for such a problem.
fn unsuited<const D: usize>(method: GlobalMethod, cone: Cone) -> bool {
    let pivots = match cone {
        Cone::Signorini => true,
        Cone::Coulomb(mu) => mu == 0.0 || D == 2,
        Cone::Rolling { .. } | Cone::Sticking | Cone::Bilateral { .. } => false,
    };
    method == GlobalMethod::Lemke && !pivots
}

/// By how much the laws are violated, relative to the velocities: in words of its own, part by part.
fn violation<const D: usize>(built: &Built<D>, u: &[Vector<D>], r: &[Vector<D>]) -> f64 {
    let size = |a: &[f64]| a.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (mut errors, mut speeds) = (0.0, 0.0);
    for c in 0..u.len() {
        let (u, r) = (&u[c], &r[c]);
        let w = (0..D).map(|i| built.w[c][c][i][i]).sum::<f64>() / D as f64;
        let split = if matches!(built.cones[c], Cone::Rolling { .. }) { D.div_ceil(2) } else { D };
        let mut add = |x: f64| errors += x * x;
        if !matches!(built.cones[c], Cone::Bilateral { .. }) {
            add(u[0].min(w * r[0]));
        }
        let mut part = |range: std::ops::Range<usize>, mu: f64| {
            let (slip, force) = (&u[range.clone()], &r[range]);
            let power: f64 = slip.iter().zip(force).map(|(u, r)| u * r).sum();
            add(w * (size(force) - mu * r[0]).max(0.0));
            // Held within the bound, and against the slip on it.
            add((power + mu * r[0] * size(slip)) * w / (w * size(force) + size(slip) + w * r[0].abs()).max(f64::MIN_POSITIVE));
        };
        match built.cones[c] {
            Cone::Signorini => add(w * size(&r[1..])),
            Cone::Coulomb(mu) => part(1..D, mu),
            Cone::Rolling { mu, mu_r } => {
                part(1..split, mu);
                part(split..D, mu_r);
            }
            Cone::Sticking => add(size(&u[1..])),
            Cone::Bilateral { held } => (0..D).for_each(|i| add(if held >> i & 1 == 1 { u[i] } else { w * r[i] })),
        }
        speeds += built.q[c].iter().chain(u).map(|x| x * x).sum::<f64>();
    }
    (errors / speeds).sqrt()
}

/// All methods on all numbers of contacts of one law.
fn conforms<const D: usize>(cone: Cone) {
    for &(method, row) in GLOBAL_METHODS {
        for contacts in 1..=12 {
            for deficient in [false, true] {
                let built = build::<D>(contacts as u64 * 11 + D as u64, cone, contacts, deficient);
                let (report, r) = solved(&built, &settings(method));
                let what = format!("{} on {cone:?} in {D}, {contacts} contacts, deficient: {deficient}", row.name);
                if unsuited::<D>(method, cone) {
                    assert_eq!(report.status, Status::Unsuited, "{what}");
                    continue;
                }
                assert_eq!(report.status, Status::Converged, "{what}: {:e} after {}", report.residual.scaled, report.sweeps);
                let mut u = times(&built.w, &r);
                (0..contacts).for_each(|c| (0..D).for_each(|i| u[c][i] += built.q[c][i]));
                let violation = violation(&built, &u, &r);
                assert!(violation < 1e-7, "{what}: the laws are violated by {violation:e}");
                check_velocities(&built, &u, deficient, &what);
            }
        }
    }
}

/// Where the velocities are unique they are those that the problem was built from.
fn check_velocities<const D: usize>(built: &Built<D>, u: &[Vector<D>], deficient: bool, what: &str) {
    for c in 0..u.len() {
        let unique = match built.cones[c] {
            Cone::Sticking | Cone::Bilateral { .. } => 0..D,
            // Without friction only the normals have a law; they are all that other contacts feel, but not all that the motion is.
            Cone::Signorini => 0..1,
            Cone::Coulomb(mu) if mu <= 0.01 && !deficient => 0..if mu == 0.0 { 1 } else { D },
            _ => 0..0,
        };
        for i in unique {
            assert!((u[c][i] - built.u[c][i]).abs() < 1e-5, "{what}: contact {c} moves by {:?}, not {:?}", u[c], built.u[c]);
        }
    }
}

#[test]
fn all_methods_solve_without_friction() {
    conforms::<1>(Cone::Signorini);
    conforms::<2>(Cone::Signorini);
    conforms::<3>(Cone::Signorini);
}

#[test]
fn all_methods_solve_with_friction_in_the_plane() {
    [0.0, 0.01, 0.3, 1.0].into_iter().for_each(|mu| conforms::<2>(Cone::Coulomb(mu)));
}

#[test]
fn all_methods_solve_with_friction_in_space() {
    [0.0, 0.01, 0.3, 1.0].into_iter().for_each(|mu| conforms::<3>(Cone::Coulomb(mu)));
}

#[test]
fn all_methods_hold_what_sticks() {
    conforms::<2>(Cone::Sticking);
    conforms::<3>(Cone::Sticking);
}

#[test]
fn all_methods_hold_joints() {
    conforms::<1>(Cone::Bilateral { held: 0b1 });
    conforms::<2>(Cone::Bilateral { held: 0b11 });
    conforms::<2>(Cone::Bilateral { held: 0b10 });
    conforms::<3>(Cone::Bilateral { held: 0b111 });
    conforms::<3>(Cone::Bilateral { held: 0b110 });
}

/// Joints and contacts with friction in one problem.
#[test]
fn all_methods_solve_joints_among_contacts() {
    for &(method, row) in GLOBAL_METHODS.iter().filter(|(method, _)| *method != GlobalMethod::Lemke) {
        for (seed, contacts) in (0..8).zip(3..) {
            let law =
                |c: usize| if c.is_multiple_of(3) { Cone::Coulomb(0.3) } else { Cone::Bilateral { held: 0b111 >> (c % 2) } };
            let built = build_of::<3>(seed, (0..contacts).map(law).collect(), false);
            let (report, r) = solved(&built, &settings(method));
            let what = format!("{}, {contacts} contacts", row.name);
            assert_eq!(report.status, Status::Converged, "{what}: {:e} after {}", report.residual.scaled, report.sweeps);
            let mut u = times(&built.w, &r);
            (0..contacts).for_each(|c| (0..3).for_each(|i| u[c][i] += built.q[c][i]));
            let violation = violation(&built, &u, &r);
            assert!(violation < 1e-7, "{what}: the laws are violated by {violation:e}");
        }
    }
}

#[test]
fn all_methods_solve_with_rolling_friction() {
    for (mu, mu_r) in [(0.3, 0.1), (0.5, 0.02)] {
        conforms::<3>(Cone::Rolling { mu, mu_r });
        conforms::<5>(Cone::Rolling { mu, mu_r });
    }
}

/// Lengths × a and impulses × b: u and q times a, r times b, W times a/b.
fn in_units<const D: usize>(built: &Built<D>, a: f64, b: f64) -> Built<D> {
    let scaled = |x: &[Vector<D>]| x.iter().map(|x| x.map(|x| a * x)).collect();
    let w = built.w.iter().map(|row| row.iter().map(|block| block.map(|row| row.map(|x| x * (a / b)))).collect()).collect();
    Built { w, q: scaled(&built.q), cones: built.cones.clone(), u: scaled(&built.u) }
}

/// By powers of two nothing is rounded, so that all is the same to the bit.
fn keeps_units<const D: usize>(cone: Cone) {
    for &(method, row) in GLOBAL_METHODS {
        let built = build::<D>(41, cone, 6, false);
        let settings = Settings { max_sweeps: 300, ..settings(method) };
        let (report, _) = solved(&built, &settings);
        // Square roots of W are taken by the mixing of `accelerated`: of even powers they are exact.
        for (a, b) in [(10, -4), (-20, 30), (7, -12), (-33, 12)] {
            if matches!(method, GlobalMethod::Accelerated | GlobalMethod::ActiveSet | GlobalMethod::Auto) && (a - b) % 2 != 0 {
                continue;
            }
            let (other, _) = solved(&in_units(&built, f64::from(a).exp2(), f64::from(b).exp2()), &settings);
            let what = format!("{} on {cone:?} in {D}, lengths by 2^{a}, impulses by 2^{b}", row.name);
            assert_eq!((report.status, report.sweeps), (other.status, other.sweeps), "{what}");
            assert_eq!(report.residual.scaled.to_bits(), other.residual.scaled.to_bits(), "{what}");
        }
    }
}

#[test]
fn units_change_neither_status_nor_residual() {
    keeps_units::<1>(Cone::Signorini);
    let held = Cone::Bilateral { held: 0b11 };
    for cone in [Cone::Signorini, Cone::Sticking, held, Cone::Coulomb(0.0), Cone::Coulomb(0.3)] {
        keeps_units::<2>(cone);
        keeps_units::<3>(cone);
    }
    keeps_units::<5>(Cone::Rolling { mu: 0.3, mu_r: 0.1 });
}

/// What no impulse moves, what is no number, and no contact at all.
#[test]
fn degenerate_problems_end() {
    for &(method, row) in GLOBAL_METHODS {
        let settings = Settings { max_sweeps: 500, ..settings(method) };
        let mut built = build::<2>(5, Cone::Coulomb(0.3), 3, false);
        (0..3).for_each(|d| (built.w[1][d], built.w[d][1]) = ([[0.0; 2]; 2], [[0.0; 2]; 2]));
        built.q[1] = [1.0, 0.5];
        let (report, r) = solved(&built, &settings);
        assert_eq!(report.status, Status::Converged, "{} with a contact that nothing moves", row.name);
        assert_eq!(r[1], [0.0; 2], "{}", row.name);
        built.q[1] = [-1.0, 0.5];
        let (report, r) = solved(&built, &settings);
        assert_ne!(report.status, Status::Converged, "{}: what falls and cannot be moved", row.name);
        assert!(r.iter().flatten().all(|x| x.is_finite()) && report.residual.scaled.is_finite(), "{}", row.name);
        built.q[1] = [f64::NAN, 0.5];
        let (report, _) = solved(&built, &settings);
        assert_eq!(report.status, Status::NotFinite, "{} without a number", row.name);
        built.q[1] = [1.0, 0.5];
        built.w[0][2][1][0] = f64::NAN;
        assert_ne!(solved(&built, &settings).0.status, Status::Converged, "{}: W without a number", row.name);
        let nothing = Built { w: vec![vec![[[0.0; 2]; 2]; 3]; 3], ..build::<2>(5, Cone::Coulomb(0.3), 3, false) };
        assert_ne!(solved(&nothing, &settings).0.status, Status::Converged, "{}: nothing can be moved", row.name);
        let none = Built::<2> { w: vec![], q: vec![], cones: vec![], u: vec![] };
        assert_eq!(solved(&none, &settings).0.status, Status::Converged, "{} without contacts", row.name);
    }
}
