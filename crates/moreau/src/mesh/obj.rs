//! Wavefront OBJ: the lines `v x y z` and `f a b c …`, where a corner is `v`, `v/vt`, `v//vn` or `v/vt/vn` and v counts points from 1, or
//! backwards from the last one so far, −1. Faces may have vertices of their own: equal points become one. A line that ends in `\` goes on in the next one. Normals, textures, groups, materials, lines
//! and curves are passed over.

use super::stl::{point, shown};
use super::{MOST_TRIANGLES, MeshError, Place, PolygonMesh};

/// The most points: as many as there may be corners of triangles.
const MOST_POINTS: usize = 3 * MOST_TRIANGLES;

pub(super) fn read(bytes: &[u8], file: &str) -> Result<PolygonMesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut mesh = PolygonMesh::default();
    let mut triangles = 0;
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
            }
            _ => {}
        }
    }
    Ok(mesh.of_file())
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
