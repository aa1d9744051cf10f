//! Assemblies of blocks as COMPAS writes them: JSON by compas_assembly (its first format and those of COMPAS 1 and 2), by compas_dem
//! (`BlockModel`), or a list of meshes.
//!
//! An object is `{ "dtype": …, "data": … }`, with COMPAS 1 `{ "dtype": …, "value": { "data": … } }`; here only the data count. The blocks are
//! the nodes of a graph, or elements that the nodes name, and interfaces its edges. A mesh has its vertices and faces by key. Units are
//! not in the file; numbers are taken as m. Blocks come in the order of their keys, numbers before words.

mod json;

use super::{MeshError, PolygonMesh};
use json::{At, Fields};
use serde_json::Value;
use std::collections::BTreeMap;

/// Blocks, and where they touch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembly {
    /// In the order of their keys.
    pub blocks: Vec<Block>,
    /// In the order of the blocks; none where the file has none.
    pub interfaces: Vec<Interface>,
}

/// A block.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// What the file knows it by.
    pub key: String,
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Its surface, in the place of the block, m.
    pub mesh: PolygonMesh,
    /// Whether it is held.
    pub support: bool,
}

/// Where two blocks touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Indices of the two blocks.
    pub blocks: [usize; 2],
    /// The corners of what they share, m.
    pub points: Vec<[f64; 3]>,
}

impl Assembly {
    /// Reads an assembly; `file` is what errors call the bytes.
    ///
    /// # Errors
    /// What is no JSON, with its line, or no assembly, with the way to what is wrong.
    pub fn from_json(bytes: &[u8], file: &str) -> Result<Self, MeshError> {
        let document: Value = serde_json::from_slice(bytes).map_err(|e| {
            let place = super::Place::Line(e.line());
            MeshError::read(file, place, format!("not valid JSON: {e}"), "expected a file that COMPAS wrote")
        })?;
        assembly(&At::top(&document, file))
    }
}

fn assembly(top: &At<'_>) -> Result<Assembly, MeshError> {
    if let Value::Array(_) = top.value {
        let blocks =
            top.items()?.iter().enumerate().map(|(i, mesh)| block(i.to_string(), mesh, None)).collect::<Result<_, _>>()?;
        return Ok(Assembly { blocks, interfaces: Vec::new() });
    }
    if let Some(elements) = top.get("elements") {
        return model(top, &elements);
    }
    if let (Some(graph), Some(blocks)) = (top.get("assembly"), top.get("blocks")) {
        let blocks = blocks.fields()?;
        let node = |key: &str, node: &At<'_>| block(key.to_owned(), &named(&blocks, key, node)?, Some(node));
        return of_graph(&graph, "vertex", node);
    }
    let graph = top.get("graph").unwrap_or_else(|| top.clone());
    if graph.get("node").is_some() {
        return of_graph(&graph, "node", |key, node| block(key.to_owned(), &node.need("block")?, Some(node)));
    }
    if top.get("vertex").is_some() || top.get("vertices").is_some() {
        return Ok(Assembly { blocks: vec![block("0".into(), top, None)?], interfaces: Vec::new() });
    }
    Err(top.fault("no assembly", "expected `graph`, `node`, `elements`, `assembly` with `blocks`, or a list of meshes"))
}

/// What a node's key or an element's id stands for.
fn named<'a>(all: &Fields<'a>, key: &str, node: &At<'_>) -> Result<At<'a>, MeshError> {
    let found = all.iter().find(|(known, _)| known == key).map(|(_, value)| value.clone());
    found.ok_or_else(|| node.fault(format!("no block `{key}`"), "expected one for each node"))
}

/// A model of compas_dem: elements by id, which the nodes of the graph name; those that none names come last.
fn model(top: &At<'_>, elements: &At<'_>) -> Result<Assembly, MeshError> {
    let elements = elements.fields()?;
    let graph = top.get("graph").filter(|graph| graph.get("node").is_some());
    let mut unnamed: Vec<&str> = elements.iter().map(|(id, _)| &**id).collect();
    let mut assembly = match &graph {
        Some(graph) => of_graph(graph, "node", |key, node| {
            let id = node.need("element")?;
            let id = id.text().ok_or_else(|| id.fault("not the id of an element", "expected a string"))?;
            unnamed.retain(|&known| known != id);
            element(key.to_owned(), &named(&elements, id, node)?)
        })?,
        None => Assembly::default(),
    };
    for (id, at) in elements.iter().filter(|(id, _)| unnamed.contains(&&**id)) {
        assembly.blocks.push(element(id.clone(), at)?);
    }
    Ok(assembly)
}

/// A block of compas_dem: a geometry and where it is.
fn element(key: String, element: &At<'_>) -> Result<Block, MeshError> {
    let mut block = block(key, &element.need("geometry")?, Some(element))?;
    if let Some(name) = element.get("name").and_then(|name| name.text().map(str::to_owned)) {
        block.name = Some(name);
    }
    if let Some(transformation) = element.get("transformation") {
        let rows = transformation.need("matrix")?.items()?;
        let rows = rows.iter().map(json::At::numbers::<4>).collect::<Result<Vec<_>, _>>()?;
        let [x, y, z, ..] = rows.as_slice() else {
            return Err(transformation.fault("a matrix of fewer than 3 rows", "expected 4 rows of 4 numbers"));
        };
        for point in &mut block.mesh.points {
            *point = [x, y, z].map(|row| row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3]);
        }
    }
    Ok(block)
}

/// The blocks of a graph's nodes and the interfaces of its edges.
fn of_graph<'a>(
    graph: &At<'a>,
    nodes: &str,
    mut read: impl FnMut(&str, &At<'a>) -> Result<Block, MeshError>,
) -> Result<Assembly, MeshError> {
    // Attributes that a node lacks are the graph's.
    let defaults = ["default_node_attributes", "node_attributes", "default_vertex_attributes", "dva"];
    let held = defaults.iter().find_map(|name| graph.get(name)?.get("is_support")).is_some_and(|flag| flag.is_set());
    let mut assembly = Assembly::default();
    for (key, node) in graph.need(nodes)?.fields()? {
        let mut block = read(&key, &node)?;
        block.support |= held && node.get("is_support").is_none();
        assembly.blocks.push(block);
    }
    let Some(edges) = graph.get("edge") else { return Ok(assembly) };
    let place = |key: &str, at: &At<'_>| {
        let place = assembly.blocks.iter().position(|block| block.key == key);
        place.ok_or_else(|| at.fault(format!("an edge to `{key}`"), "expected the key of a node"))
    };
    let mut interfaces = Vec::new();
    for (from, ends) in edges.fields()? {
        for (to, edge) in ends.fields()? {
            let blocks = [place(&from, &ends)?, place(&to, &ends)?];
            for points in polygons(&edge)? {
                interfaces.push(Interface { blocks, points });
            }
        }
    }
    assembly.interfaces = interfaces;
    Ok(assembly)
}

/// The polygons of an edge: `interfaces` or `contacts`, each with points; one `interface`; or `interface_points` alone.
fn polygons(edge: &At<'_>) -> Result<Vec<Vec<[f64; 3]>>, MeshError> {
    let corners = |points: &At<'_>| points.items()?.iter().map(At::numbers::<3>).collect();
    if let Some(points) = edge.get("interface_points") {
        return Ok(vec![corners(&points)?]);
    }
    let many = edge.get("interfaces").or_else(|| edge.get("contacts"));
    let all = match many {
        Some(many) => many.items()?,
        None => edge.get("interface").into_iter().collect(),
    };
    all.iter().map(|one| corners(&one.need("points")?)).collect()
}

/// A block by its mesh and the node or element that says more of it.
fn block(key: String, mesh: &At<'_>, node: Option<&At<'_>>) -> Result<Block, MeshError> {
    let attribute = |name: &str| mesh.get("attributes").and_then(|attributes| attributes.get(name));
    let name = attribute("name").and_then(|name| name.text().map(str::to_owned));
    let flag = node.and_then(|node| node.get("is_support")).or_else(|| attribute("is_support"));
    Ok(Block { key, name, mesh: polygon_mesh(mesh)?.of_file(), support: flag.is_some_and(|flag| flag.is_set()) })
}

/// A mesh: `vertex` and `face` by key, or a polyhedron's lists `vertices` and `faces`.
fn polygon_mesh(mesh: &At<'_>) -> Result<PolygonMesh, MeshError> {
    if let (Some(vertices), Some(faces)) = (mesh.get("vertices"), mesh.get("faces")) {
        let points = vertices.items()?.iter().map(At::numbers::<3>).collect::<Result<Vec<_>, _>>()?;
        let index = (0..points.len() as u32).map(|i| (i.to_string(), i)).collect();
        let faces = faces.items()?.iter().map(|one| face(one, &index)).collect::<Result<_, _>>()?;
        return Ok(PolygonMesh { points, faces });
    }
    let defaults = mesh.get("default_vertex_attributes").or_else(|| mesh.get("dva"));
    let (mut index, mut points) = (BTreeMap::new(), Vec::new());
    for (key, vertex) in mesh.need("vertex")?.fields()? {
        let mut point = [0.0; 3];
        for (x, axis) in point.iter_mut().zip(["x", "y", "z"]) {
            let given = vertex.get(axis).or_else(|| defaults.as_ref().and_then(|defaults| defaults.get(axis)));
            *x = given.ok_or_else(|| vertex.fault(format!("no {axis}"), "expected x, y and z"))?.number()?;
        }
        index.insert(key, points.len() as u32);
        points.push(point);
    }
    let faces = mesh.need("face")?.fields()?;
    let faces = faces.iter().map(|(_, one)| face(one, &index)).collect::<Result<_, _>>()?;
    Ok(PolygonMesh { points, faces })
}

/// The corners of a face: a list of the keys of vertices, or of the oldest format a key after each key, around the face.
fn face(face: &At<'_>, index: &BTreeMap<String, u32>) -> Result<Vec<u32>, MeshError> {
    let corners = if let Value::Array(_) = face.value { face.items()? } else { cycle(face)? };
    if corners.len() < 3 {
        return Err(face.fault(format!("a face with {} corners", corners.len()), "expected 3 or more"));
    }
    let vertex = |corner: &At<'_>| {
        let key = corner.key()?;
        index.get(&key).copied().ok_or_else(|| corner.fault(format!("no vertex `{key}`"), "expected the key of a vertex"))
    };
    corners.iter().map(vertex).collect()
}

fn cycle<'a>(face: &At<'a>) -> Result<Vec<At<'a>>, MeshError> {
    let after = face.fields()?;
    let mut corners: Vec<At<'a>> = Vec::new();
    let Some((first, _)) = after.first() else { return Ok(corners) };
    let mut key = first.clone();
    for _ in 0..after.len() {
        let next = after.iter().find(|(from, _)| *from == key).map(|(_, to)| to.clone());
        let next = next.ok_or_else(|| face.fault(format!("nothing after `{key}`"), "expected a way around the face"))?;
        key = next.key()?;
        corners.push(next);
    }
    Ok(corners)
}

#[cfg(test)]
mod tests;
