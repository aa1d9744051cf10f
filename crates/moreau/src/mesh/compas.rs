//! Assemblies of blocks as COMPAS writes them: JSON by compas_assembly (its first format and those of COMPAS 1 and 2), by compas_model and
//! compas_dem (`BlockModel`), or lists of meshes or elements.
//!
//! An object is `{ "dtype": …, "data": … }`, with COMPAS 1 `{ "dtype": …, "value": { "data": … } }`; here only the data count. The blocks are
//! the nodes of a graph, or elements that the nodes name, and interfaces its edges. An element has a transformation of its own, and follows
//! those of the groups above it in the tree and of the model. A mesh has its vertices and faces by key. Units are
//! not in the file; numbers are taken as m. Blocks come in the order of their keys, numbers before words.

mod json;

use super::{MeshError, PolygonMesh};
use json::{At, Fields};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Blocks, and where they touch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembly {
    /// In the order of their keys.
    pub blocks: Vec<Block>,
    /// In the order of the blocks; none where the file has none.
    pub interfaces: Vec<Interface>,
    /// What the file has that is left out, a sentence each.
    pub remarks: Vec<String>,
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
    /// Its density, or that of its material in the file, kg/m³.
    pub density: Option<f64>,
    /// The names of its attributes that are true, or a number that is not zero; in the order of the file's objects.
    pub flags: Vec<String>,
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
        return list(top);
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
    if let Some(blocks) = ["blocks", "meshes"].iter().find_map(|name| top.get(name)) {
        return list(&blocks);
    }
    if top.get("vertex").is_some() || top.get("vertices").is_some() || top.get("geometry").is_some() {
        return Ok(Assembly { blocks: vec![any("0".into(), top)?], ..Assembly::default() });
    }
    Err(top.fault("no assembly", "expected `graph`, `node`, `elements`, `assembly` with `blocks`, or a list of meshes"))
}

/// The blocks of a list of meshes or elements, in which lists stand for their items. Keys are numbers from 0.
fn list(top: &At<'_>) -> Result<Assembly, MeshError> {
    fn add<'a>(at: &At<'a>, depth: usize, all: &mut Vec<At<'a>>) -> Result<(), MeshError> {
        if let (Value::Array(_), 0..8) = (at.value, depth) {
            return at.items()?.iter().try_for_each(|item| add(item, depth + 1, all));
        }
        if let Value::Object(_) = at.value
            && at.get("vertex").is_none()
            && at.get("vertices").is_none()
            && at.get("geometry").is_none()
            && depth == 0
        {
            return at.fields()?.iter().try_for_each(|(_, item)| add(item, depth + 1, all));
        }
        all.push(at.clone());
        Ok(())
    }
    let mut all = Vec::new();
    add(top, 0, &mut all)?;
    let blocks = all.iter().enumerate().map(|(i, at)| any(i.to_string(), at)).collect::<Result<_, _>>()?;
    Ok(Assembly { blocks, ..Assembly::default() })
}

/// A block by its mesh, or by an element that has one.
fn any(key: String, at: &At<'_>) -> Result<Block, MeshError> {
    if at.get("geometry").is_some() { element(key, at, &BTreeMap::new()) } else { block(key, at, None) }
}

/// What a node's key or an element's id stands for.
fn named<'a>(all: &Fields<'a>, key: &str, node: &At<'_>) -> Result<At<'a>, MeshError> {
    let found = all.iter().find(|(known, _)| known == key).map(|(_, value)| value.clone());
    found.ok_or_else(|| node.fault(format!("no block `{key}`"), "expected one for each node"))
}

/// A model of compas_model or compas_dem: elements by id, which the nodes of the graph name; those that none names come last. In a list,
/// the id of an element is its guid, or its number.
fn model(top: &At<'_>, elements: &At<'_>) -> Result<Assembly, MeshError> {
    let elements: Fields<'_> = if let Value::Array(all) = elements.value {
        let guid = |i: usize| all[i].get("guid").and_then(Value::as_str).map_or_else(|| i.to_string(), str::to_owned);
        elements.items()?.into_iter().enumerate().map(|(i, at)| (guid(i), at)).collect()
    } else {
        elements.fields()?
    };
    let densities = densities(top)?;
    let moves = moves(top)?;
    let (solid, empty): (Fields<'_>, Fields<'_>) = elements.into_iter().partition(|(_, at)| at.get("geometry").is_some());
    let graph = top.get("graph").filter(|graph| graph.get("node").is_some());
    let mut unnamed: Vec<&str> = solid.iter().map(|(id, _)| &**id).collect();
    let moved = |key: String, id: &str, at: &At<'_>| {
        let mut block = element(key, at, &densities)?;
        let moves = moves.get(id).or_else(|| moves.get(""));
        moves.into_iter().flatten().for_each(|rows| transform(&mut block, rows));
        Ok(block)
    };
    let mut assembly = match &graph {
        Some(graph) => of_graph_with_gaps(graph, "node", |key, node| {
            let id = node.need("element")?;
            let id = id.key()?;
            if empty.iter().any(|(known, _)| *known == id) {
                // Groups have no geometry of their own.
                return Ok(None);
            }
            unnamed.retain(|&known| known != id);
            moved(key.to_owned(), &id, &named(&solid, &id, node)?).map(Some)
        })?,
        None => Assembly::default(),
    };
    let is_list = graph.is_none() && top.get("elements").is_some_and(|elements| elements.value.is_array());
    for (number, (id, at)) in solid.iter().enumerate().filter(|(_, (id, _))| unnamed.contains(&&**id)) {
        let key = if is_list { number.to_string() } else { id.clone() };
        assembly.blocks.push(moved(key, id, at)?);
    }
    if graph.as_ref().map(has_modifiers).transpose()?.unwrap_or(false) {
        assembly.remarks.push("modifiers (cuts of blocks by others) are left out: geometries are read without them".to_owned());
    }
    Ok(assembly)
}

/// True if an edge of the graph has modifiers.
fn has_modifiers(graph: &At<'_>) -> Result<bool, MeshError> {
    let Some(edges) = graph.get("edge") else { return Ok(false) };
    for (_, ends) in edges.fields()? {
        for (_, edge) in ends.fields()? {
            if edge.get("modifiers").is_some_and(|all| all.value.as_array().is_some_and(|all| !all.is_empty())) {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// A density, which is positive.
fn density_of(at: &At<'_>) -> Result<f64, MeshError> {
    let density = at.number()?;
    if density > 0.0 {
        Ok(density)
    } else {
        Err(at.fault(format!("a density of {density}"), "expected a positive number, in kg/m³"))
    }
}

/// The density of each material of a model, kg/m³, by id.
fn densities(top: &At<'_>) -> Result<BTreeMap<String, f64>, MeshError> {
    let mut densities = BTreeMap::new();
    let Some(materials) = top.get("materials") else { return Ok(densities) };
    let all: Fields<'_> = match materials.value {
        Value::Array(all) => {
            let guid = |i: usize| all[i].get("guid").and_then(Value::as_str).map_or_else(|| i.to_string(), str::to_owned);
            materials.items()?.into_iter().enumerate().map(|(i, at)| (guid(i), at)).collect()
        }
        _ => materials.fields()?,
    };
    for (id, material) in all {
        if let Some(density) = material.get("density") {
            densities.insert(id, density_of(&density)?);
        }
    }
    Ok(densities)
}

/// Three rows of a transformation, each a point's factors and a shift.
type Rows = [[f64; 4]; 3];

/// What moves each element apart from its own transformation: those of the groups above it in the tree, the innermost first, then the model's. The
/// id "" stands for elements that are not in the tree.
fn moves(top: &At<'_>) -> Result<BTreeMap<String, Vec<Rows>>, MeshError> {
    let of_model: Vec<Rows> = top.get("transformation").map(|at| rows(&at)).transpose()?.into_iter().collect();
    let mut moves = BTreeMap::from([(String::new(), of_model.clone())]);
    let Some(root) = top.get("tree").and_then(|tree| tree.get("root")) else { return Ok(moves) };
    let Some(elements) = top.get("elements").filter(|elements| elements.value.is_object()) else { return Ok(moves) };
    // JSON is at most 128 levels deep, so that there are few groups above any element.
    let mut open = vec![(root, of_model)];
    while let Some((node, above)) = open.pop() {
        let Some(children) = node.get("children") else { continue };
        for child in children.items()? {
            let id = child.get("element").and_then(|id| id.text().map(str::to_owned));
            let own = id.as_ref().and_then(|id| elements.get(id)?.get("transformation"));
            let mut inside: Vec<Rows> = own.map(|at| rows(&at)).transpose()?.into_iter().collect();
            inside.extend(&above);
            if let Some(id) = id {
                moves.insert(id, above.clone());
            }
            open.push((child, inside));
        }
    }
    Ok(moves)
}

fn rows(transformation: &At<'_>) -> Result<Rows, MeshError> {
    let rows = transformation.need("matrix")?.items()?;
    let rows = rows.iter().map(json::At::numbers::<4>).collect::<Result<Vec<_>, _>>()?;
    let [x, y, z, ..] = rows.as_slice() else {
        return Err(transformation.fault("a matrix of fewer than 3 rows", "expected 4 rows of 4 numbers"));
    };
    Ok([*x, *y, *z])
}

fn transform(block: &mut Block, rows: &Rows) {
    for point in &mut block.mesh.points {
        *point = rows.map(|row| row[0] * point[0] + row[1] * point[1] + row[2] * point[2] + row[3]);
    }
}

/// An element: a geometry and where it is, and a material by its id.
fn element(key: String, element: &At<'_>, densities: &BTreeMap<String, f64>) -> Result<Block, MeshError> {
    let mut block = block(key, &element.need("geometry")?, Some(element))?;
    if let Some(name) = element.get("name").and_then(|name| name.text().map(str::to_owned)) {
        block.name = Some(name);
    }
    if block.density.is_none() {
        let material = element.get("material");
        block.density = material.and_then(|id| densities.get(&id.key().ok()?).copied());
    }
    if let Some(transformation) = element.get("transformation") {
        transform(&mut block, &rows(&transformation)?);
    }
    Ok(block)
}

/// The blocks of a graph's nodes and the interfaces of its edges.
fn of_graph<'a>(
    graph: &At<'a>,
    nodes: &str,
    mut read: impl FnMut(&str, &At<'a>) -> Result<Block, MeshError>,
) -> Result<Assembly, MeshError> {
    of_graph_with_gaps(graph, nodes, |key, node| read(key, node).map(Some))
}

/// The same where not every node is a block; edges of others are passed over.
fn of_graph_with_gaps<'a>(
    graph: &At<'a>,
    nodes: &str,
    mut read: impl FnMut(&str, &At<'a>) -> Result<Option<Block>, MeshError>,
) -> Result<Assembly, MeshError> {
    // Attributes that a node lacks are the graph's.
    let defaults = ["default_node_attributes", "node_attributes", "default_vertex_attributes", "dva"];
    let held = defaults.iter().find_map(|name| graph.get(name)?.get("is_support")).is_some_and(|flag| flag.is_set());
    let mut assembly = Assembly::default();
    let mut gaps = BTreeSet::new();
    for (key, node) in graph.need(nodes)?.fields()? {
        let Some(mut block) = read(&key, &node)? else {
            gaps.insert(key);
            continue;
        };
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
            if gaps.contains(&from) || gaps.contains(&to) {
                continue;
            }
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
    let attributes = mesh.get("attributes");
    let of_any = |name: &str| node.and_then(|node| node.get(name)).or_else(|| attribute(name));
    let material = of_any("material").and_then(|material| material.get("density"));
    let density = of_any("density").or(material).map(|density| density_of(&density)).transpose()?;
    let sources = node.into_iter().chain(&attributes);
    let flags = sources.map(At::flags).collect::<Vec<_>>().concat();
    let support = of_any("is_support").is_some_and(|flag| flag.is_set());
    Ok(Block { key, name, mesh: polygon_mesh(mesh)?.of_file(), support, density, flags })
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
