//! Refuses data that would make a broken file: VTK reads the head, trusts it, and fails far from the cause.

use std::path::Path;

use super::{Array, Cells, PolyData, VtkError};

/// Whether the parts of `data` fit together.
pub(super) fn poly_data(path: &Path, data: &PolyData) -> Result<(), VtkError> {
    time(path, data.time)?;
    let points = data.points.len();
    indices(path, "line", data.lines, points)?;
    indices(path, "polygon", data.polys, points)?;
    arrays(path, "point", &data.point_data, points)?;
    arrays(path, "cell", &data.cell_data, data.cell_count())
}

/// Whether cells name points that are there.
fn indices(path: &Path, kind: &'static str, cells: &Cells, points: usize) -> Result<(), VtkError> {
    let Some(place) = cells.points().iter().position(|&index| index >= points) else { return Ok(()) };
    let cell = cells.ends().partition_point(|&end| end <= place);
    Err(VtkError::Index { path: path.to_owned(), kind, cell, index: cells.points()[place], points })
}

/// Whether a time can stand in a file.
pub(super) fn time(path: &Path, time: f64) -> Result<(), VtkError> {
    if time.is_finite() { Ok(()) } else { Err(VtkError::Time { path: path.to_owned(), time }) }
}

/// Whether a name can stand in an XML attribute: XML 1.0 has no way at all to write most control characters.
pub(super) fn name(path: &Path, name: &str) -> Result<(), VtkError> {
    let refuse = |reason| Err(VtkError::Name { path: path.to_owned(), name: name.to_owned(), reason });
    if name.is_empty() {
        return refuse("is empty");
    }
    if name.chars().any(|c| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}')) {
        return refuse("has a character that XML cannot hold");
    }
    Ok(())
}

/// Whether each array has a name of its own and one tuple for each of `count` points or cells.
fn arrays(path: &Path, place: &'static str, arrays: &[Array], count: usize) -> Result<(), VtkError> {
    for (i, a) in arrays.iter().enumerate() {
        name(path, a.name)?;
        if arrays[..i].iter().any(|b| b.name == a.name) {
            let reason = "stands for two arrays of one table, of which a reader would keep one";
            return Err(VtkError::Name { path: path.to_owned(), name: a.name.to_owned(), reason });
        }
        let found = a.values.len();
        if a.components == 0 || count.checked_mul(a.components) != Some(found) {
            let (path, array, components) = (path.to_owned(), a.name.to_owned(), a.components);
            return Err(VtkError::Length { path, place, array, found, count, components });
        }
    }
    Ok(())
}
