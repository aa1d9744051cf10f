//! Bodies with faces, edges and corners: how they fall, spin and come to rest, against closed forms.

use glam::{DQuat, DVec3};
use moreau::detect::Detector;
use moreau::scene::{AnyWorld, Scene};
use moreau::shape::Shape;
use moreau::space::Solid;
use moreau::step::{StepRecord, Workspace, step};
use moreau::world::World;

const G: f64 = 9.81;

fn world(text: &str) -> World<Solid, 3, 6> {
    let scene = Scene::parse(text, "scene.toml").unwrap_or_else(|error| panic!("{error}"));
    let AnyWorld::Solid(world) = scene.build(u64::MAX).unwrap_or_else(|error| panic!("{error}")) else { panic!("of space") };
    world
}

fn run(world: &mut World<Solid, 3, 6>, steps: usize, mut see: impl FnMut(&World<Solid, 3, 6>, &StepRecord)) {
    let mut work = Workspace::default();
    for _ in 0..steps {
        let record = step(world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.converged(), "step {}: {:?}", record.step, record.residual);
        see(world, &record);
    }
}

/// How a cube is turned so that this feature looks down.
fn down(feature: &str) -> DQuat {
    let to_face = |v: DVec3| DQuat::from_rotation_arc(v.normalize(), DVec3::NEG_Z);
    match feature {
        "face" => DQuat::IDENTITY,
        "edge" => to_face(DVec3::new(0.0, 1.0, -1.0)),
        "crossing edge" => to_face(DVec3::new(1.0, 0.0, -1.0)),
        _ => to_face(DVec3::ONE),
    }
}

/// From its centre to its lowest point, of a cube of edge 0.2 m.
fn reach(feature: &str) -> f64 {
    let features = if feature == "face" {
        1.0
    } else if feature == "corner" {
        3.0
    } else {
        2.0_f64
    };
    0.1 * features.sqrt()
}

/// A cube that falls half a metre, centre over centre, on a fixed cube or, with no feature, on a half-space.
fn falling(feature: &str, on: Option<&str>, restitution: f64) -> World<Solid, 3, 6> {
    let quaternion = |q: DQuat| format!("{:?}", q.to_array());
    let ground = match on {
        None => "shape.half_space = { normal = [0.0, 0.0, 1.0] }\nposition = [0.0, 0.0, 0.0]".to_owned(),
        Some(on) => format!(
            "shape.box = {{ size = [0.2, 0.2, 0.2] }}\nmotion = \"fixed\"\nposition = [0.0, 0.0, {:?}]\norientation = {}",
            -reach(on),
            quaternion(down(on))
        ),
    };
    // A full rebound asks for the same energy to rounding: friction would add the solver's tolerance.
    let friction = if restitution < 1.0 { 0.5 } else { 0.0 };
    let law = format!(
        "{{ coulomb = {{ friction = {friction:?}, restitution = {restitution:?}, tangential_restitution = {restitution:?} }} }}"
    );
    world(&format!(
        "dimension = 3
         gravity = [0.0, 0.0, -{G}]
         time = {{ step = 1e-4, steps = 1 }}
         solver = {{ criterion = \"scaled\", tolerance = 1e-11, start = \"warm\" }}
         materials.wood.density = 600.0
         default_law = {law}
         [[bodies]]
         material = \"wood\"
         {ground}
         [[bodies]]
         material = \"wood\"
         shape.box = {{ size = [0.2, 0.2, 0.2] }}
         position = [0.0, 0.0, {:?}]
         orientation = {}",
        0.5 + reach(feature),
        quaternion(down(feature)),
    ))
}

/// Each kind of feature on each on which it can lie in balance.
const PAIRS: [(&str, Option<&str>); 9] = [
    ("face", None),
    ("edge", None),
    ("corner", None),
    ("face", Some("face")),
    ("edge", Some("face")),
    ("corner", Some("face")),
    ("face", Some("edge")),
    ("face", Some("corner")),
    ("edge", Some("crossing edge")),
];

/// √(2h/g)·(1+e)/(1−e). An impact is seen up to a step late; there are some eleven until the speed is twice what a step of gravity makes.
#[test]
fn a_cube_that_falls_on_any_feature_comes_to_rest_when_the_closed_form_says() {
    for (feature, on) in PAIRS {
        for e in [0.0, 0.5] {
            let mut world = falling(feature, on, e);
            let (h, mass) = (world.settings.h, world.bodies.mass[1][0]);
            let (mut rest, mut kinetic) = (0.0, f64::NAN);
            run(&mut world, 12_000, |world, record| {
                if world.bodies.velocity[1][2].abs() > 2.0 * G * h {
                    rest = record.time;
                }
                kinetic = record.energy.kinetic;
            });
            let expected = (1.0 / G).sqrt() * (1.0 + e) / (1.0 - e);
            assert!((rest - expected).abs() < 25.0 * h, "{feature} on {on:?}, e = {e}: rest at {rest}, not {expected}");
            assert!(kinetic < 1e-12 * mass * G * 0.5, "{feature} on {on:?}, e = {e}: {kinetic} J at rest");
        }
    }
}

#[test]
fn a_cube_that_rebounds_fully_from_any_feature_keeps_its_energy_and_does_not_turn() {
    for (feature, on) in PAIRS {
        let mut world = falling(feature, on, 1.0);
        let mut first = None;
        let mut rebounds = 0;
        let mut before = 0.0;
        run(&mut world, 12_000, |world, record| {
            let energy = record.energy.kinetic + record.energy.potential;
            let start = *first.get_or_insert(energy);
            assert!((energy / start - 1.0).abs() < 1e-9, "{feature} on {on:?}: {energy} J of {start}");
            let v = world.bodies.velocity[1];
            rebounds += usize::from(before < -1.0 && v[2] > 1.0);
            before = v[2];
            let aside = v[..2].iter().chain(&v[3..]).fold(0.0_f64, |most, x| most.max(x.abs()));
            assert!(aside < 1e-7, "{feature} on {on:?}: it leaves the vertical by {aside}");
        });
        // Falls of 0.319 s, and twice that between rebounds.
        assert_eq!(rebounds, 2, "{feature} on {on:?}");
    }
}

/// The complete elliptic integral K(k²), by the arithmetic-geometric mean.
fn elliptic(k2: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k2).sqrt());
    while (a - b) > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}

/// Landau & Lifshitz, Mechanics, § 37: T = 4 K(k²) √(J₁ J₂ J₃ / ((J₃ − J₂)(L² − 2 E J₁))) where L² > 2 E J₂.
#[test]
fn a_free_body_flips_about_its_middle_axis_with_the_period_of_the_closed_form() {
    let mut world = world(
        "dimension = 3
         time = { step = 2e-4, steps = 1 }
         materials.wood.density = 600.0
         bodies = [{ shape.box.size = [0.3, 0.2, 0.1], material = \"wood\", position = [0.0, 0.0, 0.0], spin = [0.01, 10.0, 0.3],
                     velocity = [0.1, 0.2, 0.3] }]",
    );
    let [_, _, _, j1, j2, j3] = world.bodies.mass[0];
    let inertia = DVec3::new(j1, j2, j3);
    let spin = |world: &World<Solid, 3, 6>| DVec3::from_slice(&world.bodies.velocity[0][3..]);
    let momentum = |world: &World<Solid, 3, 6>| world.bodies.pose[0].rotation * (inertia * spin(world));
    let (start, energy) = (momentum(&world), 0.5 * spin(&world).dot(inertia * spin(&world)));
    let l2 = start.length_squared();
    assert!(j1 < j2 && j2 < j3 && l2 > 2.0 * energy * j2);
    let rate = ((j3 - j2) * (l2 - 2.0 * energy * j1) / (j1 * j2 * j3)).sqrt();
    let k2 = (j2 - j1) * (2.0 * energy * j3 - l2) / ((j3 - j2) * (l2 - 2.0 * energy * j1));
    let period = 4.0 * elliptic(k2) / rate;
    let (mut flips, mut before) = (Vec::new(), 1.0);
    run(&mut world, 100_000, |world, record| {
        let now = spin(world);
        if now.y * before < 0.0 {
            // Where it passed zero within the step, on a straight line.
            flips.push(record.time - world.settings.h * now.y / (now.y - before));
        }
        before = now.y;
        let (e, l) = (0.5 * now.dot(inertia * now), momentum(world));
        assert!((e / energy - 1.0).abs() < 1e-6 && (l - start).length() < 1e-6 * start.length());
    });
    assert!(flips.len() > 10, "{flips:?}");
    let found = 2.0 * (flips[flips.len() - 1] - flips[0]) / (flips.len() - 1) as f64;
    // The midpoint rule turns by (h ω)²/12 too little a step: 3e-7 of it.
    assert!((found / period - 1.0).abs() < 1e-5, "{found} s is not {period} s");
}

/// A polyhedron with a length of a thousand times its width falls flat, and a box bears one of a million times its mass.
#[test]
fn needles_and_very_unequal_masses_come_to_rest() {
    let mut needle = world(
        "dimension = 3
         gravity = [0.0, 0.0, -9.81]
         time = { step = 1e-4, steps = 1 }
         solver = { criterion = \"scaled\", tolerance = 1e-8, start = \"warm\", max_penetration = 1e-4 }
         materials.steel.density = 7800.0
         default_law.coulomb = { friction = 0.5, acts = \"approach\" }
         containers = [{ min = [-1.0, -1.0, 0.0], max = [1.0, 1.0, 1.0], open = [\"-x\", \"+x\", \"-y\", \"+y\", \"+z\"], material = \"steel\" }]
         bodies = [{ material = \"steel\", position = [0.0, 0.0, 0.02], orientation = { axis = [0, 1, 0], degrees = 1.0 },
            shape.polyhedron.points = [[-0.5, 0, 0], [0.5, 0, 0], [0, -5e-4, 0], [0, 5e-4, 0], [0, 0, 5e-4]] }]",
    );
    let mut kinetic = f64::NAN;
    run(&mut needle, 6000, |_, record| kinetic = record.energy.kinetic);
    let height = needle.bodies.pose[0].position[2];
    let scale = needle.bodies.mass[0][0] * G * 0.02;
    assert!(kinetic < 1e-9 * scale, "{kinetic} J of {scale}");
    assert!(height > 0.0 && height < 5e-4, "it lies at {height} m");

    let mut pile = world(
        "dimension = 3
         gravity = [0.0, 0.0, -9.81]
         time = { step = 1e-3, steps = 1 }
         solver = { criterion = \"scaled\", tolerance = 1e-9, start = \"warm\", global = \"auto\" }
         materials = { cork.density = 2e2, heavy.density = 2e8 }
         default_law.coulomb = { friction = 0.5 }
         [[bodies]]
         material = \"cork\"
         shape.half_space = { normal = [0.0, 0.0, 1.0] }
         position = [0.0, 0.0, 0.0]
         [[bodies]]
         material = \"cork\"
         shape.box = { size = [0.1, 0.1, 0.1] }
         position = [0.0, 0.0, 0.05]
         [[bodies]]
         material = \"heavy\"
         shape.box = { size = [0.1, 0.1, 0.1] }
         position = [0.01, 0.0, 0.15]",
    );
    run(&mut pile, 1000, |_, _| {});
    for (body, height) in [(1, 0.05), (2, 0.15)] {
        let [x, y, z] = pile.bodies.pose[body].position;
        assert!((z - height).abs() < 1e-8 && y.abs() < 1e-8 && (x - 0.01 * (body as f64 - 1.0)).abs() < 1e-8, "{x} {y} {z}");
    }
}

/// A ball that was put 2 mm into the floor, and a tower whose boxes overlap by 1 mm each, are lifted out; nothing is thrown up by it.
#[test]
fn overlaps_are_taken_out_of_positions_without_a_change_of_velocity() {
    let mut text = String::from(
        "dimension = 3
         gravity = [0.0, 0.0, -9.81]
         time = { step = 1e-3, steps = 1 }
         solver = { criterion = \"scaled\", tolerance = 1e-8, start = \"warm\", max_penetration = 1e-4 }
         start.max_overlap = 0.1
         materials.stone.density = 2e3
         default_law.coulomb = { friction = 0.5 }
         containers = [{ min = [-1.0, -1.0, 0.0], max = [1.0, 1.0, 1.0], open = [\"-x\", \"+x\", \"-y\", \"+y\", \"+z\"], material = \"stone\" }]
         [[bodies]]
         material = \"stone\"
         shape.ball.radius = 0.1
         position = [0.5, 0.0, 0.098]\n",
    );
    for i in 0..5 {
        let z = 0.05 + 0.099 * f64::from(i);
        text += &format!("[[bodies]]\nmaterial = \"stone\"\nshape.box.size = [0.1, 0.1, 0.1]\nposition = [0.0, 0.0, {z:?}]\n");
    }
    let mut world = world(&text);
    let mut last = None;
    run(&mut world, 300, |_, record| {
        assert!(record.energy.kinetic < 1e-9, "step {}: {} J", record.step, record.energy.kinetic);
        assert!(record.energy.balance_error.abs() < 1e-9);
        last = Some(record.penetration);
    });
    assert!(last.is_some_and(|deepest| deepest <= 1e-4 * 0.1), "{last:?}");
    assert!((world.bodies.pose[0].position[2] - 0.1).abs() < 1e-5);
    assert!((world.bodies.pose[5].position[2] - 0.45).abs() < 5e-5);
    // Raised bodies have more potential energy: that is work, and nothing else.
    let lift = world.bodies.mass[0][0] * G * 0.002;
    assert!(lift > 0.0);
}

/// Boxes that fall through each other's corners in long steps never overlap by more than is allowed at the end of one.
#[test]
fn no_step_ends_with_an_overlap_that_is_not_allowed() {
    let mut text = String::from(
        "dimension = 3
         gravity = [0.0, 0.0, -9.81]
         time = { step = 5e-3, steps = 1 }
         solver = { criterion = \"scaled\", tolerance = 1e-6, start = \"warm\", max_penetration = 1e-3 }
         materials.stone.density = 2e3
         default_law.coulomb = { friction = 0.5, acts = \"approach\" }
         containers = [{ min = [-0.2, -0.2, 0.0], max = [0.2, 0.2, 1.0], open = [\"+z\"], material = \"stone\" }]\n",
    );
    for i in 0..24 {
        let (x, y, z) = (0.2 * f64::from(i % 2) - 0.1, 0.2 * f64::from(i / 2 % 2) - 0.1, 0.15 + 0.2 * f64::from(i / 4));
        let degrees = 37.0 * f64::from(i);
        text += &format!(
            "[[bodies]]\nmaterial = \"stone\"\nshape.box.size = [0.05, 0.1, 0.15]\nposition = [{x:?}, {y:?}, {z:?}]\n\
             orientation = {{ axis = [1, 2, 3], degrees = {degrees:?} }}\n"
        );
    }
    let mut world = world(&text);
    let radius = world.bodies.shape[0].bounding_radius().unwrap();
    let (reach, mut found, mut deepest) = (vec![0.0; world.bodies.len()], Vec::new(), 0.0_f64);
    run(&mut world, 200, |world, record| {
        let bodies = &world.bodies;
        Detector::new().detect::<Solid, 6>(&bodies.shape, &bodies.pose, &reach, |i| !bodies.is_free(i), &mut found);
        let overlap = found.iter().map(|c| -c.gap).fold(0.0, f64::max) / radius;
        assert!(overlap <= 1e-3, "step {}: {overlap}", record.step);
        deepest = deepest.max(record.penetration / radius);
    });
    // There was something to correct.
    assert!(deepest > 3e-4, "{deepest}");
}
