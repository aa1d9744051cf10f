//! Stones poured into a box, for `benches/peers/stones.sh`:
//!
//! - `stones make COUNT STEP TOLERANCE SCENE.toml STONES.txt` writes a scene of random convex polyhedra of twelve corners over a box without a
//!   lid, and the same for other engines: a line a stone, its place and then its corners about that.
//! - `stones run SCENE.toml STEPS EVERY OUT` runs it: OUT.states has, as raw little-endian doubles, place, quaternion, velocity and spin
//!   of each stone for the start and each EVERY-th step, OUT.seconds the seconds of each step.
//! - `stones judge SCENE.toml OUT` measures such states, whoever made them, from positions and velocities alone.

use glam::{DQuat, DVec3};
use moreau::contacts::Contact;
use moreau::detect::Detector;
use moreau::scene::{AnyWorld, Scene};
use moreau::shape::Shape;
use moreau::space::{Pose, Solid, Space};
use moreau::step::{Workspace, step};
use moreau::world::World;
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

const FRICTION: f64 = 0.5;
const DENSITY: f64 = 2500.0;
const LAYERS: usize = 8;
const SPACING: f64 = 0.26;
const G: f64 = 9.81;
/// Floor and walls come first.
const WALLS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["make", count, step, tolerance, scene, stones] => make(count.parse()?, step, tolerance, [scene, stones]),
        ["run", scene, steps, every, out] => pour(scene, steps.parse()?, every.parse()?, out),
        ["judge", scene, out] => judge(scene, out),
        _ => Err("usage: stones make|run|judge …; see the head of the file".into()),
    }
}

/// Numbers from 0 to 1 (SplitMix64).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn direction(&mut self) -> DVec3 {
        loop {
            let v = DVec3::new(self.roll(), self.roll(), self.roll()) * 2.0 - 1.0;
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

fn make(count: usize, step: &str, tolerance: &str, [scene, stones]: [&str; 2]) -> Result<(), Box<dyn Error>> {
    let columns = ((count as f64 / LAYERS as f64).sqrt().round() as usize).max(1);
    let width = columns as f64 * SPACING;
    let mut text = format!(
        "title = \"{count} stones\"\ndimension = 3\ngravity = [0.0, 0.0, -{G}]\ntime = {{ step = {step}, steps = 1 }}\n\
         solver = {{ start = \"warm\", criterion = \"scaled\", tolerance = {tolerance}, max_sweeps = 2000, max_penetration = 1e-3 }}\n\
         materials.stone.density = {DENSITY}\ndefault_law.coulomb = {{ friction = {FRICTION}, acts = \"approach\" }}\n"
    );
    for (at, n) in [
        ([0.0; 3], [0.0, 0.0, 1.0]),
        ([0.0; 3], [1.0, 0.0, 0.0]),
        ([0.0; 3], [0.0, 1.0, 0.0]),
        ([width; 3], [-1.0, 0.0, 0.0]),
        ([width; 3], [0.0, -1.0, 0.0]),
    ] {
        writeln!(text, "[[bodies]]\nmaterial = \"stone\"\nshape.half_space.normal = {n:?}\nposition = {at:?}")?;
    }
    let mut lines = String::new();
    let mut dice = Dice(1);
    for i in 0..count {
        let (radius, site) = (0.08 + 0.04 * dice.roll(), [i % columns, i / columns % columns, i / columns / columns]);
        let at: Vec<f64> = site.iter().map(|&k| (k as f64 + 0.5) * SPACING + 0.02 * (dice.roll() - 0.5)).collect();
        let points: Vec<[f64; 3]> = (0..12).map(|_| (radius * dice.direction()).into()).collect();
        writeln!(text, "[[bodies]]\nmaterial = \"stone\"\nshape.polyhedron.points = {points:?}\nposition = {at:?}")?;
        let numbers: Vec<String> = at.iter().chain(points.as_flattened()).map(|x| format!("{x:?}")).collect();
        writeln!(lines, "{}", numbers.join(" "))?;
    }
    std::fs::write(stones, lines)?;
    Ok(std::fs::write(scene, text)?)
}

/// A world of stones, and where each body is.
type Stones = (World<Solid, 3, 6>, Vec<Pose<DQuat, 3>>);

/// The scene, its world, and where the body of each stone is in the coordinates of its corners.
fn load(path: &str) -> Result<Stones, Box<dyn Error>> {
    let scene = Scene::load(Path::new(path))?;
    let AnyWorld::Solid(world) = scene.build(u64::MAX)? else { return Err("a scene of the plane".into()) };
    let own = |i: usize| {
        let (Pose { position, rotation }, corners) = (world.bodies.pose[i], &scene.bodies[i].position);
        Pose { position: std::array::from_fn(|k| position[k] - corners[k]), rotation }
    };
    let own = (WALLS..world.bodies.len()).map(own).collect();
    Ok((world, own))
}

fn pour(scene: &str, steps: usize, every: usize, out: &str) -> Result<(), Box<dyn Error>> {
    let (mut world, own) = load(scene)?;
    let (mut work, mut states, mut seconds) = (Workspace::default(), Vec::new(), String::new());
    let mut note = |world: &World<Solid, 3, 6>| {
        for (i, own) in (WALLS..).zip(&own) {
            let (pose, v) = (world.bodies.pose[i], world.bodies.velocity[i]);
            let turn = pose.rotation * own.rotation.conjugate();
            let at = DVec3::from(pose.position) - turn * DVec3::from(own.position);
            let spin = Solid::spin_in_world(pose.rotation, &v);
            let numbers = at.to_array().into_iter().chain(turn.to_array()).chain(v[..3].iter().copied()).chain(spin);
            states.extend(numbers.flat_map(f64::to_le_bytes));
        }
    };
    note(&world);
    let (mut residuals, mut unconverged) = (Vec::new(), 0);
    for k in 1..=steps {
        let record = step(&mut world, &mut work)?;
        writeln!(seconds, "{:e}", record.seconds.step)?;
        residuals.push(record.residual.scaled);
        unconverged += usize::from(!record.converged());
        if k % every == 0 {
            note(&world);
        }
    }
    residuals.sort_by(f64::total_cmp);
    println!(
        "scaled residual: median {:.1e}, worst {:.1e}; {unconverged} steps unconverged",
        residuals[steps / 2],
        residuals[steps - 1]
    );
    std::fs::write(format!("{out}.states"), states)?;
    Ok(std::fs::write(format!("{out}.seconds"), seconds)?)
}

fn judge(scene: &str, out: &str) -> Result<(), Box<dyn Error>> {
    let (mut world, own) = load(scene)?;
    let bytes = std::fs::read(format!("{out}.states"))?;
    let numbers: Vec<f64> = bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap_or_default())).collect();
    let mut seconds: Vec<f64> =
        std::fs::read_to_string(format!("{out}.seconds"))?.lines().map(str::parse).collect::<Result<_, _>>()?;
    let (mut deepest, mut last) = (0.0_f64, [0.0; 3]);
    for state in numbers.chunks_exact(13 * own.len()) {
        for (i, (own, s)) in (WALLS..).zip(own.iter().zip(state.chunks_exact(13))) {
            let turn = DQuat::from_slice(&s[3..7]);
            let at = DVec3::from_slice(&s[..3]) + turn * DVec3::from(own.position);
            world.bodies.pose[i] = Pose { position: at.into(), rotation: (turn * own.rotation).normalize() };
            let spin = world.bodies.pose[i].rotation.conjugate() * DVec3::from_slice(&s[10..13]);
            world.bodies.velocity[i] = std::array::from_fn(|k| if k < 3 { s[7 + k] } else { spin[k - 3] });
        }
        last = measures(&world);
        deepest = deepest.max(last[0]);
    }
    let third = seconds.len() / 3;
    let [fall, landing, rest] = [0, 1, 2].map(|k| {
        let part = &mut seconds[k * third..(k + 1) * third];
        part.sort_by(f64::total_cmp);
        1e3 * part[part.len() / 2]
    });
    let [overlap, approach, kinetic] = last;
    println!(
        "ms a step: fall {fall:.2}, landing {landing:.2}, rest {rest:.2}; overlap / r: deepest {deepest:.1e}, at the end {overlap:.1e}; at the end approach / g h {approach:.1e}, kinetic / m g r {kinetic:.1e}"
    );
    Ok(())
}

/// Deepest overlap over the smaller radius, fastest approach at a closed contact over g h, kinetic energy over m g r.
fn measures(world: &World<Solid, 3, 6>) -> [f64; 3] {
    let bodies = &world.bodies;
    let radius = |i: usize| bodies.shape[i].bounding_radius().unwrap_or(f64::INFINITY);
    let reach: Vec<f64> = (0..bodies.len()).map(|i| if i < WALLS { 0.0 } else { 1e-4 * radius(i) }).collect();
    let mut contacts: Vec<Contact<3>> = Vec::new();
    Detector::new().detect::<Solid, 6>(&bodies.shape, &bodies.pose, &reach, |i| i < WALLS, &mut contacts);
    let at_point = |i: usize, c: &Contact<3>| {
        let arm = DVec3::from(c.point) - DVec3::from(bodies.pose[i].position);
        let spin = DVec3::from(Solid::spin_in_world(bodies.pose[i].rotation, &bodies.velocity[i]));
        let v = DVec3::from_slice(&bodies.velocity[i][..3]) + spin.cross(arm);
        if i < WALLS { DVec3::ZERO } else { v }
    };
    let (mut overlap, mut approach) = (0.0_f64, 0.0_f64);
    for c in &contacts {
        let (a, b) = (c.key.a as usize, c.key.b as usize);
        overlap = overlap.max(-c.gap / radius(a).min(radius(b)));
        let closing = -DVec3::from(c.normal).dot(at_point(b, c) - at_point(a, c)) - c.gap.max(0.0) / world.settings.h;
        approach = approach.max(closing / (G * world.settings.h));
    }
    let free = WALLS..bodies.len();
    let scale: f64 = free.clone().map(|i| bodies.mass[i][0] * G * radius(i)).sum();
    let kinetic: f64 = free.map(|i| (0..6).map(|k| 0.5 * bodies.mass[i][k] * bodies.velocity[i][k].powi(2)).sum::<f64>()).sum();
    [overlap, approach, kinetic / scale]
}
