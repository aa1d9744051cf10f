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

/// Two boxes that share an edge, and boxes that share a face.
#[test]
fn edges_of_four_triangles_are_left_to_grounds() {
    let of = |shift: [f64; 3]| {
        let (mut mesh, other) = (cuboid([1.0; 3]), moved(&cuboid([1.0; 3]), DQuat::IDENTITY, shift.into()));
        mesh.points.extend(other.points);
        mesh.triangles.extend(other.triangles.iter().map(|corners| corners.map(|i| i + 8)));
        mesh.merged(0.0)
    };
    for (shift, shared, hidden) in [([1.0, 0.0, 1.0], 1, 0), ([0.0, 0.0, 1.0], 5, 12), ([1.0, 0.0, 0.0], 5, 12)] {
        let mesh = of(shift);
        let edges = Edges::of(&mesh).unwrap();
        // Those of the diagonal of a shared face count, where both cut it the same way.
        assert_eq!(edges.shared.len(), shared, "{shift:?}");
        let count = edges.beyond.iter().flatten().filter(|&&other| other == HIDDEN).count();
        assert_eq!(count, hidden, "{shift:?}");
        for (i, beyond) in edges.beyond.iter().enumerate() {
            for (k, &other) in beyond.iter().enumerate().filter(|(_, other)| **other != HIDDEN) {
                let [from, to] = [k, (k + 1) % 3].map(|k| mesh.triangles[i][k]);
                let theirs = mesh.triangles[other as usize];
                assert!((0..3).any(|k| (theirs[k], theirs[(k + 1) % 3]) == (to, from)), "{shift:?}");
            }
        }
        // The face in common is no part of a surface, which has no such edges then.
        let covered = edges.covered(&mesh).iter().filter(|covered| **covered).count();
        assert_eq!(covered, if hidden == 0 { 0 } else { 4 }, "{shift:?}");
        let surface = crate::shape::solid::Surface::new(mesh.clone()).unwrap();
        assert_eq!(surface.mesh().triangles.len(), 24 - covered);
        let error = mesh.closed().unwrap_err();
        assert!(
            matches!(error, MeshError::Shared { .. }) && error.to_string().contains("four triangles or more, the first from ["),
            "{error}"
        );
    }
    // Fronts and backs that do not alternate: a box within the corner of another one's outside.
    let mut inside_out = of([1.0, 0.0, 1.0]);
    inside_out.triangles[12..].iter_mut().for_each(|corners| corners.swap(0, 1));
    assert!(matches!(Edges::of(&inside_out), Err(MeshError::Inconsistent { .. })));
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

/// Counts of triangles that are wrong, and bytes behind them, do not hide triangles that are whole.
#[test]
fn binary_stl_with_a_wrong_count_or_bytes_behind_is_read_with_a_remark() {
    let (_, binary) = stl(&corner());
    let count = (binary.len() - 84) / 50;
    let right = Mesh::from_stl(&binary, "x").unwrap();
    let with_count = |count: u32| {
        let mut bytes = binary.clone();
        bytes[80..84].copy_from_slice(&count.to_le_bytes());
        bytes
    };
    let with_rest = |rest: &[u8]| [&binary[..], rest].concat();
    let mut named = with_rest(b"some bytes");
    named[..20].copy_from_slice(b"solid facet exporter");
    for (what, bytes, words) in [
        ("no count", with_count(0), "given as 0, and there are"),
        ("too small a count", with_count(count as u32 - 1), "all"),
        ("too large a count", with_count(u32::MAX), "given as 4294967295"),
        ("a rest", with_rest(b"rest"), "4 bytes after the last triangle were left out"),
        ("a rest as long as a triangle", with_rest(&[0; 50]), "50 bytes after the last triangle"),
        ("a rest that is long", with_rest(&[0xff; 1000]), "1000 bytes after the last triangle"),
        ("a head like text", named, "10 bytes after the last triangle"),
    ] {
        let found = MeshFile::from_stl(&bytes, "test.stl").unwrap_or_else(|error| panic!("{what}: {error}"));
        assert_eq!(found.mesh, right, "{what}");
        assert!(found.remarks.len() == 1 && found.remarks[0].contains(words), "{what}: {:?}", found.remarks);
    }
    assert!(MeshFile::from_stl(&binary, "x").unwrap().remarks.is_empty());
    // A file that ends within a triangle was cut, and other bytes do not look like triangles.
    for bytes in [binary[..binary.len() - 10].to_vec(), [&with_count(7)[..84], &[0x7e; 50 * 5]].concat()] {
        let error = MeshFile::from_stl(&bytes, "test.stl").unwrap_err().to_string();
        assert!(error.contains("byte 80"), "{error}");
    }
}

#[test]
fn text_stl_may_have_any_case_and_blanks() {
    let mesh = corner();
    let (text, _) = stl(&mesh);
    let right = Mesh::from_stl(text.as_bytes(), "x").unwrap();
    let one_line = text.replace('\n', " ");
    for (what, text) in [
        ("capitals", text.to_ascii_uppercase()),
        ("other ends of lines", text.replace('\n', "\r\n")),
        ("old ends of lines", text.replace('\n', "\r")),
        ("tabs", text.replace(' ', "\t \t")),
        ("one line", one_line.clone()),
        ("a word a line", text.replace("solid test", "solid").replace(' ', "\n")),
        ("a mark of the order of bytes", format!("\u{feff}{text}")),
        ("blank lines before", format!("\n  \n{text}")),
        ("a name with words of the format", text.replace("solid test", "solid my solid facet vertex")),
        ("no name", text.replace("solid test", "solid")),
        ("normals that are no numbers", text.replace("normal 0 0 0", "normal nan nan -nan(ind)")),
        ("no normals", text.replace("normal 0 0 0", "")),
    ] {
        let found = MeshFile::from_stl(text.as_bytes(), "test.stl").unwrap_or_else(|error| panic!("{what}: {error}"));
        assert!(found.mesh == right && found.remarks.is_empty() && found.objects.len() == 1, "{what}");
    }
    let found = MeshFile::from_stl((text.clone() + "\u{1a}\0\0").as_bytes(), "test.stl").unwrap();
    assert!(found.mesh == right && found.remarks[0].contains("the text after `endsolid` was left out"), "{:?}", found.remarks);
    let [one, two] = ["first", "second one"].map(|name| one_line.replace("solid test", &format!("solid {name}")));
    let three = format!("{one}{two}\n{text}");
    let found = MeshFile::from_stl(three.as_bytes(), "three.stl").unwrap();
    let names: Vec<_> = found.objects.iter().map(|object| object.name.as_deref()).collect();
    assert_eq!(names, [Some("first"), Some("second one"), Some("test")]);
    assert!(found.object(1).closed().is_ok());
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

#[test]
fn objects_of_an_obj_are_known_by_name() {
    let cube = cuboid([1.0; 3]);
    let face = |c: &[u32; 3]| format!("f {} {} {}\n", c[0] + 1, c[1] + 1, c[2] + 1);
    let points = |at: f64| cube.points.iter().map(|p| format!("v {} {} {}\n", p[0] + at, p[1], p[2])).collect::<String>();
    let faces = |shift: u32| cube.triangles.iter().map(|c| face(&c.map(|i| i + shift))).collect::<Vec<_>>();
    let (first, second) = (faces(0), faces(8));
    // Points first, faces of one object in two places.
    let (start, rest) = first.split_at(5);
    let text =
        format!("{}{}o a\ng x\n{}o b c\n{}o a\n{}", points(0.0), points(3.0), start.concat(), second.concat(), rest.concat());
    let found = MeshFile::from_obj(text.as_bytes(), "two.obj").unwrap();
    let names: Vec<_> = found.objects.iter().map(|object| (object.name.as_deref(), object.triangles.len())).collect();
    assert_eq!(names, [(Some("a"), 12), (Some("b c"), 12)]);
    assert!(found.has_separate_objects());
    for i in 0..2 {
        let centre = found.object(i).closed().unwrap().mass().centre;
        assert!((centre[0] - 0.5 - 3.0 * i as f64).abs() < 1e-14);
    }
    // Without objects groups are objects; those of one body share points.
    let groups = format!("{}g side\n{}g rest\n{}", points(0.0), start.concat(), rest.concat());
    let found = MeshFile::from_obj(groups.as_bytes(), "one.obj").unwrap();
    assert!(found.objects.len() == 2 && !found.has_separate_objects());
    assert_eq!((found.mesh.parts().len(), MeshFile::from_obj(text.as_bytes(), "x").unwrap().mesh.parts().len()), (1, 2));
}

/// PLY of a mesh with colours, an element more, and a list of one byte before the faces: text, and binary of both orders of bytes.
fn ply(mesh: &Mesh) -> [Vec<u8>; 3] {
    let head = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\ncomment made here\nelement vertex {}\nproperty float x\nproperty float y\nproperty double z\n\
             property uchar red\nelement material 1\nproperty short number\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            mesh.points.len(),
            mesh.triangles.len()
        )
    };
    let mut text = head("ascii");
    mesh.points.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z} 255\n"));
    text += "-7\n";
    mesh.triangles.iter().for_each(|[a, b, c]| text += &format!("3 {a} {b} {c}\n"));
    let binary = |format: &str, big: bool| {
        let mut bytes = head(format).into_bytes();
        let mut put = |little: Vec<u8>| bytes.extend(if big { little.into_iter().rev().collect() } else { little });
        for [x, y, z] in &mesh.points {
            put((*x as f32).to_le_bytes().to_vec());
            put((*y as f32).to_le_bytes().to_vec());
            put(z.to_le_bytes().to_vec());
            put(vec![255]);
        }
        put((-7_i16).to_le_bytes().to_vec());
        for corners in &mesh.triangles {
            put(vec![3]);
            corners.iter().for_each(|&i| put((i as i32).to_le_bytes().to_vec()));
        }
        bytes
    };
    [text.into_bytes(), binary("binary_little_endian", false), binary("binary_big_endian", true)]
}

#[test]
fn ply_is_read_in_all_its_forms() {
    let mesh = corner();
    for bytes in ply(&mesh) {
        let found = MeshFile::from_ply(&bytes, "test.ply").unwrap_or_else(|error| panic!("{error}"));
        assert!(found.mesh == mesh && found.objects.len() == 1 && found.remarks.is_empty());
    }
    let square = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
                  property list uchar uint vertex_index\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    assert_eq!(MeshFile::from_ply(square.as_bytes(), "x").unwrap().mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    let error =
        |from: &str, to: &str| MeshFile::from_ply(square.replace(from, to).as_bytes(), "test.ply").unwrap_err().to_string();
    for (from, to, words) in [
        ("ply\n", "plx\n", "test.ply"),
        ("vertex 4", "vertex 400000000000000", "400000000000000 of the element `vertex` where"),
        ("element face 1\n", "element other 9000000000000\nelement face 1\n", "the element `other` has no properties"),
        ("face 1", "face 2", "in the element `face`"),
        ("4 0 1 2 3", "4 0 1 2", "in the element `face`"),
        ("4 0 1 2 3", "4294967295 0 1 2 3", "in the element `face`"),
        ("4 0 1 2 3", "4 0 1 2 4", "face 0 names vertex 4; expected a number below 4"),
        ("4 0 1 2 3", "2 0 1", "face 0 has 2 corners"),
        ("1 1 0", "1 nan 0", "test.ply:12: in the element `vertex`"),
        ("1 1 0", "1 1e70 0", "vertex 2 is at [1.0, inf, 0.0]"),
        ("vertex_index", "strips", "no element `face` with a list `vertex_indices`"),
        ("float z", "float w", "no element `vertex` with x, y and z"),
    ] {
        let message = error(from, to);
        assert!(message.contains(words), "{to}: {message}");
    }
}

/// The bytes of a buffer as a text in base64.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |three: &[u8]| {
        let bits = three.iter().fold(0_u32, |bits, &b| bits << 8 | u32::from(b)) << (8 * (3 - three.len()));
        let letters = (0..=three.len()).map(move |k| LETTERS[(bits >> (18 - 6 * k) & 63) as usize] as char).collect::<String>();
        letters + &"=".repeat(3 - three.len())
    };
    bytes.chunks(3).map(group).collect()
}

/// Positions and indices of a mesh as a buffer of glTF, and the document: nodes are written by the caller.
fn gltf(mesh: &Mesh, nodes: &str, uri: &str) -> (String, Vec<u8>) {
    let mut buffer: Vec<u8> = mesh.points.iter().flatten().flat_map(|&x| (x as f32).to_le_bytes()).collect();
    let positions = buffer.len();
    buffer.extend(mesh.triangles.iter().flatten().flat_map(|&i| (i as u16).to_le_bytes()));
    let uri = uri.replace("DATA", &base64(&buffer));
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": {nodes},
        "meshes": [{{"name": "it", "primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}, {{"mode": 1, "attributes": {{}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": {}}},
        {{"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": {}}}],
        "bufferViews": [{{"buffer": 0, "byteLength": {positions}}}, {{"buffer": 0, "byteOffset": {positions}, "byteLength": {}}}],
        "buffers": [{{"byteLength": {}{uri}}}]}}"#,
        mesh.points.len(),
        3 * mesh.triangles.len(),
        buffer.len() - positions,
        buffer.len()
    );
    (text, buffer)
}

fn glb(text: &str, buffer: &[u8]) -> Vec<u8> {
    let pad = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (json, binary) = (pad(text.as_bytes(), b' '), pad(buffer, 0));
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let number = |n: usize| (n as u32).to_le_bytes();
    [b"glTF", &number(2)[..], &number(length), &number(json.len()), b"JSON", &json, &number(binary.len()), b"BIN\0", &binary]
        .concat()
}

const DATA: &str = r#", "uri": "data:application/octet-stream;base64,DATA""#;

#[test]
fn gltf_is_read_with_the_transforms_of_its_nodes() {
    let mesh = corner();
    // Turned about z by a right angle, then shifted, and within it one mirrored and of twice the size.
    let nodes = r#"[{"name": "a", "mesh": 0, "translation": [10, 0, 0], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "children": [1]},
        {"mesh": 0, "matrix": [-2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1]}]"#;
    let (text, buffer) = gltf(&mesh, nodes, "");
    for bytes in [glb(&text, &buffer), gltf(&mesh, nodes, DATA).0.into_bytes()] {
        let found = MeshFile::from_gltf(&bytes, "test.glb").unwrap_or_else(|error| panic!("{error}"));
        let names: Vec<_> = found.objects.iter().map(|object| object.name.as_deref()).collect();
        assert_eq!(names, [Some("a"), Some("it")]);
        assert!(found.remarks == ["test.glb: 2 sets of points or lines were left out"], "{:?}", found.remarks);
        let [first, second] = [0, 1].map(|i| found.object(i).closed().unwrap());
        assert!(!first.turned() && !second.turned(), "a mirror keeps fronts outside");
        let own = *mesh.clone().closed().unwrap().mass();
        let [x, y, z] = own.centre;
        for (mass, volume, centre) in [
            (first.mass(), own.volume, [10.0 - y, x, z]),
            (second.mass(), 8.0 * own.volume, [10.0 - 2.0 * y, -2.0 * x, 5.0 + 2.0 * z]),
        ] {
            assert!((mass.volume / volume - 1.0).abs() < 1e-12);
            assert!((0..3).all(|k| (mass.centre[k] - centre[k]).abs() < 1e-12), "{:?} {centre:?}", mass.centre);
        }
    }
    // A buffer in a file of its own is looked for beside the document, and nowhere else.
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("the buffer.bin"), &buffer).unwrap();
    let path = folder.path().join("test.gltf");
    for (uri, words) in [
        (r#", "uri": "the%20buffer.bin""#, ""),
        (r#", "uri": "no.bin""#, "is not there"),
        (r#", "uri": "../x.bin""#, "in another place"),
    ] {
        std::fs::write(&path, gltf(&mesh, nodes, uri).0).unwrap();
        match MeshFile::load(&path) {
            Ok(found) => assert!(words.is_empty() && found.objects.len() == 2),
            Err(error) => assert!(!words.is_empty() && error.to_string().contains(words), "{error}"),
        }
    }
}

#[test]
fn wrong_gltf_is_refused_with_a_message() {
    let nodes = r#"[{"mesh": 0}]"#;
    let mesh = cuboid([1.0; 3]);
    let (text, buffer) = gltf(&mesh, nodes, "");
    for (from, to, words) in [
        (r#""2.0""#, r#""1.0""#, "not glTF 2.0"),
        (nodes, r#"[{"mesh": 3}]"#, "there is no meshes[3]"),
        (nodes, r#"[{"mesh": 0, "children": [0]}]"#, "nodes[0] is a child twice"),
        (nodes, r#"[{"mesh": 0, "children": [1, 1]}, {}]"#, "nodes[1] is a child twice"),
        (nodes, r#"[{"mesh": 0, "scale": [1, 2]}]"#, "nodes[0].scale is not 3 numbers"),
        (nodes, r#"[{"mesh": 0, "scale": [1, 2, 1e300]}]"#, "expected finite coordinates"),
        (r#""count": 8"#, r#""count": 9000000000000000000"#, "accessors[0] goes beyond its buffer"),
        (r#""count": 8"#, r#""count": 7"#, "names position 7 of 7"),
        (r#""count": 8"#, r#""sparse": {}, "count": 8"#, "accessors[0] is sparse"),
        ("5126", "5125", "accessors[0] has another type"),
        (r#""POSITION": 0"#, r#""NORMAL": 0"#, "has no POSITION"),
        (r#""indices": 1"#, r#""indices": 1, "extensions": {"KHR_draco_mesh_compression": {}}"#, "compressed by Draco"),
    ] {
        let error = MeshFile::from_gltf(&glb(&text.replace(from, to), &buffer), "test.glb").map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(words), "{to}: {error}");
    }
    assert!(MeshFile::from_gltf(&glb(&text, &buffer)[..300], "test.glb").is_err());
    // Many nodes that share one mesh ask for more than a file of this size may have.
    let many: Vec<String> = (0..200).map(|i| format!(r#"{{"mesh": 0, "translation": [{}, 0, 0]}}"#, 2 * i)).collect();
    let large = Mesh { triangles: mesh.triangles.iter().cycle().take(6000).copied().collect(), ..mesh };
    let children: Vec<String> = (1..=200).map(|i| i.to_string()).collect();
    let (text, buffer) = gltf(&large, &format!(r#"[{{"children": [{}]}}, {}]"#, children.join(", "), many.join(", ")), "");
    let error = MeshFile::from_gltf(&glb(&text, &buffer), "test.glb").map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("too many triangles"), "{error}");
}

/// A fan around the first corner of a concave face leaves the face.
#[test]
fn concave_faces_are_cut_without_leaving_them() {
    // A comb: teeth along y, seen from +z counter-clockwise, tilted.
    let outline = [[0, 0], [5, 0], [5, 3], [4, 3], [4, 1], [3, 1], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]];
    for begin in 0..outline.len() {
        let mut face: Vec<u32> = (0..outline.len() as u32).collect();
        face.rotate_left(begin);
        let points =
            outline.iter().map(|&[x, y]| [f64::from(x), f64::from(y), 0.3 * f64::from(x) + 0.1 * f64::from(y)]).collect();
        let mesh = PolygonMesh { points, faces: vec![face] }.triangulated();
        let area: f64 = (0..mesh.triangles.len()).map(|i| vector::twice_area(mesh.corners(i))[2]).sum();
        let sizes: f64 = (0..mesh.triangles.len()).map(|i| vector::twice_area(mesh.corners(i))[2].abs()).sum();
        assert_eq!(mesh.triangles.len(), outline.len() - 2);
        assert!((area - 22.0).abs() < 1e-12 && (sizes - 22.0).abs() < 1e-12, "{begin}: {area} {sizes}");
    }
    // A corner on a side, where a fan has a triangle without area.
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = PolygonMesh { points, faces: vec![vec![0, 1, 2, 3, 4]] }.triangulated();
    assert!(mesh.check().is_ok() && mesh.triangles.len() == 3);
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

/// Blocks of few faces are cut along these: pieces fill the block and do not leave it.
#[test]
fn blocks_of_few_faces_are_cut_exactly() {
    let angle = |x: f64, y: f64| [0.3 * x - 0.1 * y, 0.2 * x + y];
    let comb = [[0, 0], [5, 0], [5, 3], [4, 3], [4, 1], [3, 1], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]];
    let outline: Vec<[f64; 2]> = comb.iter().map(|&[x, y]| angle(f64::from(x), f64::from(y))).collect();
    let count = outline.len() as u32;
    let level = |z: f64| outline.iter().map(move |&[x, y]| [x, y, z]);
    let mut faces = vec![(0..count).rev().collect::<Vec<_>>(), (count..2 * count).collect()];
    faces.extend((0..count).map(|i| vec![i, (i + 1) % count, (i + 1) % count + count, i + count]));
    let comb = PolygonMesh { points: level(0.0).chain(level(0.7)).collect(), faces }.triangulated();
    // A frame: a cube with a hole through it.
    let hole = {
        let mut points = Vec::new();
        for z in [0.0, 1.0] {
            points.extend([[0.0, 0.0, z], [3.0, 0.0, z], [3.0, 3.0, z], [0.0, 3.0, z]]);
            points.extend([[1.0, 1.0, z], [2.0, 1.0, z], [2.0, 2.0, z], [1.0, 2.0, z]]);
        }
        let mut faces = Vec::new();
        for i in 0..4_u32 {
            let next = (i + 1) % 4;
            faces.push(vec![i, i + 4, next + 4, next]);
            faces.push(vec![i + 8, next + 8, next + 12, i + 12]);
            faces.push(vec![i, next, next + 8, i + 8]);
            faces.push(vec![i + 4, i + 12, next + 12, next + 4]);
        }
        PolygonMesh { points, faces }.triangulated()
    };
    for (what, mesh, most) in [("corner", corner(), 2), ("comb", comb, 4), ("frame", hole, 4)] {
        for turn in [0.0, 0.4] {
            let rotation = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), turn);
            let closed =
                moved(&mesh, rotation, DVec3::new(1.0, 2.0, 3.0)).closed().unwrap_or_else(|error| panic!("{what}: {error}"));
            let pieces = closed.pieces(Cutting::default()).unwrap();
            let volume: f64 = pieces.iter().map(|piece| convex(piece).0).sum();
            assert!(pieces.len() <= most, "{what}: {} pieces", pieces.len());
            assert!((volume / closed.mass().volume - 1.0).abs() < 1e-6, "{what}: {volume} of {}", closed.mass().volume);
        }
    }
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
        let mut all = vec![noise, text, binary, obj];
        let cube = cuboid([1.0; 3]);
        let (document, buffer) = gltf(&cube, r#"[{"mesh": 0}]"#, "");
        for mut bytes in ply(&cube).into_iter().chain([glb(&document, &buffer)]) {
            for &(place, byte) in &places {
                let place = (place * bytes.len() as f64) as usize;
                bytes[place] = byte;
            }
            all.push(bytes);
        }
        for bytes in &all {
            let found = [Mesh::from_stl(bytes, "x"), Mesh::from_obj(bytes, "x")].into_iter().flatten();
            let others = [MeshFile::from_ply(bytes, "x"), MeshFile::from_gltf(bytes, "x")].into_iter().flatten();
            for mesh in found.chain(others.map(|file| file.mesh)) {
                let _ = mesh.closed();
            }
            let _ = compas::Assembly::from_json(bytes, "x");
            let _ = Heights::rows_of(&String::from_utf8_lossy(bytes), "x");
        }
    }
}
