//! Whatever the content of a checkpoint is, a world takes it or refuses it; a world that took it gives the same again. (The checksum around
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

fuzz_target!(|bytes: &[u8]| {
    let Ok(checkpoint) = postcard::from_bytes::<Checkpoint>(bytes) else { return };
    let (mut world, mut work) = (WORLD.clone(), Workspace::default());
    if checkpoint.restore(&mut world, &mut work).is_ok() {
        let again = Checkpoint::take(SCENE, (Summary::default(), Vec::new()), &world, &work);
        assert!(again.state_digest() == checkpoint.state_digest());
        let _ = moreau::step::step(&mut world, &mut work);
    }
});
