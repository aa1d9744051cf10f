//! Checks of joints.

use super::{bodies::nonzero, plural, vector};
use crate::scene::error::{Fault, nearest};
use crate::scene::path::{KeyPath, key_path};
use crate::scene::{BodySpec, JointKindSpec, JointSpec, MotionKind, Scene};
use std::collections::BTreeMap;

pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    let mut names = BTreeMap::new();
    for (i, joint) in scene.joints.iter().enumerate() {
        if let Some(first) = joint.name.as_ref().and_then(|name| names.insert(name, i)) {
            let hint = format!("joints[{first}] has it already: expected a name of its own, or none");
            return Err(Fault::new(key_path!["joints", i, "name"], "a name that is taken", hint));
        }
        between(scene, joint, &key_path!["joints", i, "between"])?;
        kind(scene, &joint.kind, &key_path!["joints", i, "kind", joint.kind.name()])?;
    }
    Ok(())
}

/// One or two bodies that there are, of which one is free, if only later.
fn between(scene: &Scene, joint: &JointSpec, path: &KeyPath) -> Result<(), Fault> {
    if !(1..=2).contains(&joint.between.len()) {
        let message = format!("{} names where a joint has one or two", joint.between.len());
        return Err(Fault::new(path.clone(), message, "expected the names of two bodies, or of one that is joined to the world"));
    }
    let mut free = false;
    for (k, name) in joint.between.iter().enumerate() {
        let Some(body) = scene.body_named(name) else {
            let single = scene.bodies.iter().filter_map(|body| body.name.as_deref());
            let firsts: Vec<String> = scene.build.iter().filter_map(|build| build.name_of(0)).collect();
            let hint = nearest(name, "names of bodies", single.chain(firsts.iter().map(String::as_str)));
            return Err(Fault::new(path.then(k), format!("no body is named `{name}`"), hint));
        };
        let later = scene.bodies.get(body).is_some_and(BodySpec::is_ever_free);
        free |= later || scene.motion_of(body) == Some(MotionKind::Free);
    }
    if joint.between.len() == 2 && joint.between[0] == joint.between[1] {
        return Err(Fault::new(
            path.then(1),
            "a body joined to itself",
            "expected the name of another body, or none for the world",
        ));
    }
    if !free {
        return Err(Fault::new(
            path.clone(),
            "a joint of bodies that do not give way",
            "expected at least one body that is free, from the start or by one of its drives",
        ));
    }
    Ok(())
}

fn kind(scene: &Scene, kind: &JointKindSpec, path: &KeyPath) -> Result<(), Fault> {
    let plane = scene.dimension.number() == 2;
    match kind {
        JointKindSpec::Fixed {} => Ok(()),
        JointKindSpec::Hinge { axis, .. } if plane && !axis.is_empty() => {
            Err(Fault::new(path.then("axis"), "an axis in the plane", "leave it out: the plane turns about z"))
        }
        JointKindSpec::Hinge { axis, .. } if !plane && axis.is_empty() => Err(Fault::new(
            path.clone(),
            "a hinge without an axis",
            "expected an axis, as in { anchor = [..], axis = [0, 0, 1] }",
        )),
        JointKindSpec::Hinge { anchor, axis } => {
            vector(scene, path.then("anchor"), anchor, false)?;
            if plane { Ok(()) } else { direction(scene, &path.then("axis"), axis) }
        }
        JointKindSpec::Slider { axis } => direction(scene, &path.then("axis"), axis),
        JointKindSpec::Ball { .. } if plane => {
            let hint = "a pin in the plane is a hinge: write hinge = { anchor = [..] }";
            Err(Fault::new(path.clone(), "a ball joint where dimension = 2", hint))
        }
        JointKindSpec::Ball { anchor } => vector(scene, path.then("anchor"), anchor, false),
        JointKindSpec::Distance { from, to } => {
            vector(scene, path.then("from"), from, false)?;
            vector(scene, path.then("to"), to, false)?;
            let square: f64 = from.iter().zip(to).map(|(a, b)| (a - b) * (a - b)).sum();
            if square.is_normal() {
                return Ok(());
            }
            let message = format!("{} apart", if square == 0.0 { "points that are not" } else { "points too little or too far" });
            Err(Fault::new(path.then("to"), message, "expected two points with a distance between them"))
        }
    }
}

/// A vector with a length.
fn direction(scene: &Scene, path: &KeyPath, axis: &[f64]) -> Result<(), Fault> {
    if axis.is_empty() {
        return Err(Fault::new(path.clone(), plural(0, "component"), "expected a direction that is not zero"));
    }
    vector(scene, path.clone(), axis, false)?;
    nonzero(path, axis)
}
