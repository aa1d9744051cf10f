//! What a scene file can say, apart from the generators: the types that are read from it.
//!
//! Everything is in SI units. The comments here are the reference of the format: they become the descriptions of the JSON schema.

use super::events::DriveSpec;
use super::shape::{ShapeSpec, is_false};
use super::values::{Angular, Orientation};
use crate::trajectory::Precision;
use crate::world::{OnBreach, OnFailure, Rows, Start};
use moreau_solve::{Criterion, GlobalMethod, Kernels, Law, LocalMethod, Order, Parameter, Settings};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How time advances.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// Length of a step h, s.
    pub step: f64,
    /// How many steps the run takes.
    pub steps: u64,
    /// θ of the θ-method, from 0.5 (the midpoint, which keeps energy) to 1 (implicit Euler).
    #[serde(default = "Time::half")]
    pub theta: f64,
    /// Which rows give contacts their velocity at the end of a step: "turning", those of the end of the step, or "frozen", those of half a step
    /// before, as in the paper.
    #[serde(default)]
    pub rows: Rows,
}

impl Time {
    fn half() -> f64 {
        0.5
    }
}

/// How the contact problem of each step is solved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// The method over all contacts.
    pub global: GlobalMethod,
    /// The method at one contact.
    pub local: LocalMethod,
    /// The measure that ends the sweeps.
    pub criterion: Criterion,
    /// The value of the measure at which a solve ends.
    pub tolerance: f64,
    /// After how many sweeps a solve is given up.
    pub max_sweeps: u64,
    /// The impulses with which a solve begins.
    pub start: Start,
    /// The order in which a sweep visits the contacts.
    pub order: Order,
    /// Whether contacts of round bodies are visited several at a time.
    pub kernels: Kernels,
    /// How deep two bodies may overlap, as a part of the smaller one's bounding radius, or "never": where they would be deeper in the next step,
    /// bodies are moved apart, without a change of velocities.
    pub max_penetration: MaxPenetration,
    /// What to do when a solve reaches its limit of sweeps.
    pub on_failure: OnFailure,
    /// ρ of sbp, sal, ebp and eal: "auto", { relative = factor } or { absolute = kg }.
    pub rho: Parameter,
    /// γ of pdas: "auto", { relative = factor } or { absolute = kg }.
    pub gamma: Parameter,
    /// Over-relaxation ω of Gauss-Seidel sweeps, between 0 and 2, both excluded; 1 is none.
    pub relaxation: f64,
    /// Whether every second sweep of nlgs goes backwards.
    pub symmetric: bool,
}

impl Default for Solver {
    fn default() -> Self {
        let Settings { global, local, criterion, tolerance, max_sweeps, .. } = Settings::default();
        let Settings { order, kernels, rho, gamma, relaxation, symmetric, .. } = Settings::default();
        let (start, on_failure) = (Start::default(), OnFailure::default());
        Self {
            global,
            local,
            criterion,
            tolerance,
            max_sweeps,
            start,
            order,
            kernels,
            max_penetration: MaxPenetration::default(),
            on_failure,
            rho,
            gamma,
            relaxation,
            symmetric,
        }
    }
}

impl Solver {
    /// The settings of the contact solver.
    pub fn settings(&self) -> Settings {
        let Self { global, local, criterion, tolerance, max_sweeps, .. } = *self;
        let Self { order, kernels, rho, gamma, relaxation, symmetric, .. } = *self;
        Settings {
            global,
            local,
            criterion,
            tolerance,
            max_sweeps,
            order,
            kernels,
            rho,
            gamma,
            relaxation,
            symmetric,
            max_seconds: None,
            history: false,
        }
    }
}

/// From which overlap on positions are corrected.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a number or \"never\"")]
pub enum MaxPenetration {
    /// A part of the smaller body's bounding radius.
    Part(f64),
    /// Not at all.
    Word(Never),
}

/// The word for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Never {
    /// Overlaps stay.
    Never,
}

impl Default for MaxPenetration {
    fn default() -> Self {
        MaxPenetration::Part(1e-3)
    }
}

impl MaxPenetration {
    /// The part, or `None` for no correction.
    pub fn part(self) -> Option<f64> {
        match self {
            MaxPenetration::Part(part) => Some(part),
            MaxPenetration::Word(Never::Never) => None,
        }
    }
}

/// What bodies are made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Density, kg/m³; in the plane kg/m².
    pub density: f64,
}

/// The contact law of a pair of materials.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PairLaw {
    /// The names of the two materials, in any order; the same twice for contacts within one material.
    #[schemars(length(min = 2, max = 2))]
    pub between: Vec<String>,
    /// The law.
    pub law: Law,
}

/// How a body moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionKind {
    /// By forces and contacts.
    Free,
    /// Not at all.
    Fixed,
    /// With its velocity and spin as given, whatever touches it.
    Driven,
}

/// One body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodySpec {
    /// A name for output and messages; no two bodies may share one.
    pub name: Option<String>,
    /// Its form.
    pub shape: ShapeSpec,
    /// The name of its material.
    pub material: String,
    /// Its density, kg/m³ (kg/m² in the plane); default its material's.
    pub density: Option<f64>,
    /// Where it is, m: the centre of mass; of a half-space or half-plane a point of its boundary; of a polygon, polyline, polyhedron,
    /// compound, mesh or height field the place of its coordinates' origin, so that the centre of mass is there plus the turned centroid.
    pub position: Vec<f64>,
    /// How it is turned: an angle in rad in the plane, a quaternion [x, y, z, w] in space, or in both a table such as
    /// { axis = [0, 0, 1], degrees = 30 }, in the plane without the axis. Not for half-spaces, which have a normal.
    pub orientation: Option<Orientation>,
    /// Velocity of the centre of mass, m/s; default zero.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub velocity: Vec<f64>,
    /// Spin, rad/s; default zero.
    pub spin: Option<Angular>,
    /// How it moves; default as its first drive says if that begins at 0, else free, of what has no mass (half-spaces,
    /// polylines, surfaces) fixed.
    pub motion: Option<MotionKind>,
    /// A constant force on the centre of mass, N; default zero.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub force: Vec<f64>,
    /// A constant torque, N·m; default zero.
    pub torque: Option<Angular>,
    /// What it does from given times on, in their order: motions and forces as functions of time, being freed or held. Before the first it
    /// moves as `motion` says.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub drive: Vec<DriveSpec>,
    /// When it is taken out of the scene, s: at the first beginning of a step at or after this time; default never.
    pub removed_at: Option<f64>,
    /// How far it may overlap others at the start, as a part of the smaller one's radius; default start.max_overlap. Of two bodies the
    /// larger number counts.
    pub max_overlap: Option<f64>,
}

/// Bodies from a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Import {
    /// A body a polygon; in the plane.
    Polygons {
        /// A table, CSV, beside the scene: a row `x,y` a vertex, in m; `#` begins a comment. Polygons are set apart by empty lines, or
        /// by a column `id` if a first line names the columns, as in `id,x,y`.
        file: String,
        /// The name of their material.
        material: String,
        /// Whether they may be concave; see `polygon`.
        #[serde(default, skip_serializing_if = "is_false")]
        decompose: bool,
        /// How they move; default free.
        motion: Option<MotionKind>,
    },
    /// The objects of a mesh file, a body each; in space. Convex ones are polyhedra. Others need `decompose`, or are surfaces if they are fixed
    /// or driven.
    Meshes {
        /// A mesh, .stl, .obj, .ply, .gltf or .glb, beside the scene.
        file: String,
        /// The name of their material.
        material: String,
        /// By what all coordinates are multiplied, such as 0.001 for a file in mm; default 1.
        scale: Option<f64>,
        /// What makes a body: "objects" that the file names (`o` in OBJ, or `g` in a file without `o`; `solid` in STL of text; nodes in
        /// glTF), or "parts", all triangles that are connected by shared points; default "objects".
        #[serde(default)]
        split: Split,
        /// Whether bodies may be concave; see `mesh`.
        #[serde(default, skip_serializing_if = "is_false")]
        decompose: bool,
        /// With `decompose`: by which part of the whole volume a piece may fail to be convex; default 0.01.
        concavity: Option<f64>,
        /// How they move; default free.
        motion: Option<MotionKind>,
    },
    /// The blocks of an assembly; in space. Those that the file calls supports are fixed. Densities in the file replace that of the material.
    Assembly {
        /// A file that COMPAS wrote, JSON, beside the scene.
        file: String,
        /// The name of their material.
        material: String,
        /// By what all coordinates are multiplied, such as 0.001 for a file in mm; default 1.
        scale: Option<f64>,
        /// Whether blocks may be concave; see `mesh`.
        #[serde(default, skip_serializing_if = "is_false")]
        decompose: bool,
        /// With `decompose`: by which part of the whole volume a piece may fail to be convex; default 0.01.
        concavity: Option<f64>,
        /// How those move that are no supports; default free.
        motion: Option<MotionKind>,
        /// More supports than the file names.
        supports: Option<SupportsSpec>,
        /// Density of all blocks, kg/m³, in place of the file's and the material's.
        density: Option<f64>,
        /// How far a block may overlap others at the start, as a part of the smaller one's radius; default start.max_overlap.
        max_overlap: Option<f64>,
        /// What differs for single blocks, by their keys in the file.
        #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
        blocks: BTreeMap<String, BlockSpec>,
    },
}

/// What makes a body of a mesh file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Split {
    /// Each object that the file names.
    #[default]
    Objects,
    /// All triangles that are connected by shared points.
    Parts,
}

/// Which blocks of an assembly are supports, apart from those that the file calls so: all that one of these names.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SupportsSpec {
    /// Numbers of blocks, from 0, in the order of their keys.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub index: Vec<usize>,
    /// Keys of blocks in the file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub key: Vec<String>,
    /// A height z, m: all blocks whose lowest point is not above it.
    pub below: Option<f64>,
    /// The name of an attribute in the file: all blocks for which it is true, or a number that is not zero.
    pub attribute: Option<String>,
}

/// What differs for one block of an assembly.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BlockSpec {
    /// Whether it is a support; default as the rest of the import says.
    pub support: Option<bool>,
    /// The name of its material.
    pub material: Option<String>,
    /// Its density, kg/m³.
    pub density: Option<f64>,
    /// With `decompose`: by which part of the whole volume a piece may fail to be convex.
    pub concavity: Option<f64>,
    /// How far it may overlap others at the start, as a part of the smaller one's radius.
    pub max_overlap: Option<f64>,
}

/// A container: walls around a region, each a fixed half-space (half-plane) that looks inwards and goes on beyond the region's
/// edges.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Container {
    /// The lowest corner of the region, m.
    pub min: Vec<f64>,
    /// The highest corner of the region, m.
    pub max: Vec<f64>,
    /// The faces without a wall, for instance ["+z"].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub open: Vec<Face>,
    /// The name of the walls' material.
    pub material: String,
}

/// A face of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Face {
    /// The face of lowest x.
    #[serde(rename = "-x")]
    LowX,
    /// The face of highest x.
    #[serde(rename = "+x")]
    HighX,
    /// The face of lowest y.
    #[serde(rename = "-y")]
    LowY,
    /// The face of highest y.
    #[serde(rename = "+y")]
    HighY,
    /// The face of lowest z.
    #[serde(rename = "-z")]
    LowZ,
    /// The face of highest z.
    #[serde(rename = "+z")]
    HighZ,
}

impl Face {
    pub(super) const ALL: [(Face, &'static str); 6] = [
        (Face::LowX, "-x"),
        (Face::HighX, "+x"),
        (Face::LowY, "-y"),
        (Face::HighY, "+y"),
        (Face::LowZ, "-z"),
        (Face::HighZ, "+z"),
    ];
}

impl Container {
    /// The faces with a wall: axis, whether it is the high one, and its name.
    pub(super) fn walls(&self) -> impl Iterator<Item = (usize, bool, &'static str)> {
        let faces = Face::ALL.iter().enumerate().take(2 * self.min.len());
        faces.filter(|(_, (face, _))| !self.open.contains(face)).map(|(i, &(_, name))| (i / 2, i % 2 == 1, name))
    }
}

/// What a run writes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// The folder; where it is not given, the program chooses.
    pub folder: Option<String>,
    /// Steps between two frames, and between two rows of measures; 0 for none. Default: a hundredth of all steps.
    pub every: Option<u64>,
    /// What is written.
    pub kinds: Vec<OutputKind>,
    /// How real numbers of the trajectory are kept.
    pub precision: Precision,
}

impl Default for Output {
    fn default() -> Self {
        Self {
            folder: None,
            every: None,
            kinds: vec![OutputKind::Vtk, OutputKind::Steps, OutputKind::Trajectory],
            precision: Precision::Single,
        }
    }
}

/// Limits that each step must keep to; those that are not given are none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GuardSpec {
    /// The lowest corner of the region in which centres of free bodies stay, m; with `max`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub min: Vec<f64>,
    /// Its highest corner, m.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub max: Vec<f64>,
    /// How deep bodies may overlap at the predicted configuration, as a part of the smaller one's bounding radius.
    pub penetration: Option<f64>,
    /// How much energy a step may create, J: by how much kinetic and potential energy may grow beyond the work done. Rounding and the
    /// solver's tolerance create some.
    pub energy: Option<f64>,
    /// What to do when a step breaks a limit.
    pub policy: OnBreach,
}

/// How often a run is kept, so that it can go on after whatever stopped it. The last two checkpoints are in its folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CheckpointSpec {
    /// Steps from one to the next; 0 for none by steps.
    pub every: u64,
    /// Seconds of the clock on the wall from one to the next; 0 for none by the clock. Where one of the two is not 0, there is also one at the start
    /// and one at the end; 1e308 is for these two alone.
    pub seconds: f64,
}

impl Default for CheckpointSpec {
    fn default() -> Self {
        Self { every: 0, seconds: 600.0 }
    }
}

/// One kind of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OutputKind {
    /// Frames for ParaView: bodies and contacts.
    Vtk,
    /// A table with a line for each step: sweeps, residuals, energies.
    Steps,
    /// One file with bodies and contacts of every frame and the table of steps, for moreau's own views and for Python.
    Trajectory,
    /// A table of granular measures: coordination, solid fraction, fabric, stress, forces.
    Measures,
}

/// What is asked of the first configuration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StartSpec {
    /// How far two bodies may overlap at the start, as a part of the smaller one's radius; more is an error.
    pub max_overlap: f64,
}

impl Default for StartSpec {
    fn default() -> Self {
        Self { max_overlap: 1e-3 }
    }
}

impl BodySpec {
    /// How it moves at the start: as given, or as its first drive says, else freely, and not at all where it has no mass.
    pub fn motion(&self) -> MotionKind {
        let otherwise = if self.shape.has_mass() { MotionKind::Free } else { MotionKind::Fixed };
        self.motion.or(self.first_drive().map(DriveSpec::motion)).unwrap_or(otherwise)
    }

    /// Its first drive, if it has it from the start.
    pub(super) fn first_drive(&self) -> Option<&DriveSpec> {
        self.drive.first().filter(|drive| drive.from <= 0.0)
    }

    /// Whether it is free at some time.
    pub(super) fn is_ever_free(&self) -> bool {
        self.motion() == MotionKind::Free || self.drive.iter().any(|drive| drive.motion() == MotionKind::Free)
    }
}
