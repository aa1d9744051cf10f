//! Scene files: from strict TOML in SI units to a [`World`].
//!
//! [`Scene`] and the types in it are the format: each field's comment is the reference for users and, through [`Scene::schema`],
//! what an editor shows. Reading goes text → document → scene → checks → bodies → checks of the start; the first thing that is
//! wrong ends it with a [`SceneError`], which shows the line and says what would be right.
//!
//! ```
//! use moreau::scene::{AnyWorld, Scene};
//!
//! let text = r#"
//!     dimension = 2
//!     gravity = [0.0, -9.81]
//!     time = { step = 1e-3, steps = 100 }
//!     materials.glass.density = 2500.0
//!     containers = [{ min = [0.0, 0.0], max = [1.0, 1.0], open = ["+y"], material = "glass" }]
//!     bodies = [{ shape.disk.radius = 0.1, material = "glass", position = [0.5, 0.5] }]
//! "#;
//! let scene = Scene::parse(text, "disk.toml")?;
//! let AnyWorld::Plane(world) = scene.build(u64::MAX)? else { panic!("the scene is plane") };
//! assert_eq!(world.bodies.len(), 4);
//!
//! let error = Scene::parse(&text.replace("steps", "stps"), "disk.toml").unwrap_err();
//! assert!(error.to_string().contains("did you mean `steps`?"));
//! # Ok::<(), moreau::scene::SceneError>(())
//! ```

mod build;
pub mod builders;
mod check;
mod dimension;
mod error;
mod estimate;
mod events;
mod explain;
mod files;
mod generate;
mod joints;
mod lattice;
mod packing;
mod path;
mod points;
mod radii;
mod shape;
mod source;
mod spec;
mod start;
mod triangles;
mod values;

pub use builders::{BUILDERS, Build, BuildKind};
pub use error::{LineColumn, Place, SceneError};
pub use estimate::Estimate;
pub use events::{DriveSpec, SinkSpec, SourceSpec};
pub use generate::{Generate, Lattice, LatticeKind, LogNormal, Packing, Radii, Range};
pub use joints::{JointKindSpec, JointSpec};
pub use shape::{PartSpec, ShapeSpec};
pub use spec::{
    BlockSpec, BodySpec, CheckpointSpec, Container, Face, GuardSpec, Import, Material, MaxPenetration, MotionKind, Never, Output,
    OutputKind, PairLaw, Solver, Split, StartSpec, SupportsSpec, Time,
};
pub use values::{Angular, Dimension, Numbers, Orientation, Turn};

use crate::space::{Plane, Solid};
use crate::world::World;
use error::Fault;
use moreau_solve::{Law, law::Frictionless};
use path::KeyPath;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use source::Source;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// A scene: everything that a run starts from. All quantities are in SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// What the scene shows, in one line.
    pub title: Option<String>,
    /// 2 or 3; positions, velocities and forces have that many numbers.
    pub dimension: Dimension,
    /// Gravity, m/s²; default zero.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub gravity: Vec<f64>,
    /// How time advances.
    pub time: Time,
    /// How the contact problem of each step is solved.
    #[serde(default)]
    pub solver: Solver,
    /// What bodies are made of, by name.
    #[serde(default)]
    pub materials: BTreeMap<String, Material>,
    /// The law of every pair of materials that `laws` does not name; default frictionless without rebound.
    #[serde(default = "Scene::frictionless")]
    pub default_law: Law,
    /// The laws of single pairs of materials.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub laws: Vec<PairLaw>,
    /// Single bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bodies: Vec<BodySpec>,
    /// Files of many bodies. They are read with the scene and become part of `bodies`, in order, after those that are written there.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub import: Vec<Import>,
    /// Structures of many bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub build: Vec<Build>,
    /// Containers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub containers: Vec<Container>,
    /// Generators of many balls or disks.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub generate: Vec<Generate>,
    /// Joints between bodies, or between a body and the world.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<JointSpec>,
    /// Where balls or disks come into the scene while it runs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<SourceSpec>,
    /// Where free bodies leave it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sinks: Vec<SinkSpec>,
    /// Limits that each step must keep to.
    #[serde(default)]
    pub guard: GuardSpec,
    /// What a run writes.
    #[serde(default)]
    pub output: Output,
    /// How often the run is kept, so that it can go on after whatever stopped it.
    #[serde(default)]
    pub checkpoint: CheckpointSpec,
    /// What is asked of the first configuration.
    #[serde(default)]
    pub start: StartSpec,
    /// The text, for the places of errors.
    #[serde(skip)]
    source: Source,
    /// What its files had wrong that did not prevent reading them.
    #[serde(skip)]
    remarks: Remarks,
}

/// What was remarked when a scene was read. It is no part of what the scene says: scenes compare without it.
#[derive(Clone, Debug, Default)]
struct Remarks(Vec<String>);

impl PartialEq for Remarks {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A world of either dimension.
#[derive(Clone, Debug)]
pub enum AnyWorld {
    /// In the plane.
    Plane(World<Plane, 2, 3>),
    /// In space.
    Solid(World<Solid, 3, 6>),
}

impl Scene {
    /// Reads a scene from text; `file_name` is what errors call it. Files that it names are read beside that file, and what they hold takes
    /// their place.
    ///
    /// # Errors
    /// The first thing that is wrong: in the text, in its keys and types, in files that it names, or in what the scene asks for.
    pub fn parse(text: &str, file_name: &str) -> Result<Self, SceneError> {
        Self::parse_with(text, file_name, &[])
    }

    /// Reads a scene from text with overrides; see [`Scene::load_with`].
    ///
    /// # Errors
    /// As [`Scene::parse`].
    pub fn parse_with(text: &str, file_name: &str, sets: &[String]) -> Result<Self, SceneError> {
        let source = Source::new(file_name, text, sets);
        let document = source.document()?;
        check_numbers(&source, document.get_ref())?;
        let result = Scene::deserialize(toml::de::Deserializer::from(document));
        let mut scene = match result {
            Ok(scene) => scene,
            Err(error) => return Err(explain::explain(&source, source.document()?.get_ref(), &error)),
        };
        scene.source = source;
        let folder = Path::new(file_name).parent().unwrap_or(Path::new(""));
        files::read(&mut scene, folder).map_err(|fault| scene.source.fault(&fault))?;
        check::check(&scene).map_err(|fault| scene.source.fault(&fault))?;
        Ok(scene)
    }

    /// Reads a scene file.
    ///
    /// # Errors
    /// As [`Scene::parse`], and where the file cannot be read.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::load_with(path, &[])
    }

    /// Reads a scene file and replaces values in it: each of `sets` is `key.path=value`, such as `solver.tolerance=1e-9` or
    /// `bodies.0.position=[0, 0, 1]`. Values are TOML; a bare word is a string.
    ///
    /// # Errors
    /// As [`Scene::load`]; an error in an override shows the override.
    pub fn load_with(path: &Path, sets: &[String]) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|e| {
            let fault = Fault::new(KeyPath::default(), format!("cannot read the scene: {e}"), "");
            Source::new(&name, "", &[]).fault(&fault)
        })?;
        Self::parse_with(&text, &name, sets)
    }

    /// Returns what was remarked when the scene was read, a sentence each: what its files have wrong that did not prevent reading them, and
    /// what they say that may not be meant.
    pub fn remarks(&self) -> &[String] {
        &self.remarks.0
    }

    /// The scene as TOML with all defaults and overrides in place: what was run. (A scene that was not read but put together with
    /// whole numbers above 2⁶³, which TOML does not have, gives a comment that says so.)
    pub fn to_toml(&self) -> String {
        toml::to_string(self).unwrap_or_else(|e| format!("# This scene cannot be written as TOML: {e}\n"))
    }

    /// The JSON schema of scene files, for editors.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(Scene).to_value()
    }

    /// Makes the world. A scene that needs more than `available_memory` bytes is refused before anything is allocated; `u64::MAX`
    /// is no limit.
    ///
    /// Bodies come in the order of the scene: `bodies`, those of `build`, walls of `containers`, `generate`, then those that `sources` will
    /// bring, which are absent until then.
    ///
    /// # Errors
    /// Where the memory does not suffice, a generator cannot place its bodies, shapes cannot touch each other, or bodies overlap.
    pub fn build(&self, available_memory: u64) -> Result<AnyWorld, SceneError> {
        let world = || {
            check::check(self)?;
            estimate::check_memory(self, available_memory)?;
            Ok(match self.dimension {
                Dimension::Two => AnyWorld::Plane(build::build(self)?),
                Dimension::Three => AnyWorld::Solid(build::build(self)?),
            })
        };
        world().map_err(|fault: Fault| self.source.fault(&fault))
    }

    /// What the scene needs, from its counts alone.
    pub fn estimate(&self) -> Estimate {
        estimate::estimate(self)
    }

    /// The names of the materials: material `i` of the world is the `i`-th.
    pub fn material_names(&self) -> Vec<&str> {
        self.materials.keys().map(String::as_str).collect()
    }

    /// The name that the scene gives to body `index` of the world, if any.
    pub fn body_name(&self, index: usize) -> Option<Cow<'_, str>> {
        match start::Origin::of(self, index)? {
            start::Origin::Body(i) => self.bodies.get(i)?.name.as_deref().map(Cow::from),
            start::Origin::Built(i, number) => self.build.get(i)?.name_of(number).map(Cow::from),
            _ => None,
        }
    }

    /// The index in the world of the body that has this name in the scene.
    pub fn body_named(&self, name: &str) -> Option<usize> {
        if let Some(index) = self.bodies.iter().position(|body| body.name.as_deref() == Some(name)) {
            return Some(index);
        }
        let mut first = self.bodies.len() as u64;
        for build in &self.build {
            if let Some(number) = build.number_of(name, self.dimension.number()) {
                return usize::try_from(first.saturating_add(number)).ok();
            }
            first = first.saturating_add(build.count(self.dimension.number()));
        }
        None
    }

    /// How body `index` of the world moves, of those that have names.
    fn motion_of(&self, index: usize) -> Option<MotionKind> {
        match start::Origin::of(self, index)? {
            start::Origin::Body(i) => Some(self.bodies.get(i)?.motion()),
            start::Origin::Built(i, number) => Some(self.build.get(i)?.motion_of(number, self.dimension.number())),
            _ => None,
        }
    }

    /// Words for body `index` of the world that tell where it comes from: `bodies[3] "hammer"`, `voussoir 2 of build[0]`, `wall -z of
    /// containers[0]`.
    pub fn body_label(&self, index: usize) -> String {
        start::Origin::of(self, index).map_or_else(|| format!("body {index}"), |origin| origin.label(self))
    }

    /// Steps between two frames or two rows of measures: as given, else a hundredth of the run; 0 for none.
    pub fn frames_every(&self) -> u64 {
        self.output.every.unwrap_or((self.time.steps / 100).max(1))
    }

    fn frictionless() -> Law {
        Law::Frictionless(Frictionless::default())
    }

    /// How many bodies there are that are not generated: single ones, those of builders, and the walls of containers.
    fn explicit_bodies(&self) -> u64 {
        let walls: usize = self.containers.iter().map(|container| container.walls().count()).sum();
        let built = self.build.iter().map(|build| build.count(self.dimension.number()));
        built.fold((self.bodies.len() + walls) as u64, u64::saturating_add)
    }
}

/// A commented scene to begin with, for `moreau new`.
pub fn template(name: &str) -> String {
    let text = include_str!("scene/template.toml");
    // The schema lies beside the shipped scenes, not beside the new one; a name is TOML text only without quotes and breaks.
    let name: String = name.chars().filter(|c| !c.is_control() && !['"', '\\'].contains(c)).collect();
    let lines = text.lines().filter(|line| !line.starts_with("#:schema"));
    lines.map(|line| line.replace("NAME", &name) + "\n").collect()
}

/// Refuses nan, infinity, and whole numbers that TOML does not have, wherever they stand.
fn check_numbers(source: &Source, document: &DeTable<'_>) -> Result<(), SceneError> {
    let mut first = None;
    source::visit_table(document, &KeyPath::default(), &mut |path, span, value| {
        let (message, hint) = match value {
            Some(DeValue::Float(float)) if !float.as_str().parse::<f64>().is_ok_and(f64::is_finite) => {
                (format!("the value is {float}"), "expected a finite number")
            }
            Some(DeValue::Integer(whole)) if i64::from_str_radix(whole.as_str(), whole.radix()).is_err() => {
                (format!("{whole} is too large"), "expected a number between -2^63 and 2^63")
            }
            _ => return,
        };
        first.get_or_insert_with(|| source.at(span, path, &message, hint));
    });
    first.map_or(Ok(()), Err)
}
