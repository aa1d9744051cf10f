//! Sliders, bodies that move as one, and mechanisms.

use super::{close, head, plane, run, solid};
use moreau::space::{Plane, Solid, Space};
use moreau::step::{Workspace, step};

const G: f64 = 9.81;

/// A block on a rail at the angle α, with its centre off the rail or not: s = ½ g sin α t², and it does not turn.
#[test]
fn a_slider_on_an_incline_falls_at_g_sin_alpha() {
    let alpha = 25.0_f64.to_radians();
    let (sine, cosine) = alpha.sin_cos();
    let rail = |d: usize| if d == 2 { format!("[{cosine:?}, {:?}]", -sine) } else { format!("[{cosine:?}, 0.0, {:?}]", -sine) };
    let block = |d: usize, shape: &str| {
        format!(
            "{}[[bodies]]\nname = \"block\"\nmaterial = \"steel\"\n{shape}\n\
             [[joints]]\nkind.slider = {{ axis = {} }}\nbetween = [\"block\"]\n",
            head(d, 1e-3),
            rail(d)
        )
    };
    let polygon = "shape.polygon = { vertices = [[-0.1, -0.1], [0.2, -0.1], [0.1, 0.1]] }\nposition = [0.0, 0.0]";
    let mut world = plane(&block(2, polygon));
    let start = world.bodies.pose[0];
    run(&mut world, 1000, |_, _, _| {});
    let (end, s) = (world.bodies.pose[0], 0.5 * G * sine);
    close(end.position[0] - start.position[0], s * cosine, 1e-9, "along the rail");
    close(end.position[1] - start.position[1], -s * sine, 1e-9, "down the rail");
    close(end.rotation[1], 0.0, 1e-12, "it does not turn");
    let mut world = solid(&block(3, "shape.box = { size = [0.1, 0.2, 0.3] }\nposition = [0.0, 1.0, 2.0]"));
    run(&mut world, 1000, |_, _, _| {});
    let [x, y, z] = world.bodies.pose[0].position;
    close(x, s * cosine, 1e-9, "along the rail");
    close(y, 1.0, 1e-12, "beside the rail");
    close(z, 2.0 - s * sine, 1e-9, "down the rail");
    close(Solid::quaternion(world.bodies.pose[0].rotation)[3], 1.0, 1e-12, "it does not turn");
}

/// Two boxes that a fixed joint holds together, thrown with a spin, move as the one box that they make: in the plane of motion the centre flies on
/// a parabola and the spin stays. Compared with that box itself, step by step, in a tumble that is not about a principal axis.
#[test]
fn two_boxes_held_together_move_as_one() {
    let motion = "velocity = [1.0, 2.0, 3.0]\nspin = [0.5, 3.0, 1.0]";
    let one = format!(
        "{}[[bodies]]\nname = \"whole\"\nshape.box = {{ size = [0.4, 0.2, 0.3] }}\nmaterial = \"steel\"\nposition = [0.0, 0.0, 0.0]\n{motion}\n",
        head(3, 2.5e-4)
    );
    // v of each half: v + ω × (±0.1, 0, 0) = v ± (0, 0.1 ω_z, −0.1 ω_y).
    let half = |sign: f64, name: &str| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nshape.box = {{ size = [0.2, 0.2, 0.3] }}\nmaterial = \"steel\"\nposition = [{:?}, 0.0, 0.0]\n\
             velocity = [1.0, {:?}, {:?}]\nspin = [0.5, 3.0, 1.0]\n",
            0.1 * sign,
            2.0 + 0.1 * sign,
            3.0 - 0.3 * sign
        )
    };
    let two = format!(
        "{}{}{}[[joints]]\nkind.fixed = {{}}\nbetween = [\"left\", \"right\"]\n",
        head(3, 2.5e-4),
        half(-1.0, "left"),
        half(1.0, "right")
    );
    let (mut whole, mut halves) = (solid(&one), solid(&two));
    run(&mut whole, 4000, |_, _, _| {});
    run(&mut halves, 4000, |_, _, _| {});
    let [left, right] = [0, 1].map(|i| halves.bodies.pose[i].position);
    for k in 0..3 {
        close(0.5 * (left[k] + right[k]), whole.bodies.pose[0].position[k], 1e-9, "the centre");
    }
    // Both schemes are of second order, with constants of their own: 3.2 rad/s at 0.25 ms leave some 1e-7 a second.
    let axis = Solid::rotate(whole.bodies.pose[0].rotation, [0.2, 0.0, 0.0]);
    for k in 0..3 {
        close(right[k] - left[k], axis[k], 2e-6, "the axis through both");
    }
    let (a, b) = (Solid::quaternion(halves.bodies.pose[0].rotation), Solid::quaternion(halves.bodies.pose[1].rotation));
    for k in 0..4 {
        close(a[k], b[k], 1e-6, "they are turned alike");
    }
}

/// What joints do between free bodies changes neither momentum nor angular momentum, whatever their kind.
#[test]
fn joints_keep_momentum() {
    let kinds = [
        "fixed = {}",
        "hinge = { anchor = [0.15, 0.05, 0.0], axis = [1.0, 2.0, 3.0] }",
        "slider = { axis = [1.0, -1.0, 0.5] }",
        "ball = { anchor = [0.2, 0.3, -0.1] }",
        "distance = { from = [0.0, 0.1, 0.0], to = [0.4, 0.0, 0.1] }",
    ];
    for kind in kinds {
        let text = format!(
            "{}[[bodies]]\nname = \"a\"\nshape.box = {{ size = [0.2, 0.1, 0.3] }}\nmaterial = \"steel\"\nposition = [0.0, 0.0, 0.0]\n\
             velocity = [1.0, 0.5, 0.0]\nspin = [1.0, -2.0, 0.5]\n\
             [[bodies]]\nname = \"b\"\nshape.box = {{ size = [0.1, 0.2, 0.2] }}\nmaterial = \"steel\"\nposition = [0.4, 0.1, 0.0]\n\
             velocity = [-1.0, 0.0, 0.5]\nspin = [0.0, 3.0, -1.0]\n\
             [[joints]]\nkind = {{ {kind} }}\nbetween = [\"a\", \"b\"]\n",
            head(3, 1e-3).replace("[0.0, 0.0, -9.81]", "[0.0, 0.0, 0.0]")
        );
        let mut world = solid(&text);
        let before = momenta(&world.bodies);
        run(&mut world, 500, |_, _, record| assert!(record.joint_error < 1e-10, "{kind}: {}", record.joint_error));
        let after = momenta(&world.bodies);
        for k in 0..6 {
            close(after[k], before[k], 1e-11, &format!("{kind}: component {k}"));
        }
    }
}

/// Momentum and angular momentum about the origin.
fn momenta(bodies: &moreau::bodies::Bodies<Solid, 3, 6>) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for i in 0..bodies.len() {
        let (x, v, m) = (bodies.pose[i].position, bodies.velocity[i], bodies.mass[i]);
        let spin = Solid::rotate(bodies.pose[i].rotation, [m[3] * v[3], m[4] * v[4], m[5] * v[5]]);
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            sum[k] += m[0] * v[k];
            sum[3 + k] += m[0] * (x[a] * v[b] - x[b] * v[a]) + spin[k];
        }
    }
    sum
}

/// A crank turned at a given spin drives a piston on a rail: x = r cos φ + √(l² − r² sin² φ) all the way round.
#[test]
fn a_slider_crank_moves_its_piston_by_the_closed_form() {
    let (r, l, omega, h) = (0.3_f64, 1.0_f64, 5.0_f64, 1e-4);
    let disk = |name: &str, x: f64, more: &str| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nshape.disk = {{ radius = 0.1 }}\nmaterial = \"steel\"\nposition = [{x:?}, 0.0]\n{more}\n"
        )
    };
    let text = format!(
        "{}{}{}{}\
         [[joints]]\nkind.hinge = {{ anchor = [{r:?}, 0.0] }}\nbetween = [\"crank\", \"rod\"]\n\
         [[joints]]\nkind.hinge = {{ anchor = [{:?}, 0.0] }}\nbetween = [\"rod\", \"piston\"]\n\
         [[joints]]\nkind.slider = {{ axis = [1.0, 0.0] }}\nbetween = [\"piston\"]\n",
        head(2, h),
        disk("crank", 0.0, &format!("motion = \"driven\"\nspin = {omega:?}")),
        disk("rod", r + 0.5 * l, &format!("velocity = [0.0, {:?}]\nspin = {:?}", 0.5 * r * omega, -r * omega / l)),
        disk("piston", r + l, ""),
        r + l
    );
    let mut world = plane(&text);
    let mut most = 0.0_f64;
    run(&mut world, (2.0 * std::f64::consts::PI / omega / h) as u64, |world, _, _| {
        // The angle that the crank has, not the one that it should have: its own turn has the error of its step.
        let [cosine, sine] = world.bodies.pose[0].rotation;
        let exact = r * cosine + (l * l - r * r * sine * sine).sqrt();
        most = most.max((world.bodies.pose[2].position[0] - exact).abs());
    });
    // Joints are closed at the predictions, half a step from here: (h ω)²/8 r = 1e-8 is left between them.
    assert!(most < 1e-7, "the piston is {most} m beside its place");
}

/// A four-bar linkage in space has more joint rows than freedoms, all of which agree: it moves as the parallelogram that it is.
#[test]
fn an_overconstrained_parallelogram_swings_as_one_pendulum() {
    let bar = |name: &str, size: &str, x: f64, z: f64| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nshape.box = {{ size = {size} }}\nmaterial = \"steel\"\nposition = [{x:?}, 0.0, {z:?}]\n"
        )
    };
    let hinge = |x: f64, z: f64, between: &str| {
        format!("[[joints]]\nkind.hinge = {{ anchor = [{x:?}, 0.0, {z:?}], axis = [0.0, 1.0, 0.0] }}\nbetween = [{between}]\n")
    };
    let h = 1e-3;
    let text = [
        head(3, h).replace("[0.0, 0.0, -9.81]", "[4.0, 0.0, -9.81]"),
        bar("left", "[0.05, 0.05, 1.0]", 0.0, -0.5),
        bar("right", "[0.05, 0.05, 1.0]", 1.0, -0.5),
        bar("below", "[1.0, 0.05, 0.05]", 0.5, -1.0),
        hinge(0.0, 0.0, "\"left\""),
        hinge(1.0, 0.0, "\"right\""),
        hinge(0.0, -1.0, "\"left\", \"below\""),
        hinge(1.0, -1.0, "\"right\", \"below\""),
    ]
    .concat();
    let mut world = solid(&text);
    run(&mut world, 2000, |world, _, _| {
        let y = world.bodies.pose.iter().map(|pose| pose.position[1].abs()).fold(0.0, f64::max);
        assert!(y < 1e-9, "it stays in its plane: {y}");
        let [.., turned, _] = Solid::quaternion(world.bodies.pose[2].rotation);
        assert!(turned.abs() < 1e-9, "the lower bar stays level");
    });
    // It swings about the direction of this gravity, 22° from the start, and back: its speed is that of energy.
    let (m, v) = (2.5, &world.bodies.velocity);
    let inertia = m * (1.0 + 0.0025) / 12.0 + m * 0.25;
    let lowered = |i: usize, x: f64, z: f64| {
        let p = world.bodies.pose[i].position;
        4.0 * m * (p[0] - x) - G * m * (p[2] - z)
    };
    let lost = lowered(0, 0.0, -0.5) + lowered(1, 1.0, -0.5) + lowered(2, 0.5, -1.0);
    let spin = v[0][4];
    close(0.5 * (2.0 * inertia + m) * spin * spin, lost, 1e-4 * m * G, "energy");
    close(v[1][4], spin, 1e-6, "both sides turn alike");
}

/// A joint keeps its bodies from touching each other unless it says otherwise.
#[test]
fn joined_bodies_collide_only_on_demand() {
    let count = |collide: &str| {
        let disk = |name: &str, x: f64| {
            format!(
                "[[bodies]]\nname = \"{name}\"\nshape.disk = {{ radius = 0.1 }}\nmaterial = \"steel\"\nposition = [{x:?}, 0.0]\n"
            )
        };
        let text = format!(
            "{}{}{}[[joints]]\nkind.hinge = {{ anchor = [0.1, 0.0] }}\nbetween = [\"a\", \"b\"]\n{collide}\n",
            head(2, 1e-3),
            disk("a", 0.0),
            disk("b", 0.2)
        );
        let mut world = plane(&text);
        step::<Plane, 2, 3>(&mut world, &mut Workspace::default()).unwrap().contacts
    };
    assert_eq!((count(""), count("collide = false"), count("collide = true")), (0, 0, 1));
}
