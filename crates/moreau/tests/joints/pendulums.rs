//! Bodies that swing: periods, cones, and energy.

use super::{close, head, plane, run, solid};
use moreau::space::{Solid, Space};
use std::f64::consts::PI;

const G: f64 = 9.81;

/// A bar of 1 m × 0.1 m in the plane on a pin at its end, hung at the angle `degrees` from below.
fn bar(h: f64, degrees: f64) -> String {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    format!(
        "{}[[bodies]]\nname = \"bar\"\nshape.polygon = {{ vertices = [[-0.05, -0.5], [0.05, -0.5], [0.05, 0.5], [-0.05, 0.5]] }}\n\
         material = \"steel\"\nposition = [{:?}, {:?}]\norientation = {{ degrees = {degrees:?} }}\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.0, 0.0] }}\nbetween = [\"bar\"]\n",
        head(2, h),
        0.5 * sine,
        -0.5 * cosine,
    )
}

/// The complete elliptic integral of the first kind by the arithmetic-geometric mean: K(k) = π/2 / agm(1, √(1 − k²)).
fn elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..20 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * PI / a
}

/// The period of a compound pendulum, 4 √(J/(m g l)) K(sin(α/2)), from small to nearly upside down. The scheme is of second order: h = 1 ms
/// of a period of about 2 s leaves some 1e-6 of it.
#[test]
fn a_compound_pendulum_swings_with_the_period_of_the_elliptic_integral() {
    let (mass, l) = (100.0, 0.5);
    let inertia = mass * (1.0 + 0.01) / 12.0 + mass * l * l;
    for degrees in [5.0_f64, 90.0, 170.0] {
        let exact = 4.0 * (inertia / (mass * G * l)).sqrt() * elliptic((0.5 * degrees.to_radians()).sin());
        let mut world = plane(&bar(1e-3, degrees));
        // The spin changes its sign where the bar turns back, half a period after the start and a whole one after that.
        let (mut before, mut turns) = (0.0, Vec::new());
        run(&mut world, (1.2 * exact / 1e-3) as u64, |world, _, record| {
            let spin = world.bodies.velocity[0][2];
            if before * spin < 0.0 {
                turns.push(record.time - 1e-3 * spin / (spin - before));
            }
            before = spin;
        });
        close(turns[0], 0.5 * exact, 1e-5 * exact, "half a period");
        close(turns[1], exact, 1e-5 * exact, "the period");
    }
}

/// Two bars on each other, let go from the horizontal: the motion is chaotic, its energy is kept. It swings about its value by what a scheme
/// of second order leaves, and does not drift: the second half of the run is no worse than the first.
#[test]
fn a_double_pendulum_keeps_its_energy() {
    let shape =
        "shape.polygon = { vertices = [[-0.25, -0.02], [0.25, -0.02], [0.25, 0.02], [-0.25, 0.02]] }\nmaterial = \"steel\"";
    let text = format!(
        "{}[[bodies]]\nname = \"a\"\n{shape}\nposition = [0.25, 0.0]\n[[bodies]]\nname = \"b\"\n{shape}\nposition = [0.75, 0.0]\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.0, 0.0] }}\nbetween = [\"a\"]\n\
         [[joints]]\nkind.hinge = {{ anchor = [0.5, 0.0] }}\nbetween = [\"a\", \"b\"]\n",
        head(2, 2e-4)
    );
    let mut world = plane(&text);
    let (mut halves, mut kinetic) = ([0.0_f64; 2], 0.0_f64);
    run(&mut world, 50_000, |_, _, record| {
        let energy = &record.energy;
        let half = &mut halves[usize::from(record.step > 25_000)];
        *half = half.max((energy.kinetic + energy.potential).abs());
        kinetic = kinetic.max(energy.kinetic);
    });
    assert!(halves[0] < 1e-4 * kinetic && halves[1] < 1.5 * halves[0], "{halves:?} of {kinetic}");
}

/// A rod of 1 m on a ball joint that goes round a cone: by the balance of moments about the pivot, with the inertia A across and C along the rod,
/// (A − C) ω² cos α = m g l. The square of ω is found from the time of ten rounds.
#[test]
fn a_rod_goes_round_a_cone() {
    let (alpha, h) = (30.0_f64.to_radians(), 5e-4);
    let (mass, l) = (1000.0 * 0.1 * 0.1, 0.5);
    let (across, along) = (mass * (1.0 + 0.01) / 12.0 + mass * l * l, mass * 0.02 / 12.0);
    let omega = (mass * G * l / ((across - along) * alpha.cos())).sqrt();
    let text = format!(
        "{}[[bodies]]\nname = \"rod\"\nshape.box = {{ size = [0.1, 0.1, 1.0] }}\nmaterial = \"steel\"\n\
         position = [{:?}, 0.0, {:?}]\norientation = {{ axis = [0.0, 1.0, 0.0], degrees = -30.0 }}\n\
         velocity = [0.0, {:?}, 0.0]\nspin = [0.0, 0.0, {omega:?}]\n\
         [[joints]]\nkind.ball = {{ anchor = [0.0, 0.0, 0.0] }}\nbetween = [\"rod\"]\n",
        head(3, h),
        l * alpha.sin(),
        -l * alpha.cos(),
        omega * l * alpha.sin(),
    );
    let mut world = solid(&text);
    let (mut before, mut rounds) = (0.0, Vec::new());
    run(&mut world, (10.5 * 2.0 * PI / omega / h) as u64, |world, work, record| {
        let [x, y, z] = world.bodies.pose[0].position;
        close((x * x + y * y).sqrt(), l * alpha.sin(), 1e-4, "the radius");
        close(z, -l * alpha.cos(), 1e-4, "the height");
        // It goes up through y = 0 on the side of x > 0 once a round.
        if before < 0.0 && y >= 0.0 {
            rounds.push(record.time - h * y / (y - before));
        }
        before = y;
        // The first prediction is off the sphere by (h ω)²/8, which the first step closes at once.
        if record.step < 3 {
            return;
        }
        // The pivot carries the weight and m ω² r towards the axis, as an impulse.
        let reaction = &work.reactions()[0];
        close(reaction.impulse[2] / h, mass * G, 1e-3 * mass * G, "the weight");
        let inwards = -(reaction.impulse[0] * x + reaction.impulse[1] * y) / (x * x + y * y).sqrt() / h;
        close(inwards, mass * omega * omega * l * alpha.sin(), 2e-3 * mass * G, "the centripetal force");
    });
    close(rounds[9] - rounds[0], 9.0 * 2.0 * PI / omega, 1e-5 * 9.0 * 2.0 * PI / omega, "nine rounds");
}

/// A ball on a massless rod, held by its centre, is a spherical pendulum: energy and the momentum about the vertical are kept, and the
/// height at which it turns follows from them: (g/l) [..] is a cubic in z whose other root is known.
#[test]
fn a_ball_on_a_distance_joint_is_a_spherical_pendulum() {
    let (l, v) = (1.0_f64, 2.0_f64);
    let z0 = -0.6 * l;
    let text = format!(
        "{}[[bodies]]\nname = \"ball\"\nshape.ball = {{ radius = 0.05 }}\nmaterial = \"steel\"\n\
         position = [0.8, 0.0, -0.6]\nvelocity = [0.0, {v:?}, 0.0]\n\
         [[joints]]\nkind.distance = {{ from = [0.0, 0.0, 0.0], to = [0.8, 0.0, -0.6] }}\nbetween = [\"ball\"]\n",
        head(3, 5e-4)
    );
    // v² = v0² − 2 g (z − z0) and r v_φ = r0 v0: where ż = 0, (l² − z²)(v0² − 2 g (z − z0)) = (l² − z0²) v0². Divided by (z − z0):
    // 2 g (z² − l²) − v0² (z + z0) = 0.
    let turn = (v * v - (v.powi(4) + 8.0 * G * (2.0 * G * l * l + v * v * z0)).sqrt()) / (4.0 * G);
    let mut world = solid(&text);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let momentum = |p: &[f64; 3], v: &[f64; 6]| p[0] * v[1] - p[1] * v[0];
    run(&mut world, 20_000, |world, _, _| {
        let (position, velocity) = (&world.bodies.pose[0].position, &world.bodies.velocity[0]);
        (low, high) = (low.min(position[2]), high.max(position[2]));
        close(momentum(position, velocity), 0.8 * v, 1e-9, "the momentum about the vertical");
        let spin = Solid::spin_in_world(world.bodies.pose[0].rotation, velocity);
        assert!(spin.iter().all(|x| x.abs() < 1e-9), "a rod to the centre does not turn the ball: {spin:?}");
    });
    let (least, most) = (turn.min(z0), turn.max(z0));
    close(low, least, 1e-5, "the lowest point");
    close(high, most, 1e-5, "the highest point");
}
