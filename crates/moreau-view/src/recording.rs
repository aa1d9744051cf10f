//! A run's folder, as pages and pictures see it: the scene for shapes and names, the trajectory for all that moves.

mod block;
mod bodies;
mod measures;
mod record;

pub use block::block;
pub(crate) use bodies::Drawn;

use measures::Measures;
use moreau::scene::{AnyWorld, Scene};
use moreau::trajectory::{Trajectory, TrajectoryError};
use serde_json::{Value, json};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// What keeps a run from being shown.
#[derive(Debug, thiserror::Error)]
pub enum RecordingError {
    /// The scene beside the trajectory.
    #[error(transparent)]
    Scene(#[from] moreau::scene::SceneError),
    /// The trajectory.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// There is no trajectory.
    #[error(
        "{0} has no trajectory.h5: it is no folder of a run, or of one whose output.kinds had no \"trajectory\"; name the folder that moreau run wrote"
    )]
    None(PathBuf),
    /// The scene's world is not the trajectory's.
    #[error("{folder}: scene.toml makes {scene} bodies and the trajectory has {trajectory}: they are of two runs")]
    Bodies {
        /// The run's folder.
        folder: PathBuf,
        /// Bodies of the scene.
        scene: usize,
        /// Bodies of the trajectory.
        trajectory: usize,
    },
}

/// So many bodies, and half of those that a scene is expected to have, are built to be counted.
const SLACK: usize = 1000;

/// A run that is over, was killed, or goes on.
pub struct Recording {
    /// What was run.
    pub scene: Scene,
    /// The world as it was built.
    pub world: AnyWorld,
    /// The frames at hand.
    pub trajectory: Trajectory,
    folder: PathBuf,
    /// The records of steps, by the columns of `steps.csv`.
    columns: Vec<Vec<f64>>,
    measures: Measures,
}

impl Recording {
    /// Opens the folder of a run.
    ///
    /// # Errors
    /// Where there is no trajectory or scene, or they cannot be read, or do not belong together.
    pub fn open(folder: &Path) -> Result<Self, RecordingError> {
        let path = folder.join("trajectory.h5");
        if !path.is_file() {
            return Err(RecordingError::None(folder.to_owned()));
        }
        let trajectory = Trajectory::open(&path)?;
        let scene = Scene::load(&folder.join("scene.toml"))?;
        let count = trajectory.header().radius.len();
        let of_two_runs = |bodies: usize| RecordingError::Bodies { folder: folder.to_owned(), scene: bodies, trajectory: count };
        // A scene of a few bytes can ask for more bodies than there is memory for; those of the run were seen in the trajectory.
        let expected = usize::try_from(scene.estimate().bodies).unwrap_or(usize::MAX);
        if expected / 2 > count + SLACK {
            return Err(of_two_runs(expected));
        }
        let world = scene.build(u64::MAX)?;
        let bodies = match &world {
            AnyWorld::Plane(world) => world.bodies.len(),
            AnyWorld::Solid(world) => world.bodies.len(),
        };
        if bodies != count {
            return Err(of_two_runs(bodies));
        }
        let columns = trajectory.columns()?;
        let measures = Measures::read(&folder.join("measures.csv"));
        Ok(Self { scene, world, trajectory, folder: folder.to_owned(), columns, measures })
    }

    /// Sees what has come since.
    ///
    /// # Errors
    /// Where the trajectory cannot be read any more.
    pub fn renew(&mut self) -> Result<(), RecordingError> {
        self.renew_frames()?;
        self.columns = self.trajectory.columns()?;
        self.measures = Measures::read(&self.folder.join("measures.csv"));
        Ok(())
    }

    /// Sees the frames that have come since, and no records of steps: of a file that grows fast little can be read before it has changed again.
    ///
    /// # Errors
    /// As for [`Self::renew`].
    pub fn renew_frames(&mut self) -> Result<(), RecordingError> {
        self.trajectory = Trajectory::open(&self.folder.join("trajectory.h5"))?;
        Ok(())
    }

    /// Its name: the scene's title, else the folder's; without control characters, which no XML can hold.
    pub fn title(&self) -> String {
        let folder = || self.folder.file_name().map(|name| name.to_string_lossy().into_owned());
        let title = self.scene.title.clone().or_else(folder).unwrap_or_default();
        title.chars().filter(|c| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}')).collect()
    }

    /// A column of `steps.csv`, by its name; empty where there is none.
    pub fn column(&self, name: &str) -> &[f64] {
        let place = moreau::observe::COLUMNS.iter().position(|&column| column == name);
        place.map_or(&[], |place| self.columns[place].as_slice())
    }

    /// A column of `measures.csv`, by its name; empty where there is none.
    pub fn measure(&self, name: &str) -> &[f64] {
        self.measures.column(name)
    }

    /// What a page knows before it sees a frame, for these frames in these blocks. `live` says whether the run goes on.
    pub fn meta(&self, frames: &[usize], blocks: &[Range<usize>], thinned: usize, live: bool) -> Value {
        let (scene, trajectory) = (&self.scene, &self.trajectory);
        let (bodies, shapes) = match &self.world {
            AnyWorld::Plane(world) => bodies::of(scene, world),
            AnyWorld::Solid(world) => bodies::of(scene, world),
        };
        let solver = scene.solver.settings();
        let each = |what: &dyn Fn(usize) -> Value| frames.iter().map(|&i| what(i)).collect::<Vec<_>>();
        json!({
            "version": 1,
            "title": self.title(),
            "dimension": trajectory.header().dimension,
            "gravity": scene.gravity,
            "scene": scene.to_toml(),
            "live": live,
            "solver": {
                "local": solver.local.name(),
                "global": solver.global.name(),
                "criterion": scene.solver.criterion,
                "tolerance": solver.tolerance,
                "step": scene.time.step,
                "theta": scene.time.theta,
            },
            "verdict": record::verdict(self),
            "materials": scene.materials.keys().collect::<Vec<_>>(),
            "bodies": bodies,
            "shapes": shapes,
            "frames": {
                "time": each(&|i| trajectory.times()[i].into()),
                "step": each(&|i| trajectory.steps()[i].into()),
                "contacts": each(&|i| trajectory.contacts(i).into()),
            },
            "blocks": blocks.iter().map(|b| json!({ "first": b.start, "frames": b.len() })).collect::<Vec<_>>(),
            "thinned": thinned,
            "steps": record::steps(self),
            "measures": self.measures.json(),
        })
    }
}
