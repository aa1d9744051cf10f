//! PLY: text, and binary of either order of bytes.
//!
//! The elements `vertex` (x, y, z) and `face` (a list `vertex_indices` or `vertex_index`) count; others are passed over. The crate ply-rs-bw
//! knows the grammar. What it does not limit is limited here: a header may ask for more elements than the file has bytes.

use super::obj::of_polygons;
use super::{LARGEST, MOST_TRIANGLES, MeshError, MeshFile, Place, PolygonMesh};
use ply_rs_bw::parser::{Parser, Reader};
use ply_rs_bw::ply::{Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType, ScalarType};

/// The most points: as many as there may be corners of triangles.
const MOST_POINTS: usize = 3 * MOST_TRIANGLES;

pub(super) fn read(bytes: &[u8], file: &str) -> Result<MeshFile, MeshError> {
    let fault = |place: Place, message: String, hint: &str| MeshError::read(file, place, message, hint);
    let place = |line: Option<usize>| line.map_or(Place::File, Place::Line);
    let mut reader = Reader::new(bytes);
    let header = Parser::<Vertex>::new().read_header(&mut reader).map_err(|error| {
        fault(
            place(error.line()),
            format!("not a header of PLY: {}", in_one_line(&error)),
            "expected `ply`, `format`, elements, `end_header`",
        )
    })?;
    let rest = reader.get_ref().len();
    for element in header.elements.values() {
        let least = smallest(&header, element.properties.values().map(|property| &property.data_type));
        if element.properties.is_empty() && element.count > 0 {
            return Err(fault(Place::File, format!("the element `{}` has no properties", shown(&element.name)), "expected some"));
        }
        if element.count.checked_mul(least).is_none_or(|size| size > rest.saturating_add(1)) || element.count > MOST_POINTS {
            let message =
                format!("{} of the element `{}` where {rest} bytes follow the header", element.count, shown(&element.name));
            return Err(fault(Place::File, message, "expected as many as there are in the file"));
        }
    }
    let mut mesh = PolygonMesh::default();
    let mut triangles = 0_usize;
    let has = |name: &str, wanted: &[&str]| {
        let element = header.elements.get(name);
        element.is_some_and(|element| wanted.iter().any(|wanted| element.properties.contains_key(*wanted)))
    };
    if !["x", "y", "z"].iter().all(|axis| has("vertex", &[axis])) {
        return Err(fault(Place::File, "no element `vertex` with x, y and z".into(), "expected one"));
    }
    if !has("face", &LISTS) {
        let hint = "expected triangles or polygons; strips and clouds of points are not read";
        return Err(fault(Place::File, "no element `face` with a list `vertex_indices`".into(), hint));
    }
    for element in header.elements.values() {
        let failed = |error: ply_rs_bw::parser::ParseError| {
            let message = format!("in the element `{}`: {}", shown(&element.name), in_one_line(&error));
            let line = if header.encoding == Encoding::Ascii { error.line() } else { None };
            fault(place(line), message, "expected the values that the header names")
        };
        match element.name.as_str() {
            "vertex" => {
                let all = Parser::<Vertex>::new().read_payload_for_element(&mut reader, element, &header).map_err(failed)?;
                mesh.points = all.into_iter().map(|vertex| vertex.0).collect();
            }
            "face" => {
                let all = Parser::<Face>::new().read_payload_for_element(&mut reader, element, &header).map_err(failed)?;
                triangles += all.iter().map(|face| face.0.len().saturating_sub(2)).sum::<usize>();
                mesh.faces = all.into_iter().map(|face| face.0).collect();
            }
            _ => {
                Parser::<Other>::new().read_payload_for_element(&mut reader, element, &header).map_err(failed)?;
            }
        }
    }
    if triangles > MOST_TRIANGLES {
        return Err(fault(Place::File, "too many triangles".into(), &format!("expected at most {MOST_TRIANGLES}")));
    }
    if let Some(i) = mesh.points.iter().position(|point| !point.iter().all(|x| x.abs() < LARGEST)) {
        let message = format!("vertex {i} is at {:?}", mesh.points[i]);
        return Err(fault(Place::File, message, "expected three finite numbers, below 1e60"));
    }
    let count = mesh.points.len();
    for (i, face) in mesh.faces.iter().enumerate() {
        if face.len() < 3 {
            return Err(fault(Place::File, format!("face {i} has {} corners", face.len()), "expected 3 or more"));
        }
        if let Some(corner) = face.iter().find(|&&corner| corner as usize >= count) {
            let message = format!("face {i} names vertex {}", i64::from(*corner as i32));
            return Err(fault(Place::File, message, &format!("expected a number below {count}, that of the vertices")));
        }
    }
    let faces = (0..mesh.faces.len()).collect();
    Ok(of_polygons(&mesh.of_file(), vec![(None, faces)]))
}

/// The names of the list of a face's corners.
const LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// The least number of bytes that an element takes: of its properties, or in text a digit and a blank each.
fn smallest<'a>(header: &Header, properties: impl Iterator<Item = &'a PropertyType>) -> usize {
    let is_text = header.encoding == Encoding::Ascii;
    let size = |scalar: &ScalarType| match scalar {
        _ if is_text => 2,
        ScalarType::Char | ScalarType::UChar => 1,
        ScalarType::Short | ScalarType::UShort => 2,
        ScalarType::Int | ScalarType::UInt | ScalarType::Float => 4,
        ScalarType::Double => 8,
    };
    properties
        .map(|property| match property {
            PropertyType::Scalar(scalar) => size(scalar),
            PropertyType::List(count, _) => size(count),
        })
        .sum()
}

/// What the library says of an error, in one line.
fn in_one_line(error: &impl std::fmt::Display) -> String {
    let text: String = error.to_string().chars().map(|c| if c.is_control() { ' ' } else { c }).take(400).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn shown(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).take(40).collect()
}

struct Vertex([f64; 3]);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Self([f64::NAN; 3])
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Some(axis) = ["x", "y", "z"].iter().position(|axis| *axis == name) else { return PropertyAccessResult::Ignored };
        self.0[axis] = match property {
            Property::Double(x) => x,
            Property::Float(x) => f64::from(x),
            Property::Char(x) => f64::from(x),
            Property::UChar(x) => f64::from(x),
            Property::Short(x) => f64::from(x),
            Property::UShort(x) => f64::from(x),
            Property::Int(x) => f64::from(x),
            Property::UInt(x) => f64::from(x),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

/// The corners of a face. A number below zero becomes one that no vertex has.
struct Face(Vec<u32>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Self(Vec::new())
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !LISTS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        fn whole<T: Into<i64>>(all: Vec<T>) -> Vec<u32> {
            all.into_iter().map(|i| u32::try_from(i.into()).unwrap_or(u32::MAX)).collect()
        }
        self.0 = match property {
            Property::ListInt(all) => whole(all),
            Property::ListUInt(all) => all,
            Property::ListChar(all) => whole(all),
            Property::ListUChar(all) => whole(all),
            Property::ListShort(all) => whole(all),
            Property::ListUShort(all) => whole(all),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

/// An element that is passed over.
struct Other;

impl PropertyAccess for Other {
    fn new() -> Self {
        Self
    }
}
