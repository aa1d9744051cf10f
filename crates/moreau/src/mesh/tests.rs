//! Readers, checks, masses and pieces: against closed forms and files written here.

use super::*;
use glam::{DQuat, DVec3};
use proptest::prelude::*;

/// A box from the origin to these corners, faces outward.
fn cuboid([x, y, z]: [f64; 3]) -> Mesh {
    let points = (0..8).map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 1 { [x, y, z][k] } else { 0.0 })).collect();
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    PolygonMesh { points, faces: faces.iter().map(|face| face.to_vec()).collect() }.triangulated()
}

fn moved(mesh: &Mesh, rotation: DQuat, place: DVec3) -> Mesh {
    let points = mesh.points.iter().map(|&p| (place + rotation * DVec3::from(p)).to_array()).collect();
    Mesh { points, triangles: mesh.triangles.clone() }
}

/// An L: a 2 × 1 × 1 beam with a 1 × 1 × 1 block on one end.
fn corner() -> Mesh {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    prism(&outline, &[[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]], 1.0)
}

/// What lies over an outline, counter-clockwise, whose inside these triangles fill, up to a height.
fn prism(outline: &[[f64; 2]], fill: &[[u32; 3]], height: f64) -> Mesh {
    let count = outline.len() as u32;
    let level = |z: f64| outline.iter().map(move |&[x, y]| [x, y, z]);
    let mut triangles: Vec<[u32; 3]> = fill.iter().map(|&[a, b, c]| [a, c, b]).collect();
    triangles.extend(fill.iter().map(|corners| corners.map(|i| i + count)));
    for i in 0..count {
        let next = (i + 1) % count;
        triangles.extend([[i, next, next + count], [i, next + count, i + count]]);
    }
    Mesh { points: level(0.0).chain(level(height)).collect(), triangles }
}

fn near(found: f64, right: f64, scale: f64) {
    assert!((found - right).abs() < 1e-13 * scale, "{found} is not {right}");
}

#[test]
fn a_box_weighs_what_a_box_weighs_wherever_it_is_and_however_turned() {
    let [x, y, z]: [f64; 3] = [1.0, 2.0, 3.0];
    let moments = [y * y + z * z, z * z + x * x, x * x + y * y].map(|square| x * y * z * square / 12.0);
    for turn in 0..20 {
        let rotation = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 0.3 * f64::from(turn));
        let place = f64::from(turn) * DVec3::new(1.0, -2.0, 0.5);
        let mass = *moved(&cuboid([x, y, z]), rotation, place).closed().unwrap().mass();
        near(mass.volume, x * y * z, 100.0);
        let centre = place + rotation * DVec3::new(0.5 * x, 0.5 * y, 0.5 * z);
        assert!((DVec3::from(mass.centre) - centre).length() < 1e-13);
        let (principal, axes) = mass.principal();
        let mut found = principal;
        found.sort_by(f64::total_cmp);
        let mut right = moments;
        right.sort_by(f64::total_cmp);
        (0..3).for_each(|k| near(found[k], right[k], 100.0));
        // Each principal axis is an edge of the turned box.
        for k in 0..3 {
            let axis = rotation.conjugate() * (axes * DVec3::AXES[k]);
            let edge = (0..3).find(|&e| axis[e].abs() > 1.0 - 1e-12).expect("an edge");
            near(principal[k], moments[edge], 100.0);
        }
    }
    assert_eq!(cuboid([2.0; 3]).closed().unwrap().mass().principal().1, DQuat::IDENTITY, "a cube is not turned");
}

#[test]
fn a_corner_of_a_cube_weighs_what_a_tetrahedron_weighs() {
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mesh = Mesh { points, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] };
    let mass = *mesh.closed().unwrap().mass();
    near(mass.volume, 1.0 / 6.0, 1.0);
    mass.centre.iter().for_each(|&x| near(x, 0.25, 1.0));
    // About the centre: ∫ x² = 1/60 − 1/96, and ∫ x y = 1/120 − 1/96.
    for i in 0..3 {
        for j in 0..3 {
            near(mass.second[i][j], if i == j { 1.0 / 60.0 } else { 1.0 / 120.0 } - 1.0 / 96.0, 1.0);
        }
    }
}

#[test]
fn a_prism_of_many_sides_weighs_what_its_polygon_says() {
    // A regular polygon of n corners: area n/2 sin(2π/n), polar moment of area · (2 + cos(2π/n))/6.
    let (count, height) = (100_u32, 3.0);
    let angle = std::f64::consts::TAU / f64::from(count);
    let outline: Vec<[f64; 2]> = (0..count).map(|i| [(f64::from(i) * angle).cos(), (f64::from(i) * angle).sin()]).collect();
    let fill: Vec<[u32; 3]> = (1..count - 1).map(|i| [0, i, i + 1]).collect();
    let mass = *prism(&outline, &fill, height).closed().unwrap().mass();
    let area = 0.5 * f64::from(count) * angle.sin();
    let polar = area * (2.0 + angle.cos()) / 6.0;
    near(mass.volume, area * height, 10.0);
    let ([a, b, c], _) = mass.principal();
    near(c, polar * height, 10.0);
    [a, b].iter().for_each(|&x| near(x, 0.5 * polar * height + mass.volume * height * height / 12.0, 10.0));
}

#[test]
fn a_mesh_that_is_inside_out_is_turned_and_says_so() {
    let mut inward = cuboid([1.0; 3]);
    inward.triangles.iter_mut().for_each(|corners| corners.swap(0, 1));
    let closed = inward.closed().unwrap();
    assert!(closed.turned() && (closed.mass().volume - 1.0).abs() < 1e-14);
    assert!(!cuboid([1.0; 3]).closed().unwrap().turned());
}

#[test]
fn what_is_wrong_with_a_mesh_is_said_with_its_place() {
    let error = |change: &dyn Fn(&mut Mesh)| {
        let mut mesh = cuboid([1.0; 3]);
        change(&mut mesh);
        mesh.closed().unwrap_err()
    };
    assert_eq!(error(&|mesh| mesh.triangles.clear()), MeshError::Empty);
    assert!(matches!(error(&|mesh| mesh.triangles[3][1] = 8), MeshError::NoSuchPoint { triangle: 3, point: 8, count: 8 }));
    assert!(matches!(error(&|mesh| mesh.points[2][0] = f64::NAN), MeshError::Nowhere { point: 2, .. }));
    assert!(matches!(error(&|mesh| mesh.points[2][0] = 1e61), MeshError::Nowhere { point: 2, .. }));
    assert!(matches!(error(&|mesh| mesh.triangles[5][1] = mesh.triangles[5][0]), MeshError::NoArea { triangle: 5, .. }));
    let open = error(&|mesh| mesh.triangles.truncate(11));
    assert!(matches!(&open, MeshError::Open { count: 3, edges } if edges.len() == 3), "{open}");
    assert!(open.to_string().contains("from [0.0, 0.0, 1.0] to [0.0, 1.0, 1.0]"), "{open}");
    assert!(matches!(error(&|mesh| mesh.triangles[0].swap(0, 1)), MeshError::Inconsistent { count: 3, .. }));
    assert!(matches!(error(&|mesh| mesh.triangles.push(mesh.triangles[0])), MeshError::Crowded { count: 3, .. }));
    let doubled = error(&|mesh| {
        mesh.points.push(mesh.points[3]);
        mesh.triangles[0] = mesh.triangles[0].map(|i| if i == 3 { 8 } else { i });
        mesh.triangles
            .iter_mut()
            .find(|corners| corners.contains(&3))
            .unwrap()
            .iter_mut()
            .filter(|i| **i == 3)
            .for_each(|i| *i = 8);
    });
    assert!(matches!(doubled, MeshError::SamePoint { first: 3, second: 8, .. }), "{doubled}");
    // A corner pulled through the opposite face.
    assert!(matches!(error(&|mesh| mesh.points[7] = [0.3, 0.3, -0.5]), MeshError::Crossing { .. }));
    // Two triangles back to back.
    let flat = Mesh { points: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], triangles: vec![[0, 1, 2], [0, 2, 1]] };
    assert!(matches!(flat.closed(), Err(MeshError::NoVolume { .. })));
}

#[test]
fn boxes_that_go_through_each_other_cross_and_boxes_apart_do_not() {
    let two = |shift: f64| {
        let (mut mesh, other) = (cuboid([1.0; 3]), moved(&cuboid([1.0; 3]), DQuat::IDENTITY, DVec3::new(shift, 0.31, 0.17)));
        mesh.points.extend(other.points);
        mesh.triangles.extend(other.triangles.iter().map(|corners| corners.map(|i| i + 8)));
        mesh.closed()
    };
    assert!(matches!(two(0.7), Err(MeshError::Crossing { .. })));
    assert!((two(1.5).unwrap().mass().volume - 2.0).abs() < 1e-14);
    assert!(two(1.0).is_ok(), "boxes that touch do not cross");
}

/// STL of a mesh: text, and binary.
fn stl(mesh: &Mesh) -> (String, Vec<u8>) {
    let mut text = "solid test\n".to_owned();
    let mut binary = vec![b's'; 80];
    binary.extend((mesh.triangles.len() as u32).to_le_bytes());
    for i in 0..mesh.triangles.len() {
        text += "facet normal 0 0 0\n outer loop\n";
        binary.extend([0; 12]);
        for point in mesh.corners(i) {
            text += &format!("  vertex {} {} {}\n", point[0], point[1], point[2]);
            point.iter().for_each(|&x| binary.extend((x as f32).to_le_bytes()));
        }
        text += " endloop\nendfacet\n";
        binary.extend([0; 2]);
    }
    (text + "endsolid test\n", binary)
}

#[test]
fn stl_is_read_as_it_was_written_with_equal_points_merged() {
    // Halves and wholes are the same in 32 bits.
    let mesh = corner();
    let (text, binary) = stl(&mesh);
    for bytes in [text.as_bytes(), &binary] {
        let read = Mesh::from_stl(bytes, "test.stl").unwrap();
        assert_eq!((read.points.len(), read.triangles.len()), (mesh.points.len(), mesh.triangles.len()));
        assert!((0..mesh.triangles.len()).all(|i| read.corners(i) == mesh.corners(i)));
        assert!((read.closed().unwrap().mass().volume - 3.0).abs() < 1e-14);
    }
    // A binary file may begin like text.
    let mut confusing = binary.clone();
    confusing[..5].copy_from_slice(b"solid");
    assert_eq!(Mesh::from_stl(&confusing, "x"), Mesh::from_stl(&binary, "x"));
}

#[test]
fn wrong_stl_is_said_with_its_line_or_byte() {
    let (text, binary) = stl(&cuboid([1.0; 3]));
    let error = |bytes: &[u8]| Mesh::from_stl(bytes, "test.stl").unwrap_err().to_string();
    for (from, to, words) in [
        ("vertex 1", "vertx 1", ":"),
        ("outer loop", "inner loop", "test.stl:3: `inner`; expected `outer loop`"),
        ("vertex 0 0 0", "vertex 0 0", "test.stl:4: no z; expected three finite numbers"),
        ("vertex 0 0 0", "vertex 0 nan 0", "test.stl:4: `nan` for y"),
        ("endloop", "vertex 1 2 3", "test.stl:7: a fourth corner"),
        ("endsolid test", "", "the text ends within the solid; expected `facet` or `endsolid`"),
    ] {
        let message = error(text.replacen(from, to, 1).as_bytes());
        assert!(message.contains(words), "{message}");
    }
    assert!(error(&binary[..200]).contains("byte 80: 200 bytes where 12 triangles take 684"), "{}", error(&binary[..200]));
    assert!(error(b"nothing").contains("7 bytes where the head alone takes 84"));
    let mut infinite = binary;
    infinite[84 + 50 + 12..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    assert!(error(&infinite).contains("byte 146: a corner at [inf"), "{}", error(&infinite));
}

#[test]
fn obj_is_read_in_all_its_forms() {
    let text = "# a pyramid\nmtllib none.mtl\no first\nv 0 0 0\nv 1 0 0 1.0\nvt 0 0\nvn 0 0 1\nv 1 1 0\nv 0 1 0\n\
                g base\nf 4//1 3//1 2//1 1//1 # as a fan\nv 0.5 0.5 \\\n 1\nusemtl x\nf 1/1/1 2/1/1 -1/1/1\nf 2/1 3/1 5/1\nf 3 4 5\nf -2 1 -1\n";
    let mesh = Mesh::from_obj(text.as_bytes(), "test.obj").unwrap();
    assert_eq!((mesh.points.len(), mesh.triangles.len()), (5, 6));
    assert_eq!(mesh.triangles[..3], [[3, 2, 1], [3, 1, 0], [0, 1, 4]]);
    assert!((mesh.closed().unwrap().mass().volume - 1.0 / 3.0).abs() < 1e-15);
    let error = |text: &str| Mesh::from_obj(text.as_bytes(), "test.obj").unwrap_err().to_string();
    for (text, words) in [
        ("v 0 0\n", "test.obj:1: no z"),
        ("v 0 0 0\nf 1 1\n", "test.obj:2: a face with 2 corners; expected 3 or more"),
        ("v 0 0 0\nf 1 1 2\n", "test.obj:2: a corner `2`; expected a point from 1 to 1"),
        ("v 0 0 0\nf 1 -2 1\n", "a corner `-2`"),
        ("v 0 0 0\nf 0 1 1\n", "a corner `0`"),
        ("v 0 0 0\nf 1 x/1 1\n", "a corner `x/1`"),
        ("v 1e60 0 0\n", "`1e60` for x"),
    ] {
        assert!(error(text).contains(words), "{}", error(text));
    }
}

/// As many programs write it: each face has corners of its own, rounded or not.
#[test]
fn an_obj_whose_faces_have_vertices_of_their_own_is_closed() {
    let cube = cuboid([0.3, 0.2, 0.1]);
    for noise in [0.0, 1e-11] {
        let (mut vertices, mut faces) = (String::new(), String::new());
        for (i, triangle) in cube.triangles.iter().enumerate() {
            for &point in triangle {
                let [x, y, z] = cube.points[point as usize].map(|x| x + noise * (i % 3) as f64);
                vertices += &format!("v {x:?} {y:?} {z:?}\n");
            }
            faces += &format!("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
        }
        let mesh = Mesh::from_obj((vertices + &faces).as_bytes(), "cube.obj").unwrap();
        assert_eq!((mesh.points.len(), mesh.triangles.len()), (8, 12));
        assert!(mesh.closed().is_ok());
    }
}

#[test]
fn points_within_the_tolerance_become_the_first_of_them() {
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0 + 9e-4, 0.0, 0.0], [-0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let mesh = Mesh { points, triangles: vec![[0, 1, 2], [3, 5, 4], [1, 3, 5]] };
    let exact = mesh.merged(0.0);
    assert_eq!((exact.points.len(), exact.triangles[1]), (5, [3, 4, 2]));
    let near = mesh.merged(1e-3);
    assert_eq!((near.points.len(), near.triangles.as_slice()), (4, [[0, 1, 2], [1, 3, 2]].as_slice()));
    assert_eq!(mesh.merged(8e-4).points.len(), 5);
}

#[test]
fn heights_are_read_by_rows_and_become_triangles_that_face_up() {
    let rows = Heights::rows_of("# x grows along a row\n0, 1,2\n\n3;4 5\n", "h.csv").unwrap();
    assert_eq!(rows, [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]);
    let mesh = Heights { origin: [10.0, 20.0, 30.0], spacing: [2.0, 4.0], rows }.mesh().unwrap();
    assert_eq!((mesh.points[0], mesh.points[5]), ([10.0, 20.0, 30.0], [14.0, 24.0, 35.0]));
    assert!(mesh.triangles.len() == 4 && (0..4).all(|i| vector::twice_area(mesh.corners(i))[2] == 8.0));
    let error = |text: &str| Heights::rows_of(text, "h.csv").unwrap_err().to_string();
    assert!(error("1 2\n1 2 3\n").contains("h.csv:2: 3 heights; expected 2, as in the first row"));
    assert!(error("1 2\n1 two\n").contains("h.csv:2: `two`; expected a finite number"));
    let small = Heights { origin: [0.0; 3], spacing: [1.0; 2], rows: vec![vec![1.0, 2.0]] };
    assert!(small.mesh().unwrap_err().to_string().contains("the number of rows of heights is 1; expected at least 2"));
}

/// Volume and whether all points lie behind all faces.
fn convex(piece: &Piece) -> (f64, bool) {
    let volume = moments_of(&piece.points, &piece.triangles).volume;
    let behind = piece.triangles.iter().all(|corners| {
        let corners = corners.map(|i| piece.points[i as usize]);
        let normal = vector::twice_area(corners);
        let length = vector::length(normal);
        piece.points.iter().all(|&p| vector::dot(normal, vector::sub(p, corners[0])) <= 1e-9 * length)
    });
    (volume, behind)
}

#[test]
fn a_corner_is_cut_into_convex_pieces_that_fill_it() {
    let closed = corner().closed().unwrap();
    let pieces = closed.pieces(Cutting::default()).unwrap();
    assert!(pieces.len() >= 2, "{}", pieces.len());
    let mut volume = 0.0;
    for piece in &pieces {
        let (part, is_convex) = convex(piece);
        assert!(is_convex && part > 0.0);
        volume += part;
    }
    assert!((volume / 3.0 - 1.0).abs() < 0.03, "{volume} of 3 m³ in {} pieces", pieces.len());
    let whole = cuboid([1.0, 2.0, 3.0]).closed().unwrap().pieces(Cutting::default()).unwrap();
    assert!(whole.len() == 1 && (convex(&whole[0]).0 - 6.0).abs() < 1e-9, "what is convex stays whole");
    assert!(matches!(closed.pieces(Cutting { resolution: 1, ..Cutting::default() }), Err(MeshError::Setting { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    /// Any bytes, and good files with a few of them changed, are read or refused.
    #[test]
    fn readers_are_total(noise in prop::collection::vec(any::<u8>(), 0..300), places in prop::collection::vec((0.0..1.0_f64, any::<u8>()), 0..5)) {
        let (text, mut binary) = stl(&cuboid([1.0; 3]));
        let mut text = text.into_bytes();
        let mut obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1/1 2/1 4/1\nf 2//3 3//2 4//1\nf -4 -1 -2\n".to_vec();
        for bytes in [&mut text, &mut binary, &mut obj] {
            for &(place, byte) in &places {
                let place = (place * bytes.len() as f64) as usize;
                bytes[place] = byte;
            }
        }
        for bytes in [&noise, &text, &binary, &obj] {
            for mesh in [Mesh::from_stl(bytes, "x"), Mesh::from_obj(bytes, "x")].into_iter().flatten() {
                let _ = mesh.closed();
            }
            let _ = compas::Assembly::from_json(bytes, "x");
            let _ = Heights::rows_of(&String::from_utf8_lossy(bytes), "x");
        }
    }
}
