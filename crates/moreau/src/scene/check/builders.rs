//! Checks of builders.

use super::bodies::orientation_of;
use super::{MOST_BODIES, material, vector};
use crate::scene::builders::{BUILDERS, Build, Site};
use crate::scene::error::Fault;
use crate::scene::path::{KeyPath, key_path};
use crate::scene::{MotionKind, Scene};

pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    let mut total = 0_u64;
    for (i, build) in scene.build.iter().enumerate() {
        let path = key_path!["build", i];
        builder(scene, i, build, &path)?;
        name(scene, i, build, &path)?;
        let count = build.count(scene.dimension.number());
        total = total.saturating_add(count);
        if total > MOST_BODIES {
            let message = format!("{count} bodies here make more than the {MOST_BODIES} that can be numbered");
            return Err(Fault::new(path.then("kind"), message, "expected fewer bodies"));
        }
    }
    Ok(())
}

fn builder(scene: &Scene, index: usize, build: &Build, path: &KeyPath) -> Result<(), Fault> {
    let dimension = scene.dimension.number();
    let kind = &build.kind;
    if !kind.dimensions().contains(&dimension) {
        let known = BUILDERS.iter().filter(|(dimensions, _)| dimensions.contains(&dimension)).map(|(_, row)| row.name);
        let hint = format!("the builders of dimension {dimension} are {}", known.collect::<Vec<_>>().join(", "));
        return Err(Fault::new(path.then("kind"), format!("a {} where dimension = {dimension}", kind.name()), hint));
    }
    material(scene, path.then("material"), &build.material)?;
    vector(scene, path.then("position"), &build.position, false)?;
    if let Some(orientation) = &build.orientation {
        orientation_of(scene, orientation, &path.then("orientation"))?;
    }
    kind.builder().check(&Site::new(scene, index, build))?;
    if build.motion() == MotionKind::Fixed && kind.builder().spin() != 0.0 {
        let hint = "leave the spin out, or set motion = \"driven\" (turns as given) or \"free\"";
        return Err(Fault::new(path.then("motion"), "a spin of fixed bodies", hint));
    }
    Ok(())
}

/// Names of builders differ, and the names that they give to their bodies are no other body's.
fn name(scene: &Scene, index: usize, build: &Build, path: &KeyPath) -> Result<(), Fault> {
    if build.name.is_some()
        && let Some(first) = scene.build[..index].iter().position(|other| other.name == build.name)
    {
        let hint = format!("build[{first}] has it already: expected a name of its own, or none");
        return Err(Fault::new(path.then("name"), "a name that is taken", hint));
    }
    let ours = |name: &str| build.number_of(name, scene.dimension.number()).is_some();
    let taken = scene.bodies.iter().position(|body| body.name.as_deref().is_some_and(ours));
    taken.map_or(Ok(()), |i| {
        let hint = format!("expected another name of this body or of build[{index}]");
        Err(Fault::new(key_path!["bodies", i, "name"], format!("the name of a body of build[{index}]"), hint))
    })
}
