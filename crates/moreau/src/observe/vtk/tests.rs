//! What is written in the background is what would be written at once, and what cannot be written ends the run.

use super::files::Files;
use super::snapshot::Snapshot;
use super::{Frame, Observer, OutputError, VtkOutput};
use crate::bodies::Motion;
use crate::observe::StepsCsv;
use crate::observe::background::Writer;
use crate::run::{End, Task, run};
use crate::scene::{AnyWorld, Scene};
use crate::space::Solid;
use crate::step::Workspace;
use crate::world::World;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

const DROP: &str = r#"
dimension = 3
gravity = [0.0, 0.0, -10.0]
time = { step = 1e-3, steps = 1000 }
materials.stone.density = 1000.0
default_law.coulomb = { friction = 0.5 }

[[bodies]]
shape.half_space = { normal = [0.0, 0.0, 1.0] }
material = "stone"
position = [0.0, 0.0, 0.0]

[[bodies]]
shape.ball = { radius = 0.1 }
material = "stone"
position = [0.0, 0.0, 0.101]
velocity = [1.0, 0.0, 0.0]
"#;

/// A box falls beside the ball.
const BOX: &str = r#"
[[bodies]]
shape.box = { size = [0.1, 0.2, 0.3] }
material = "stone"
position = [1.0, 0.0, 0.151]
velocity = [1.0, 0.0, 0.0]
"#;

fn world() -> World<Solid, 3, 6> {
    built(DROP)
}

fn built(text: &str) -> World<Solid, 3, 6> {
    let scene = Scene::parse_with(text, "drop.toml", &[]).unwrap_or_else(|error| panic!("{error}"));
    match scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("of the plane"),
    }
}

/// All files of a folder.
fn all(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    paths.map(|path| (path.strip_prefix(folder).unwrap().to_owned(), fs::read(&path).unwrap())).collect()
}

/// Writes each frame before it returns.
struct Direct(Files);

impl Observer<Solid, 3, 6> for Direct {
    fn see(&mut self, frame: &Frame<'_, Solid, 3, 6>) -> Result<(), OutputError> {
        let mut snapshot = Snapshot::default();
        // Its drawing is made anew each time.
        snapshot.take(frame, &mut Arc::default());
        self.0.write(&snapshot)
    }

    fn finish(&mut self) -> Result<(), OutputError> {
        self.0.catch_up()
    }
}

#[test]
fn files_are_those_of_a_run_that_waits_for_them() {
    // A ball has no polygons, so the first scene has neither shapes nor interfaces.
    for (text, kinds) in [(DROP.to_owned(), 2), (DROP.to_owned() + BOX, 4)] {
        let (behind, direct) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let mut observers: [Box<dyn Observer<Solid, 3, 6>>; 2] =
            [Box::new(VtkOutput::create(behind.path(), 1).unwrap()), Box::new(Direct(Files::new(direct.path())))];
        run(&mut built(&text), &mut Workspace::default(), Task::new(30), &mut observers, &AtomicBool::new(false), |_| {})
            .unwrap();
        // Without a drop: all must be there when the run is over.
        let (behind, direct) = (all(behind.path()), all(direct.path()));
        assert_eq!(behind.len(), kinds * 31 + kinds);
        assert!(behind == direct, "{:?} and {:?}", behind.keys(), direct.keys());
    }
}

#[test]
fn a_body_that_is_gone_is_drawn_no_more() {
    let mut world = built(&(DROP.to_owned() + BOX));
    let (mut snapshot, mut drawing) = (Snapshot::default(), Arc::default());
    for (motion, polygons) in [(Motion::Free, 6), (Motion::Absent, 0), (Motion::Absent, 0)] {
        world.bodies.set_motion(2, motion);
        snapshot.take(&Frame { world: &world, contacts: &[], record: None }, &mut drawing);
        let data = snapshot.shapes();
        assert_eq!((data.polys.len(), data.cell_data[0].values.len()), (polygons, polygons));
        assert!(snapshot.has_shapes() == (polygons > 0) && data.points.len() == polygons / 6 * 8);
    }
}

#[test]
fn the_collections_follow_when_there_is_a_pause() {
    let folder = tempfile::tempdir().unwrap();
    let mut output = VtkOutput::create(folder.path(), 1).unwrap();
    let mut world = world();
    for _ in 0..5 {
        output.see(&Frame { world: &world, contacts: &[], record: None }).unwrap();
        world.steps += 1;
    }
    let until = Instant::now() + Duration::from_secs(20);
    let named = || fs::read_to_string(folder.path().join("contacts.pvd")).map_or(0, |text| text.matches("<DataSet").count());
    while named() < 5 {
        assert!(Instant::now() < until, "{} frames are named", named());
        std::thread::sleep(Duration::from_millis(10));
    }
    drop(output);
}

/// Puts a file in the place of a folder after some frames.
struct Vandal {
    folder: PathBuf,
    frames: u32,
}

impl Observer<Solid, 3, 6> for Vandal {
    fn see(&mut self, _: &Frame<'_, Solid, 3, 6>) -> Result<(), OutputError> {
        self.frames += 1;
        if self.frames == 10 {
            // The other thread may be making a file in it.
            let gone = (0..1000).any(|_| fs::remove_dir_all(&self.folder).is_ok());
            assert!(gone && fs::write(&self.folder, "a file").is_ok());
        }
        Ok(())
    }
}

#[test]
fn a_folder_that_is_lost_ends_the_run_and_leaves_the_other_files_complete() {
    for every in [1, 7] {
        let folder = tempfile::tempdir().unwrap();
        let (vtk, csv) = (folder.path().join("vtk"), folder.path().join("steps.csv"));
        let mut observers: [Box<dyn Observer<Solid, 3, 6>>; 3] = [
            Box::new(VtkOutput::create(&vtk, every).unwrap()),
            Box::new(StepsCsv::create(&csv).unwrap()),
            Box::new(Vandal { folder: vtk.clone(), frames: 0 }),
        ];
        let (mut world, stop) = (world(), AtomicBool::new(false));
        let slow = |_: &_| std::thread::sleep(Duration::from_millis(1));
        let unwritten = run(&mut world, &mut Workspace::default(), Task::new(100_000), &mut observers, &stop, slow).unwrap_err();
        let steps = unwritten.outcome.summary.steps();
        assert!(unwritten.outcome.end == End::Unwritten && (9..100_000).contains(&steps), "{steps} steps");
        assert!(unwritten.to_string().starts_with(&format!("cannot write {}", vtk.display())), "{unwritten}");
        assert_eq!(fs::read_to_string(&csv).unwrap().lines().count() as u64, 1 + steps);
    }
}

#[test]
fn a_last_frame_that_cannot_be_written_is_told_at_the_end() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("contacts_00000003.vtp")).unwrap();
    let mut observers: [Box<dyn Observer<Solid, 3, 6>>; 1] = [Box::new(VtkOutput::create(folder.path(), 1).unwrap())];
    let stop = AtomicBool::new(false);
    let unwritten = run(&mut world(), &mut Workspace::default(), Task::new(3), &mut observers, &stop, |_| {}).unwrap_err();
    assert!(unwritten.outcome.end == End::Unwritten && unwritten.outcome.summary.steps() == 3);
    assert!(unwritten.to_string().contains("contacts_00000003.vtp"), "{unwritten}");
    // The collections name what is there, and nothing else.
    let named = |name| fs::read_to_string(folder.path().join(name)).unwrap().matches("<DataSet").count();
    assert_eq!([named("bodies.pvd"), named("contacts.pvd")], [4, 3]);
}
