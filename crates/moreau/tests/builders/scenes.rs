//! Built bodies in their scene: names, joints, places, and what is refused.

use super::{close, faces, text};
use moreau::scene::{AnyWorld, Scene};

#[test]
fn built_bodies_have_names_and_labels_between_those_of_bodies_and_walls() {
    let text = text(2, "column = { drums = 3, height = 3, width = 1 }")
        + "[[build]]\nkind.dominoes = { count = 2, size = [0.1, 1], spacing = 1 }\nmaterial = \"stone\"\nposition = [3, 0]\n\
           [[containers]]\nmin = [-9, -9]\nmax = [9, 9]\nmaterial = \"stone\"\n";
    let scene = Scene::parse(&text, "names.toml").unwrap();
    let names: Vec<_> = (0..10).map(|i| scene.body_name(i).map(|name| name.to_string())).collect();
    let named = |name: &str| Some(name.to_owned());
    assert_eq!(names[..6], [named("ground"), named("it.0"), named("it.1"), named("it.2"), None, None]);
    assert_eq!(
        ["ground", "it.0", "it.2", "it.3", "it.02", "it"].map(|name| scene.body_named(name)),
        [Some(0), Some(1), Some(3), None, None, None]
    );
    assert_eq!(scene.body_label(2), "drum 1 of build[0] \"it\"");
    assert_eq!(scene.body_label(5), "domino 1 of build[1]");
    assert_eq!(scene.body_label(6), "wall -x of containers[0]");
    let estimate = scene.estimate();
    assert_eq!((estimate.bodies, estimate.free_bodies), (10, 5));
    let AnyWorld::Plane(world) = scene.build(u64::MAX).unwrap() else { panic!("of the plane") };
    assert_eq!(world.bodies.len(), 10);
    close(world.bodies.pose[5].position[0], 4.0, 1e-12);
}

#[test]
fn joints_know_built_bodies_by_name() {
    let arch = "arch = { stones = 4, radius = 1.0, thickness = 0.3, springers = \"fixed\" }";
    let joint = |between: &str| format!("{}[[joints]]\nkind.hinge.anchor = [0, 1]\nbetween = [{between}]\n", text(2, arch));
    let scene = Scene::parse(&joint("\"it.1\", \"it.2\""), "joint.toml").unwrap();
    let AnyWorld::Plane(world) = scene.build(u64::MAX).unwrap() else { panic!("of the plane") };
    assert_eq!(world.joints.len(), 1);
    assert_eq!(world.joints[0].bodies, [Some(2), Some(3)]);
    let error = Scene::parse(&joint("\"it.4\", \"it.5\""), "joint.toml").expect_err("two springers").to_string();
    assert!(error.contains("do not give way"), "{error}");
    let error = Scene::parse(&joint("\"it.6\""), "joint.toml").expect_err("six stones").to_string();
    assert!(error.contains("no body is named `it.6`") && error.contains("`it.0`"), "{error}");
}

#[test]
fn builders_can_be_turned() {
    let turned = text(3, "wall = { size = [0.5, 0.3, 0.2], courses = 2, bricks = 3 }")
        .replace("name = \"it\"", "name = \"it\"\norientation = { axis = [0, 0, 1], degrees = 90 }");
    let AnyWorld::Solid(world) = Scene::parse(&turned, "turned.toml").unwrap().build(u64::MAX).unwrap() else {
        panic!("of space")
    };
    let first = world.bodies.pose[1].position;
    assert!((first[0]).abs() < 1e-12 && (first[1] + 0.5).abs() < 1e-12 && (first[2] - 0.1).abs() < 1e-12, "{first:?}");
    assert_eq!(faces(&world).len(), 3 + 6 + 2 + 3);
}

/// The message of a scene that cannot be built.
#[track_caller]
fn refused(dimension: usize, kind: &str, key: &str, words: &[&str]) {
    let error =
        Scene::parse(&text(dimension, kind), "bad.toml").and_then(|scene| scene.build(1 << 30).map(drop)).expect_err(kind);
    let message = error.to_string();
    assert_eq!(error.place.key, key, "{message}");
    for word in words {
        assert!(message.contains(word), "`{word}` is not in:\n{message}");
    }
    assert!(!error.hint.is_empty(), "{message}");
}

#[test]
fn wrong_numbers_are_refused_by_name() {
    let arch = |rest: &str| format!("arch = {{ stones = 8, radius = 1.0, {rest} }}");
    refused(2, &arch("thickness = -0.1"), "build[0].kind.arch.thickness", &["thickness is -0.1", "positive number"]);
    refused(2, &arch("thickness = 2.5"), "build[0].kind.arch.thickness", &["less than twice the mean radius"]);
    refused(2, &arch("thickness = 0.1, span = 2.0"), "build[0].kind.arch", &["both of radius and span"]);
    refused(2, &arch("thickness = 0.1, depth = 1.0"), "build[0].kind.arch.depth", &["a depth where dimension = 2"]);
    refused(3, &arch("thickness = 0.1"), "build[0].kind.arch", &["`depth` is missing"]);
    refused(2, &arch("thickness = 0.1, degrees = 90"), "build[0].kind.arch.degrees", &["springers = \"fixed\""]);
    refused(2, &arch("thickness = 0.2, joints = \"vertical\""), "build[0].kind.arch.joints", &["fewer stones"]);
    refused(2, &arch("thickness = 0.2, joints = \"slanted\""), "build[0].kind.arch.joints", &["radial", "vertical"]);
    refused(2, &arch("thicknes = 0.2"), "build[0].kind.arch.thicknes", &["did you mean `thickness`?"]);
    refused(2, "arc = { stones = 8 }", "build[0].kind.arc", &["did you mean `arch`?"]);
    refused(2, "arch = { stones = 1, radius = 1.0, thickness = 0.1 }", "build[0].kind.arch.stones", &["2 or more"]);
    let arcade = "arcade = { arches = 2, stones = 9, span = 2.0, pier = 1.2, height = 1.5, blocks = 3, level = 0.9 }";
    refused(2, arcade, "build[0].kind.arcade.level", &["more than half the span"]);
    refused(2, "wall = { size = [1, 1, 1], courses = 2, bricks = 2 }", "build[0].kind.wall.size", &["length and height"]);
    refused(3, "wall = { size = [1, 1, 0], courses = 2, bricks = 2 }", "build[0].kind.wall.size[2]", &["positive number"]);
    refused(2, "wall = { size = [1, 1], courses = 2, bricks = 2, gap = 1.0 }", "build[0].kind.wall.gap", &["less than a brick"]);
    refused(2, "wall = { size = [1, 1], courses = 0, bricks = 2 }", "build[0].kind.wall.courses", &["1 or more"]);
    let count = "wall = { size = [1, 1], courses = 1000000, bricks = 1000000 }";
    refused(2, count, "build[0].kind", &["bodies here make more than"]);
    refused(2, "wall = { size = [1, 1], courses = 10000, bricks = 10000 }", "build[0]", &["GiB of memory"]);
    refused(2, "column = { drums = 2, height = 1, radius = 1 }", "build[0].kind.column.radius", &["expected a width"]);
    refused(3, "column = { drums = 2, height = 1 }", "build[0].kind.column", &["neither of radius and width"]);
    refused(3, "column = { drums = 2, height = 1, radius = 1, sides = 2 }", "build[0].kind.column.sides", &["3 to 360"]);
    let dome = "dome = { courses = 4, stones = 8, radius = 2.0, thickness = 0.5, oculus = 1.8 }";
    refused(3, dome, "build[0].kind.dome.oculus", &["less than the inner radius of 1.75"]);
    refused(2, dome, "build[0].kind", &["a dome where dimension = 2", "the builders of dimension 2 are arch"]);
    let stones = "dry_stone = { size = [1, 1], layers = 2, stones = 2, irregularity = 1.0 }";
    refused(2, stones, "build[0].kind.dry_stone.irregularity", &["from 0 to less than 1"]);
    let dominoes = "dominoes = { count = 2, size = [0.1, 1], spacing = 0.05 }";
    refused(2, dominoes, "build[0].kind.dominoes.spacing", &["at least the thickness"]);
    let lying = "dominoes = { count = 2, size = [0.1, 1], spacing = 0.2, tilt_degrees = 30 }";
    refused(2, lying, "build[0]", &["domino 0 of build[0] \"it\" and domino 1 of build[0] \"it\" overlap"]);
    let cards = "card_house = { levels = 2, size = [0.09, 0.002], degrees = 29.5 }";
    refused(2, cards, "build[0].kind.card_house.degrees", &["pairs of cards overlap"]);
    let drum = "drum = { radius = 1, length = 1, thickness = 0.1, sides = 2 }";
    refused(3, drum, "build[0].kind.drum.sides", &["3 to 1000"]);
    let still = "drum = { radius = 1, length = 1, thickness = 0.1, spin = 1 }\nmotion = \"fixed\"";
    refused(3, still, "build[0].motion", &["a spin of fixed bodies"]);
    let hopper = "hopper = { opening = 0.4, top = 0.3, height = 0.4, thickness = 0.05 }";
    refused(2, hopper, "build[0].kind.hopper.top", &["at least the opening"]);
    let ballast = |rest: &str| format!("ballast = {{ count = 9, radii.constant = 1.0, {rest} }}");
    refused(2, &ballast("seed = 1"), "build[0].kind.ballast", &["a lattice or a packing"]);
    let room = "packing = { min = [0, 0], max = [9, 9] }";
    refused(2, &ballast(room), "build[0].kind.ballast.packing", &["bodies fit"]);
    refused(2, &ballast(&format!("{room}, elongation = 1.5")), "build[0].kind.ballast.elongation", &["0.001 to 1"]);
    refused(2, &ballast(&format!("{room}, corners = 2")), "build[0].kind.ballast.corners", &["from 3"]);
    refused(2, &ballast(&format!("{room}, flatness = 0.5")), "build[0].kind.ballast.flatness", &["leave it out"]);
    refused(2, &ballast("packing = { min = [0], max = [9, 9] }"), "build[0].kind.ballast.packing.min", &["expected 2 numbers"]);
    let tiny = "arch = { stones = 8, radius = 1e-300, thickness = 1e-301, depth = 1 }";
    refused(3, tiny, "build[0].kind.arch.radius", &["from 1e-50"]);
}

#[test]
fn names_that_are_taken_are_refused() {
    let column = "column = { drums = 3, height = 3, width = 1 }";
    let second =
        "\n[[build]]\nname = \"it\"\nkind.column = { drums = 1, height = 1, width = 1 }\nmaterial = \"stone\"\nposition = [9, 0]";
    refused(2, &format!("{column}{second}"), "build[1].name", &["build[0] has it already"]);
    let body = text(2, column).replace("name = \"ground\"", "name = \"it.2\"");
    let error = Scene::parse(&body, "bad.toml").expect_err("a name of the column's");
    assert!(error.to_string().contains("bodies[0].name: the name of a body of build[0]"), "{error}");
    refused(2, &format!("{column}\nmotion = \"loose\""), "build[0].motion", &["free"]);
}
