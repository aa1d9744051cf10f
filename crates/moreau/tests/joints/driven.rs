//! Joints to driven bodies, joints that cannot close, and joints while positions are corrected.

use super::{close, error, head, plane, run, solid};
use moreau::step::{StepError, Workspace, step};
use moreau_solve::Status;

/// A driven ball whose velocity changes in each step swings a bar that a ball joint holds to it. The work that it does is booked with the mean of its
/// velocities at both ends of the step, so the ledger closes to the rounding of the energies at hand.
#[test]
fn the_ledger_closes_where_a_joint_holds_a_driven_body() {
    let text = format!(
        "{}[[bodies]]\nname = \"hand\"\nshape.ball = {{ radius = 0.1 }}\nmaterial = \"steel\"\nposition = [0.0, 0.0, 0.0]\n\
         drive = [{{ velocity = [{{ sine = {{ amplitude = 0.5, frequency = 3.0 }} }}, 0.0, 0.0] }}]\n\
         [[bodies]]\nname = \"bar\"\nshape.box = {{ size = [0.1, 0.1, 0.6] }}\nmaterial = \"steel\"\nposition = [0.0, 0.0, -0.4]\n\
         [[joints]]\nkind.ball = {{ anchor = [0.0, 0.0, -0.1] }}\nbetween = [\"hand\", \"bar\"]\n",
        head(3, 1e-3).replace("-9.81", "0.0")
    );
    let (mut world, mut work, mut most) = (solid(&text), Workspace::default(), 0.0_f64);
    for _ in 0..500 {
        let energy = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}")).energy;
        most = most.max(energy.kinetic);
        assert!(energy.balance_error.abs() < 1e-12 * most, "{energy:?}");
    }
    assert!(most > 0.1, "the bar moves: {most}");
}

/// A bar pinned to two fixed bodies by distances that no place satisfies once one of them is driven away.
fn torn(policy: &str) -> String {
    format!(
        "{}[[bodies]]\nname = \"left\"\nmotion = \"fixed\"\nshape.disk = {{ radius = 0.1 }}\nmaterial = \"steel\"\nposition = [0.0, 0.0]\n\
         [[bodies]]\nname = \"bar\"\nshape.box = {{ size = [0.8, 0.1] }}\nmaterial = \"steel\"\nposition = [0.5, 0.0]\n\
         [[bodies]]\nname = \"right\"\nmotion = \"driven\"\nshape.disk = {{ radius = 0.1 }}\nmaterial = \"steel\"\nposition = [1.0, 0.0]\n\
         velocity = [0.1, 0.0]\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.1, 0.0] }}\nbetween = [\"left\", \"bar\"]\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.9, 0.0] }}\nbetween = [\"bar\", \"right\"]\n",
        head(2, 1e-3).replace("\"stop\"", policy)
    )
}

/// A joint that stays open is a solve that failed, whatever the policy makes of that.
#[test]
fn a_joint_that_stays_open_is_a_failed_step() {
    let settings = |policy: &str| torn(policy).replace("on_failure", "max_sweeps = 200, on_failure");
    let record = step(&mut plane(&settings("\"warn\"")), &mut Workspace::default()).unwrap();
    assert!(!record.converged() && record.joint_error > 1e-5, "{record:?}");
    for policy in ["\"stop\"", "\"halve\""] {
        let mut world = plane(&settings(policy));
        let before = world.bodies.clone();
        let error = step(&mut world, &mut Workspace::default()).expect_err(policy);
        assert!(matches!(error, StepError::OpenJoint { .. } | StepError::Unconverged { .. }), "{error:?}");
        assert_eq!(world.bodies.pose, before.pose, "the step was not taken");
    }
    let mut work = Workspace::default();
    let record = step(&mut plane(&settings("\"dump\"")), &mut work).unwrap();
    assert_ne!(record.status, Status::Converged);
    assert!(work.take_failed().is_some());
}

/// A bar at rest on a hinge, pressed into a fixed block by 2 % of its size. It is turned out of it about its hinge, without energy.
#[test]
fn a_hinged_bar_is_moved_out_about_its_hinge() {
    let text = format!(
        "{}default_law.frictionless = {{}}\nstart.max_overlap = 1.0\n\
         [[bodies]]\nname = \"bar\"\nshape.box = {{ size = [1.0, 0.1] }}\nmaterial = \"steel\"\nposition = [0.5, 0.05]\n\
         [[bodies]]\nname = \"block\"\nmotion = \"fixed\"\nshape.box = {{ size = [0.4, 0.4] }}\nmaterial = \"steel\"\nposition = [0.9, -0.18]\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.0, 0.05] }}\nbetween = [\"bar\"]\n",
        head(2, 1e-3)
            .replace("[0.0, -9.81]", "[0.0, 0.0]")
            .replace("tolerance = 1e-12", "max_penetration = 1e-3, tolerance = 1e-10")
    );
    let mut world = plane(&text);
    let mut work = Workspace::default();
    for _ in 0..50 {
        let record = step(&mut world, &mut work).unwrap_or_else(|error| panic!("{error}"));
        assert!(record.energy.kinetic < 1e-14, "step {}: {:?}", record.step, record.energy);
        close(error(&world), 0.0, 1e-10, "the hinge");
    }
    let deepest = work.contacts().iter().map(|c| -c.contact.gap).fold(0.0, f64::max);
    assert!(deepest < 1e-3 * 0.5025, "still {deepest} m deep");
}

/// Energy swings by O(h²) and no more: a quarter of the step, a sixteenth of the swing.
#[test]
fn the_energy_of_a_chain_swings_by_the_square_of_the_step() {
    let bar = "shape.polygon = { vertices = [[-0.05, -0.01], [0.05, -0.01], [0.05, 0.01], [-0.05, 0.01]] }\nmaterial = \"steel\"";
    let swing = |h: f64| {
        let mut text = head(2, h);
        for i in 0..10 {
            let x = 0.1 * f64::from(i);
            let on = if i == 0 { String::new() } else { format!("\"b{}\", ", i - 1) };
            text += &format!("[[bodies]]\nname = \"b{i}\"\n{bar}\nposition = [{:?}, 0.0]\n", x + 0.05);
            text += &format!("[[joints]]\nkind.hinge = {{ anchor = [{x:?}, 0.0] }}\nbetween = [{on}\"b{i}\"]\n");
        }
        let (mut world, mut most) = (plane(&text), 0.0_f64);
        // Until it hangs, before it lashes: the motion is still the same at both steps.
        run(&mut world, (0.45 / h).round() as u64, |_, _, record| {
            most = most.max((record.energy.kinetic + record.energy.potential).abs());
        });
        most
    };
    let (coarse, fine) = (swing(1e-3), swing(2.5e-4));
    assert!(fine < coarse / 14.0 && fine > coarse / 18.0 && coarse < 3e-2, "{coarse} J and {fine} J");
}

/// A pendulum that is held at first and set free later is one that was free from the start, so many steps later.
#[test]
fn a_joint_may_wait_for_its_body_to_be_freed() {
    let bar = |motion: &str| {
        format!(
            "{}[[bodies]]\nname = \"bar\"\n{motion}shape.box = {{ size = [0.5, 0.05, 0.05] }}\nmaterial = \"steel\"\n\
             position = [0.25, 0.0, 0.0]\n[[joints]]\nkind.hinge = {{ anchor = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0] }}\nbetween = [\"bar\"]\n",
            head(3, 1e-3)
        )
    };
    let held = "motion = \"fixed\"\ndrive = [{ from = 0.1, motion = \"free\" }]\n";
    let (mut held, mut free) = (solid(&bar(held)), solid(&bar("")));
    let (mut work, mut other) = (Workspace::default(), Workspace::default());
    let start = held.bodies.pose[0];
    for _ in 0..100 {
        let record = step(&mut held, &mut work).unwrap();
        assert!(record.converged() && record.joint_error == 0.0, "{record:?}");
    }
    assert_eq!(held.bodies.pose[0], start);
    for k in 0..400 {
        step(&mut held, &mut work).unwrap();
        step(&mut free, &mut other).unwrap();
        let apart = (0..3).map(|i| (held.bodies.pose[0].position[i] - free.bodies.pose[0].position[i]).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-12, "{apart} after {k} steps");
    }
    assert!(free.bodies.pose[0].position[2] < -0.2, "it swings: {:?}", free.bodies.pose[0]);
}
