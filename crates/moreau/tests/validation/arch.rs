//! 10. A semicircular arch of equal stones with radial joints.

use super::{close, scene};
use moreau::run::{End, Task, run};
use moreau::scene::AnyWorld;
use moreau::space::Space;
use moreau::step::Workspace;
use moreau::world::World;
use std::sync::atomic::AtomicBool;

/// The arch with mean radius 1 m on a floor: n stones of this thickness, m.
fn arch(file: &str, n: usize, thickness: f64) -> AnyWorld {
    let sets = [format!("build.0.kind.arch.stones={n}"), format!("build.0.kind.arch.thickness={thickness:?}")];
    scene(file, &sets.each_ref().map(String::as_str))
}

/// Whether it still stands after these steps.
fn stands_for<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>, steps: u64) -> bool {
    let height = |world: &World<S, D, N>| world.bodies.pose.iter().map(|pose| pose.position[D - 1]).collect::<Vec<_>>();
    let start = height(&world);
    let outcome = run(&mut world, &mut Workspace::default(), Task::new(steps), &mut [], &AtomicBool::new(false), |_| {}).unwrap();
    assert!(outcome.end == End::Done, "{:?}", outcome.end);
    let sunk = height(&world).iter().zip(start).map(|(z, before)| (before - z).abs()).fold(0.0, f64::max);
    sunk < 1e-7
}

fn stands(n: usize, thickness: f64) -> bool {
    match arch("10-arch/scene.toml", n, thickness) {
        AnyWorld::Plane(world) => stands_for(world, 2000),
        AnyWorld::Solid(_) => panic!("of the plane"),
    }
}

/// The least thickness over mean radius at which an arch stands, by bisection between three parts in a hundred below and above of what statics
/// says of stones with straight sides; see the folder.
///
/// One that stands moves by the error of the solver, some 1e-11 m; one that is a ten-thousandth too thin is pushed out of balance by about a
/// ten-thousandth of its weight, and moves by 1e-4 m in two seconds. What is left is the width of the last step of the bisection.
#[test]
fn an_arch_stands_above_its_least_thickness_and_falls_below() {
    for (n, least) in [(7, 0.095_703), (15, 0.106_068), (25, 0.106_959)] {
        let (mut falls, mut stood) = (0.97 * least, 1.03 * least);
        assert!(stands(n, stood) && !stands(n, falls), "{n} stones");
        while stood - falls > 6e-4 * least {
            let middle = 0.5 * (falls + stood);
            if stands(n, middle) { stood = middle } else { falls = middle }
        }
        close(0.5 * (falls + stood), least, 1e-3 * least, "least thickness");
    }
}

/// Depth changes nothing in an arch that bends in its plane: the same stones as polyhedra stand a hundredth above the least thickness of the
/// plane and fall a hundredth below. Out of balance by a hundredth of its weight, the latter sinks by millimetres in half a second.
#[test]
fn an_arch_of_polyhedra_has_the_least_thickness_of_the_plane() {
    for (n, least) in [(7, 0.095_703), (15, 0.106_068)] {
        for (part, expected) in [(1.01, true), (0.99, false)] {
            let AnyWorld::Solid(world) = arch("10-arch/scene-3d.toml", n, part * least) else { panic!("of space") };
            assert_eq!(stands_for(world, 500), expected, "{n} stones, {part} of the least thickness");
        }
    }
}
