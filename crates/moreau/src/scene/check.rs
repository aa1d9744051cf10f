//! What a scene must keep to beyond its form: ranges, names, and numbers of components.

mod bodies;
mod builders;
mod events;
pub(super) mod generate;
mod joints;
mod plane;
mod solid;

pub(super) use plane::{Refusal, polygon_error, polyline_error};
pub(super) use solid::concavity;

use super::error::{Fault, nearest};
use super::path::{KeyPath, Segment, key_path};
use super::{Angular, CheckpointSpec, Output, Scene};
use std::collections::{BTreeMap, BTreeSet};

/// The most bodies that there can be: their indices are 32 bits wide, and one is kept for "none".
const MOST_BODIES: u64 = u32::MAX as u64 - 1;

/// Finds the first thing that is wrong with a scene and can be seen without making its bodies.
pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    vector(scene, key_path!["gravity"], &scene.gravity, true)?;
    time(scene)?;
    scene.solver.settings().check().map_err(|e| {
        let given = if e.setting == "max_sweeps" { scene.solver.max_sweeps.to_string() } else { e.value.to_string() };
        Fault::new(key_path!["solver", e.setting], format!("{} is {given}", e.setting), format!("expected {}", e.range))
    })?;
    if let Some(part) = scene.solver.max_penetration.part()
        && !(part > 1e-9 && part <= 0.1)
    {
        let hint = "expected a part of the smaller radius, above 1e-9 and up to 0.1, or \"never\"";
        return Err(Fault::new(key_path!["solver", "max_penetration"], format!("max_penetration is {part}"), hint));
    }
    materials_and_laws(scene)?;
    max_overlap(key_path!["start", "max_overlap"], scene.start.max_overlap)?;
    guard(scene)?;
    output(&scene.output)?;
    checkpoint(&scene.checkpoint)?;
    bodies::check(scene)?;
    builders::check(scene)?;
    generate::check(scene)?;
    joints::check(scene)?;
    events::check(scene)?;
    count(scene)
}

/// How far bodies may overlap at the start.
pub(super) fn max_overlap(path: KeyPath, part: f64) -> Result<(), Fault> {
    if (0.0..=1.0).contains(&part) {
        return Ok(());
    }
    Err(Fault::new(path, format!("max_overlap is {part}"), "expected a part of the smaller radius, from 0 to 1"))
}

fn time(scene: &Scene) -> Result<(), Fault> {
    let time = &scene.time;
    positive(key_path!["time", "step"], time.step, "in s")?;
    if !(0.5..=1.0).contains(&time.theta) {
        let hint = "expected a number from 0.5 (keeps energy) to 1 (implicit Euler)";
        return Err(Fault::new(key_path!["time", "theta"], format!("theta is {}", time.theta), hint));
    }
    if time.steps == 0 {
        return Err(Fault::new(key_path!["time", "steps"], "a run of 0 steps", "expected 1 step or more"));
    }
    Ok(())
}

fn materials_and_laws(scene: &Scene) -> Result<(), Fault> {
    if scene.materials.len() > usize::from(u16::MAX) {
        let hint = format!("expected at most {}", u16::MAX);
        return Err(Fault::new(key_path!["materials"], format!("{} materials", scene.materials.len()), hint));
    }
    for (name, material) in &scene.materials {
        positive(key_path!["materials", name, "density"], material.density, "in kg/m³ (kg/m² in the plane)")?;
    }
    law(&key_path!["default_law"], &scene.default_law)?;
    let mut pairs = BTreeMap::new();
    for (i, pair) in scene.laws.iter().enumerate() {
        let between = key_path!["laws", i, "between"];
        let [a, b] = pair.between.as_slice() else {
            let message = format!("{} materials where a law has two", pair.between.len());
            return Err(Fault::new(between, message, "expected the names of two materials, as in [\"glass\", \"steel\"]"));
        };
        material(scene, between.then(0), a)?;
        material(scene, between.then(1), b)?;
        if let Some(first) = pairs.insert((a.min(b), a.max(b)), i) {
            let message = format!("a second law between `{a}` and `{b}`");
            return Err(Fault::new(between, message, format!("laws[{first}] is the first: keep one of them")));
        }
        law(&key_path!["laws", i, "law"], &pair.law)?;
    }
    Ok(())
}

fn law(path: &KeyPath, law: &moreau_solve::Law) -> Result<(), Fault> {
    law.check().map_err(|e| {
        let message = format!("{} is {}", e.parameter, e.value);
        Fault::new(path.then(law.name()).then(e.parameter), message, format!("expected {}", e.range))
    })
}

fn output(output: &Output) -> Result<(), Fault> {
    let mut seen = BTreeSet::new();
    let twice = output.kinds.iter().position(|kind| !seen.insert(*kind as u8));
    twice.map_or(Ok(()), |i| {
        Err(Fault::new(key_path!["output", "kinds", i], "the same kind of output twice", "expected each kind at most once"))
    })
}

fn guard(scene: &Scene) -> Result<(), Fault> {
    let guard = &scene.guard;
    if !guard.min.is_empty() || !guard.max.is_empty() {
        vector(scene, key_path!["guard", "min"], &guard.min, false)?;
        vector(scene, key_path!["guard", "max"], &guard.max, false)?;
        if let Some(k) = guard.min.iter().zip(&guard.max).position(|(min, max)| min >= max) {
            let message = format!("max is {}, min {}", guard.max[k], guard.min[k]);
            return Err(Fault::new(key_path!["guard", "max", k], message, "expected more than min"));
        }
    }
    for (name, limit) in [("penetration", guard.penetration), ("energy", guard.energy)] {
        if let Some(limit) = limit.filter(|limit| limit.is_nan() || *limit < 0.0) {
            return Err(Fault::new(key_path!["guard", name], format!("the limit is {limit}"), "expected 0 or more"));
        }
    }
    Ok(())
}

fn checkpoint(checkpoint: &CheckpointSpec) -> Result<(), Fault> {
    if checkpoint.seconds >= 0.0 {
        return Ok(());
    }
    let message = format!("checkpoints each {} s", checkpoint.seconds);
    Err(Fault::new(key_path!["checkpoint", "seconds"], message, "expected seconds, or 0 for none by the clock"))
}

/// Counts the bodies before any is made.
fn count(scene: &Scene) -> Result<(), Fault> {
    let dimension = scene.dimension.number();
    let mut total = scene.explicit_bodies();
    for (i, generate) in scene.generate.iter().enumerate() {
        let number = generate.number(dimension);
        total = total.saturating_add(number);
        if total > MOST_BODIES {
            let message = format!("{number} bodies here make more than the {MOST_BODIES} that can be numbered");
            let place = if generate.count.is_some() { "count" } else { "lattice" };
            return Err(Fault::new(key_path!["generate", i, place], message, "expected fewer bodies"));
        }
    }
    for (i, source) in scene.sources.iter().enumerate() {
        let number = source.number(&scene.time);
        total = total.saturating_add(number);
        if total > MOST_BODIES {
            let message = format!("{number} bodies here make more than the {MOST_BODIES} that can be numbered");
            return Err(Fault::new(key_path!["sources", i], message, "expected a smaller rate, or a count"));
        }
    }
    if scene.bodies.is_empty() && scene.build.is_empty() && scene.generate.is_empty() && scene.sources.is_empty() {
        let hint = "add [[bodies]], [[build]], [[generate]] or [[sources]]; a container alone has nothing to hold";
        return Err(Fault::new(KeyPath::default(), "the scene has no bodies", hint));
    }
    Ok(())
}

/// Lengths, m, of which moments of inertia, of the fifth power, are numbers.
const LENGTHS: std::ops::RangeInclusive<f64> = 1e-50..=1e50;

/// A positive number; `unit` ends the hint. Lengths (in m) must be such that masses can be told from them.
pub(super) fn positive(path: KeyPath, value: f64, unit: &str) -> Result<(), Fault> {
    let is_length = unit == "in m";
    if value > 0.0 && value.is_finite() && (!is_length || LENGTHS.contains(&value)) {
        return Ok(());
    }
    let unit = if is_length { "in m, from 1e-50 to 1e50: others have no mass that is a number" } else { unit };
    let key = path.0.iter().rev().find_map(|segment| if let Segment::Key(key) = segment { Some(&**key) } else { None });
    let message = format!("{} is {value:?}", key.unwrap_or("the value"));
    Err(Fault::new(path, message, format!("expected a positive number, {unit}")))
}

/// A vector with as many numbers as the scene has dimensions; where `optional`, none are zero.
fn vector(scene: &Scene, path: KeyPath, value: &[f64], optional: bool) -> Result<(), Fault> {
    let dimension = scene.dimension.number();
    if value.len() == dimension || (optional && value.is_empty()) {
        return finite(&path, value);
    }
    let message = format!("{} where dimension = {dimension}", plural(value.len(), "component"));
    Err(Fault::new(path, message, format!("expected {dimension} numbers")))
}

fn finite(path: &KeyPath, values: &[f64]) -> Result<(), Fault> {
    let bad = values.iter().position(|x| !x.is_finite());
    bad.map_or(Ok(()), |i| Err(Fault::new(path.then(i), format!("the value is {}", values[i]), "expected a finite number")))
}

/// A spin or torque of the scene's dimension.
fn angular(scene: &Scene, path: KeyPath, value: Option<&Angular>) -> Result<(), Fault> {
    match (value, scene.dimension.number()) {
        (None, _) => Ok(()),
        (Some(Angular::Plane(number)), 2) if number.is_finite() => Ok(()),
        (Some(Angular::Solid(numbers)), 3) => vector(scene, path, numbers, false),
        (Some(_), 2) => Err(Fault::new(path, "not one finite number", "expected one number in the plane")),
        (Some(_), _) => {
            Err(Fault::new(path, "one number where dimension = 3", "expected 3 numbers, a vector in the world frame"))
        }
    }
}

/// A region with its lowest and highest corner.
fn region(scene: &Scene, path: &KeyPath, min: &[f64], max: &[f64]) -> Result<(), Fault> {
    vector(scene, path.then("min"), min, false)?;
    vector(scene, path.then("max"), max, false)?;
    let flat = min.iter().zip(max).position(|(low, high)| low >= high);
    flat.map_or(Ok(()), |k| {
        let message = format!("max is {} where min is {}", max[k], min[k]);
        Err(Fault::new(path.then("max").then(k), message, "expected max above min in every component"))
    })
}

/// The name of a material that the scene has.
pub(super) fn material(scene: &Scene, path: KeyPath, name: &str) -> Result<(), Fault> {
    if scene.materials.contains_key(name) {
        return Ok(());
    }
    let hint = nearest(name, "materials", scene.materials.keys().map(String::as_str));
    Err(Fault::new(path, format!("unknown material `{name}`"), hint))
}

/// "1 thing" or "2 things".
fn plural(count: usize, thing: &str) -> String {
    if count == 1 { format!("1 {thing}") } else { format!("{count} {thing}s") }
}
