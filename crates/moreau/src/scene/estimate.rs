//! What a scene will need, from its counts alone: nothing is generated for it.

use super::error::Fault;
use super::path::key_path;
use super::spec::MotionKind;
use super::{Scene, triangles};

/// Memory of one body in all arrays of a run, bytes: state, forces, detection and scratch.
const BODY_BYTES: u64 = 600;

/// Memory of one contact in all arrays of a run, bytes: points, H, blocks of W, impulses and those of the step before.
const CONTACT_BYTES: u64 = 700;

/// Memory of one triangle of a surface, bytes: its corners, normals, neighbours, and what it is found by.
const TRIANGLE_BYTES: u64 = 300;

/// What a scene holds and needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// How many bodies there are, with those that are fixed or driven, the walls of containers, and those that sources can bring.
    pub bodies: u64,
    /// How many of them move freely.
    pub free_bodies: u64,
    /// How many contacts are to be expected once everything has settled: D for each free body, as in an isostatic heap of balls.
    pub contacts: u64,
    /// The expected mass of all generated bodies, kg.
    pub generated_mass: f64,
    /// The memory of a run, bytes; a guess that is right within a factor of about two.
    pub memory_bytes: u64,
}

pub(super) fn estimate(scene: &Scene) -> Estimate {
    let dimension = scene.dimension.number();
    let mut generated = 0_u64;
    let mut generated_mass = 0.0;
    for generate in &scene.generate {
        let number = generate.number(dimension);
        generated = generated.saturating_add(number);
        let unit_ball = if dimension == 2 { std::f64::consts::PI } else { 4.0 / 3.0 * std::f64::consts::PI };
        let density = scene.materials.get(&generate.material).map_or(0.0, |material| material.density);
        generated_mass += number as f64 * density * unit_ball * generate.radii.mean_power(dimension);
    }
    let to_come = scene.sources.iter().map(|source| source.number(&scene.time)).fold(0, u64::saturating_add);
    let alone = scene.bodies.iter().filter(|body| body.motion() == MotionKind::Free).count() as u64;
    let built = scene.build.iter().map(|build| build.free(dimension));
    let free = built.fold(alone, u64::saturating_add);
    let bodies = generated.saturating_add(to_come).saturating_add(scene.explicit_bodies());
    let free_bodies = generated.saturating_add(to_come).saturating_add(free);
    let contacts = free_bodies.saturating_mul(dimension as u64);
    let triangles: u64 = scene.bodies.iter().map(|body| triangles::count(&body.shape)).sum();
    let each = [(bodies, BODY_BYTES), (contacts, CONTACT_BYTES), (triangles, TRIANGLE_BYTES)];
    let memory_bytes = each.iter().fold(0_u64, |all, (count, bytes)| all.saturating_add(count.saturating_mul(*bytes)));
    Estimate { bodies, free_bodies, contacts, generated_mass, memory_bytes }
}

/// Refuses a scene that needs more memory than there is.
pub(super) fn check_memory(scene: &Scene, available: u64) -> Result<(), Fault> {
    let estimate = estimate(scene);
    if estimate.memory_bytes <= available {
        return Ok(());
    }
    let gib = |bytes: u64| bytes as f64 / f64::from(1 << 30);
    let dimension = scene.dimension.number();
    let largest = (0..scene.generate.len()).max_by_key(|&i| scene.generate[i].number(dimension));
    let generated = largest.map_or(0, |i| scene.generate[i].number(dimension));
    let built = (0..scene.build.len()).max_by_key(|&i| scene.build[i].count(dimension));
    let flowing = (0..scene.sources.len()).max_by_key(|&i| scene.sources[i].number(&scene.time));
    let built = built.filter(|&i| scene.build[i].count(dimension) > generated);
    let path = match (flowing.filter(|&i| scene.sources[i].number(&scene.time) > generated), built) {
        (Some(i), _) => key_path!["sources", i],
        (_, Some(i)) => key_path!["build", i],
        _ => match largest {
            Some(i) if scene.generate[i].count.is_some() => key_path!["generate", i, "count"],
            Some(i) => key_path!["generate", i, "lattice"],
            None => key_path!["bodies"],
        },
    };
    let (need, have) = (gib(estimate.memory_bytes), gib(available));
    let message = format!("{} bodies need about {need:.1} GiB of memory, {have:.1} GiB are there", estimate.bodies);
    Err(Fault::new(path, message, "expected fewer bodies, or a machine with more memory"))
}
