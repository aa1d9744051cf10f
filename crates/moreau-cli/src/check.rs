//! `moreau check`: what a scene would run.

use crate::failure::{Failure, say};
use crate::scene;
use crate::table::aligned;
use moreau::scene::{AnyWorld, Scene};
use moreau::shape::Shape;
use moreau::space::Space;
use moreau::world::World;
use std::path::PathBuf;

/// Arguments of `moreau check`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The scene file
    scene: PathBuf,
    /// Change a value of the scene: key.path=value (may be given again)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
}

/// Prints bodies, mass, box, steps, solver, memory.
pub(crate) fn check(args: &Args) -> Result<(), Failure> {
    let scene = scene::load(&args.scene, &args.sets)?;
    let rows = match scene::build(&scene)? {
        AnyWorld::Plane(world) => rows(&scene, &world),
        AnyWorld::Solid(world) => rows(&scene, &world),
    };
    say(&aligned(&rows))
}

fn rows<S: Space<D, N>, const D: usize, const N: usize>(scene: &Scene, world: &World<S, D, N>) -> Vec<Vec<String>> {
    let bodies = &world.bodies;
    let free = (0..bodies.len()).filter(|&i| bodies.is_free(i)).count();
    let mass: f64 = (0..bodies.len()).filter(|&i| bodies.is_free(i)).map(|i| bodies.mass[i][0]).fold(0.0, |sum, mass| sum + mass);
    let mut low = [f64::INFINITY; D];
    let mut high = [f64::NEG_INFINITY; D];
    for (shape, pose) in bodies.shape.iter().zip(&bodies.pose) {
        let Some(radius) = shape.bounding_radius() else { continue };
        for k in 0..D {
            low[k] = low[k].min(pose.position[k] - radius);
            high[k] = high[k].max(pose.position[k] + radius);
        }
    }
    let (settings, solver) = (&world.settings, &world.settings.solver);
    let (present, places) = (bodies.present(), bodies.len());
    let to_come = if places > present { format!(", up to {} to come", places - present) } else { String::new() };
    let list = |v: &[f64]| v.iter().map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(", ");
    let row = |name: &str, value: String| vec![name.to_owned(), value];
    vec![
        row("dimension", format!("{D}D")),
        row("bodies", format!("{present} ({free} free, {} fixed or driven){to_come}", present - free)),
        row("mass", format!("{mass:.6e} kg")),
        row("box", format!("[{}] to [{}] m", list(&low), list(&high))),
        row(
            "time",
            format!("{} steps of {:e} s, to t = {:.6} s", scene.time.steps, settings.h, scene.time.steps as f64 * settings.h),
        ),
        row("solver", format!("{} inside {}, tolerance {:e}", solver.local.name(), solver.global.name(), solver.tolerance)),
        row("memory", format!("about {:.2} MiB expected", scene.estimate().memory_bytes as f64 / f64::from(1 << 20))),
    ]
}
