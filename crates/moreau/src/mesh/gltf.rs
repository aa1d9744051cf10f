//! glTF 2.0: JSON with its buffers in it or beside it (`.gltf`), or all in one binary file (`.glb`).
//!
//! The triangles of each node with a mesh are an object, moved by the transforms of the node and of those above it. Coordinates are taken as
//! they are; by the specification y points up. Points and lines, skins, targets of morphing, materials and cameras are passed over. Sparse and
//! compressed accessors are refused.
//!
//! Nodes may share meshes, and accessors may share bytes, so that a small file can ask for many triangles; [`per_byte`] limits that.

mod accessors;
mod buffers;

use super::stl::shown;
use super::{LARGEST, MOST_TRIANGLES, Mesh, MeshError, MeshFile, Object, Place};
use accessors::{indices, points};
use serde_json::Value;
use std::path::Path;

/// The most triangles of a file of so many bytes.
fn per_byte(bytes: usize) -> usize {
    bytes.saturating_mul(4).saturating_add(1 << 16).min(MOST_TRIANGLES)
}

/// Turns and shifts a point: three rows of four.
type Rows = [[f64; 4]; 3];

const HERE: Rows = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

/// A file: its JSON and its buffers.
struct File<'a> {
    json: Value,
    buffers: Vec<Vec<u8>>,
    name: &'a str,
    most: usize,
}

impl File<'_> {
    fn fault(&self, message: impl Into<String>, hint: &str) -> MeshError {
        MeshError::read(self.name, Place::File, message, hint)
    }

    /// Item `index` of a list of the document.
    fn item(&self, list: &str, index: usize) -> Result<&Value, MeshError> {
        let found = self.json.get(list).and_then(|all| all.get(index));
        found.ok_or_else(|| self.fault(format!("there is no {list}[{index}]"), "expected a number of an item of that list"))
    }
}

/// Reads a file; buffers that are files of their own are looked for in `folder`.
pub(super) fn read(bytes: &[u8], file: &str, folder: Option<&Path>) -> Result<MeshFile, MeshError> {
    let (json, binary) = buffers::chunks(bytes, file)?;
    let json: Value = serde_json::from_slice(json).map_err(|error| {
        MeshError::read(file, Place::Line(error.line()), format!("not valid JSON: {error}"), "expected glTF 2.0")
    })?;
    let version = json.get("asset").and_then(|asset| asset.get("version")).and_then(Value::as_str);
    if !version.is_some_and(|version| version.starts_with("2.")) {
        return Err(MeshError::read(file, Place::File, "not glTF 2.0", "expected `asset` with a `version` of 2.0"));
    }
    let buffers = buffers::read(&json, binary, file, folder)?;
    let size = bytes.len() + buffers.iter().map(Vec::len).sum::<usize>();
    let document = File { json, buffers, name: file, most: per_byte(size) };
    let mut found = MeshFile::default();
    walk(&document, &mut found)?;
    let extent = |k: usize| {
        let values = found.mesh.points.iter().map(|p| p[k]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (high - low).max(0.0)
    };
    let tolerance = super::polygons::ONE_POINT * (0..3).map(extent).fold(0.0, f64::max);
    Ok(found.merged(tolerance))
}

/// Adds the triangles of all nodes of the scene: the one that the file begins with, else the first; without scenes, of all nodes that are
/// children of none.
fn walk(file: &File<'_>, found: &mut MeshFile) -> Result<(), MeshError> {
    let count = file.json.get("nodes").and_then(Value::as_array).map_or(0, Vec::len);
    let roots = if file.json.get("scenes").is_some() {
        let number = whole(file.json.get("scene")).unwrap_or(0);
        numbers(file.item("scenes", number)?.get("nodes"))
    } else {
        let nodes = file.json.get("nodes").and_then(Value::as_array).into_iter().flatten();
        let children: std::collections::BTreeSet<usize> = nodes.flat_map(|node| numbers(node.get("children"))).collect();
        (0..count).filter(|i| !children.contains(i)).collect()
    };
    let mut seen = vec![false; count];
    let mut open: Vec<(usize, Rows)> = roots.into_iter().rev().map(|node| (node, HERE)).collect();
    let mut left_out = 0;
    while let Some((number, above)) = open.pop() {
        let node = file.item("nodes", number)?;
        if std::mem::replace(&mut seen[number], true) {
            return Err(file.fault(format!("nodes[{number}] is a child twice"), "expected a tree of nodes"));
        }
        let place = times(&above, &transform(file, node, number)?);
        if let Some(mesh) = whole(node.get("mesh")) {
            left_out += object(file, found, (node, mesh), &place)?;
        }
        open.extend(numbers(node.get("children")).into_iter().rev().map(|child| (child, place)));
    }
    if left_out > 0 {
        found.remarks.push(format!("{}: {left_out} sets of points or lines were left out", file.name));
    }
    Ok(())
}

/// Adds the triangles of a mesh of a node. Returns the number of primitives that are not triangles.
fn object(file: &File<'_>, found: &mut MeshFile, (node, number): (&Value, usize), place: &Rows) -> Result<usize, MeshError> {
    let mesh = file.item("meshes", number)?;
    let name = [node, mesh].iter().find_map(|at| at.get("name").and_then(Value::as_str)).map(shown);
    let first = found.mesh.triangles.len() as u32;
    let mut left_out = 0;
    for primitive in mesh.get("primitives").and_then(Value::as_array).into_iter().flatten() {
        if primitive.get("extensions").is_some_and(|all| all.get("KHR_draco_mesh_compression").is_some()) {
            return Err(file.fault(format!("meshes[{number}] is compressed by Draco"), "expected triangles without compression"));
        }
        let mode = primitive.get("mode").map_or(Some(4), |mode| whole(Some(mode)));
        let Some(mode @ 4..=6) = mode else {
            left_out += 1;
            continue;
        };
        let attribute = primitive.get("attributes").and_then(|all| whole(all.get("POSITION")));
        let attribute = attribute
            .ok_or_else(|| file.fault(format!("meshes[{number}] has no POSITION"), "expected one for each primitive"))?;
        let all = points(file, attribute)?;
        let order = match whole(primitive.get("indices")) {
            Some(accessor) => indices(file, accessor)?,
            None => (0..all.len() as u32).collect(),
        };
        add(file, found, (mode, &all, &order), place)?;
    }
    let triangles = (first..found.mesh.triangles.len() as u32).collect();
    found.objects.push(Object { name, triangles });
    Ok(left_out)
}

/// Adds triangles: a list (mode 4), a strip (5) or a fan (6). Each has corners of its own; equal ones are merged later.
fn add(
    file: &File<'_>,
    found: &mut MeshFile,
    (mode, all, order): (usize, &[[f64; 3]], &[u32]),
    place: &Rows,
) -> Result<(), MeshError> {
    let triangles: Box<dyn Iterator<Item = [u32; 3]>> = match mode {
        4 => Box::new(order.chunks_exact(3).map(|c| [c[0], c[1], c[2]])),
        5 => {
            Box::new(order.windows(3).enumerate().map(|(i, c)| if i % 2 == 0 { [c[0], c[1], c[2]] } else { [c[1], c[0], c[2]] }))
        }
        _ => Box::new(order.windows(2).skip(1).map(|c| [order[0], c[0], c[1]])),
    };
    // A mirror turns fronts into backs.
    let mirrored = determinant(place) < 0.0;
    let Mesh { points, triangles: done } = &mut found.mesh;
    for corners in triangles {
        if done.len() >= file.most {
            return Err(file.fault("too many triangles", &format!("expected at most {}, for a file of this size", file.most)));
        }
        let base = points.len() as u32;
        for corner in corners {
            let point = all.get(corner as usize);
            let hint = "expected the number of a position";
            let point = point.ok_or_else(|| file.fault(format!("a corner names position {corner} of {}", all.len()), hint))?;
            let point = place.map(|row| row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3]);
            if !point.iter().all(|x| x.abs() < LARGEST) {
                return Err(file.fault(format!("a position at {point:?}"), "expected finite coordinates, below 1e60"));
            }
            points.push(point);
        }
        done.push(if mirrored { [base, base + 2, base + 1] } else { [base, base + 1, base + 2] });
    }
    Ok(())
}

/// Where a node is in the one above it: a matrix, or a shift, a turn (quaternion) and factors.
fn transform(file: &File<'_>, node: &Value, number: usize) -> Result<Rows, MeshError> {
    let list = |key: &str| -> Result<Option<Vec<f64>>, MeshError> {
        let Some(value) = node.get(key) else { return Ok(None) };
        let found = value.as_array().and_then(|all| all.iter().map(Value::as_f64).collect::<Option<Vec<_>>>());
        let wanted = [("matrix", 16), ("rotation", 4)].iter().find(|(name, _)| *name == key).map_or(3, |(_, count)| *count);
        let found = found.filter(|all| all.len() == wanted);
        found
            .map(Some)
            .ok_or_else(|| file.fault(format!("nodes[{number}].{key} is not {wanted} numbers"), "expected a transform"))
    };
    if let Some(m) = list("matrix")? {
        // Column by column.
        return Ok([0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| m[4 * column + row])));
    }
    let shift = list("translation")?.unwrap_or_else(|| vec![0.0; 3]);
    let size = list("scale")?.unwrap_or_else(|| vec![1.0; 3]);
    let turn = list("rotation")?.unwrap_or_else(|| vec![0.0, 0.0, 0.0, 1.0]);
    let length = turn.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length.is_nan() || length <= 0.0 {
        return Err(file.fault(format!("nodes[{number}].rotation is {turn:?}"), "expected a quaternion of length 1"));
    }
    let [x, y, z, w] = [0, 1, 2, 3].map(|k| turn[k] / length);
    let rotation = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ];
    Ok([0, 1, 2].map(|k| [rotation[k][0] * size[0], rotation[k][1] * size[1], rotation[k][2] * size[2], shift[k]]))
}

fn times(a: &Rows, b: &Rows) -> Rows {
    let entry = |row: usize, column: usize| {
        let sum: f64 = (0..3).map(|k| a[row][k] * b[k][column]).sum();
        if column == 3 { sum + a[row][3] } else { sum }
    };
    [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| entry(row, column)))
}

fn determinant([a, b, c]: &Rows) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// A whole number, not negative.
fn whole(value: Option<&Value>) -> Option<usize> {
    value.and_then(Value::as_u64).and_then(|number| usize::try_from(number).ok())
}

fn numbers(list: Option<&Value>) -> Vec<usize> {
    list.and_then(Value::as_array).into_iter().flatten().filter_map(|value| whole(Some(value))).collect()
}
