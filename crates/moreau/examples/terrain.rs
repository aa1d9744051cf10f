//! Rocks that fall on rugged ground, and where the time of a step goes:
//!
//! - `terrain make CELLS ROCKS FOLDER` writes `scene.toml` and `heights.csv`: a slope of CELLS by CELLS cells of 0.25 m, two triangles each, with
//!   hills of three sizes, and ROCKS stones of 0.2 to 0.4 m above it;
//! - `terrain run FOLDER STEPS` runs it and prints, for each tenth of the run, contacts, sweeps, and the time of a step and its parts.

use moreau::scene::{AnyWorld, Scene};
use moreau::shape::{Shape, SolidShape};
use moreau::step::{StepRecord, Workspace, step};
use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

const SPACING: f64 = 0.25;
const SLOPE: f64 = 0.5;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["make", cells, rocks, folder] => make(cells.parse()?, rocks.parse()?, Path::new(folder)),
        ["run", folder, steps] => run(&Path::new(folder).join("scene.toml"), steps.parse()?),
        _ => Err("usage: terrain make CELLS ROCKS FOLDER | terrain run FOLDER STEPS".into()),
    }
}

/// Hills on a slope that falls along x.
fn height(x: f64, y: f64) -> f64 {
    let hill = |length: f64, turn: f64| (x / length + turn).sin() * (y / length - turn).cos();
    -SLOPE * x + 2.0 * hill(9.0, 0.3) + 0.3 * hill(1.7, 1.1) + 0.05 * hill(0.31, 2.0)
}

fn make(cells: usize, rocks: usize, folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut heights = String::new();
    for j in 0..=cells {
        let row: Vec<String> = (0..=cells).map(|i| format!("{:.4}", height(SPACING * i as f64, SPACING * j as f64))).collect();
        writeln!(heights, "{}", row.join(","))?;
    }
    // A layer over the upper part of the slope, eight metres along it, high enough for its hills.
    let across = (rocks as f64 / 8.0).ceil();
    let (begin, middle) = (0.1 * SPACING * cells as f64, 0.5 * SPACING * cells as f64);
    let (low, high) = ([begin, middle - 0.5 * across, 4.0], [begin + 8.0, middle + 0.5 * across, 5.5]);
    let scene = format!(
        "title = \"{rocks} rocks on {} triangles\"\ndimension = 3\ngravity = [0.0, 0.0, -9.81]\ntime = {{ step = 1e-3, steps = 4000 }}\n\
         solver = {{ start = \"warm\", criterion = \"scaled\", max_penetration = 1e-2 }}\nmaterials.rock.density = 2700.0\n\
         default_law.coulomb = {{ friction = 0.5, acts = \"approach\" }}\n\
         [[bodies]]\nname = \"ground\"\nmaterial = \"rock\"\nposition = [0, 0, 0]\n\
         shape.height_field = {{ file = \"heights.csv\", spacing = [{SPACING}, {SPACING}] }}\n\
         [[build]]\nmaterial = \"rock\"\nposition = [0, 0, {:.4}]\n\
         kind.ballast = {{ count = {rocks}, corners = 12, radii.uniform = {{ min = 0.2, max = 0.4 }}, seed = 1, \
         lattice = {{ min = {low:?}, max = {high:?}, spacing = 1.0 }} }}\n",
        2 * cells * cells,
        -SLOPE * begin
    );
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("heights.csv"), heights)?;
    Ok(std::fs::write(folder.join("scene.toml"), scene)?)
}

fn run(path: &Path, steps: usize) -> Result<(), Box<dyn Error>> {
    let begun = Instant::now();
    let scene = Scene::load(path)?;
    let read = begun.elapsed().as_secs_f64();
    let AnyWorld::Solid(mut world) = scene.build(u64::MAX)? else { return Err("a scene of the plane".into()) };
    let triangles: usize = world
        .bodies
        .shape
        .iter()
        .map(|shape| if let SolidShape::Surface(surface) = shape { surface.mesh().triangles.len() } else { 0 })
        .sum();
    let rocks = (0..world.bodies.len()).filter(|&i| world.bodies.is_free(i)).count();
    println!(
        "{triangles} triangles, {rocks} rocks; read in {read:.2} s, built in {:.2} s\n",
        begun.elapsed().as_secs_f64() - read
    );
    println!(
        "| steps | contacts | sweeps | ms a step | of it detection | localising | solving | unconverged | deepest overlap / r |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let mut work = Workspace::default();
    for part in 0..10 {
        let records = (0..steps / 10).map(|_| step(&mut world, &mut work)).collect::<Result<Vec<StepRecord>, _>>()?;
        let mean = |of: &dyn Fn(&StepRecord) -> f64| records.iter().map(of).sum::<f64>() / records.len() as f64;
        let whole = mean(&|record| record.seconds.step);
        let share = |of: &dyn Fn(&StepRecord) -> f64| 100.0 * mean(of) / whole;
        let least = (0..world.bodies.len()).filter_map(|i| world.bodies.shape[i].bounding_radius()).fold(f64::INFINITY, f64::min);
        println!(
            "| {} | {:.0} | {:.0} | {:.2} | {:.0} % | {:.0} % | {:.0} % | {} | {:.1e} |",
            (part + 1) * (steps / 10),
            mean(&|record| record.contacts as f64),
            mean(&|record| record.sweeps as f64),
            1e3 * whole,
            share(&|record| record.seconds.detect),
            share(&|record| record.seconds.localise),
            share(&|record| record.seconds.solve),
            records.iter().filter(|record| !record.converged()).count(),
            records.iter().map(|record| record.penetration).fold(0.0, f64::max) / least,
        );
    }
    Ok(())
}
