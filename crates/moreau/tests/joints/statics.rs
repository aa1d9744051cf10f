//! Joints at rest: reactions by statics, alone and among contacts.

use super::{close, head, plane, run, solid};
use moreau::step::{Workspace, step};
use moreau::world::OnFailure;

/// A chain of eight pinned bars between two points falls and is stopped whenever its kinetic energy has begun to fall, until it rests. There
/// the reactions at the ends carry the weight, half each, and pull with the same force; and each bar hangs by the law of the chain: the tangents
/// of the slopes grow in steps of the weight over the pull.
#[test]
fn a_chain_hangs_as_statics_says() {
    use std::fmt::Write;
    let mut text = head(2, 1e-2);
    let (n, length) = (8, 0.25);
    // A zigzag that is higher in the middle of each pair: closed at the start, far from rest.
    let corner = |i: usize| [0.2 * i as f64, if i.is_multiple_of(2) { 0.0 } else { 0.15 }];
    for i in 0..n {
        let ([ax, ay], [bx, by]) = (corner(i), corner(i + 1));
        let angle = (by - ay).atan2(bx - ax);
        let _ = write!(
            text,
            "[[bodies]]\nname = \"bar {i}\"\nmaterial = \"steel\"\nposition = [{:?}, {:?}]\norientation = {angle:?}\n\
             shape.polygon = {{ vertices = [[-0.125, -0.01], [0.125, -0.01], [0.125, 0.01], [-0.125, 0.01]] }}\n",
            0.5 * (ax + bx),
            0.5 * (ay + by)
        );
    }
    for i in 0..=n {
        let [x, y] = corner(i);
        let between = match i {
            0 => "\"bar 0\"".to_owned(),
            _ if i == n => format!("\"bar {}\"", n - 1),
            _ => format!("\"bar {}\", \"bar {i}\"", i - 1),
        };
        let _ = write!(text, "[[joints]]\nkind.hinge = {{ anchor = [{x:?}, {y:?}] }}\nbetween = [{between}]\n");
    }
    let mut world = plane(&text);
    // Where bars whip round a step is too long to close all hinges.
    world.settings.on_failure = OnFailure::Halve;
    let (mut work, mut kinetic) = (Workspace::default(), 0.0);
    for _ in 0..6000 {
        let record = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        if record.energy.kinetic < kinetic {
            world.bodies.velocity.fill([0.0; 3]);
        }
        kinetic = if record.energy.kinetic < kinetic { 0.0 } else { record.energy.kinetic };
    }
    let speed = world.bodies.velocity.iter().flatten().fold(0.0_f64, |most, v| most.max(v.abs()));
    assert!(speed < 1e-7, "it still moves at {speed}");
    let ends = [0, n].map(|i| work.reactions()[i].impulse.map(|r| r / 1e-2));
    let weight = 1000.0 * length * 0.02 * 9.81;
    let (pull, all) = (ends[1][0], n as f64 * weight);
    close(ends[0][1], 0.5 * all, 1e-6 * all, "the left end carries half");
    close(ends[1][1], 0.5 * all, 1e-6 * all, "the right end carries half");
    close(ends[0][0], -pull, 1e-6 * all, "the pulls are equal");
    for i in 1..n {
        let slope = |i: usize| world.bodies.pose[i].rotation[1] / world.bodies.pose[i].rotation[0];
        close(slope(i) - slope(i - 1), weight / pull, 1e-6, "the law of the chain");
    }
}

/// A bar on a pin at one end lies with the other on a post: half of its weight each. The post is a fixed box with friction, and the pin
/// shares the bar's weight with it in one solve.
#[test]
fn a_bar_on_a_pin_and_a_post_rests_by_halves() {
    let text = format!(
        "{}default_law.coulomb = {{ friction = 0.4 }}\n\
         [[bodies]]\nname = \"floor\"\nshape.half_plane = {{ normal = [0.0, 1.0] }}\nmaterial = \"steel\"\nposition = [0.0, 0.0]\n\
         [[bodies]]\nname = \"bar\"\nmaterial = \"steel\"\nposition = [0.0, 0.0]\n\
         shape.polygon = {{ vertices = [[0.0, 0.1], [1.0, 0.0], [1.0, 0.2], [0.0, 0.2]] }}\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.0, 0.15] }}\nbetween = [\"floor\", \"bar\"]\ncollide = true\n",
        head(2, 1e-3)
    );
    let mut world = plane(&text);
    let (mass, centre) = (world.bodies.mass[1][0], world.bodies.pose[1].position[0]);
    run(&mut world, 1000, |_, work, record| {
        assert_eq!(record.contacts, 1, "the tip touches the floor");
        let (tip, pin) = (&work.contacts()[0], &work.reactions()[0]);
        // Moments about the pin: N·1 + F·0.15 = m g x. Friction is undetermined but within its cone; the pin takes the rest.
        let [normal, friction] = tip.impulse.map(|r| r / 1e-3);
        let along = tip.frame[1][0] * friction;
        close(normal + 0.15 * along, mass * 9.81 * centre, 1e-6 * mass, "moments about the pin");
        close(normal + pin.impulse[1] / 1e-3, mass * 9.81, 1e-6 * mass, "the weight");
        close(along + pin.impulse[0] / 1e-3, 0.0, 1e-6 * mass, "no force sideways");
        assert!(friction.abs() <= 0.4 * normal + 1e-9 && normal > 0.0);
    });
    assert!(world.bodies.velocity[1].iter().all(|v| v.abs() < 1e-9), "{:?}", world.bodies.velocity[1]);
}

/// A cantilever: a box held at a fixed joint carries its weight and the moment of it.
#[test]
fn a_fixed_joint_carries_a_force_and_a_moment() {
    let text = format!(
        "{}[[bodies]]\nname = \"post\"\nshape.box = {{ size = [0.2, 0.2, 0.2] }}\nmaterial = \"steel\"\nposition = [0.0, 0.0, 0.0]\n\
         motion = \"fixed\"\n\
         [[bodies]]\nname = \"arm\"\nshape.box = {{ size = [1.0, 0.1, 0.1] }}\nmaterial = \"steel\"\nposition = [0.6, 0.1, 0.0]\n\
         [[bodies]]\nname = \"tip\"\nshape.box = {{ size = [0.2, 0.2, 0.2] }}\nmaterial = \"steel\"\nposition = [1.2, 0.1, 0.0]\n\
         [[joints]]\nkind.fixed = {{}}\nbetween = [\"post\", \"arm\"]\n\
         [[joints]]\nkind.fixed = {{}}\nbetween = [\"arm\", \"tip\"]\n",
        head(3, 1e-3)
    );
    let mut world = solid(&text);
    let (arm, tip) = (10.0 * 9.81, 8.0 * 9.81);
    run(&mut world, 300, |_, work, _| {
        let [root, end] = [0, 1].map(|i| work.reactions()[i]);
        // At the centre of the arm: both weights, and the moment of the tip's alone, 0.6 m further out.
        close(root.impulse[2] / 1e-3, arm + tip, 1e-6 * arm, "the weights");
        close(root.moment[1] / 1e-3, -0.6 * tip, 1e-6 * arm, "the moment at the arm's centre");
        close(end.impulse[2] / 1e-3, tip, 1e-6 * arm, "the weight of the tip");
        assert!(end.moment.iter().all(|m| m.abs() < 1e-6 * arm), "at its own centre the tip needs no moment: {end:?}");
    });
}
