//! Checks of single bodies and of containers.

use super::plane::{compound, polygon, polyline};
use super::solid::pointed;
use super::{angular, material, max_overlap, plural, positive, region, vector};
use crate::scene::error::Fault;
use crate::scene::path::{KeyPath, key_path};
use crate::scene::{BodySpec, Container, Face, MotionKind, Numbers, Orientation, Scene, ShapeSpec, Turn};
use std::collections::BTreeMap;

pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    let mut names = BTreeMap::new();
    for (i, body) in scene.bodies.iter().enumerate() {
        if let Some(first) = body.name.as_ref().and_then(|name| names.insert(name, i)) {
            let hint = format!("bodies[{first}] has it already: expected a name of its own, or none");
            return Err(Fault::new(key_path!["bodies", i, "name"], "a name that is taken", hint));
        }
        body_of(scene, body, &key_path!["bodies", i])?;
    }
    scene.containers.iter().enumerate().try_for_each(|(i, container)| container_of(scene, container, &key_path!["containers", i]))
}

fn body_of(scene: &Scene, body: &BodySpec, path: &KeyPath) -> Result<(), Fault> {
    shape(scene, &body.shape, &path.then("shape"))?;
    material(scene, path.then("material"), &body.material)?;
    body.density.map_or(Ok(()), |density| positive(path.then("density"), density, "in kg/m³ (kg/m² in the plane)"))?;
    body.max_overlap.map_or(Ok(()), |part| max_overlap(path.then("max_overlap"), part))?;
    vector(scene, path.then("position"), &body.position, false)?;
    vector(scene, path.then("velocity"), &body.velocity, true)?;
    vector(scene, path.then("force"), &body.force, true)?;
    angular(scene, path.then("spin"), body.spin.as_ref())?;
    angular(scene, path.then("torque"), body.torque.as_ref())?;
    if let Some(orientation) = &body.orientation {
        if body.shape.has_normal() {
            let hint = "its normal says how it is turned: leave the orientation out";
            return Err(Fault::new(path.then("orientation"), format!("an orientation of a {}", body.shape.name()), hint));
        }
        orientation_of(scene, orientation, &path.then("orientation"))?;
    }
    motion(body, path)
}

fn motion(body: &BodySpec, path: &KeyPath) -> Result<(), Fault> {
    let moves = !body.velocity.is_empty() || body.spin.is_some();
    let loaded = !body.force.is_empty() || body.torque.is_some();
    match body.motion() {
        MotionKind::Free if !body.shape.has_mass() => {
            let message = format!("a {} that is free: it has no mass", body.shape.name());
            Err(Fault::new(path.then("motion"), message, "expected \"fixed\" or \"driven\""))
        }
        MotionKind::Fixed if moves => {
            let key = if body.velocity.is_empty() { "spin" } else { "velocity" };
            let hint = "leave it out, or set motion = \"driven\" (moves as given) or \"free\"";
            Err(Fault::new(path.then(key), format!("a {key} of a fixed body"), hint))
        }
        MotionKind::Fixed | MotionKind::Driven if loaded && !body.is_ever_free() => {
            let key = if body.force.is_empty() { "torque" } else { "force" };
            let hint = "leave it out, or set motion = \"free\": only free bodies follow forces";
            Err(Fault::new(path.then(key), format!("a {key} on a body that is not free"), hint))
        }
        _ => Ok(()),
    }
}

pub(super) fn orientation_of(scene: &Scene, orientation: &Orientation, path: &KeyPath) -> Result<(), Fault> {
    let fault = |message: &str, hint: &str| Err(Fault::new(path.clone(), message, hint));
    let plane = scene.dimension.number() == 2;
    match orientation {
        Orientation::Angle(angle) if plane && angle.is_finite() => Ok(()),
        Orientation::Angle(_) => fault("an angle without an axis", "expected [x, y, z, w] or { axis = [0, 0, 1], degrees = 30 }"),
        Orientation::Quaternion(_) if plane => {
            fault("a quaternion in the plane", "expected an angle in rad, or { degrees = 30 }")
        }
        Orientation::Quaternion(q) if q.len() != 4 => {
            fault(&plural(q.len(), "component"), "expected the 4 numbers x, y, z, w of a quaternion")
        }
        Orientation::Quaternion(q) => nonzero(path, q),
        Orientation::Turn(Turn { axis, angle, degrees }) => match (axis, angle, degrees) {
            (_, Some(_), Some(_)) | (_, None, None) => {
                fault("not exactly one angle", "expected either `angle` (rad) or `degrees`")
            }
            (Some(_), ..) if plane => fault("an axis in the plane", "expected only an angle: the plane turns about z"),
            (None, ..) if !plane => fault("an angle without an axis", "expected { axis = [0, 0, 1], degrees = 30 }"),
            (Some(Numbers(axis)), ..) => nonzero(&path.then("axis"), axis),
            (None, ..) => Ok(()),
        },
    }
}

/// A direction of any length but zero, neither so long nor so short that its square is not a number.
pub(super) fn nonzero(path: &KeyPath, direction: &[f64]) -> Result<(), Fault> {
    let square: f64 = direction.iter().map(|x| x * x).sum();
    if square.is_normal() {
        return Ok(());
    }
    Err(Fault::new(path.clone(), "a direction without a length", "expected numbers that are not all zero"))
}

pub(super) fn shape(scene: &Scene, shape: &ShapeSpec, path: &KeyPath) -> Result<(), Fault> {
    let dimension = scene.dimension.number();
    if !shape.dimensions().contains(&dimension) {
        let plane = "disk, box, polygon, capsule, compound, half_plane and polyline";
        let solid = "ball, box, capsule, cylinder, polyhedron, compound, mesh, height_field and half_space";
        let known = if dimension == 2 { plane } else { solid };
        let message = format!("a {} where dimension = {dimension}", shape.name());
        return Err(Fault::new(path.clone(), message, format!("the shapes of dimension {dimension} are {known}")));
    }
    let path = path.then(shape.name());
    match shape {
        ShapeSpec::Ball { radius } | ShapeSpec::Disk { radius } => positive(path.then("radius"), *radius, "in m"),
        ShapeSpec::Box { size } => {
            vector(scene, path.then("size"), size, false)?;
            size.iter().enumerate().try_for_each(|(k, &edge)| positive(path.then("size").then(k), edge, "in m"))
        }
        ShapeSpec::HalfSpace { normal: Numbers(normal) } => nonzero(&path.then("normal"), normal),
        ShapeSpec::HalfPlane { normal: Numbers(normal) } => nonzero(&path.then("normal"), normal),
        ShapeSpec::Capsule { radius, length } | ShapeSpec::Cylinder { radius, length } => {
            positive(path.then("radius"), *radius, "in m")?;
            positive(path.then("length"), *length, "in m")
        }
        ShapeSpec::Polygon { vertices, decompose, file } => polygon(&path, vertices, *decompose, file.as_deref()),
        ShapeSpec::Polyline { points, closed, file } => polyline(&path, points, *closed, file.as_deref()),
        ShapeSpec::Polyhedron { .. } | ShapeSpec::Mesh { .. } | ShapeSpec::HeightField { .. } => pointed(shape, &path),
        ShapeSpec::Compound { parts } => compound(scene, &path.then("parts"), parts),
    }
}

fn container_of(scene: &Scene, container: &Container, path: &KeyPath) -> Result<(), Fault> {
    region(scene, path, &container.min, &container.max)?;
    material(scene, path.then("material"), &container.material)?;
    let faces = 2 * scene.dimension.number();
    for (i, face) in container.open.iter().enumerate() {
        let number = Face::ALL.iter().position(|(known, _)| known == face).unwrap_or(faces);
        if number >= faces {
            let hint = "the faces of a region in the plane are -x, +x, -y, +y";
            return Err(Fault::new(path.then("open").then(i), "a face that the plane does not have", hint));
        }
    }
    Ok(())
}
