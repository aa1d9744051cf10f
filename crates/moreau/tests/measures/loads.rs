//! Stress and forces where they are known from equilibrium, and velocities.

use super::*;
use moreau::measure::{
    Cell, MeasureError, Touch, deviator, extent, fabric, histogram, mean, mean_stress, normal_forces, principal, profile,
    sliding_share, stress_in, stress_of_bodies, volume,
};

const H: f64 = 1e-3;
const COUNT: usize = 6;

fn floor(dimension: usize) -> String {
    let shape = ["half_plane", "half_space"][dimension - 2];
    let normal: Vec<f64> = (0..dimension).map(|k| if k + 1 == dimension { 1.0 } else { 0.0 }).collect();
    format!("shape.{shape} = {{ normal = {normal:?} }}\nposition = {:?}", vec![0.0; dimension])
}

/// Round bodies of this radius above each other, at rest: the stress of each is the mean of the forces above and below times its diameter over
/// its volume, and the whole has n² times weight times radius over the volume of its box.
fn column<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>, radius: f64) {
    let work = stepped(&mut world);
    let weight = 10.0 * world.bodies.mass[1][0];
    let stress = stress_of_bodies(&world, work.contacts(), H);
    assert_eq!(stress[0], [[0.0; D]; D], "a wall has none");
    for i in 1..=COUNT {
        let (above, below) = ((COUNT - i) as f64 * weight, (COUNT - i + 1) as f64 * weight);
        let mut right = [[0.0; D]; D];
        right[D - 1][D - 1] = 0.5 * (above + below) * 2.0 * radius / volume(&world.bodies, i);
        close(&stress[i], &right, 1e-8 * right[D - 1][D - 1]);
        let vertical = stress[i][D - 1][D - 1];
        assert!((deviator(&stress[i]) - vertical).abs() < 1e-8 * vertical);
        assert!((mean_stress(&stress[i]) - vertical / D as f64).abs() < 1e-8 * vertical);
        assert!((principal(&stress[i]).1[0][D - 1].abs() - 1.0).abs() < 1e-8);
    }
    let region = extent(&world.bodies).unwrap();
    let of_all = stress_in(&world, work.contacts(), H, &region)[D - 1][D - 1] * region.volume();
    let right = weight * radius * (COUNT * COUNT) as f64;
    assert!((of_all - right).abs() < 1e-8 * right, "{of_all} {right}");
    assert!((deviator(&fabric(Touch::Loaded.among(work.contacts()))) - 1.0).abs() < 1e-14, "all contacts point one way");

    let forces = normal_forces(work.contacts(), H);
    assert!((mean(&forces) - 0.5 * (COUNT + 1) as f64 * weight).abs() < 1e-8 * weight && forces.len() == COUNT);
    // Forces over their mean are 2/7, 4/7 … 12/7: the bins of a half have 1, 2, 2, and one is beyond.
    let found = histogram(&forces, 3, 1.5).unwrap();
    let sixths = [1.0, 2.0, 2.0].map(|count: f64| count / 6.0 / 0.5);
    assert!(found.density.iter().zip(sixths).all(|(one, other)| (one - other).abs() < 1e-14), "{found:?}");
    assert!((found.beyond - 1.0 / 6.0).abs() < 1e-15 && found.width == 0.5);
    assert_eq!(sliding_share(work.contacts()), 0.0);
}

#[test]
fn the_stress_of_a_column_is_that_of_the_weight_above() {
    let heights = || (0..COUNT).map(|k| 0.1 + 0.2 * k as f64);
    let balls: Vec<String> = std::iter::once(floor(3)).chain(heights().map(|z| ball([0.0, 0.0, z], 0.1))).collect();
    column(solid([0.0, 0.0, -10.0], &balls), 0.1);
    let disks: Vec<String> = std::iter::once(floor(2)).chain(heights().map(|y| disk([0.0, y], 0.1))).collect();
    column(plane([0.0, -10.0], &disks), 0.1);
}

const SIDE: usize = 4;
const FORCE: f64 = 7.0;

/// The force on a body of a block of which each outer one is pushed inwards.
fn push<const D: usize>(at: [usize; D]) -> [f64; D] {
    at.map(|x| if x == 0 { FORCE } else { 0.0 } - if x == SIDE - 1 { FORCE } else { 0.0 })
}

/// A block under equal forces on all sides: each row carries the force, so a box with one row in each direction has the force over its side's
/// area as pressure, and a body the force times its diameter over its volume.
fn compressed<S: Space<D, N>, const D: usize, const N: usize>(mut world: World<S, D, N>) {
    let work = stepped(&mut world);
    let of_bodies = stress_of_bodies(&world, work.contacts(), H);
    let inner = |i: &usize| world.bodies.pose[*i].position.iter().all(|x| (0.5..2.5).contains(x));
    for i in (0..world.bodies.len()).filter(inner) {
        close(&of_bodies[i], &isotropic(FORCE / volume(&world.bodies, i)), 1e-7);
    }
    let cell = Cell::new([0.7; D], [1.7; D]).unwrap();
    let stress = stress_in(&world, work.contacts(), H, &cell);
    close(&stress, &isotropic(FORCE), 1e-7);
    assert!((mean_stress(&stress) - FORCE).abs() < 1e-7 && deviator(&stress) < 1e-7);
    // Half a row's thickness more on one side holds no row more there, but more of those across.
    let wide = Cell::new([0.7; D], std::array::from_fn(|k| if k == 0 { 2.0 } else { 1.7 })).unwrap();
    let stress = stress_in(&world, work.contacts(), H, &wide);
    assert!((stress[0][0] - FORCE).abs() < 1e-7 && (stress[1][1] - FORCE / 1.3).abs() < 1e-7, "{stress:?}");
}

#[test]
fn equal_forces_on_all_sides_make_a_pressure() {
    let balls = (0..SIDE * SIDE * SIDE).map(|n| [n % SIDE, n / SIDE % SIDE, n / SIDE / SIDE]);
    let balls = balls.map(|at| format!("{}\nforce = {:?}", ball(at.map(|x| x as f64), 0.5), push(at)));
    compressed(solid([0.0; 3], &balls.collect::<Vec<_>>()));
    let disks = (0..SIDE * SIDE).map(|n| [n % SIDE, n / SIDE]);
    let disks = disks.map(|at| format!("{}\nforce = {:?}", disk(at.map(|x| x as f64), 0.5), push(at)));
    compressed(plane([0.0; 2], &disks.collect::<Vec<_>>()));
}

/// What is summed by bodies and by branches is the same, with friction, walls and bodies that are not round.
#[test]
fn the_stress_of_a_heap_is_that_of_its_bodies() {
    let wall = |x: f64, n: f64| format!("shape.half_plane = {{ normal = [{n:?}, 0.0] }}\nposition = [{x:?}, 0.0]");
    let stone = "shape.box = { size = [0.9, 0.6] }\nposition = [1.4, 2.2]\norientation = 0.02".to_owned();
    let disks = [[0.5, 0.5], [1.5, 0.5], [2.5, 0.5], [1.0, 1.37], [2.0, 1.37]].map(|at| disk(at, 0.5));
    let bodies: Vec<String> = [floor(2), wall(0.0, 1.0), wall(3.0, -1.0)].into_iter().chain(disks).chain([stone]).collect();
    let mut world = plane([0.0, -10.0], &bodies);
    let mut work = Workspace::default();
    for _ in 0..150 {
        step(&mut world, &mut work).unwrap();
    }
    assert!(normal_forces(work.contacts(), H).len() > 8);
    let of_bodies = stress_of_bodies(&world, work.contacts(), H);
    let of_all: [[f64; 2]; 2] = std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..of_bodies.len()).map(|b| of_bodies[b][i][j] * free_volume(&world, b)).sum())
    });
    let region = Cell::new([-1.0; 2], [4.0; 2]).unwrap();
    let in_region = stress_in(&world, work.contacts(), H, &region).map(|row| row.map(|x| x * region.volume()));
    close(&in_region, &of_all, 1e-9 * of_all[1][1]);
}

fn free_volume(world: &World<Plane, 2, 3>, i: usize) -> f64 {
    if world.bodies.is_free(i) { volume(&world.bodies, i) } else { 0.0 }
}

#[test]
fn principal_values_come_in_order_whatever_their_signs() {
    let half = 0.5_f64.sqrt();
    let (values, axes) = principal(&[[0.0, 2.0], [0.0, 0.0]]);
    assert!((values[0] - 1.0).abs() < 1e-15 && (values[1] + 1.0).abs() < 1e-15);
    assert!(axes.as_flattened().iter().all(|x| (x.abs() - half).abs() < 1e-15) && axes[0][0] * axes[0][1] > 0.0);
    let stress = [[-3.0, 0.0, 1.0], [0.0, -4.0, 0.0], [1.0, 0.0, -3.0]];
    let (values, _) = principal(&stress);
    assert!(values.iter().zip([-2.0, -4.0, -4.0]).all(|(one, other)| (one - other).abs() < 1e-14), "{values:?}");
    assert!((deviator(&stress) - 2.0).abs() < 1e-14 && (mean_stress(&stress) + 10.0 / 3.0).abs() < 1e-15);
    assert_eq!(principal(&[[0.0; 3]; 3]).0, [0.0; 3]);
}

/// Balls, because forces of a face are not unique: points of a block that stands may pull against each other up to the limit.
#[test]
fn a_ball_that_slides_is_counted_and_one_that_rests_is_not() {
    let moving = |x: f64, v: f64| format!("{}\nvelocity = [{v:?}, 0.0, 0.0]", ball([x, 0.0, 0.1], 0.1));
    for (speeds, share) in [([0.0, 0.0], 0.0), ([1.0, 0.0], 0.5), ([1.0, 1.0], 1.0)] {
        let mut world = solid([0.0, 0.0, -10.0], &[floor(3), moving(0.0, speeds[0]), moving(1.0, speeds[1])]);
        let work = stepped(&mut world);
        assert_eq!(sliding_share(work.contacts()), share, "{speeds:?}");
    }
}

/// Pairs of bodies at 0.5, 1.5, 2.5 m that move at 0.5, 1.5, 2.5 m/s, one of each pair faster by 0.1 m/s and one slower.
#[test]
fn a_shear_flow_has_its_profile_and_temperature() {
    let bodies: Vec<String> = (0..6)
        .map(|n| {
            let (y, side) = (0.5 + (n / 2) as f64, if n % 2 == 0 { 1.0 } else { -1.0 });
            format!("{}\nvelocity = [{:?}, 0.0]", disk([side, y], 0.2), y + 0.1 * side)
        })
        .collect();
    let world = plane([0.0; 2], &bodies);
    let slabs = profile(&world, 1, [0.0, 4.0], 4).unwrap();
    for (k, slab) in slabs[..3].iter().enumerate() {
        let middle = 0.5 + k as f64;
        assert!(slab.bodies == 2 && slab.middle == middle && (slab.mass - 2.0 * world.bodies.mass[0][0]).abs() < 1e-12);
        assert!((slab.velocity[0] - middle).abs() < 1e-15 && slab.velocity[1] == 0.0);
        assert!((slab.temperature - 0.1 * 0.1 / 2.0).abs() < 1e-15, "{slab:?}");
    }
    assert!(slabs[3].bodies == 0 && slabs[3].velocity == [0.0; 2] && slabs[3].temperature == 0.0);
    assert_eq!(profile(&world, 2, [0.0, 4.0], 4), Err(MeasureError::Axis { axis: 2, dimension: 2 }));
    assert_eq!(profile(&world, 1, [0.0, 0.0], 4), Err(MeasureError::Region { axis: 1, from: 0.0, to: 0.0 }));
    assert_eq!(profile(&world, 1, [0.0, 4.0], 0), Err(MeasureError::NoParts { what: "slabs" }));
}
