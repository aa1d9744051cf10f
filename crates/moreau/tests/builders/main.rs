//! Builders: what they make is what they say, neighbours share their faces, and what should stand stands.

mod grains;
mod masonry;
mod scenes;

use glam::DVec3;
use moreau::contacts::Contact;
use moreau::detect::Detector;
use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid, Space};
use moreau::world::World;

/// A scene with a ground and one builder.
fn text(dimension: usize, kind: &str) -> String {
    let (gravity, ground, origin) = match dimension {
        2 => ("[0, -9.81]", "half_plane = { normal = [0, 1] }", "[0, 0]"),
        _ => ("[0, 0, -9.81]", "half_space = { normal = [0, 0, 1] }", "[0, 0, 0]"),
    };
    format!(
        "dimension = {dimension}\ngravity = {gravity}\ntime = {{ step = 1e-3, steps = 10 }}\n\
         solver = {{ tolerance = 1e-8, max_sweeps = 20000 }}\nmaterials.stone.density = 1000.0\n\
         default_law.coulomb = {{ friction = 0.6, acts = \"closed\" }}\n\
         [[bodies]]\nname = \"ground\"\nshape.{ground}\nmaterial = \"stone\"\nposition = {origin}\n\
         [[build]]\nname = \"it\"\nmaterial = \"stone\"\nposition = {origin}\nkind.{kind}\n"
    )
}

fn scene(dimension: usize, kind: &str) -> Scene {
    Scene::parse(&text(dimension, kind), "build.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn solid(kind: &str) -> World<Solid, 3, 6> {
    match scene(3, kind).build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of space"),
    }
}

fn plane(kind: &str) -> World<Plane, 2, 3> {
    match scene(2, kind).build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("of the plane"),
    }
}

/// Volume, or area, of all that is built.
fn volume<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> f64 {
    (0..world.bodies.len()).filter(|&i| world.bodies.is_free(i)).map(|i| world.bodies.mass[i][0] / 1000.0).sum()
}

/// Points of contact within a micrometre, of all pairs.
fn contacts<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> Vec<Contact<D>> {
    let bodies = &world.bodies;
    let mut contacts = Vec::new();
    let reach = vec![5e-7; bodies.len()];
    Detector::new().detect::<S, N>(&bodies.shape, &bodies.pose, &reach, |i| !bodies.is_free(i), &mut contacts);
    contacts
}

/// Pairs of bodies that share a face, with the numbers of the builder's bodies; the ground is body 0. Fails where a gap is anything but
/// rounding.
fn faces<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> Vec<(u32, u32)> {
    let contacts = contacts(world);
    for contact in &contacts {
        assert!(contact.gap.abs() < 1e-12, "{} and {}: a gap of {:e}", contact.key.a, contact.key.b, contact.gap);
    }
    let mut pairs: Vec<(u32, u32)> = contacts.iter().map(|contact| (contact.key.a, contact.key.b)).collect();
    pairs.dedup();
    pairs.retain(|&pair| {
        let points: Vec<[f64; D]> = contacts.iter().filter(|c| (c.key.a, c.key.b) == pair).map(|c| c.point).collect();
        size(&points) > 1e-6
    });
    pairs
}

/// The greatest length between some points in the plane, in space the greatest area between three: nothing at a corner or along an edge.
fn size<const D: usize>(points: &[[f64; D]]) -> f64 {
    let way = |p: &[f64; D], q: &[f64; D]| -> [f64; 3] { std::array::from_fn(|k| if k < D { q[k] - p[k] } else { 0.0 }) };
    let mut largest = 0.0_f64;
    for p in points {
        for q in points {
            let u = DVec3::from(way(p, q));
            largest = if D == 2 {
                largest.max(u.length())
            } else {
                points.iter().fold(largest, |most, r| most.max(u.cross(way(p, r).into()).length()))
            };
        }
    }
    largest
}

fn close(found: f64, expected: f64, part: f64) {
    assert!((found / expected - 1.0).abs() < part, "{found} is not {expected}");
}

/// The least distance from the middle at which stone 0, which is body 1, touches the ground.
fn lowest<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> f64 {
    let ours = contacts(world).into_iter().filter(|contact| (contact.key.a, contact.key.b) == (0, 1));
    ours.map(|contact| contact.point[0]).fold(f64::INFINITY, f64::min)
}
