//! Limits that steps must keep to: each is noticed in the step that breaks it, and each policy does what it says.

use moreau::scene::{AnyWorld, Scene};
use moreau::space::{Plane, Solid};
use moreau::step::{Breach, StepError, StepRecord, Workspace, step};
use moreau::world::World;

/// Two balls of radius 5 cm, 30 cm apart, of which the first flies at 1 m/s at the other.
const TWO: &str = r#"
dimension = 3
time = { step = 1e-2, steps = 100 }
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
        let created = dissipated - record.energy.dissipated;
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
