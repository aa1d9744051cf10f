//! How still a structure stands: `standing STEPS SCENE.toml …` runs each scene and prints what moved, what is left of motion, and whether
//! the supports carry the weight; then tilts gravity until the structure falls.
//!
//! Drift is the greatest way of a body from where it began, kinetic energy that of the last step over what lifts every body by its own
//! radius, weight the vertical impulse of the supports over h against the weight, each worst over the last tenth of the run.

use moreau::run::{End, Task, run};
use moreau::scene::{AnyWorld, Scene};
use moreau::shape::Shape;
use moreau::space::Space;
use moreau::step::{Workspace, step};
use moreau::world::World;
use moreau_solve::GlobalMethod;
use std::error::Error;
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let Some((steps, scenes)) = words.split_first() else { return Err("usage: standing STEPS SCENE.toml …".into()) };
    let steps: u64 = steps.parse()?;
    println!(
        "| scene | free bodies | steps | unconverged | drift / radius | kinetic / (m g radius) | weight carried − 1 | deepest overlap / radius | seconds | falls when tilted by |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for path in scenes {
        let scene = Scene::load(Path::new(path))?;
        let name = Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        match scene.build(u64::MAX)? {
            AnyWorld::Plane(world) => row(&name, &world, steps)?,
            AnyWorld::Solid(world) => row(&name, &world, steps)?,
        }
    }
    Ok(())
}

fn radius<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, i: usize) -> f64 {
    world.bodies.shape[i].bounding_radius().unwrap_or(f64::INFINITY)
}

fn free<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> impl Iterator<Item = usize> + '_ {
    (0..world.bodies.len()).filter(|&i| world.bodies.is_free(i))
}

/// The greatest way of a free body, in its radius.
fn drift<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, start: &World<S, D, N>) -> f64 {
    let way = |i: usize| {
        let (p, q) = (world.bodies.pose[i].position, start.bodies.pose[i].position);
        (0..D).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt() / radius(start, i)
    };
    free(start).map(way).fold(0.0, f64::max)
}

fn row<S: Space<D, N>, const D: usize, const N: usize>(
    name: &str,
    start: &World<S, D, N>,
    steps: u64,
) -> Result<(), Box<dyn Error>> {
    let (mut world, mut work) = (start.clone(), Workspace::default());
    let g = start.gravity.iter().map(|x| x * x).sum::<f64>().sqrt();
    let weight: f64 = free(start).map(|i| start.bodies.mass[i][0] * g).sum();
    let scale: f64 = free(start).map(|i| start.bodies.mass[i][0] * g * radius(start, i)).sum();
    let smallest = free(start).map(|i| radius(start, i)).fold(f64::INFINITY, f64::min);
    let (mut unconverged, mut deepest, mut kinetic, mut carried) = (0, 0.0_f64, 0.0_f64, 0.0_f64);
    let clock = std::time::Instant::now();
    for k in 0..steps {
        let record = step(&mut world, &mut work)?;
        unconverged += u64::from(!record.converged());
        deepest = deepest.max(record.penetration);
        if k >= steps - steps.div_ceil(10) {
            kinetic = kinetic.max(record.energy.kinetic / scale);
            carried = carried.max((supports(&world, &work) / (weight * world.settings.h) - 1.0).abs());
        }
    }
    let seconds = clock.elapsed().as_secs_f64();
    let bodies = free(start).count();
    let falls = tilt(start)?.map_or("more than 45°".to_owned(), |degrees| format!("{degrees}°"));
    println!(
        "| {name} | {bodies} | {steps} | {unconverged} | {:.1e} | {kinetic:.1e} | {carried:.1e} | {:.1e} | {seconds:.0} | {falls} |",
        drift(&world, start),
        deepest / smallest
    );
    Ok(())
}

/// The impulse against gravity that bodies which are not free give the others in a step, N·s.
fn supports<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>, work: &Workspace<S, D, N>) -> f64 {
    let g = world.gravity.iter().map(|x| x * x).sum::<f64>().sqrt();
    let up = world.gravity.map(|x| -x / g);
    let of = |c: &moreau::step::Localised<D>| {
        let [a, b] = [c.contact.key.a, c.contact.key.b].map(|body| world.bodies.is_free(body as usize));
        let impulse: f64 = (0..D).map(|k| up[k] * (0..D).map(|i| c.frame[i][k] * c.impulse[i]).sum::<f64>()).sum();
        match (a, b) {
            (false, true) => impulse,
            (true, false) => -impulse,
            _ => 0.0,
        }
    };
    work.contacts().iter().map(of).sum()
}

/// The least of some angles of gravity from the vertical, towards x, at which a body goes a tenth of its radius in a second.
fn tilt<S: Space<D, N>, const D: usize, const N: usize>(start: &World<S, D, N>) -> Result<Option<f64>, Box<dyn Error>> {
    for degrees in [1.0_f64, 2.0, 3.0, 5.0, 7.0, 10.0, 14.0, 18.0, 22.0, 27.0, 32.0, 38.0, 45.0] {
        let mut world = start.clone();
        // Hardly any method ends a step of hundreds of sliding blocks as finely as one at rest, and a fall shows without.
        let solver = &mut world.settings.solver;
        (solver.global, solver.max_sweeps) = (GlobalMethod::Accelerated, solver.max_sweeps.min(5000));
        let g = world.gravity[D - 1];
        world.gravity[0] = -g * degrees.to_radians().sin();
        world.gravity[D - 1] = g * degrees.to_radians().cos();
        let steps = (1.0 / world.settings.h).ceil() as u64;
        let outcome = run(&mut world, &mut Workspace::default(), Task::new(steps), &mut [], &AtomicBool::new(false), |_| {})?;
        if outcome.end != End::Done || drift(&world, start) > 0.1 {
            return Ok(Some(degrees));
        }
    }
    Ok(None)
}
