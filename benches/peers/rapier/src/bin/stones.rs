//! Pours the stones in Rapier: `stones STONES.txt WIDTH STEP STEPS EVERY OUT`; see `crates/moreau/examples/stones.rs` for the files.
//!
//! All settings are Rapier's own but the step; bodies may not sleep, since a step in which all sleep is none.

use rapier3d_f64::prelude::*;
use std::error::Error;
use std::fmt::Write as _;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [stones, width, step, steps, every, out] = words.as_slice() else { return Err("six arguments are needed".into()) };
    let (width, step): (f64, f64) = (width.parse()?, step.parse()?);
    let (steps, every): (usize, usize) = (steps.parse()?, every.parse()?);
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.dt = step;
    let far = Vector::new(width, width, 0.0);
    for (at, normal) in
        [(Vector::ZERO, Vector::Z), (Vector::ZERO, Vector::X), (Vector::ZERO, Vector::Y), (far, -Vector::X), (far, -Vector::Y)]
    {
        let wall = ColliderBuilder::new(SharedShape::halfspace(normal));
        world.insert(RigidBodyBuilder::fixed().translation(at), material(wall));
    }
    let mut handles = Vec::new();
    for line in std::fs::read_to_string(stones)?.lines() {
        let numbers: Vec<f64> = line.split(' ').map(str::parse).collect::<Result<_, _>>()?;
        let corners: Vec<_> = numbers[3..].chunks_exact(3).map(|p| Vector::new(p[0], p[1], p[2])).collect();
        let hull = ColliderBuilder::convex_hull(&corners).ok_or("a stone has no hull")?;
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(numbers[0], numbers[1], numbers[2])).can_sleep(false);
        handles.push(world.insert(body, material(hull)).0);
    }
    let (mut states, mut seconds) = (Vec::new(), String::new());
    let mut note = |world: &PhysicsWorld| {
        for &handle in &handles {
            let body = &world.bodies[handle];
            let (at, q) = (body.translation(), body.rotation());
            let (v, spin) = (body.linvel(), body.angvel());
            let numbers = [at.x, at.y, at.z, q.x, q.y, q.z, q.w, v.x, v.y, v.z, spin.x, spin.y, spin.z];
            states.extend(numbers.into_iter().flat_map(f64::to_le_bytes));
        }
    };
    note(&world);
    for k in 1..=steps {
        let clock = Instant::now();
        world.step();
        writeln!(seconds, "{:e}", clock.elapsed().as_secs_f64())?;
        if k % every == 0 {
            note(&world);
        }
    }
    std::fs::write(format!("{out}.states"), states)?;
    Ok(std::fs::write(format!("{out}.seconds"), seconds)?)
}

fn material(collider: ColliderBuilder) -> ColliderBuilder {
    collider.density(2500.0).friction(0.5).restitution(0.0)
}
