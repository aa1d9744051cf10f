//! From a scene to a world: the bodies in the order of the scene, then what is built, the walls of containers, and what is generated.

use super::dimension::{SceneSpace, vector, velocity_in_body};
use super::error::Fault;
use super::generate::{Arrangement, Generate, Radii};
use super::lattice::Sites;
use super::packing::pack;
use super::path::{KeyPath, key_path};
use super::spec::{BodySpec, Container, MotionKind};
use super::{Scene, builders, events, joints, start};
use crate::bodies::{Bodies, Body, Motion};
use crate::laws::Laws;
use crate::random::Random;
use crate::space::Pose;
use crate::space::curve::Curve;
use crate::world::{Guard, StepSettings, World};

/// Makes the world of a scene that passed the checks.
pub(super) fn build<S: SceneSpace<D, N>, const D: usize, const N: usize>(scene: &Scene) -> Result<World<S, D, N>, Fault> {
    let mut bodies = Bodies::default();
    for (i, body) in scene.bodies.iter().enumerate() {
        if let Some(body) = explicit::<S, D, N>(scene, body, &key_path!["bodies", i, "shape"])? {
            bodies.push(body);
        }
    }
    for (i, build) in scene.build.iter().enumerate() {
        for (number, body) in (0..).zip(builders::bodies::<S, D, N>(scene, i, build)?) {
            let body = explicit::<S, D, N>(scene, &body, &key_path!["build", i, "kind"])?.ok_or_else(|| {
                let message = format!("{} has no volume that can be told from rounding", build.label_of(i, number));
                Fault::new(key_path!["build", i, "kind"], message, "expected sizes that differ less from each other")
            })?;
            bodies.push(body);
        }
    }
    for container in &scene.containers {
        walls::<S, D, N>(scene, container, &mut bodies);
    }
    for (i, generate) in scene.generate.iter().enumerate() {
        generated::<S, D, N>(scene, i, generate, &mut bodies)?;
    }
    let schedule = events::schedule(scene, &mut bodies)?;
    let joints = joints::joints(scene, &bodies);
    start::check(scene, &bodies, &joints)?;
    let solver = &scene.solver;
    let settings = StepSettings {
        h: scene.time.step,
        theta: scene.time.theta,
        rows: scene.time.rows,
        max_penetration: solver.max_penetration.part(),
        start: solver.start,
        on_failure: solver.on_failure,
        solver: solver.settings(),
    };
    let (laws, gravity) = (laws(scene), vector(&scene.gravity));
    let spec = &scene.guard;
    let domain = (!spec.min.is_empty()).then(|| [vector(&spec.min), vector(&spec.max)]);
    let guard = Guard { domain, penetration: spec.penetration, energy: spec.energy, policy: spec.policy };
    let mut world = World { bodies, laws, joints, gravity, schedule, guard, settings, time: 0.0, steps: 0 };
    // What begins at the start is seen at the start.
    world.act();
    Ok(world)
}

fn laws(scene: &Scene) -> Laws {
    let mut laws = Laws::new(scene.materials.len(), scene.default_law);
    for pair in &scene.laws {
        if let [a, b] = pair.between.as_slice() {
            laws.set(material(scene, a).0, material(scene, b).0, pair.law);
        }
    }
    laws
}

/// The number of a material and its density. Materials are numbered in the order of their names.
pub(super) fn material(scene: &Scene, name: &str) -> (u16, f64) {
    let number = scene.materials.keys().position(|known| known == name).unwrap_or(0) as u16;
    (number, scene.materials.get(name).map_or(0.0, |material| material.density))
}

/// The body of these words, of which `path` is where they give its shape.
fn explicit<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    spec: &BodySpec,
    path: &KeyPath,
) -> Result<Option<Body<S, D, N>>, Fault> {
    let (position, rotation) = (vector(&spec.position), S::rotation(spec.orientation.as_ref()));
    let placed = match S::of_triangles(&spec.shape, position, rotation) {
        Some(Ok(placed)) => Some(placed),
        Some(Err(message)) => {
            return Err(Fault::new(path.then(spec.shape.name()), message, "expected triangles that make a body"));
        }
        None => S::place(&spec.shape, position, rotation),
    };
    let Some((shape, pose)) = placed else { return Ok(None) };
    let velocity = S::join(vector(&spec.velocity), spec.spin.as_ref());
    let (material, density) = material(scene, &spec.material);
    Ok(Some(Body {
        shape,
        velocity: velocity_in_body::<S, D, N>(pose.rotation, &velocity),
        pose,
        density: spec.density.unwrap_or(density),
        material,
        motion: if spec.motion() == MotionKind::Free { Motion::Free } else { Motion::Driven },
        load: S::join(vector(&spec.force), spec.torque.as_ref()),
    }))
}

fn walls<S: SceneSpace<D, N>, const D: usize, const N: usize>(scene: &Scene, spec: &Container, bodies: &mut Bodies<S, D, N>) {
    let (min, max): ([f64; D], [f64; D]) = (vector(&spec.min), vector(&spec.max));
    let (material, density) = material(scene, &spec.material);
    for (axis, high, _) in spec.walls() {
        let mut position = std::array::from_fn(|k| 0.5 * (min[k] + max[k]));
        position[axis] = if high { max[axis] } else { min[axis] };
        let mut normal = [0.0; D];
        normal[axis] = if high { -1.0 } else { 1.0 };
        let (shape, pose) = S::wall(position, normal);
        bodies.push(Body { shape, pose, velocity: [0.0; N], density, material, motion: Motion::Driven, load: [0.0; N] });
    }
}

fn generated<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    index: usize,
    spec: &Generate,
    bodies: &mut Bodies<S, D, N>,
) -> Result<(), Fault> {
    let [mut sizes, mut places, mut speeds] = Random::three(spec.seed.unwrap_or(index as u64));
    let count = usize::try_from(spec.number(D)).unwrap_or(usize::MAX);
    let radii = spec.radii.draw(count, D, &mut sizes).ok_or_else(|| Radii::empty(key_path!["generate", index, "radii"]))?;
    let centres =
        centres::<D>(spec.arrangement().as_ref(), spec.radii.largest(), &radii, &mut places, &key_path!["generate", index])?;
    let (material, density) = material(scene, &spec.material);
    let common = S::join(vector(&spec.velocity), spec.spin.as_ref());
    // Numbered along a curve through space: neighbours are then near each other in memory, too.
    let poses: Vec<_> = centres.into_iter().map(|position| Pose { position, rotation: S::IDENTITY }).collect();
    let mut along = Curve::default();
    let places = along.places(&poses, |_| true);
    let mut order: Vec<usize> = (0..poses.len()).collect();
    order.sort_unstable_by_key(|&i| places[i]);
    for (radius, pose) in order.into_iter().map(|i| (radii[i], poses[i])) {
        let mut velocity = common;
        if spec.speed > 0.0 {
            let direction: [f64; D] = speeds.direction();
            for k in 0..D {
                velocity[k] += spec.speed * direction[k];
            }
        }
        bodies.push(Body { shape: S::round(radius), pose, velocity, density, material, motion: Motion::Free, load: [0.0; N] });
    }
    Ok(())
}

/// Centres for balls of these radii, none larger than the `largest`.
pub(super) fn centres<const D: usize>(
    arrangement: Option<&Arrangement<'_>>,
    largest: f64,
    radii: &[f64],
    random: &mut Random,
    path: &KeyPath,
) -> Result<Vec<[f64; D]>, Fault> {
    match arrangement {
        Some(Arrangement::Lattice(lattice)) => {
            let sites = Sites::new(lattice, largest, D);
            let room = 0.5 * lattice.jitter * (sites.spacing() - 2.0 * largest).max(0.0);
            let mut centres = sites.first::<D>(radii.len());
            if room > 0.0 {
                for centre in &mut centres {
                    let step: [f64; D] = random.in_ball();
                    *centre = std::array::from_fn(|k| centre[k] + room * step[k]);
                }
            }
            Ok(centres)
        }
        Some(Arrangement::Packing(packing)) => {
            let (min, max) = (vector(&packing.min), vector(&packing.max));
            pack(radii, &min, &max, packing.tries, random).map_err(|placed| {
                let message =
                    format!("{placed} of {} bodies fit: the next found no room in {} tries", radii.len(), packing.tries);
                let hint = "expected fewer bodies, a larger region, more tries, or a lattice";
                Fault::new(path.then("packing"), message, hint)
            })
        }
        None => Ok(Vec::new()),
    }
}
