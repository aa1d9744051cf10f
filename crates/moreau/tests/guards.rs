//! Limits that steps must keep to: each is noticed in the step that breaks it, and each policy does what it says.

use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid};
use moreau::step::{Breach, StepError, StepRecord, Workspace, step};
use moreau::world::World;

/// Two balls of radius 5 cm, 30 cm apart, of which the first flies at 1 m/s at the other.
const TWO: &str = r#"
dimension = 3
time = { step = 1e-2, steps = 100 }
solver.max_penetration = "never"
default_law.frictionless.acts = "closed"
materials.steel.density = 7800.0
bodies = [
  { shape.ball.radius = 0.05, material = "steel", position = [0.0, 0.0, 0.0], velocity = [1.0, 0.0, 0.0] },
  { shape.ball.radius = 0.05, material = "steel", position = [0.3033, 0.0, 0.0] },
]
"#;

fn two(guard: &str) -> World<Solid, 3, 6> {
    let text = format!("{TWO}\n[guard]\n{guard}\n");
    match Scene::parse(&text, "two.toml").unwrap_or_else(|error| panic!("{error}")).build(u64::MAX).unwrap() {
        AnyWorld::Solid(world) => world,
        AnyWorld::Plane(_) => panic!("the scene is in space"),
    }
}

/// Takes steps until one breaks a limit or fails.
fn until_breach(world: &mut World<Solid, 3, 6>) -> (Option<StepRecord>, Option<StepError>) {
    let mut work = Workspace::default();
    for _ in 0..100 {
        match step(world, &mut work) {
            Ok(record) if record.breach.is_some() => return (Some(record), None),
            Ok(_) => {}
            Err(error) => return (None, Some(error)),
        }
    }
    (None, None)
}

const DOMAIN: &str = "min = [-1.0, -1.0, -1.0]\nmax = [0.155, 1.0, 1.0]";

#[test]
fn a_body_that_leaves_the_domain_is_noticed_in_the_step_in_which_it_does() {
    // Who starts outside counts, too: the second one is not free of it.
    let wide = DOMAIN.replace("0.155", "0.405");
    let mut world = two(&wide);
    let (record, _) = until_breach(&mut world);
    let record = record.expect("the ball that was hit flies on");
    let Some(Breach::Domain { body: 1, position }) = record.breach else { panic!("{record:?}") };
    let before = world.bodies.pose[1].position[0] - world.settings.h * world.bodies.velocity[1][0];
    assert!(position[0] > 0.405 && before <= 0.405 && position[0] == world.bodies.pose[1].position[0]);
    let (_, error) = until_breach(&mut two(&format!("{DOMAIN}\npolicy = \"stop\"")));
    let error = error.expect("the second ball begins outside");
    assert!(matches!(&error, StepError::Breach { time, breach: Breach::Domain { body: 1, .. } } if *time == 0.01), "{error:?}");
    assert_eq!(error.bodies(), [1]);
    assert!(error.to_string().contains("in the step to t = 0.01 s body 1 left the domain"), "{error}");
    // Halving does not help; the world is then as it was before the step.
    let mut world = two(&format!("{wide}\npolicy = \"halve\""));
    let (_, error) = until_breach(&mut world);
    assert!(matches!(error, Some(StepError::Breach { .. })), "{error:?}");
    assert!(world.bodies.pose[1].position[0] <= 0.405);
    assert!((world.time - world.steps as f64 * 0.01).abs() < 1e-12);
}

#[test]
fn an_overlap_that_is_too_deep_names_its_bodies_and_smaller_steps_help() {
    // At the prediction half a step ahead the two overlap by up to 5 mm; 1 mm is allowed.
    let limit = "penetration = 0.02";
    let (record, _) = until_breach(&mut two(limit));
    let record = record.expect("an overlap");
    let Some(Breach::Penetration { bodies: [0, 1], depth, allowed }) = record.breach else { panic!("{record:?}") };
    assert!(depth == record.penetration && depth > allowed && (allowed - 0.001).abs() < 1e-15);
    let mut world = two(&format!("{limit}\npolicy = \"stop\""));
    let mut work = Workspace::default();
    let error = (0..100).find_map(|_| step(&mut world, &mut work).err()).expect("an overlap");
    assert_eq!(error.bodies(), [0, 1]);
    let dumped = work.take_failed().expect("its problem").problem.expect("one that files have a place for");
    assert_eq!(dumped.mu.len(), 1, "one contact");
    // With halves all goes well, and no overlap is deeper than is allowed.
    let (mut world, mut work) = (two(&format!("{limit}\npolicy = \"halve\"")), Workspace::default());
    let records: Vec<_> = (0..40).map(|_| step(&mut world, &mut work).expect("halves help")).collect();
    assert!(records.iter().any(|record| record.h < 0.01), "some step was halved");
    assert!(records.iter().all(|record| record.penetration <= 0.001 && record.breach.is_none()));
    assert!(world.bodies.velocity[1][0] > 0.4, "they met");
    assert!(records.iter().all(|record| record.energy.balance_error.abs() < 1e-12));
}

/// A heap of disks whose solver is stopped after one sweep: its impulses are wrong, and may lift what they should carry.
fn careless(guard: &str) -> World<Plane, 2, 3> {
    let text = format!(
        r#"
dimension = 2
gravity = [0.0, -9.81]
time = {{ step = 1e-2, steps = 100 }}
solver = {{ global = "nlgs", max_sweeps = 1, start = "warm" }}
materials.steel.density = 7800.0
containers = [{{ min = [0.0, 0.0], max = [0.4, 2.0], open = ["+y"], material = "steel" }}]
generate = [{{ material = "steel", count = 24, radii.constant = 0.049, lattice = {{ min = [0.0, 0.0], max = [0.4, 1.0], spacing = 0.1 }} }}]
[guard]
{guard}
"#
    );
    match Scene::parse(&text, "heap.toml").unwrap_or_else(|error| panic!("{error}")).build(u64::MAX).unwrap() {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("the scene is plane"),
    }
}

#[test]
fn energy_that_is_created_is_noticed_in_its_step() {
    let (mut world, mut work) = (careless("energy = 1e-6"), Workspace::default());
    let (mut noticed, mut dissipated) = (0, 0.0);
    for _ in 0..100 {
        let record = step(&mut world, &mut work).unwrap();
        let created = record.created.total();
        // One island may create what another one dissipates: never less than the whole step does.
        let whole = dissipated - record.energy.dissipated;
        assert!(created >= whole - 1e-12 * record.energy.dissipated.abs().max(1.0), "{created} J, {whole} J in all");
        dissipated = record.energy.dissipated;
        match &record.breach {
            Some(Breach::Energy { created: said, allowed }) => {
                assert!(*said == created && created > 1e-6 && *allowed == 1e-6);
                noticed += 1;
            }
            None => assert!(created <= 1e-6, "{created}"),
            other => panic!("{other:?}"),
        }
    }
    assert!(noticed > 0, "the heap was to be careless");
    let (mut world, mut work) = (careless("energy = 1e-6\npolicy = \"stop\""), Workspace::default());
    let error = (0..100).find_map(|_| step(&mut world, &mut work).err()).expect("energy is created");
    assert!(error.to_string().contains("J were created"), "{error}");
}

/// A square with a corner below and before its centre meets the floor with full normal restitution and sticks: Kane's paradox, theory (45).
/// At the prediction it overlaps the floor by 1e-10 m. Mass 2 kg, inertia 1/3 kg m², the corner at (√2/4, −√6/4) from the centre.
const KANE: &str = r#"
dimension = 2
time = { step = 1e-3, steps = 10 }
solver = { tolerance = 1e-13, max_penetration = "never" }
materials.steel.density = 2.0
default_law.coulomb = { friction = 2.0, restitution = 1.0, tangential_restitution = 0.0 }
bodies = [
  { material = "steel", position = [0.0, 0.0], shape.half_plane.normal = [0.0, 1.0] },
  { material = "steel", position = [0.0, 0.6128724355957945], orientation = -0.2617993877991494, velocity = [-0.4, -1.0], shape.box.size = [1.0, 1.0] },
  # A disk far away slides where it lands, and loses more than the square gains.
  { material = "steel", position = [9.0, 0.5002], velocity = [5.0, -1.0], shape.disk.radius = 0.5 },
]
"#;

fn plane(text: &str) -> World<Plane, 2, 3> {
    match Scene::parse(text, "scene.toml").unwrap_or_else(|error| panic!("{error}")).build(u64::MAX).unwrap() {
        AnyWorld::Plane(world) => world,
        AnyWorld::Solid(_) => panic!("the scene is plane"),
    }
}

#[test]
fn energy_that_a_law_creates_is_reported_by_part_and_is_not_hidden_by_what_others_lose() {
    let (mut world, mut work) = (plane(KANE), Workspace::default());
    let record = step(&mut world, &mut work).unwrap();
    assert_eq!(record.active, 2);
    // W_nn = 7/8, W_nt = 3√3/8, W_tt = 13/8, det W = 1; u⁻ = (−1, −0.4) and u⁺ = (1, 0).
    let tangential = 7.0 / 8.0 * 0.4 - 2.0 * 3.0 * 3.0_f64.sqrt() / 8.0;
    let expected = 0.5 * tangential * -0.4;
    let created = record.created;
    assert!(expected > 0.12 && (created.contacts - expected).abs() < 1e-8, "{created:?}, {expected}");
    assert!([created.joints, created.correction].iter().all(|&x| x == 0.0) && created.scheme < 1e-15, "{created:?}");
    assert!(record.energy.impact.abs() < 1e-9, "a full rebound loses nothing");
    assert!(record.energy.dissipated > 1.0 && record.energy.balance_error.abs() < 1e-13, "the step as a whole loses energy");
    // The limit of energy counts the same number.
    let mut world = plane(&format!("{KANE}\n[guard]\nenergy = 0.1\npolicy = \"stop\""));
    let error = step(&mut world, &mut Workspace::default()).expect_err("0.19 J are created");
    assert!(matches!(error, StepError::Breach { breach: Breach::Energy { created: said, .. }, .. } if said == created.total()));
    // Restitution of the tangent as of the normal: nothing is created, (44).
    let mut world = plane(&KANE.replace("tangential_restitution = 0.0", "tangential_restitution = 1.0"));
    let record = step(&mut world, &mut Workspace::default()).unwrap();
    assert!(record.active == 2 && record.created.total() < 1e-11, "{:?}", record.created);
}

#[test]
fn weights_that_a_correction_lifts_are_energy_created() {
    let deep = r#"
dimension = 2
gravity = [0.0, -10.0]
time = { step = 1e-3, steps = 10 }
solver = { criterion = "scaled", tolerance = 1e-10, max_penetration = 1e-3 }
start.max_overlap = 1.0
materials.steel.density = 2.0
default_law.frictionless = {}
bodies = [
  { material = "steel", position = [0.0, 0.0], shape.half_plane.normal = [0.0, 1.0] },
  { material = "steel", position = [0.0, 0.49], shape.disk.radius = 0.5 },
]
"#;
    let (mut world, mut work) = (plane(deep), Workspace::default());
    let record = step(&mut world, &mut work).unwrap();
    let lifted = world.bodies.mass[1][0] * 10.0 * (world.bodies.pose[1].position[1] - 0.49);
    assert!(lifted > 0.1 && (record.created.correction - lifted).abs() < 1e-12 * lifted, "{:?}, {lifted}", record.created);
    assert!(record.created.correction == record.created.total() && record.energy.balance_error.abs() < 1e-14);
    // The correction takes out what the scene brings before the first contacts, and leaves half of what is allowed.
    assert!((record.overlap - 5e-4).abs() < 1e-12 && (record.penetration - 2.5e-4).abs() < 1e-12, "{record:?}");
    let mut world = plane(&format!("{deep}\n[guard]\nenergy = 0.1"));
    let record = step(&mut world, &mut Workspace::default()).unwrap();
    assert!(matches!(record.breach, Some(Breach::Energy { .. })), "{:?}", record.breach);
}

#[test]
fn numbers_that_overflow_end_the_step_and_are_named() {
    let balls = |gravity: &str, velocity: &str| {
        let text = format!(
            "dimension = 3\ngravity = {gravity}\ntime = {{ step = 1e-3, steps = 5 }}\nmaterials.g.density = 1000.0\n\
             default_law.frictionless.acts = \"closed\"\n[[bodies]]\nshape.ball.radius = 0.1\nmaterial = \"g\"\nposition = [0.0, 0.0, 0.0]\n\
             [[bodies]]\nshape.ball.radius = 0.1\nmaterial = \"g\"\nposition = [0.201, 0.0, 0.0]\nvelocity = {velocity}\n"
        );
        let Ok(AnyWorld::Solid(mut world)) = Scene::parse(&text, "balls.toml").unwrap().build(u64::MAX) else { panic!("{text}") };
        let mut work = Workspace::default();
        (0..5).find_map(|_| step(&mut world, &mut work).err()).map(|error| (error.to_string(), error))
    };
    let rest = "[0.0, 0.0, 0.0]";
    assert_eq!(balls(rest, rest), None);
    assert_eq!(balls(rest, "[0.0, 1e140, 0.0]"), None, "large numbers are no error");
    // 4/3 π 0.1³ 1000 kg · ½ (1e160 m/s)² is beyond 1.8e308.
    let (words, error) = balls(rest, "[0.0, 1e160, 0.0]").expect("a square overflows");
    assert!(matches!(error, StepError::Overflow { what: "kinetic energy", body: Some(1), time: 1e-3 }), "{error:?}");
    assert!(words.contains("the kinetic energy of body 1 is not a finite number in the step to t = 0.001 s"), "{words}");
    assert_eq!(error.bodies(), [1]);
    let (words, _) = balls("[1e308, 0.0, 0.0]", rest).expect("weights overflow");
    assert!(words.contains("not a finite number") || words.contains("finite numbers"), "{words}");
    // Whatever overflows first, no step with such numbers is reported as done.
    for exponent in [150, 154, 155, 200, 250, 300, 308] {
        for direction in [format!("[-1e{exponent}, 0.0, 0.0]"), format!("[0.0, 0.0, 1e{exponent}]")] {
            if exponent >= 155 {
                assert!(balls(rest, &direction).is_some(), "{direction}");
            }
        }
    }
}
