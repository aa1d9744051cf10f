//! How far a run is from what smaller steps would give: the same scene at h, h/2, h/4, to the same time.
//!
//! Let d(h) be the difference between the ends of the runs at h and at h/2. Where the error of a run is c hᵖ, d(h)/d(h/2) is 2ᵖ, and
//! the error that is left at h/2 about d(h)/(2ᵖ − 1) (Richardson 1911). The solver's tolerance must be well below these differences.

use crate::run::{End, Task, Unwritten, run};
use crate::scene::{AnyWorld, Scene, SceneError};
use crate::shape::Shape;
use crate::space::{Space, swept};
use crate::step::{StepRecord, Workspace};
use crate::world::World;
use std::sync::atomic::AtomicBool;

/// One of the runs.
#[derive(Clone, Debug)]
pub struct Level {
    /// Length of a step, s.
    pub h: f64,
    /// Steps done.
    pub steps: u64,
    /// Steps whose solve did not meet its criterion.
    pub unconverged: u64,
    /// How the run ended; levels after one that was not done are not there.
    pub end: End,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// How the run before, at twice the step, differs from it; none of the first.
    pub difference: Option<Difference>,
}

/// How far the ends of two runs are apart: root mean squares over points of the free bodies, namely their centres and those on their principal
/// axes at their bounding radius, and what their energies differ by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// m.
    pub position: f64,
    /// m/s.
    pub velocity: f64,
    /// Of kinetic and potential energy together, J.
    pub energy: f64,
}

impl Difference {
    /// The orders p that this difference and that of the runs with half the step tell, in the order of the fields.
    pub fn orders(&self, finer: &Self) -> [f64; 3] {
        let order = |coarse: f64, fine: f64| libm::log2(coarse / fine);
        [order(self.position, finer.position), order(self.velocity, finer.velocity), order(self.energy, finer.energy)]
    }
}

/// Where a run ended.
#[derive(Default)]
struct Last {
    /// Points and their velocities, those of absent bodies not numbers.
    position: Vec<f64>,
    velocity: Vec<f64>,
    energy: f64,
}

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum ConvergenceError {
    /// The scene cannot be built.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Never, for nothing is written.
    #[error(transparent)]
    Run(#[from] Box<Unwritten>),
}

/// Runs the scene at its own step and at `halvings` halves of it.
///
/// # Errors
/// Where the scene cannot be built in the memory that is there.
pub fn study(
    scene: &Scene,
    halvings: u32,
    available_memory: u64,
    stop: &AtomicBool,
    mut progress: impl FnMut(&StepRecord),
) -> Result<Vec<Level>, ConvergenceError> {
    let (mut levels, mut before): (Vec<Level>, Last) = Default::default();
    for level in 0..=halvings {
        let mut scene = scene.clone();
        scene.time.step /= libm::exp2(f64::from(level));
        scene.time.steps = scene.time.steps.saturating_mul(1_u64.checked_shl(level).unwrap_or(u64::MAX));
        let steps = scene.time.steps;
        let (mut level, last) = match scene.build(available_memory)? {
            AnyWorld::Plane(world) => end_of(world, steps, stop, &mut progress)?,
            AnyWorld::Solid(world) => end_of(world, steps, stop, &mut progress)?,
        };
        level.difference = (!levels.is_empty() && level.end == End::Done).then(|| before.difference(&last));
        before = last;
        let done = level.end == End::Done;
        levels.push(level);
        if !done {
            break;
        }
    }
    Ok(levels)
}

/// Runs a world to its end.
fn end_of<S: Space<D, N>, const D: usize, const N: usize>(
    mut world: World<S, D, N>,
    steps: u64,
    stop: &AtomicBool,
    progress: impl FnMut(&StepRecord),
) -> Result<(Level, Last), ConvergenceError> {
    let outcome = run(&mut world, &mut Workspace::default(), Task::new(steps), &mut [], stop, progress)?;
    let (h, summary) = (world.settings.h, &outcome.summary);
    let (steps, unconverged, seconds) = (summary.steps(), summary.unconverged(), summary.seconds_total());
    Ok((Level { h, steps, unconverged, end: outcome.end, seconds, difference: None }, Last::of(&world)))
}

impl Last {
    fn of<S: Space<D, N>, const D: usize, const N: usize>(world: &World<S, D, N>) -> Self {
        let (bodies, mut last) = (&world.bodies, Self::default());
        for i in (0..bodies.len()).filter(|&i| bodies.is_free(i) || !bodies.is_present(i)) {
            let (pose, v) = (&bodies.pose[i], &bodies.velocity[i]);
            let radius = bodies.shape[i].bounding_radius().unwrap_or(0.0);
            let spin = S::spin_in_world(pose.rotation, v);
            for axis in 0..=D {
                // The last has no axis: it is the centre.
                let arm = S::rotate(pose.rotation, std::array::from_fn(|k| if k == axis { radius } else { 0.0 }));
                let swept = swept(&spin, &arm);
                last.position.extend((0..D).map(|k| pose.position[k] + arm[k]));
                last.velocity.extend((0..D).map(|k| v[k] + swept[k]));
            }
            last.energy += bodies.energy(i, &world.gravity).iter().map(|x| if x.is_finite() { *x } else { 0.0 }).sum::<f64>();
        }
        last
    }

    fn difference(&self, finer: &Self) -> Difference {
        let apart = |a: &[f64], b: &[f64]| {
            let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).filter(|square| square.is_finite());
            let (sum, count) = squares.fold((0.0, 0_u64), |(sum, count), square| (sum + square, count + 1));
            (sum / count.max(1) as f64).sqrt()
        };
        Difference {
            position: apart(&self.position, &finer.position),
            velocity: apart(&self.velocity, &finer.velocity),
            energy: (self.energy - finer.energy).abs(),
        }
    }
}
