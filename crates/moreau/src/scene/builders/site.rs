//! Where a builder builds, and the checks that builders share.

use super::Build;
use crate::scene::Scene;
use crate::scene::check::positive;
use crate::scene::error::Fault;
use crate::scene::path::{KeyPath, key_path};

/// What a builder must know of the scene.
pub(in crate::scene) struct Site<'a> {
    /// For the checks that a scene must pass as a whole.
    pub(in crate::scene) scene: &'a Scene,
    /// The way to its own numbers: `build[0].kind.arch`.
    pub(in crate::scene) path: KeyPath,
    /// 2 or 3.
    pub(in crate::scene) dimension: usize,
    /// The seed of one that names none: its place in the list.
    pub(in crate::scene) seed: u64,
}

impl<'a> Site<'a> {
    /// The site of the builder of this index.
    pub(in crate::scene) fn new(scene: &'a Scene, index: usize, build: &Build) -> Self {
        let path = key_path!["build", index, "kind", build.kind.name()];
        Self { scene, path, dimension: scene.dimension.number(), seed: index as u64 }
    }
}

impl Site<'_> {
    /// The fault of one of its numbers.
    pub(super) fn fault(&self, field: &str, message: impl Into<String>, hint: impl Into<String>) -> Fault {
        Fault::new(self.path.then(field), message, hint)
    }

    /// Lengths by their names.
    pub(super) fn lengths<const K: usize>(&self, lengths: [(&str, f64); K]) -> Result<(), Fault> {
        lengths.into_iter().try_for_each(|(field, length)| positive(self.path.then(field), length, "in m"))
    }

    /// A number between two, both excluded; `hint` says what would be right.
    pub(super) fn between(&self, field: &str, value: f64, (low, high): (f64, f64), hint: &str) -> Result<(), Fault> {
        if value > low && value < high {
            return Ok(());
        }
        Err(self.fault(field, format!("{field} is {value}"), hint))
    }

    /// A number of things.
    pub(super) fn whole(&self, field: &str, value: u64, least: u64) -> Result<(), Fault> {
        if value >= least {
            return Ok(());
        }
        Err(self.fault(field, format!("{field} is {value}"), format!("expected {least} or more")))
    }

    /// The size of something along x, in space y, and up.
    pub(super) fn size(&self, field: &str, size: &[f64]) -> Result<(), Fault> {
        if size.len() != self.dimension {
            let known = if self.dimension == 2 { "length and height" } else { "length, depth and height" };
            let message = format!("{} numbers where dimension = {}", size.len(), self.dimension);
            return Err(self.fault(field, message, format!("expected {} numbers: {known}", self.dimension)));
        }
        size.iter().enumerate().try_for_each(|(k, &length)| positive(self.path.then(field).then(k), length, "in m"))
    }

    /// A length across the plane: of space, and only there.
    pub(super) fn across(&self, field: &str, length: Option<f64>) -> Result<(), Fault> {
        match length {
            Some(length) if self.dimension == 3 => self.lengths([(field, length)]),
            None if self.dimension == 2 => Ok(()),
            Some(_) => Err(self.fault(field, format!("a {field} where dimension = 2"), "leave it out")),
            None => {
                Err(Fault::new(self.path.clone(), format!("`{field}` is missing"), format!("in space it needs a {field}, in m")))
            }
        }
    }

    /// One of two numbers in place of each other.
    pub(super) fn either(&self, first: (&str, Option<f64>), second: (&str, Option<f64>)) -> Result<(), Fault> {
        if first.1.is_some() != second.1.is_some() {
            return Ok(());
        }
        let found = if first.1.is_some() { "both" } else { "neither" };
        let message = format!("{found} of {} and {}", first.0, second.0);
        Err(Fault::new(self.path.clone(), message, "expected exactly one of the two"))
    }
}

/// Length, depth (in space) and height of a size.
pub(super) fn edges(size: &[f64]) -> ([f64; 2], Option<f64>) {
    match *size {
        [length, depth, height] => ([length, height], Some(depth)),
        [length, height] => ([length, height], None),
        _ => ([0.0; 2], None),
    }
}
