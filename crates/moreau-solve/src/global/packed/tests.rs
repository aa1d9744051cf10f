//! Packed solves against plain ones, and against themselves on other kernels and numbers of threads.

use crate::operator::{Balls, NONE, balls::RoundBody};
use crate::{Cone, Criterion, GlobalMethod, Kernels, LocalMethod, Operator, Problem, Report, Scratch, Settings, Status, solve};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

struct Pile<const K: usize> {
    balls: Balls<K>,
    q: Vec<[f64; K]>,
    cones: Vec<Cone>,
}

/// A cube of balls of all sizes, with normals that lean, on a floor; `busy` bodies have more contacts than there are colours.
fn pile<const K: usize>(side: usize, mu: f64, busy: bool) -> Pile<K> {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    let body = |rng: &mut Pcg64Mcg| {
        let radius: f64 = rng.random_range(0.5..1.0);
        let mass = radius.powi(3);
        RoundBody { inverse_mass: 1.0 / mass, inverse_inertia: 2.5 / (mass * radius * radius) }
    };
    let mut balls = Balls::default();
    balls.clear((0..side * side * side).map(|_| body(&mut rng)));
    let id = |at: [usize; 3]| ((at[2] * side + at[1]) * side + at[0]) as u32;
    let mut q = Vec::new();
    let mut touch = |rng: &mut Pcg64Mcg, pair: [u32; 2], axis: usize| {
        let mut n: [f64; 3] = std::array::from_fn(|k| if k == axis { 1.0 } else { rng.random_range(-0.3..0.3) });
        let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
        n = n.map(|x| x / length);
        let s = if n[0].abs() < 0.6 { [0.0, -n[2], n[1]] } else { [-n[2], 0.0, n[0]] };
        let length = s.iter().map(|x| x * x).sum::<f64>().sqrt();
        let s = s.map(|x| x / length);
        let t = [n[1] * s[2] - n[2] * s[1], n[2] * s[0] - n[0] * s[2], n[0] * s[1] - n[1] * s[0]];
        let frame = [n, s, t];
        balls.push(pair, std::array::from_fn(|i| frame[i]), [rng.random_range(0.5..1.0), rng.random_range(0.5..1.0)]);
        let fall = if pair[0] == NONE { -1.0 } else { 0.0 };
        q.push(std::array::from_fn(|i| if i == 0 { fall } else { 0.0 } + rng.random_range(-0.2..0.2)));
    };
    for z in 0..side {
        for y in 0..side {
            for x in 0..side {
                let at = [x, y, z];
                if z == 0 {
                    touch(&mut rng, [NONE, id(at)], 2);
                }
                for axis in (0..3).filter(|&axis| at[axis] + 1 < side) {
                    let mut next = at;
                    next[axis] += 1;
                    touch(&mut rng, [id(at), id(next)], axis);
                }
                if busy && id(at) > 0 {
                    touch(&mut rng, [0, id(at)], x % 3);
                }
            }
        }
    }
    let cone = if mu > 0.0 { Cone::Coulomb(mu) } else { Cone::Signorini };
    let cones = vec![cone; q.len()];
    Pile { balls, q, cones }
}

fn run<const K: usize>(pile: &Pile<K>, settings: Settings, threads: usize) -> (Report, Vec<[f64; K]>) {
    let problem = Problem { operator: &pile.balls, q: &pile.q, cones: &pile.cones };
    let mut r = vec![[0.0; K]; problem.len()];
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let report = pool.install(|| solve(&problem, &settings, &mut r, &mut Scratch::default()));
    (report, r)
}

fn settings(global: GlobalMethod) -> Settings {
    Settings { global, tolerance: 1e-9, ..Settings::default() }
}

/// The velocities that the impulses give: they are unique, impulses need not be.
fn velocities<const K: usize>(pile: &Pile<K>, r: &[[f64; K]]) -> Vec<f64> {
    let mut state = Vec::new();
    pile.balls.start(r, &mut state);
    state.into_iter().flatten().flatten().collect()
}

fn agrees_with_plain<const K: usize>(mu: f64, busy: bool) {
    let pile = pile::<K>(6, mu, busy);
    let plain = Settings { kernels: Kernels::Plain, local: LocalMethod::Exact, ..settings(GlobalMethod::Nlgs) };
    let (report, expected) = run(&pile, plain, 1);
    assert_eq!(report.status, Status::Converged);
    for global in [GlobalMethod::Nlgs, GlobalMethod::Accelerated] {
        for criterion in [Criterion::EpsGlob, Criterion::Scaled, Criterion::Strict] {
            let (report, r) = run(&pile, Settings { criterion, ..settings(global) }, 1);
            assert_eq!(report.status, Status::Converged, "{}", global.name());
            assert!(report.residual.of(criterion) <= 1e-9);
            let (ours, theirs) = (velocities(&pile, &r), velocities(&pile, &expected));
            let apart = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-5, "{} by {}: {apart}", global.name(), criterion.name());
        }
    }
}

#[test]
fn without_friction_velocities_are_those_of_plain_sweeps() {
    agrees_with_plain::<1>(0.0, false);
    agrees_with_plain::<3>(0.0, false);
}

#[test]
fn with_friction_the_residual_is_met_and_sweeps_continue_from_their_answer() {
    for mu in [0.1, 0.6] {
        let pile = pile::<3>(6, mu, false);
        let (report, r) = run(&pile, settings(GlobalMethod::Accelerated), 1);
        assert_eq!(report.status, Status::Converged);
        // The reference finds nothing to do from there.
        let problem = Problem { operator: &pile.balls, q: &pile.q, cones: &pile.cones };
        let plain =
            Settings { kernels: Kernels::Plain, local: LocalMethod::Exact, tolerance: 2e-9, ..settings(GlobalMethod::Nlgs) };
        let report = solve(&problem, &plain, &mut r.clone(), &mut Scratch::default());
        assert!(report.status == Status::Converged && report.sweeps <= 2, "{} sweeps", report.sweeps);
    }
}

#[test]
fn a_body_with_more_contacts_than_colours_is_visited_once_at_a_time() {
    agrees_with_plain::<1>(0.0, true);
}

#[test]
fn kernels_and_threads_do_not_change_the_bits() {
    fn same<const K: usize>(mu: f64, global: GlobalMethod) {
        // Enough for several waves of blocks, which are smaller under Miri, and so are the piles; there idle threads take most of the time.
        let (side, sweeps, many) = if cfg!(miri) { (4, 2, 3) } else { (20, 60, 8) };
        let pile = pile::<K>(side, mu, false);
        let settings = Settings { max_sweeps: sweeps, ..settings(global) };
        let (report, expected) = run(&pile, settings, 1);
        assert_eq!(report.sweeps, sweeps);
        for (threads, kernels) in [(2, Kernels::Auto), (3, Kernels::Auto), (many, Kernels::Auto), (1, Kernels::Portable)] {
            let (other, r) = run(&pile, Settings { kernels, ..settings }, threads);
            assert!(r == expected && other == report, "{threads} threads, {kernels:?}");
        }
    }
    same::<1>(0.0, GlobalMethod::Accelerated);
    same::<1>(0.0, GlobalMethod::Nlgs);
    same::<2>(0.3, GlobalMethod::Accelerated);
    same::<3>(0.3, GlobalMethod::Accelerated);
}

#[test]
fn what_is_no_number_ends_the_solve() {
    let mut pile = pile::<1>(4, 0.0, false);
    pile.q[5][0] = f64::NAN;
    assert_eq!(run(&pile, settings(GlobalMethod::Accelerated), 1).0.status, Status::NotFinite);
}
