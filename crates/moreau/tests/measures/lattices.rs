//! Lattices of balls that touch. A block of one is finite: coordination is that of bodies whose neighbours are all in the block, fractions are
//! those of boxes inside that repeat, and fabrics are of blocks with the symmetry of the lattice, or of such a box.

use super::*;
use moreau::detect::Detector;
use moreau::measure::{
    Cell, Grid, Touch, branch_fabric, coordination, deviator, extent, fabric, solid_fraction, solid_fractions,
};
use std::f64::consts::PI;

const CLOSED: Touch = Touch::Closed(1e-9);

/// How many neighbours the bodies at places inside have, all the same.
fn inside(of_body: &[u32], is_inside: impl Fn(usize) -> bool) -> u32 {
    let inner: Vec<u32> = (0..of_body.len()).filter(|&i| is_inside(i)).map(|i| of_body[i]).collect();
    assert!(inner.len() > 4 && inner.iter().all(|count| *count == inner[0]), "{inner:?}");
    inner[0]
}

fn block(side: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..side * side * side).map(move |n| [n % side, n / side % side, n / side / side])
}

#[test]
fn a_simple_cubic_lattice_has_six_neighbours_and_fills_pi_sixths() {
    let bodies: Vec<String> = block(5).map(|at| ball(at.map(|x| x as f64), 0.5)).collect();
    let mut world = solid([0.0; 3], &bodies);
    let mut touching = Vec::new();
    let (shapes, poses) = (&world.bodies.shape, &world.bodies.pose);
    Detector::new().detect::<Solid, 6>(shapes, poses, &[1e-9; 125], |_| false, &mut touching);
    let work = stepped(&mut world);
    let contacts = work.contacts();
    let closed: Vec<_> = CLOSED.among(contacts).map(|c| c.contact.key).collect();
    assert_eq!(touching.iter().map(|c| c.key).collect::<Vec<_>>(), closed);
    let found = coordination(&world, contacts, CLOSED);
    let at = |i: usize| world.bodies.pose[i].position;
    assert_eq!(inside(&found.of_body, |i| at(i).iter().all(|x| (0.5..3.5).contains(x))), 6);
    // 3 n² (n − 1) contacts among n³ bodies.
    assert!((found.mean - 2.0 * 300.0 / 125.0).abs() < 1e-14 && !found.rattler.contains(&true), "{}", found.mean);
    assert_eq!(coordination(&world, contacts, Touch::Loaded).mean, 0.0, "nothing presses");
    close(&fabric(CLOSED.among(contacts)), &isotropic(1.0 / 3.0), 1e-14);
    close(&branch_fabric(&world, CLOSED.among(contacts)), &isotropic(1.0 / 3.0), 1e-14);
    for low in [[1.0; 3], [1.3, 1.7, 2.2]] {
        let cell = Cell::new(low, low.map(|x| x + 1.0)).unwrap();
        assert!((solid_fraction(&world, &cell) - PI / 6.0).abs() < 1e-13);
    }
    let region = Cell::new([0.5; 3], [3.5; 3]).unwrap();
    let grid = Grid::new(region, [3, 3, 3]).unwrap();
    assert!(solid_fractions(&world, &grid).iter().all(|fraction| (fraction - PI / 6.0).abs() < 1e-13));
}

#[test]
fn a_face_centred_cubic_lattice_has_twelve_neighbours_and_fills_the_most() {
    let sites = block(7).filter(|at| at.iter().sum::<usize>().is_multiple_of(2));
    let bodies: Vec<String> = sites.map(|at| ball(at.map(|x| 0.5 * x as f64), 0.125_f64.sqrt())).collect();
    let mut world = solid([0.0; 3], &bodies);
    let work = stepped(&mut world);
    let found = coordination(&world, work.contacts(), CLOSED);
    let at = |i: usize| world.bodies.pose[i].position;
    assert_eq!(inside(&found.of_body, |i| at(i).iter().all(|x| (0.4..2.6).contains(x))), 12);
    let tensor = fabric(CLOSED.among(work.contacts()));
    close(&tensor, &isotropic(1.0 / 3.0), 1e-14);
    assert!(deviator(&tensor) < 1e-14);
    let cell = Cell::new([1.0; 3], [2.0; 3]).unwrap();
    assert!((solid_fraction(&world, &cell) - PI / 18.0_f64.sqrt()).abs() < 1e-13);
}

#[test]
fn a_hexagonal_lattice_of_disks_has_six_neighbours_and_fills_the_most_of_the_plane() {
    let row = 0.75_f64.sqrt();
    let sites = (0..64).map(|n| [(n % 8) as f64 + 0.5 * (n / 8 % 2) as f64, row * (n / 8) as f64]);
    let mut world = plane([0.0; 2], &sites.map(|at| disk(at, 0.5)).collect::<Vec<_>>());
    let work = stepped(&mut world);
    let found = coordination(&world, work.contacts(), CLOSED);
    assert_eq!(inside(&found.of_body, |i| (1..7).contains(&(i % 8)) && (1..7).contains(&(i / 8))), 6);
    // Two bodies wide and two rows high: four bodies, twelve contacts.
    let low = [2.3, 1.1];
    let cell = Cell::new(low, [low[0] + 2.0, low[1] + 2.0 * row]).unwrap();
    assert!((solid_fraction(&world, &cell) - PI / 12.0_f64.sqrt()).abs() < 1e-13);
    let within = || CLOSED.among(work.contacts()).filter(|c| cell.contains(&c.contact.point));
    assert_eq!(within().count(), 12);
    close(&fabric(within()), &isotropic(0.5), 1e-14);
}

/// On a floor: two disks beside each other with one on top; a disk alone with another on it; one in the air.
#[test]
fn rattlers_are_taken_away_until_there_are_none() {
    let floor = "shape.half_plane = { normal = [0.0, 1.0] }\nposition = [0.0, 0.0]".to_owned();
    let top = [0.5, 0.5 + 0.75_f64.sqrt()];
    let places = [[0.0, 0.5], [1.0, 0.5], top, [5.0, 0.5], [5.0, 1.5], [9.0, 5.0]];
    let bodies: Vec<String> = std::iter::once(floor).chain(places.map(|at| disk(at, 0.5))).collect();
    let mut world = plane([0.0; 2], &bodies);
    let work = stepped(&mut world);
    let found = coordination(&world, work.contacts(), CLOSED);
    assert_eq!(found.of_body, [3, 3, 3, 2, 2, 1, 0]);
    assert_eq!(found.rattler, [false, false, false, false, true, true, true]);
    assert!((found.mean - 11.0 / 6.0).abs() < 1e-15 && (found.without_rattlers - 8.0 / 3.0).abs() < 1e-15);
}

/// Two blocks on each other have one or two neighbours, but faces hold them.
#[test]
fn blocks_on_their_faces_are_no_rattlers() {
    let floor = "shape.half_space = { normal = [0.0, 0.0, 1.0] }\nposition = [0.0, 0.0, 0.0]".to_owned();
    let block = |z: f64| format!("shape.box = {{ size = [1.0, 1.0, 1.0] }}\nposition = [0.0, 0.0, {z:?}]");
    let mut world = solid([0.0, 0.0, -10.0], &[floor, block(0.5), block(1.5)]);
    let work = stepped(&mut world);
    let found = coordination(&world, work.contacts(), Touch::Loaded);
    assert_eq!((found.of_body, found.rattler), (vec![1, 2, 1], vec![false; 3]));
    assert_eq!((found.mean, found.without_rattlers), (1.5, 1.5));
}

#[test]
fn a_world_of_nothing_has_measures_of_zero() {
    let world = plane([0.0; 2], &["shape.half_plane = { normal = [0.0, 1.0] }\nposition = [0.0, 0.0]".to_owned()]);
    let found = coordination(&world, &[], CLOSED);
    assert_eq!((found.mean, found.without_rattlers, found.of_body), (0.0, 0.0, vec![0]));
    assert_eq!(extent(&world.bodies), None);
    assert_eq!(fabric::<2>([]), [[0.0; 2]; 2]);
    assert_eq!(solid_fraction(&world, &Cell::new([-1.0; 2], [1.0; 2]).unwrap()), 0.0);
}
