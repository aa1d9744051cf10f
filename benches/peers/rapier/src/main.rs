//! Drops the pile in Rapier: `rapier-pile BALLS.csv WIDTH STEP STEPS EVERY BUDGET OUT`.
//!
//! BALLS.csv has a row `radius,x,y,z` a ball. Writes OUT.states (raw little-endian doubles: position, velocity, spin of each ball, for
//! the start and each EVERY-th step) and OUT.seconds (a line a step). Ends early after BUDGET seconds. All settings are Rapier's own
//! but the step; bodies may not sleep, since a step in which all sleep is none.

use rapier3d_f64::prelude::*;
use std::error::Error;
use std::fmt::Write as _;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [balls, width, step, steps, every, budget, out] = words.as_slice() else {
        return Err("seven arguments are needed".into());
    };
    let (width, step, budget): (f64, f64, f64) = (width.parse()?, step.parse()?, budget.parse()?);
    let (steps, every): (usize, usize) = (steps.parse()?, every.parse()?);

    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.dt = step;
    walls(&mut world, width);
    let mut handles = Vec::new();
    for row in std::fs::read_to_string(balls)?.lines() {
        let numbers: Vec<f64> = row.split(',').map(str::parse).collect::<Result<_, _>>()?;
        let [radius, x, y, z] = numbers[..] else { return Err(format!("not a ball: {row}").into()) };
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, y, z)).can_sleep(false);
        handles.push(world.insert(body, material(ColliderBuilder::ball(radius))).0);
    }

    let (mut states, mut seconds) = (Vec::new(), String::new());
    let mut note = |world: &PhysicsWorld| {
        for &handle in &handles {
            let body = &world.bodies[handle];
            for v in [body.translation(), body.linvel(), body.angvel()] {
                states.extend([v.x, v.y, v.z].into_iter().flat_map(f64::to_le_bytes));
            }
        }
    };
    note(&world);
    let started = Instant::now();
    for k in 1..=steps {
        let clock = Instant::now();
        world.step();
        writeln!(seconds, "{:e}", clock.elapsed().as_secs_f64())?;
        if k % every == 0 {
            note(&world);
        }
        if started.elapsed().as_secs_f64() > budget {
            break;
        }
    }
    std::fs::write(format!("{out}.states"), states)?;
    Ok(std::fs::write(format!("{out}.seconds"), seconds)?)
}

/// A floor and four walls.
fn walls(world: &mut PhysicsWorld, width: f64) {
    let far = Vector::new(width, width, 0.0);
    for (at, normal) in
        [(Vector::ZERO, Vector::Z), (Vector::ZERO, Vector::X), (Vector::ZERO, Vector::Y), (far, -Vector::X), (far, -Vector::Y)]
    {
        let wall = ColliderBuilder::new(SharedShape::halfspace(normal));
        world.insert(RigidBodyBuilder::fixed().translation(at), material(wall));
    }
}

fn material(collider: ColliderBuilder) -> ColliderBuilder {
    collider.density(2500.0).friction(0.3).restitution(0.0)
}
