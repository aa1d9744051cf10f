//! What joints hold stays closed.

use super::{close, error, head, plane, run, solid};

/// A hundred thousand steps of a bar that goes round and round on a pin: at the predictions the joint is closed to a part in 1e10 of its size
/// throughout, and between them it is open by the sagitta (h ω)²/8 of the arc and no more, at the end as at the beginning.
#[test]
fn a_hinge_does_not_open_in_a_hundred_thousand_steps() {
    let h = 1e-4;
    let text = format!(
        "{}[[bodies]]\nname = \"bar\"\nshape.polygon = {{ vertices = [[-0.5, -0.05], [0.5, -0.05], [0.5, 0.05], [-0.5, 0.05]] }}\n\
         material = \"steel\"\nposition = [0.5, 0.0]\n[[joints]]\nkind.hinge = {{ anchor = [0.0, 0.0] }}\nbetween = [\"bar\"]\n",
        head(2, h)
    );
    let mut world = plane(&text);
    let mut at_predictions = 0.0_f64;
    run(&mut world, 100_000, |world, _, record| {
        at_predictions = at_predictions.max(record.joint_error);
        let sagitta = 0.5 * (h * world.bodies.velocity[0][2]).powi(2) / 8.0;
        close(error(world), sagitta, 1e-10, "between the predictions");
    });
    assert!(at_predictions < 1e-10, "{at_predictions}");
}

/// The same in space, of a hinge that is oblique to the body's axes and of all its rows, at a spin at which nothing is small.
#[test]
fn a_hinge_in_space_does_not_open() {
    let text = format!(
        "{}[[bodies]]\nname = \"box\"\nshape.box = {{ size = [0.3, 0.5, 0.7] }}\nmaterial = \"steel\"\nposition = [0.5, 0.1, 0.2]\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.0, 0.0, 0.0], axis = [1.0, 2.0, 0.5] }}\nbetween = [\"box\"]\n",
        head(3, 5e-4)
    );
    let mut world = solid(&text);
    let (mut halves, mut energies) = ([0.0_f64; 2], [0.0_f64; 2]);
    run(&mut world, 20_000, |world, _, record| {
        assert!(record.joint_error < 1e-10, "step {}: {}", record.step, record.joint_error);
        let half = usize::from(record.step > 10_000);
        halves[half] = halves[half].max(error(world));
        let start = 105.0 * 9.81 * 0.2;
        energies[half] = energies[half].max((record.energy.kinetic + record.energy.potential - start).abs());
    });
    assert!(halves[0] < 1e-5 && halves[1] < 1.1 * halves[0], "{halves:?}");
    assert!(energies[1] < 1.5 * energies[0] && energies[0] < 1e-3 * 105.0 * 9.81, "energy moves by {energies:?}");
}

/// Two bars overlap where a hinge joins them, which keeps them from touching. Where another body lands and is too deep, and positions are put right, the
/// bars stay as they are.
#[test]
fn what_a_joint_keeps_from_touching_is_not_pushed_apart() {
    let body = |name: &str, at: [f64; 2], drive: &str| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nshape.box = {{ size = [0.4, 0.1] }}\nmaterial = \"steel\"\nposition = {at:?}\n{drive}\n"
        )
    };
    let text = format!(
        "{}default_law.frictionless = {{}}\n{}{}{}{}[[joints]]\nkind.hinge = {{ anchor = [0.15, 0.0] }}\nbetween = [\"left\", \"right\"]\n",
        head(2, 1e-3).replace("tolerance = 1e-12,", "tolerance = 1e-12, max_penetration = 1e-3,"),
        body("left", [0.0, 0.0], ""),
        body("right", [0.3, 0.0], ""),
        body("shelf", [5.0, 0.0], "motion = \"fixed\""),
        body("deep", [5.0, 0.1005], "velocity = [0.0, -5.0]")
    );
    let mut world = plane(&text);
    run(&mut world, 10, |world, _, _| close(error(world), 0.0, 1e-12, "the hinge"));
    close(world.bodies.pose[1].position[0] - world.bodies.pose[0].position[0], 0.3, 1e-12, "the bars");
    let raised = world.bodies.pose[3].position[1];
    assert!(raised > 0.0997, "the deep one was put right: {raised}");
}
