//! What cells cut off bodies.

use super::*;
use moreau::measure::{Cell, Grid, MeasureError, ball_in, extent, solid_fractions, volume, volume_in};
use std::f64::consts::PI;

const R: f64 = 0.7;
const FAR: f64 = 10.0;

/// What a ball around the origin has between these corners.
fn cut<const D: usize>(min: [f64; D], max: [f64; D]) -> f64 {
    ball_in(&[0.0; D], R, &Cell::new(min, max).unwrap())
}

fn same(found: f64, right: f64) {
    assert!((found - right).abs() < 1e-15, "{found} is not {right}");
}

#[test]
fn a_ball_is_cut_into_caps_quarters_and_eighths() {
    let whole = 4.0 / 3.0 * PI * R * R * R;
    same(cut([-FAR; 3], [FAR; 3]), whole);
    same(cut([0.0; 3], [FAR; 3]), whole / 8.0);
    same(cut([0.0, 0.0, -FAR], [FAR; 3]), whole / 4.0);
    for h in [1e-9, 0.1, 0.5, R, 1.1, 2.0 * R - 1e-9] {
        let cap = PI * h * h * (3.0 * R - h) / 3.0;
        for k in 0..3 {
            let low = std::array::from_fn(|j| if j == k { R - h } else { -FAR });
            same(cut(low, [FAR; 3]), cap);
            same(cut([-FAR; 3], low.map(|x: f64| if x == -FAR { FAR } else { -x })), cap);
        }
    }
    assert_eq!(cut([R, -1.0, -1.0], [FAR; 3]), 0.0);
    // A box inside, and one whose edges alone are inside: the ball but for six caps.
    same(cut([-0.1, -0.2, -0.3], [0.3, 0.2, 0.1]), 0.4 * 0.4 * 0.4);
    let h = R - 0.6;
    same(cut([-0.6; 3], [0.6; 3]), whole - 6.0 * PI * h * h * (3.0 * R - h) / 3.0);
}

#[test]
fn a_disk_is_cut_into_segments_and_quarters() {
    same(cut([0.0; 2], [FAR; 2]), PI * R * R / 4.0);
    let x = 0.2;
    same(cut([x, -FAR], [FAR; 2]), R * R * (x / R).acos() - x * (R * R - x * x).sqrt());
    same(cut([-0.1; 2], [0.3; 2]), 0.16);
    assert_eq!(cut([0.6; 2], [FAR; 2]), 0.0);
}

/// Columns of a fine grid across, each as long as the ball or the cell allows: exact but for the fineness.
#[test]
fn a_ball_is_cut_by_any_cell() {
    let cells = [
        ([-0.2, 0.1, 0.25], [0.5, 0.6, 0.9]),
        ([0.3, 0.3, 0.3], [0.9, 0.5, 0.8]),
        ([-0.69, -0.1, -0.2], [0.1, 0.69, 0.69]),
        ([-0.5, -0.5, -0.9], [-0.4, 0.9, 0.3]),
    ];
    for (min, max) in cells {
        let count = 1000;
        let [dx, dy] = [0, 1].map(|k| (max[k] - min[k]) / f64::from(count));
        let mut sum = 0.0;
        for i in 0..count {
            for j in 0..count {
                let (x, y) = (min[0] + (f64::from(i) + 0.5) * dx, min[1] + (f64::from(j) + 0.5) * dy);
                let half = (R * R - x * x - y * y).max(0.0).sqrt();
                sum += (half.min(max[2]) - (-half).max(min[2])).max(0.0) * dx * dy;
            }
        }
        assert!((cut(min, max) - sum).abs() < 1e-6, "{} {sum}", cut(min, max));
    }
}

/// The corners of the cell go through the surface of the ball, where two formulas meet.
#[test]
fn nothing_jumps_where_a_corner_leaves_the_ball() {
    let corner = R / 3.0_f64.sqrt();
    for off in [-1e-9, -1e-12, -1e-15, 0.0, 1e-15, 1e-12, 1e-9] {
        let c = corner + off;
        assert!((cut([0.0; 3], [c; 3]) - c * c * c).abs() < 1e-15);
    }
    let edge = R / 2.0_f64.sqrt();
    let quarter = cut([0.0; 3], [edge, edge, FAR]);
    for off in [-1e-9, -1e-12, 1e-12, 1e-9] {
        assert!((cut([0.0; 3], [edge + off, edge + off, FAR]) - quarter).abs() < 2.0 * off.abs());
    }
}

/// The cells of a grid have all of a body between them, whatever it is and however it is turned.
#[test]
fn a_body_is_shared_out_among_cells_without_loss() {
    let shapes = [
        "ball = { radius = 0.45 }",
        "box = { size = [0.5, 0.3, 0.4] }",
        "capsule = { radius = 0.2, length = 0.4 }",
        "cylinder = { radius = 0.2, length = 0.4 }",
        "polyhedron = { points = [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.1, 0.1, 0.6]] }",
        "compound.parts = [{ shape.ball = { radius = 0.2 } }, { shape.ball = { radius = 0.2 }, position = [0.4, 0.1, 0.0] }]",
    ];
    let grid = Grid::new(Cell::new([-1.0, -1.1, -1.2], [1.3, 1.0, 1.1]).unwrap(), [7, 4, 9]).unwrap();
    for shape in shapes {
        let mut world = solid([0.0; 3], &[format!("shape.{shape}\nposition = [0.12, -0.07, 0.031]")]);
        let rotation = world.bodies.pose[0].rotation;
        world.bodies.pose[0].rotation = Solid::turned(rotation, [0.48, 0.6, 0.64], 0.7);
        let shared: f64 = solid_fractions(&world, &grid).iter().enumerate().map(|(i, part)| part * grid.cell(i).volume()).sum();
        let whole = volume(&world.bodies, 0);
        assert!((shared - whole).abs() < 1e-12 * whole, "{shape}: {shared} {whole}");
        let cells: f64 = (0..grid.len()).map(|i| volume_in(&world.bodies, 0, &grid.cell(i))).sum();
        assert!((cells - whole).abs() < 1e-12 * whole, "{shape}: {cells} {whole}");
        let region = extent(&world.bodies).unwrap();
        assert!((volume_in(&world.bodies, 0, &region) - whole).abs() < 1e-12 * whole, "{shape}");
    }
}

#[test]
fn cubes_in_cells_are_exact() {
    let cube = || solid([0.0; 3], &["shape.box = { size = [1.0, 1.0, 1.0] }\nposition = [0.0, 0.0, 0.0]".to_owned()]);
    let cell = |min, max| Cell::new(min, max).unwrap();
    let mut world = cube();
    same(volume_in(&world.bodies, 0, &cell([0.0; 3], [0.25, 1.0, 1.0])), 0.25 * 0.5 * 0.5);
    same(volume_in(&world.bodies, 0, &cell([-0.5; 3], [0.5; 3])), 1.0);
    same(volume_in(&world.bodies, 0, &cell([0.5, 0.0, 0.0], [1.0; 3])), 0.0);
    // On an edge, a side of the cell cuts off a prism.
    let identity = world.bodies.pose[0].rotation;
    world.bodies.pose[0].rotation = Solid::turned(identity, [0.0, 0.0, 1.0], PI / 4.0);
    let height = 0.5_f64.sqrt() - 0.4;
    same(volume_in(&world.bodies, 0, &cell([0.4, -2.0, -0.25], [2.0; 3])), height * height * 0.75);
    // On a corner, a pyramid with three right angles at its top.
    let slope = 0.5_f64.sqrt();
    world.bodies.pose[0].rotation = Solid::turned(identity, [slope, -slope, 0.0], (1.0 / 3.0_f64.sqrt()).acos());
    let below = 0.3;
    let cut = volume_in(&world.bodies, 0, &cell([-2.0, -2.0, 0.75_f64.sqrt() - below], [2.0; 3]));
    let pyramid = 0.75_f64.sqrt() * below * below * below;
    let upside = (volume_in(&world.bodies, 0, &cell([-2.0; 3], [2.0, 2.0, below - 0.75_f64.sqrt()])), pyramid);
    assert!((cut - pyramid).abs() < 1e-15 && (upside.0 - upside.1).abs() < 1e-15, "{cut} {pyramid}");
}

#[test]
fn squares_in_cells_are_exact() {
    let mut world = plane([0.0; 2], &["shape.box = { size = [1.0, 1.0] }\nposition = [0.0, 0.0]".to_owned()]);
    let cell = |min, max| Cell::new(min, max).unwrap();
    same(volume_in(&world.bodies, 0, &cell([0.0; 2], [0.25, 1.0])), 0.125);
    world.bodies.pose[0].rotation = [0.5_f64.sqrt(); 2];
    let height = 0.5_f64.sqrt() - 0.4;
    same(volume_in(&world.bodies, 0, &cell([0.4, -2.0], [2.0; 2])), height * height);
    same(volume_in(&world.bodies, 0, &cell([0.4, 0.0], [2.0; 2])), 0.5 * height * height);
}

#[test]
fn regions_without_an_inside_are_refused() {
    assert!(matches!(Cell::new([0.0; 2], [1.0, 0.0]), Err(MeasureError::Region { axis: 1, .. })));
    assert!(matches!(Cell::new([0.0; 2], [f64::INFINITY, 1.0]), Err(MeasureError::Region { axis: 0, .. })));
    let cell = Cell::new([0.0; 2], [1.0; 2]).unwrap();
    let error = Grid::new(cell, [3, 0]).unwrap_err();
    assert_eq!(error.to_string(), "0 cells of a grid; expected 1 or more");
}
