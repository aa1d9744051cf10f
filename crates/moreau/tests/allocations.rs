//! A step in a steady state allocates nothing but the list of stages in its solver's report.

use moreau::scene::{AnyWorld, Scene};
use moreau::step::{Workspace, step};
use std::alloc::{GlobalAlloc, Layout, System};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system's allocator, counting.
struct Counting;

static COUNT: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call goes to the system's allocator as it came.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// In a pool, as the program has it: a call from outside allocates now and then where it hands work in.
#[test]
fn steps_do_not_allocate() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    pool.install(|| {
        balls_at_rest_take_steps_without_allocations();
        joints_take_steps_without_allocations();
    });
}

fn balls_at_rest_take_steps_without_allocations() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes/box-of-balls.toml");
    let mesh = "bodies=[{ shape.height_field = { spacing = [1e-3, 1e-3], heights = ROWS }, material = \"glass\", position = [0, 0, 1e-5] }]";
    let mesh = mesh.replace("ROWS", &format!("{:?}", vec![vec![0.0; 21]; 21]));
    for (law, ground) in
        [("frictionless = {}", ""), ("coulomb = { friction = 0.3 }", ""), ("coulomb = { friction = 0.3 }", &mesh)]
    {
        let mut sets = vec!["generate.0.count=100".to_owned(), "time.step=1e-3".to_owned(), format!("default_law={{ {law} }}")];
        sets.extend((!ground.is_empty()).then(|| ground.to_owned()));
        let scene = Scene::load_with(&path, &sets).unwrap_or_else(|error| panic!("{error}"));
        let AnyWorld::Solid(mut world) = scene.build(u64::MAX).unwrap() else { panic!("a scene in space") };
        let mut work = Workspace::default();
        let mut steps = |count: usize| {
            let before = COUNT.load(Ordering::Relaxed);
            let contacts = (0..count).map(|_| step(&mut world, &mut work).unwrap().contacts).max();
            (COUNT.load(Ordering::Relaxed) - before, contacts)
        };
        steps(2500);
        let (allocations, contacts) = steps(500);
        assert!(contacts > Some(100), "{contacts:?} contacts are no heap");
        // Now and then a heap that still creeps has a contact more than ever before.
        assert!(allocations <= 500 + 10, "{law}: {allocations} allocations in 500 steps");
    }
}

/// A mechanism with joints and contacts: a list of stages for each of a step's solves, of which there are at most five; to colour the contacts of
/// bodies that are not round takes memory, so they stay in their order.
fn joints_take_steps_without_allocations() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes/slider-crank.toml");
    let sets = ["solver.order=natural".to_owned()];
    let scene = Scene::load_with(&path, &sets).unwrap_or_else(|error| panic!("{error}"));
    let AnyWorld::Plane(mut world) = scene.build(u64::MAX).unwrap() else { panic!("a scene of the plane") };
    let mut work = Workspace::default();
    let mut allocations = |steps: usize| {
        let before = COUNT.load(Ordering::Relaxed);
        let converged = (0..steps).all(|_| step(&mut world, &mut work).unwrap().converged());
        assert!(converged, "every step of the scene converges");
        COUNT.load(Ordering::Relaxed) - before
    };
    allocations(2500);
    let allocations = allocations(500);
    assert!(allocations <= 5 * 500, "{allocations} allocations in 500 steps with joints");
}
