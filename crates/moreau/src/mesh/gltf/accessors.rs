//! Numbers in the buffers of glTF.

use super::{File, whole};
use crate::mesh::MeshError;
use serde_json::Value;

/// The bytes of an accessor, one item after the other.
struct Items<'a> {
    bytes: &'a [u8],
    count: usize,
    stride: usize,
    component: usize,
}

impl<'a> Items<'a> {
    fn each(&self, size: usize) -> impl Iterator<Item = &'a [u8]> {
        let (bytes, stride) = (self.bytes, self.stride);
        (0..self.count).map(move |i| &bytes[i * stride..][..size])
    }
}

/// The positions of an accessor: three numbers of 32 bits each.
pub(super) fn points(file: &File<'_>, accessor: usize) -> Result<Vec<[f64; 3]>, MeshError> {
    let items = items(file, accessor, "VEC3", &[(5126, 12)])?;
    let number = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    Ok(items.each(12).map(|b| [number(b), number(&b[4..]), number(&b[8..])]).collect())
}

/// The whole numbers of an accessor, of 8, 16 or 32 bits.
pub(super) fn indices(file: &File<'_>, accessor: usize) -> Result<Vec<u32>, MeshError> {
    let items = items(file, accessor, "SCALAR", &[(5121, 1), (5123, 2), (5125, 4)])?;
    Ok(match items.component {
        5121 => items.each(1).map(|b| u32::from(b[0])).collect(),
        5123 => items.each(2).map(|b| u32::from(u16::from_le_bytes([b[0], b[1]]))).collect(),
        _ => items.each(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect(),
    })
}

/// The items of an accessor of this kind; `sizes` has the kinds of numbers with the bytes of an item.
fn items<'a>(file: &'a File<'_>, number: usize, kind: &str, sizes: &[(usize, usize)]) -> Result<Items<'a>, MeshError> {
    let at = file.item("accessors", number)?;
    let fault = |message: &str, hint: &str| file.fault(format!("accessors[{number}] {message}"), hint);
    if at.get("sparse").is_some() {
        return Err(fault("is sparse", "expected all numbers in one buffer view"));
    }
    let component = whole(at.get("componentType")).unwrap_or(0);
    let size = sizes.iter().find(|(known, _)| *known == component).map(|(_, size)| *size);
    let (Some(size), true) = (size, at.get("type").and_then(Value::as_str) == Some(kind)) else {
        return Err(fault(
            "has another type",
            &format!("expected {kind} of componentType {:?}", sizes.iter().map(|s| s.0).collect::<Vec<_>>()),
        ));
    };
    let view =
        whole(at.get("bufferView")).ok_or_else(|| fault("has no bufferView", "expected one; compressed meshes are not read"))?;
    let view = file.item("bufferViews", view)?;
    let count = whole(at.get("count")).unwrap_or(0);
    let buffer = whole(view.get("buffer")).unwrap_or(usize::MAX);
    let start = whole(view.get("byteOffset")).unwrap_or(0);
    let length = whole(view.get("byteLength")).unwrap_or(0);
    let offset = whole(at.get("byteOffset")).unwrap_or(0);
    let stride = whole(view.get("byteStride")).unwrap_or(size);
    let bytes = file.buffers.get(buffer).and_then(|bytes| bytes.get(start..start.checked_add(length)?));
    let bytes = bytes.and_then(|bytes| bytes.get(offset..));
    // The last item need not fill its stride.
    let needed = count.checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
    match (bytes, needed) {
        (Some(bytes), Some(needed)) if needed <= bytes.len() && stride >= size => Ok(Items { bytes, count, stride, component }),
        _ => Err(fault("goes beyond its buffer", "expected a file that is whole")),
    }
}
