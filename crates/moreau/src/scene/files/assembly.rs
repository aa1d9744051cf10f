//! Files of assemblies of blocks, each a body.

use super::meshes::shape_of;
use super::solid::{bytes, factor, wrong};
use super::{Made, body};
use crate::mesh::compas::{Assembly, Block};
use crate::scene::Scene;
use crate::scene::check;
use crate::scene::error::{Fault, nearest};
use crate::scene::path::KeyPath;
use crate::scene::spec::{BlockSpec, Import, MotionKind, SupportsSpec};
use std::path::Path;

/// Makes a body of each block of an assembly.
pub(super) fn read(scene: &mut Scene, import: Import, number: usize, folder: &Path, path: &KeyPath) -> Result<(), Fault> {
    let Import::Assembly { file, material, scale, decompose, concavity, motion, supports, density, max_overlap, blocks } = import
    else {
        return Ok(());
    };
    let scale = factor(scale, path)?;
    check::concavity(path, concavity, decompose)?;
    density.map_or(Ok(()), |density| check::positive(path.then("density"), density, "in kg/m³"))?;
    let place = path.then("file");
    let mut found = bytes(&file, folder, &place)
        .and_then(|bytes| Assembly::from_json(&bytes, &file).map_err(|error| wrong(&place, &error)))?;
    if found.blocks.is_empty() {
        return Err(Fault::new(place, format!("{file} has no blocks"), "expected an assembly"));
    }
    for block in &mut found.blocks {
        block.mesh.points.iter_mut().for_each(|point| *point = point.map(|x| scale * x));
    }
    // Here, because the body that a later check would name is not in the text.
    check::material(scene, path.then("material"), &material)?;
    each_block(scene, &found, &blocks, decompose, &path.then("blocks"))?;
    let held = held(&found, supports.as_ref(), &path.then("supports"))?;
    let mut remarks = std::mem::take(&mut found.remarks);
    let (mut densities, mut free) = (Vec::new(), false);
    for (block, is_held) in found.blocks.into_iter().zip(held) {
        let own = blocks.get(&block.key).cloned().unwrap_or_default();
        let is_held = own.support.unwrap_or(is_held);
        let motion = if is_held { Some(MotionKind::Fixed) } else { motion };
        free |= !matches!(motion, Some(MotionKind::Fixed | MotionKind::Driven));
        let made = Made { decompose, concavity: own.concavity.or(concavity).filter(|_| decompose), is_fixed: false };
        let shape = shape_of(&block.mesh.triangulated(), made)
            .map_err(|(message, hint)| Fault::new(place.clone(), format!("{file}: block {:?}: {message}", block.key), hint))?;
        let given = own.density.or(density);
        if given.is_none() {
            densities.extend(block.density);
        }
        // Its key, because names of blocks are often all the same.
        let name = format!("import[{number}] {}", block.key);
        let mut body = body(name, shape, own.material.as_deref().unwrap_or(&material), vec![0.0; 3], motion);
        body.density = given.or(block.density);
        body.max_overlap = own.max_overlap.or(max_overlap);
        scene.bodies.push(body);
    }
    if let (Some(least), Some(most)) = (densities.iter().copied().reduce(f64::min), densities.iter().copied().reduce(f64::max)) {
        let range = if least < most { format!("from {least} to {most}") } else { format!("{least}") };
        remarks.push(format!(
            "{file} gives {} blocks a density of their own, {range} kg/m³, in place of that of {material:?}",
            densities.len()
        ));
    }
    if free
        && scene.bodies.iter().all(|body| body.motion() == MotionKind::Free)
        && scene.containers.is_empty()
        && scene.build.is_empty()
    {
        remarks
            .push(format!("{file} has no supports, and nothing else in the scene is fixed; `supports` of the import names some"));
    }
    scene.remarks.0.extend(remarks.into_iter().map(|remark| format!("{place}: {remark}")));
    Ok(())
}

/// Checks what is given for single blocks.
fn each_block(
    scene: &Scene,
    found: &Assembly,
    blocks: &std::collections::BTreeMap<String, BlockSpec>,
    decompose: bool,
    path: &KeyPath,
) -> Result<(), Fault> {
    for (key, spec) in blocks {
        let path = path.then(key);
        known(found, key, &path)?;
        spec.material.as_ref().map_or(Ok(()), |name| check::material(scene, path.then("material"), name))?;
        spec.density.map_or(Ok(()), |density| check::positive(path.then("density"), density, "in kg/m³"))?;
        check::concavity(&path, spec.concavity, decompose)?;
    }
    Ok(())
}

/// Fails if there is no block of this key.
fn known(found: &Assembly, key: &str, path: &KeyPath) -> Result<(), Fault> {
    if found.blocks.iter().any(|block| block.key == key) {
        return Ok(());
    }
    let keys = found.blocks.iter().take(100).map(|block| block.key.as_str());
    Err(Fault::new(path.clone(), format!("there is no block `{key}`"), nearest(key, "blocks", keys)))
}

/// Whether each block is a support.
fn held(found: &Assembly, supports: Option<&SupportsSpec>, path: &KeyPath) -> Result<Vec<bool>, Fault> {
    let mut held: Vec<bool> = found.blocks.iter().map(|block| block.support).collect();
    let Some(SupportsSpec { index, key, below, attribute }) = supports else { return Ok(held) };
    for (i, &number) in index.iter().enumerate() {
        let hint = format!("expected a number below {}, that of the blocks", held.len());
        let Some(block) = held.get_mut(number) else {
            return Err(Fault::new(path.then("index").then(i), format!("there is no block {number}"), hint));
        };
        *block = true;
    }
    for (i, name) in key.iter().enumerate() {
        known(found, name, &path.then("key").then(i))?;
        found.blocks.iter().zip(&mut held).for_each(|(block, held)| *held |= block.key == *name);
    }
    let mut all = |name: &str, message: String, is_one: &dyn Fn(&Block) -> bool| {
        if !found.blocks.iter().any(is_one) {
            return Err(Fault::new(path.then(name), message, "expected one that names at least one block"));
        }
        found.blocks.iter().zip(&mut held).for_each(|(block, held)| *held |= is_one(block));
        Ok(())
    };
    if let Some(height) = *below {
        let lowest = |block: &Block| block.mesh.points.iter().map(|point| point[2]).fold(f64::INFINITY, f64::min);
        let least = found.blocks.iter().map(lowest).fold(f64::INFINITY, f64::min);
        all("below", format!("no block begins below {height} m: the lowest point is at {least} m"), &|block| {
            lowest(block) <= height
        })?;
    }
    if let Some(name) = attribute {
        all("attribute", format!("no block has the attribute `{name}` set"), &|block| block.flags.contains(name))?;
    }
    Ok(held)
}
