//! Whatever the content of a checkpoint is, a world takes it or refuses it; what a world that took it gives, another takes and gives again. (The checksum around
//! the content, which would keep all but what was written away, is left out.)
#![no_main]

use libfuzzer_sys::fuzz_target;
use moreau::checkpoint::Checkpoint;
use moreau::observe::Summary;
use moreau::scene::{AnyWorld, Scene};
use moreau::space::Solid;
use moreau::step::Workspace;
use moreau::world::World;
use std::sync::LazyLock;

/// The scene of the seeds.
const SCENE: &str = include_str!("../seeds/scene/events.toml");

static WORLD: LazyLock<World<Solid, 3, 6>> = LazyLock::new(|| {
    let AnyWorld::Solid(world) = Scene::parse(SCENE, "checkpoint.toml").unwrap().build(u64::MAX).unwrap() else { panic!() };
    world
});

/// The checkpoint in a world of its own, if that takes it.
fn taken(checkpoint: &Checkpoint) -> Option<(World<Solid, 3, 6>, Workspace<Solid, 3, 6>)> {
    let (mut world, mut work) = (WORLD.clone(), Workspace::default());
    checkpoint.restore(&mut world, &mut work).ok().map(|()| (world, work))
}

fuzz_target!(|bytes: &[u8]| {
    let Ok(checkpoint) = postcard::from_bytes::<Checkpoint>(bytes) else { return };
    let Some((world, work)) = taken(&checkpoint) else { return };
    // What says something of a body that is not there may change once, and not again.
    let once = Checkpoint::take(SCENE, (Summary::default(), Vec::new()), &world, &work);
    let (mut world, mut work) = taken(&once).expect("what a run gives it takes");
    let twice = Checkpoint::take(SCENE, (Summary::default(), Vec::new()), &world, &work);
    assert!(once.state_digest() == twice.state_digest());
    let _ = moreau::step::step(&mut world, &mut work);
});
