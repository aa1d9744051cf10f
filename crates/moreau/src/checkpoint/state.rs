//! What steps change of a world and of its workspace.

use super::CheckpointError;
use super::digest::{Digest, Sum};
use crate::bodies::{Bodies, Motion};
use crate::events::ScheduleState;
use crate::shape::Shape;
use crate::space::{Pose, Space};
use crate::step::{Workspace, WorkspaceState};
use crate::world::World;
use serde::{Deserialize, Serialize};

/// All of it, in plain numbers, arrays body by body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) steps: u64,
    time: f64,
    /// Of what never changes: by it the world of another scene is known.
    bodies: Digest,
    motion: Vec<u8>,
    position: Vec<f64>,
    rotation: Vec<[f64; 4]>,
    velocity: Vec<f64>,
    load: Vec<f64>,
    schedule: ScheduleState,
    work: WorkspaceState,
}

/// How bodies move, by number.
const MOTIONS: [Motion; 3] = [Motion::Free, Motion::Driven, Motion::Absent];

impl State {
    pub(super) fn take<S: Space<D, N>, const D: usize, const N: usize>(
        world: &World<S, D, N>,
        work: &Workspace<S, D, N>,
    ) -> Self {
        let World { bodies, schedule, time, steps, .. } = world;
        Self {
            steps: *steps,
            time: *time,
            bodies: digest(bodies),
            motion: bodies.motion.iter().map(|motion| *motion as u8).collect(),
            position: bodies.pose.iter().flat_map(|pose| pose.position).collect(),
            rotation: bodies.pose.iter().map(|pose| S::numbers(pose.rotation)).collect(),
            velocity: bodies.velocity.as_flattened().to_vec(),
            load: bodies.load.as_flattened().to_vec(),
            schedule: schedule.state(),
            work: work.state(),
        }
    }

    /// The checksum of all of it.
    pub(super) fn digest(&self) -> Digest {
        // A vector takes all that is written to it.
        Digest::of(&[&postcard::to_stdvec(self).unwrap_or_default()])
    }

    pub(super) fn restore<S: Space<D, N>, const D: usize, const N: usize>(
        &self,
        world: &mut World<S, D, N>,
        work: &mut Workspace<S, D, N>,
    ) -> Result<(), CheckpointError> {
        let bodies = &mut world.bodies;
        let count = bodies.len();
        if digest(bodies) != self.bodies {
            return Err(CheckpointError::misfit(
                "it has other bodies than the run had: a change of it, or another version of moreau, makes them differently (what sources bring \
                 depends on time.steps)",
            ));
        }
        let wrong = |what: &str| CheckpointError::misfit(format!("{what} of bodies are none that a run could have"));
        let poses = poses::<S, D, N>(&self.position, &self.rotation).filter(|poses| poses.len() == count);
        let poses = poses.ok_or_else(|| wrong("poses"))?;
        let velocity = rows(&self.velocity, count).ok_or_else(|| wrong("velocities"))?;
        let load = rows(&self.load, count).ok_or_else(|| wrong("loads"))?;
        let motions: Option<Vec<Motion>> = self.motion.iter().map(|&m| MOTIONS.get(usize::from(m)).copied()).collect();
        let motions = motions.filter(|motions| motions.len() == count).ok_or_else(|| wrong("motions"))?;
        for (i, &motion) in motions.iter().enumerate() {
            let finite = poses[i].position.iter().all(|x| x.is_finite()) && velocity[i].iter().all(|x: &f64| x.is_finite());
            if motion != Motion::Absent && !finite {
                return Err(wrong("positions or velocities"));
            }
            (bodies.pose[i], bodies.velocity[i], bodies.load[i]) = (poses[i], velocity[i], load[i]);
            bodies.set_motion(i, motion);
        }
        (world.steps, world.time) = (self.steps, self.time);
        world.schedule.restore(&self.schedule)?;
        work.restore(&self.work)
    }
}

/// Arrays of N numbers, so many.
pub(crate) fn rows<const N: usize>(numbers: &[f64], count: usize) -> Option<Vec<[f64; N]>> {
    let (rows, rest) = numbers.as_chunks();
    (rest.is_empty() && rows.len() == count).then(|| rows.to_vec())
}

/// Poses, if these are some.
pub(crate) fn poses<S: Space<D, N>, const D: usize, const N: usize>(
    positions: &[f64],
    rotations: &[[f64; 4]],
) -> Option<Vec<Pose<S::Rotation, D>>> {
    let positions = rows(positions, rotations.len())?;
    let pose = |(position, numbers): (_, &[f64; 4])| Some(Pose { position, rotation: S::from_numbers(*numbers)? });
    positions.into_iter().zip(rotations).map(pose).collect()
}

/// What the bodies of a run are known by.
fn digest<S: Space<D, N>, const D: usize, const N: usize>(bodies: &Bodies<S, D, N>) -> Digest {
    let mut sum = Sum::default();
    for i in 0..bodies.len() {
        let radius = bodies.shape[i].bounding_radius().unwrap_or(f64::INFINITY);
        bodies.mass[i].iter().chain([&radius]).for_each(|x| sum.add(&x.to_le_bytes()));
        sum.add(&bodies.material[i].to_le_bytes());
    }
    sum.now()
}
