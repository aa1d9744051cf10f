//! Runs a scene in Rapier: `rapier-fidelity SCENE.json OUT`.
//!
//! SCENE.json is what `scene.py` makes of a scene file, with the settings of `settings.py`. Writes OUT.f64, the states (raw little-endian
//! doubles: time, then position, quaternion w x y z, velocity and spin of each body), and prints the seconds that the steps took.

mod scene;

use rapier3d_f64::prelude::*;
use scene::{Body, Joint, Scene, Settings, Shape};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [path, out] = words.as_slice() else { return Err("two arguments are needed".into()) };
    let scene: Scene = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let mut world = PhysicsWorld { gravity: scene.gravity.into(), ..PhysicsWorld::default() };
    apply(&scene.settings, scene.step, &mut world.integration_parameters);
    let handles: Vec<_> = scene.bodies.iter().map(|body| insert(&mut world, body, &scene)).collect();
    for joint in &scene.joints {
        join(&mut world, joint, &handles, &scene);
    }
    let mut states = Vec::new();
    note(&world, &handles, 0.0, &mut states);
    let mut seconds = 0.0;
    for k in 1..=scene.steps {
        let clock = Instant::now();
        world.step();
        seconds += clock.elapsed().as_secs_f64();
        if k % scene.every == 0 {
            note(&world, &handles, k as f64 * scene.step, &mut states);
        }
    }
    std::fs::write(format!("{out}.f64"), states)?;
    println!("{seconds}");
    Ok(())
}

/// Changes what the settings name, and leaves all else as Rapier has it.
fn apply(settings: &Settings, step: f64, to: &mut IntegrationParameters) {
    to.dt = step;
    to.num_solver_iterations = settings.iterations.unwrap_or(to.num_solver_iterations);
    to.num_internal_pgs_iterations = settings.pgs_iterations.unwrap_or(to.num_internal_pgs_iterations);
    to.num_internal_stabilization_iterations = settings.stabilization.unwrap_or(to.num_internal_stabilization_iterations);
    to.length_unit = settings.length_unit.unwrap_or(to.length_unit);
    to.contact_recycling = settings.contact_recycling.unwrap_or(to.contact_recycling);
    to.warmstart_joints = settings.warmstart_joints.unwrap_or(to.warmstart_joints);
    if let Some([frequency, damping]) = settings.contact {
        to.contact_softness = SpringCoefficients { natural_frequency: frequency, damping_ratio: damping };
        to.static_contact_softness = to.contact_softness;
    }
    if settings.coulomb {
        to.friction_model = FrictionModel::Coulomb;
    }
}

fn insert(world: &mut PhysicsWorld, body: &Body, scene: &Scene) -> RigidBodyHandle {
    let [w, x, y, z] = body.quaternion;
    let mut built = if body.fixed { RigidBodyBuilder::fixed() } else { RigidBodyBuilder::dynamic() }
        .translation(body.position.into())
        .linvel(body.velocity.into())
        .angvel(body.spin.into())
        .can_sleep(scene.settings.sleep)
        .build();
    built.set_rotation(Rotation::from_xyzw(x, y, z, w), false);
    built.add_force(body.force.into(), false);
    let collider = match body.shape {
        Shape::Box([x, y, z]) => ColliderBuilder::cuboid(x / 2.0, y / 2.0, z / 2.0),
        Shape::Ball(radius) => ColliderBuilder::ball(radius),
        Shape::Capsule([radius, length]) => ColliderBuilder::capsule_z(length / 2.0, radius),
        // Rapier's axis is y.
        Shape::Cylinder([radius, length]) => {
            ColliderBuilder::cylinder(length / 2.0, radius).rotation(Vector::X * std::f64::consts::FRAC_PI_2)
        }
        Shape::HalfSpace(normal) => ColliderBuilder::new(SharedShape::halfspace(Vector::from(normal).normalize())),
    };
    let groups = if scene.collide { Group::ALL } else { Group::NONE };
    let collider = collider
        .density(body.density)
        .friction(scene.friction)
        .restitution(0.0)
        .contact_skin(scene.settings.contact_skin)
        .collision_groups(InteractionGroups::new(groups, groups, InteractionTestMode::And));
    world.insert(built, collider).0
}

fn join(world: &mut PhysicsWorld, joint: &Joint, handles: &[RigidBodyHandle], scene: &Scene) {
    let at = |k: Option<usize>| k.map_or([0.0; 3], |k| scene.bodies[k].position);
    let handle = |world: &mut PhysicsWorld, k: Option<usize>| {
        k.map_or_else(|| world.insert_body(RigidBodyBuilder::fixed()), |k| handles[k])
    };
    let local = |anchor: [f64; 3], k: Option<usize>| Vector::from(anchor) - Vector::from(at(k));
    let (a, b) = (handle(world, joint.a), handle(world, Some(joint.b)));
    // Bodies that joints join are not turned at the start in any of the scenes.
    let (one, two) = (local(joint.anchor, joint.a), local(joint.anchor, Some(joint.b)));
    let data: GenericJoint = match joint.axis {
        None => SphericalJointBuilder::new().local_anchor1(one).local_anchor2(two).contacts_enabled(false).build().into(),
        Some(axis) => {
            PrismaticJointBuilder::new(axis.into()).local_anchor1(one).local_anchor2(two).contacts_enabled(false).build().into()
        }
    };
    if scene.settings.multibody {
        world.multibody_joints.insert(a, b, data, true);
    } else {
        world.impulse_joints.insert(a, b, data, true);
    }
}

fn note(world: &PhysicsWorld, handles: &[RigidBodyHandle], time: f64, to: &mut Vec<u8>) {
    to.extend(time.to_le_bytes());
    for &handle in handles {
        let body = &world.bodies[handle];
        let (p, q, v, w) = (body.translation(), body.rotation(), body.linvel(), body.angvel());
        to.extend([p.x, p.y, p.z, q.w, q.x, q.y, q.z, v.x, v.y, v.z, w.x, w.y, w.z].into_iter().flat_map(f64::to_le_bytes));
    }
}
