//! What one visit costs: nanoseconds per contact and sweep, by law, in cache and out of it, packed and plain.
//!
//! `cargo bench -p moreau-solve` prints a table. A figure is the difference of two solves of the same pile, one with more sweeps than
//! the other, over the sweeps between them: what a solve does once does not count. Each is the median of three; all runs are of one
//! thread.

use moreau_solve::operator::balls::RoundBody;
use moreau_solve::operator::{Balls, NONE};
use moreau_solve::{Cone, Criterion, GlobalMethod, Kernels, LocalMethod, Problem, Scratch, Settings, solve};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::time::Instant;

struct Pile<const K: usize> {
    balls: Balls<K>,
    q: Vec<[f64; K]>,
    cones: Vec<Cone>,
}

/// A cube of `side`³ balls with some three contacts each, numbered along its axes.
fn pile<const K: usize>(side: usize, mu: f64) -> Pile<K> {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let mut balls = Balls::default();
    balls.clear((0..side * side * side).map(|_| {
        let mass: f64 = rng.random_range(0.5..1.5);
        RoundBody { inverse_mass: 1.0 / mass, inverse_inertia: 2.5 / mass }
    }));
    let id = |[x, y, z]: [usize; 3]| ((z * side + y) * side + x) as u32;
    let mut q = Vec::new();
    for (z, y, x) in (0..side).flat_map(|z| (0..side).flat_map(move |y| (0..side).map(move |x| (z, y, x)))) {
        for axis in 0..3 {
            let mut next = [x, y, z];
            next[axis] += 1;
            let pair = match (next[axis] < side, axis == 2 && z == 0) {
                (true, _) => [id([x, y, z]), id(next)],
                (false, true) => [NONE, id([x, y, z])],
                _ => continue,
            };
            let unit = |e: usize| std::array::from_fn(|k| f64::from(u8::from(k == e)));
            let frame: [[f64; 3]; K] = std::array::from_fn(|i| unit((axis + i) % 3));
            balls.push(pair, frame, [1.0, 1.0]);
            q.push(std::array::from_fn(|_| rng.random_range(-0.6..0.4)));
        }
    }
    let cones = vec![if mu > 0.0 { Cone::Coulomb(mu) } else { Cone::Signorini }; q.len()];
    Pile { balls, q, cones }
}

/// Seconds of a solve that ends after so many sweeps.
fn seconds<const K: usize>(
    pile: &Pile<K>,
    settings: &Settings,
    scratch: &mut Scratch<Vec<[[f64; 4]; 2]>, K>,
    sweeps: u64,
) -> f64 {
    let problem = Problem { operator: &pile.balls, q: &pile.q, cones: &pile.cones };
    let settings = Settings { max_sweeps: sweeps, ..*settings };
    let mut r = vec![[0.0; K]; pile.q.len()];
    let clock = Instant::now();
    let report = solve(&problem, &settings, &mut r, scratch);
    let seconds = clock.elapsed().as_secs_f64();
    assert_eq!(report.sweeps, sweeps);
    seconds
}

/// Nanoseconds per contact and sweep.
fn visit<const K: usize>(pile: &Pile<K>, global: GlobalMethod, kernels: Kernels) -> f64 {
    // Nothing reaches such a tolerance, and this criterion is looked at now and then only.
    let settings = Settings {
        global,
        kernels,
        local: LocalMethod::Pdas,
        criterion: Criterion::EpsGlob,
        tolerance: 1e-300,
        ..Settings::default()
    };
    let sweeps = (8_000_000 / pile.q.len() as u64).clamp(12, 400);
    let mut scratch = Scratch::default();
    let mut all: Vec<f64> = (0..3)
        .map(|_| {
            let short = seconds(pile, &settings, &mut scratch, 4);
            let long = seconds(pile, &settings, &mut scratch, 4 + sweeps);
            (long - short) / sweeps as f64 / pile.q.len() as f64 * 1e9
        })
        .collect();
    all.sort_unstable_by(f64::total_cmp);
    all[1]
}

fn rows<const K: usize>(law: &str, mu: f64) {
    for side in [8, 17, 100] {
        let pile = pile::<K>(side, mu);
        let [plain, portable, packed, momentum] = [
            (GlobalMethod::Nlgs, Kernels::Plain),
            (GlobalMethod::Nlgs, Kernels::Portable),
            (GlobalMethod::Nlgs, Kernels::Auto),
            (GlobalMethod::Accelerated, Kernels::Auto),
        ]
        .map(|(global, kernels)| visit(&pile, global, kernels));
        let (balls, contacts) = (side * side * side, pile.q.len());
        println!("| {law} | {balls} | {contacts} | {plain:.1} | {portable:.1} | {packed:.1} | {momentum:.1} |");
    }
}

fn main() {
    println!("| law | balls | contacts | plain, ns | packed, portable | packed | with momentum |");
    println!("|---|---|---|---|---|---|---|");
    rows::<1>("frictionless", 0.0);
    rows::<2>("friction 0.3, plane", 0.3);
    rows::<3>("friction 0.3, space", 0.3);
}
