//! Granular measures against what is known: of lattices, columns and cut bodies.

mod lattices;
mod loads;
mod rows;
mod volumes;

use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid, Space};
use moreau::step::{Workspace, step};
use moreau::world::World;

/// The scene of these bodies, each with its keys but for the material; distances are in m, the density is 1000.
fn scene(dimension: usize, gravity: &[f64], bodies: &[String]) -> AnyWorld {
    let bodies: String = bodies.iter().map(|keys| format!("[[bodies]]\nmaterial = \"stone\"\n{keys}\n")).collect();
    let text = format!(
        "dimension = {dimension}\ngravity = {gravity:?}\ntime = {{ step = 1e-3, steps = 1 }}\n\
         solver = {{ criterion = \"scaled\", tolerance = 1e-13, max_sweeps = 100000 }}\n\
         materials.stone.density = 1000.0\ndefault_law.coulomb = {{ friction = 0.5 }}\n{bodies}"
    );
    let scene = Scene::parse(&text, "test.toml").unwrap_or_else(|error| panic!("{error}"));
    scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}"))
}

fn solid(gravity: [f64; 3], bodies: &[String]) -> World<Solid, 3, 6> {
    match scene(3, &gravity, bodies) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of the plane"),
    }
}

fn plane(gravity: [f64; 2], bodies: &[String]) -> World<Plane, 2, 3> {
    match scene(2, &gravity, bodies) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("of space"),
    }
}

fn ball(at: [f64; 3], radius: f64) -> String {
    format!("shape.ball = {{ radius = {radius:?} }}\nposition = {at:?}")
}

fn disk(at: [f64; 2], radius: f64) -> String {
    format!("shape.disk = {{ radius = {radius:?} }}\nposition = {at:?}")
}

/// The contacts of one step, which is of the length in the scene.
fn stepped<S: Space<D, N>, const D: usize, const N: usize>(world: &mut World<S, D, N>) -> Workspace<S, D, N> {
    let mut work = Workspace::default();
    assert!(step(world, &mut work).unwrap().converged());
    work
}

fn close<const D: usize>(found: &[[f64; D]; D], right: &[[f64; D]; D], tolerance: f64) {
    for (one, other) in found.as_flattened().iter().zip(right.as_flattened()) {
        assert!((one - other).abs() <= tolerance, "{found:?} is not {right:?}");
    }
}

/// s times the identity.
fn isotropic<const D: usize>(s: f64) -> [[f64; D]; D] {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { s } else { 0.0 }))
}
