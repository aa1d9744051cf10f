//! What happens in the course of a run: drives of single bodies, sources and sinks, and what the engine makes of them.

use super::Scene;
use super::build::material;
use super::dimension::{SceneSpace, vector};
use super::error::Fault;
use super::generate::Radii;
use super::path::key_path;
use super::spec::{MotionKind, Time};
use super::values::Numbers;
use crate::bodies::{Bodies, Body, Motion};
use crate::drive::{Course, Drive, Function, Imposed, Turning};
use crate::events::{Change, Event, Rain, Schedule, Sink, Source};
use crate::random::Random;
use crate::space::Pose;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a body does from some time on, until its next drive begins: it moves as given, or is free, or stands still.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DriveSpec {
    /// When it begins, s: at the first beginning of a step at or after this time; default 0.
    pub from: f64,
    /// How the body moves then; default driven where a motion is given, free where a force or torque is.
    pub motion: Option<MotionKind>,
    /// The velocity of its centre, m/s: a function of time for each component. The body is where the integral says at the end of each step.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub velocity: Vec<Function>,
    /// In place of the velocity the position of its centre, m: a function of time for each component. Only its change counts: the body moves
    /// on from where it is when the drive begins.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub position: Vec<Function>,
    /// The axis in the world about which it turns, of any length; in the plane it is left out.
    pub axis: Option<Numbers<3>>,
    /// The spin about the axis, rad/s.
    pub spin: Option<Function>,
    /// In place of the spin the angle about the axis, rad. Only its change counts.
    pub angle: Option<Function>,
    /// A force on the centre of mass of a free body, N, beside the constant one: a function of time for each component.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub force: Vec<Function>,
    /// A torque on a free body, N·m, beside the constant one: one function of time in the plane, in space one for each component.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub torque: Vec<Function>,
}

impl DriveSpec {
    /// Whether it gives a motion.
    pub(super) fn imposes(&self) -> bool {
        !self.velocity.is_empty() || !self.position.is_empty() || self.spin.is_some() || self.angle.is_some()
    }

    /// How the body moves: as given, else by what else is given.
    pub fn motion(&self) -> MotionKind {
        self.motion.unwrap_or(if self.imposes() { MotionKind::Driven } else { MotionKind::Free })
    }

    fn drive<const D: usize, const N: usize>(&self) -> Drive<D, N> {
        if self.motion() == MotionKind::Free {
            let load = |k: usize| if k < D { self.force.get(k) } else { self.torque.get(k - D) };
            return Drive::Free(Box::new(std::array::from_fn(|k| load(k).cloned().unwrap_or(Function::Constant(0.0)))));
        }
        let rate = |rate: &Function| Course::Rate(rate.clone());
        let itself = |value: &Function| Course::Itself(value.clone());
        let centre = |k: usize| self.velocity.get(k).map(rate).or_else(|| self.position.get(k).map(itself));
        let angle = self.spin.as_ref().map(rate).or_else(|| self.angle.as_ref().map(itself));
        let [x, y, z] = self.axis.map_or([0.0, 0.0, 1.0], |axis| axis.0);
        let length = (x * x + y * y + z * z).sqrt();
        Drive::Imposed(Imposed {
            centre: Box::new(std::array::from_fn(|k| centre(k).unwrap_or(Course::REST))),
            turn: angle.map(|angle| Turning { axis: [x, y, z].map(|x| x / length), angle }),
        })
    }
}

/// A source: a region in which balls (in the plane disks) appear one after the other, at random places where they overlap nothing. One that
/// finds no room waits. They come between steps, at the first beginning of a step at or after their time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SourceSpec {
    /// The name of their material.
    pub material: String,
    /// Their sizes.
    pub radii: Radii,
    /// The lowest corner of the region, m; all appear inside.
    pub min: Vec<f64>,
    /// The highest corner of the region, m.
    pub max: Vec<f64>,
    /// How many come in a second. Each source has either a rate or an interval.
    pub rate: Option<f64>,
    /// The time from one to the next, s.
    pub interval: Option<f64>,
    /// When the first comes, s; default 0.
    #[serde(default)]
    pub from: f64,
    /// The time after which none comes, s; default the end of the run.
    pub until: Option<f64>,
    /// How many come in all; default as many as are due in the run.
    pub count: Option<u64>,
    /// The velocity with which they appear, m/s; default zero.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub velocity: Vec<f64>,
    /// The seed of all that is random here; default the place of this source in the list, from 0.
    pub seed: Option<u64>,
    /// How many places are tried at each step for one that waits.
    #[serde(default = "SourceSpec::hundred")]
    pub tries: u64,
}

/// Sizes are drawn in groups of so many, each of which follows the distribution closely. A longer run has the same first ones.
const GROUP: usize = 64;

impl SourceSpec {
    fn hundred() -> u64 {
        100
    }

    /// The time from one to the next, s.
    fn every(&self) -> f64 {
        self.interval.unwrap_or(1.0 / self.rate.unwrap_or(1.0))
    }

    /// How many can come in the run.
    pub(super) fn number(&self, time: &Time) -> u64 {
        let end = self.until.unwrap_or(f64::INFINITY).min(time.step * time.steps as f64);
        let due = if end < self.from { 0.0 } else { ((end - self.from) / self.every() * (1.0 + 1e-12)).floor() + 1.0 };
        self.count.unwrap_or(u64::MAX).min(due as u64)
    }
}

/// A sink: a region in which free bodies vanish, between steps, as soon as their centres are in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SinkSpec {
    /// The lowest corner of the region, m.
    pub min: Vec<f64>,
    /// The highest corner of the region, m.
    pub max: Vec<f64>,
}

/// The schedule of a scene that passed the checks. The bodies of sources join `bodies`, absent.
pub(super) fn schedule<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    bodies: &mut Bodies<S, D, N>,
) -> Result<Schedule<S, D, N>, Fault> {
    let mut events = Vec::new();
    for (body, spec) in scene.bodies.iter().enumerate() {
        let drives = spec.drive.iter().map(|drive| (drive.from, Change::Drive(drive.drive())));
        let removed = spec.removed_at.map(|time| (time, Change::Remove));
        events.extend(drives.chain(removed).map(|(time, change)| Event { time, body, change }));
    }
    let sources = scene.sources.iter().enumerate().map(|(i, spec)| source(scene, i, spec, bodies));
    let sources = sources.collect::<Result<_, _>>()?;
    let sinks = scene.sinks.iter().map(|sink| Sink { min: vector(&sink.min), max: vector(&sink.max) });
    Ok(Schedule::new(events, sources, sinks.collect()))
}

fn source<S: SceneSpace<D, N>, const D: usize, const N: usize>(
    scene: &Scene,
    index: usize,
    spec: &SourceSpec,
    bodies: &mut Bodies<S, D, N>,
) -> Result<Source<D, N>, Fault> {
    let seed = spec.seed.unwrap_or(index as u64);
    let [mut sizes, ..] = Random::three(seed);
    let count = usize::try_from(spec.number(&scene.time)).unwrap_or(usize::MAX);
    let (material, density) = material(scene, &spec.material);
    let first = bodies.len();
    while bodies.len() - first < count {
        let radii = spec.radii.draw(GROUP, D, &mut sizes).ok_or_else(|| Radii::empty(key_path!["sources", index, "radii"]))?;
        for radius in radii.into_iter().take(count - (bodies.len() - first)) {
            let (shape, pose) = (S::round(radius), Pose { position: [f64::NAN; D], rotation: S::IDENTITY });
            let motion = Motion::Absent;
            bodies.push(Body { shape, pose, velocity: [0.0; N], density, material, motion, load: [0.0; N] });
        }
    }
    let rain = Rain {
        bodies: first..bodies.len(),
        from: spec.from,
        until: spec.until.unwrap_or(f64::INFINITY),
        interval: spec.every(),
        region: [vector(&spec.min), vector(&spec.max)],
        velocity: S::join(vector(&spec.velocity), None),
        tries: spec.tries,
    };
    Ok(Source::new(rain, seed))
}
