//! Interfaces and the line of thrust, where statics says what they are.

use super::{close, run, scene};
use moreau::observe::interfaces::{Interface, interfaces, thrust};
use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid, Space};
use moreau::step::Workspace;
use moreau::world::World;

const G: f64 = 9.81;

fn build(text: &str, sets: &[&str]) -> AnyWorld {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let scene = Scene::parse_with(text, "scene.toml", &sets).unwrap_or_else(|error| panic!("{error}"));
    scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}"))
}

fn plane(text: &str, sets: &[&str]) -> World<Plane, 2, 3> {
    let AnyWorld::Plane(world) = build(text, sets) else { panic!("of space") };
    world
}

fn solid(text: &str, sets: &[&str]) -> World<Solid, 3, 6> {
    let AnyWorld::Solid(world) = build(text, sets) else { panic!("of the plane") };
    world
}

/// The interfaces after some steps, and the line of thrust.
fn after<S: Space<D, N>, const D: usize, const N: usize>(
    world: &mut World<S, D, N>,
    steps: u64,
) -> (Vec<Interface<D>>, Vec<[usize; 2]>) {
    let mut found = (Vec::new(), Vec::new());
    run(world, steps, |world: &World<S, D, N>, work: &Workspace<S, D, N>, record| {
        let all: Vec<_> = interfaces(work.contacts(), record.h).collect();
        found = (all.clone(), thrust(&all, &world.bodies, &world.gravity));
    });
    found
}

/// A block 0.4 m wide and 0.6 m high, in space 0.5 m deep, that is pushed at its centre.
fn pushed(dimension: usize, force: &[f64], friction: f64) -> String {
    let (up, shape) = match dimension {
        2 => ("[0.0, 1.0]", "polygon = { vertices = [[-0.2, -0.3], [0.2, -0.3], [0.2, 0.3], [-0.2, 0.3]] }"),
        _ => ("[0.0, 0.0, 1.0]", "box = { size = [0.4, 0.5, 0.6] }"),
    };
    let vector =
        |last: f64| format!("{:?}", (0..dimension).map(|k| if k + 1 == dimension { last } else { 0.0 }).collect::<Vec<_>>());
    let ground = if dimension == 2 { "half_plane" } else { "half_space" };
    format!(
        "dimension = {dimension}\ngravity = {}\ntime = {{ step = 1e-3, steps = 10 }}\n\
         solver = {{ criterion = \"scaled\", tolerance = 1e-13, max_sweeps = 100000 }}\n\
         materials.stone.density = 1000.0\ndefault_law.coulomb = {{ friction = {friction:?} }}\n\
         [[bodies]]\nshape.{ground} = {{ normal = {up} }}\nmaterial = \"stone\"\nposition = {}\n\
         [[bodies]]\nshape.{shape}\nmaterial = \"stone\"\nposition = {}\nforce = {force:?}\n",
        vector(-G),
        vector(0.0),
        vector(0.3),
    )
}

/// The moment of the push about the base, P H/2, must be that of the weight about the centre of pressure, W e.
#[test]
fn the_resultant_under_a_pushed_block_passes_where_statics_says() {
    let (weight, push) = (240.0 * G, 700.0);
    let (found, joined) = after(&mut plane(&pushed(2, &[push, 0.0], 0.5), &[]), 10);
    let [one] = found[..] else { panic!("{found:?}") };
    assert!(one.bodies == [0, 1] && one.points == 2 && one.normal == [0.0, 1.0] && joined.is_empty());
    close(one.force[0], -push, 1e-8, "shear");
    close(one.force[1], weight, 1e-8, "weight");
    close(one.pressure[0], push * 0.3 / weight, 1e-10, "centre of pressure");
    close(one.eccentricity(), push * 0.3 / weight, 1e-10, "eccentricity");
    close(one.moment[2], push * 0.3, 1e-8, "moment about the centre of the base");
    close(one.mobilised, push / (0.5 * weight), 1e-10, "mobilised friction");

    let (weight, push) = (120.0 * G, [150.0, -200.0, 0.0]);
    let (found, _) = after(&mut solid(&pushed(3, &push, 0.4), &[]), 10);
    let [one] = found[..] else { panic!("{found:?}") };
    assert!(one.points == 4, "{one:?}");
    for k in 0..2 {
        close(one.pressure[k], push[k] * 0.3 / weight, 1e-9, "centre of pressure in space");
    }
    for (found, right) in one.moment.iter().zip([-200.0 * 0.3, -150.0 * 0.3, 0.0]) {
        close(*found, right, 1e-6, "moment in space");
    }
    close(one.shear_force, 250.0, 1e-6, "shear in space");
    close(one.mobilised, 250.0 / (0.4 * weight), 1e-9, "mobilised friction in space");
}

#[test]
fn a_block_that_slides_mobilises_all_friction() {
    let (found, _) = after(&mut plane(&pushed(2, &[400.0, 0.0], 0.1), &[]), 10);
    close(found[0].mobilised, 1.0, 1e-10, "mobilised friction");
    close(found[0].shear_force, 0.1 * 240.0 * G, 1e-7, "shear");
}

/// Nothing pushes sideways, so each interface carries the weight above it, at the centre of mass of what is above.
#[test]
fn each_interface_of_a_tower_carries_what_is_above_it() {
    let mut world = solid(include_str!("../../../../scenes/tower.toml"), &["time.steps=100"]);
    let (found, joined) = after(&mut world, 100);
    assert_eq!(found.len(), 20);
    let one = 0.4 * 0.3 * 0.1 * 2000.0 * G;
    for (level, interface) in found.iter().enumerate() {
        assert_eq!(interface.bodies, [level as u32, level as u32 + 1]);
        let above = world.bodies.pose[level + 1..].iter();
        let count = above.len() as f64;
        // The tolerance is a hundred-millionth of the largest velocity of a step, g h, in which twenty boxes add up.
        close(interface.force[2], count * one, 20.0 * 20.0 * 1e-8 * one, "weight above");
        for k in 0..2 {
            let centre = above.clone().map(|pose| pose.position[k]).sum::<f64>() / count;
            close(interface.pressure[k], centre, 1e-6, "centre of pressure");
        }
    }
    // Up from the ground, through all boxes but the last.
    assert!(joined.iter().copied().eq((0..19).map(|i| [i, i + 1])), "{joined:?}");
}

/// Where the line of thrust of an arch passes its joints, from one foot to the other: 1 is the outer edge, −1 the inner.
///
/// The line must be a chain from foot to foot, and the forces that act at its points must balance each stone: Σ F = 0 and Σ x × F = 0.
fn line_of_thrust(n: usize, thickness: f64, method: &str) -> Vec<f64> {
    let (stones, thick) = (format!("build.0.kind.arch.stones={n}"), format!("build.0.kind.arch.thickness={thickness:?}"));
    let sets = [&stones, &thick, "solver.tolerance=1e-10", &format!("solver.global={method}")];
    let AnyWorld::Plane(mut world) = scene("10-arch/scene.toml", &sets) else { panic!("of space") };
    let (found, mut joined) = after(&mut world, 20);
    // Joint j is between stones j − 1 and j, which are bodies j and j + 1; the first and the last are with the ground.
    let at = |j: usize| {
        let bodies = match j as u32 {
            0 => [0, 1],
            last if j == n => [0, last],
            inner => [inner, inner + 1],
        };
        found.iter().position(|one| one.bodies == bodies).unwrap_or_else(|| panic!("joint {j} is open"))
    };
    let mut chain: Vec<[usize; 2]> = (0..n).map(|j| [at(j).min(at(j + 1)), at(j).max(at(j + 1))]).collect();
    chain.sort_unstable();
    joined.sort_unstable();
    assert_eq!(joined, chain);
    for stone in 1..=n {
        let weight = G * world.bodies.mass[stone][0];
        let x = world.bodies.pose[stone].position;
        let mut rest = [0.0, -weight, 0.0];
        for one in [at(stone - 1), at(stone)].map(|i| &found[i]) {
            let sign = if one.bodies[1] == stone as u32 { 1.0 } else { -1.0 };
            let arm = [one.pressure[0] - x[0], one.pressure[1] - x[1]];
            rest[0] += sign * one.force[0];
            rest[1] += sign * one.force[1];
            rest[2] += sign * (arm[0] * one.force[1] - arm[1] * one.force[0]);
        }
        assert!(rest.iter().all(|part| part.abs() <= 1e-6 * weight), "stone {stone} of {n}: {rest:?} of {weight}");
    }
    (0..=n).map(|j| (found[at(j)].pressure[0].hypot(found[at(j)].pressure[1]) - 1.0) / (0.5 * thickness)).collect()
}

#[test]
fn the_line_of_thrust_of_an_arch_balances_each_stone_and_stays_inside() {
    for n in [7, 15, 25] {
        let line = line_of_thrust(n, 0.15, "accelerated");
        assert!(line.iter().all(|place| place.abs() <= 1.0 + 1e-9), "{line:?}");
    }
}

/// A thick arch has many lines of thrust, and which one a sweep finds depends on its order. Splitting treats all contacts alike: its line is
/// as symmetric as the arch, to the tolerance of the solver.
#[test]
fn a_method_without_an_order_finds_a_symmetric_line_of_thrust() {
    for n in [7, 15, 25] {
        let line = line_of_thrust(n, 0.15, "admm");
        for j in 0..=n {
            close(line[j], line[n - j], 1e-9, "symmetry");
        }
    }
}

/// With hardly more than the least thickness there is hardly more than one line: it is symmetric, touches the outer edge at the crown and at the
/// feet and the inner edge at the haunches between them (Heyman 1995), to what the rest of thickness leaves.
#[test]
fn at_the_least_thickness_the_line_of_thrust_touches_both_edges() {
    for (n, least) in [(7, 0.095_703), (15, 0.106_068), (25, 0.106_959)] {
        let line = line_of_thrust(n, 1.002 * least, "accelerated");
        let largest = |joints: std::ops::RangeInclusive<usize>, side: f64| {
            line[joints].iter().map(|place| side * place).fold(f64::NEG_INFINITY, f64::max)
        };
        assert!(largest(n / 3..=n - n / 3, 1.0) > 0.98, "crown: {line:?}");
        assert!(line[0] > 0.98 && line[n] > 0.98, "feet: {line:?}");
        assert!(largest(1..=n / 2, -1.0) > 0.98 && largest(n - n / 2..=n - 1, -1.0) > 0.98, "haunches: {line:?}");
        for j in 0..=n {
            close(line[j], line[n - j], 0.02, "symmetry");
        }
    }
}
