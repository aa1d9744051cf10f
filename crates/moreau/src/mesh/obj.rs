//! Wavefront OBJ: the lines `v x y z` and `f a b c …`, where a corner is `v`, `v/vt`, `v//vn` or `v/vt/vn` and v counts points from 1, or
//! backwards from the last one so far, −1. Faces may have vertices of their own: equal points become one. A line that ends in `\` goes on in
//! the next one. Faces belong to the object of the last line `o`, and in a file without such lines to the group of the last line `g`. Normals,
//! textures, materials, lines and curves are passed over.

use super::polygons::triangles_of;
use super::stl::{point, shown};
use super::{MOST_TRIANGLES, Mesh, MeshError, MeshFile, Object, Place, PolygonMesh};
use std::collections::BTreeMap;

/// The most points: as many as there may be corners of triangles.
const MOST_POINTS: usize = 3 * MOST_TRIANGLES;

/// The names that lines `o` or `g` have given, and to which of them each face belongs.
#[derive(Default)]
struct Names {
    numbers: BTreeMap<String, u32>,
    current: Option<u32>,
    of_faces: Vec<Option<u32>>,
}

impl Names {
    fn begin(&mut self, name: &str) {
        let next = self.numbers.len() as u32;
        self.current = Some(*self.numbers.entry(shown(name)).or_insert(next));
    }

    /// The objects with the numbers of their faces. Faces before the first name are an object without one.
    fn objects(&self) -> Vec<(Option<String>, Vec<usize>)> {
        let mut objects = vec![(None, Vec::new()); self.numbers.len() + 1];
        self.numbers.iter().for_each(|(name, &number)| objects[number as usize + 1].0 = Some(name.clone()));
        for (face, owner) in self.of_faces.iter().enumerate() {
            objects[owner.map_or(0, |number| number as usize + 1)].1.push(face);
        }
        objects.retain(|(_, faces)| !faces.is_empty());
        objects
    }
}

pub(super) fn read(bytes: &[u8], file: &str) -> Result<MeshFile, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = PolygonMesh::default();
    let mut triangles = 0;
    let (mut objects, mut groups) = (Names::default(), Names::default());
    let mut lines = text.lines().enumerate();
    while let Some((i, line)) = lines.next() {
        let (mut line, place) = (std::borrow::Cow::from(line), Place::Line(i + 1));
        while line.ends_with('\\') {
            let rest = lines.next().map_or("", |(_, rest)| rest);
            line = format!("{} {rest}", &line[..line.len() - 1]).into();
        }
        let mut words = line.split('#').next().unwrap_or_default().split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                mesh.points.push(point(words, file, i + 1)?);
                if mesh.points.len() > MOST_POINTS {
                    return Err(MeshError::read(file, place, "too many points", format!("expected at most {MOST_POINTS}")));
                }
            }
            Some("f") => {
                let face = words.map(|word| corner(word, mesh.points.len(), file, place)).collect::<Result<Vec<_>, _>>()?;
                if face.len() < 3 {
                    let message = format!("a face with {} corners", face.len());
                    return Err(MeshError::read(file, place, message, "expected 3 or more"));
                }
                triangles += face.len() - 2;
                if triangles > MOST_TRIANGLES {
                    let hint = format!("expected at most {MOST_TRIANGLES}");
                    return Err(MeshError::read(file, place, "too many triangles", hint));
                }
                mesh.faces.push(face);
                objects.of_faces.push(objects.current);
                groups.of_faces.push(groups.current);
            }
            Some("o") => objects.begin(&words.collect::<Vec<_>>().join(" ")),
            Some("g") => groups.begin(&words.collect::<Vec<_>>().join(" ")),
            _ => {}
        }
    }
    let names = if objects.numbers.is_empty() { groups } else { objects };
    Ok(of_polygons(&mesh.of_file(), names.objects()))
}

/// The triangles of polygons, which keep the order of the faces, and the objects that have these faces.
pub(super) fn of_polygons(mesh: &PolygonMesh, objects: Vec<(Option<String>, Vec<usize>)>) -> MeshFile {
    let (mut triangles, mut first) = (Vec::new(), vec![0]);
    for face in &mesh.faces {
        triangles.extend(triangles_of(&mesh.points, face));
        first.push(triangles.len() as u32);
    }
    let object = |(name, faces): (Option<String>, Vec<usize>)| Object {
        name,
        triangles: faces.iter().flat_map(|&face| first[face]..first[face + 1]).collect(),
    };
    let objects = objects.into_iter().map(object).collect();
    MeshFile { mesh: Mesh { points: mesh.points.clone(), triangles }, objects, remarks: Vec::new() }
}

/// The index of a point, from 0.
fn corner(word: &str, count: usize, file: &str, place: Place) -> Result<u32, MeshError> {
    let named = word.split('/').next().and_then(|index| index.parse::<i64>().ok());
    let index = named.and_then(|index| {
        let size = usize::try_from(index.unsigned_abs()).ok()?;
        if index > 0 { Some(size - 1) } else { count.checked_sub(size) }
    });
    index.filter(|&index| index < count).and_then(|index| u32::try_from(index).ok()).ok_or_else(|| {
        let hint = format!("expected a point from 1 to {count}, or from -{count} to -1: those before this line");
        MeshError::read(file, place, format!("a corner `{}`", shown(word)), hint)
    })
}
