//! ParaView's XML PolyData files (`.vtp`) and the collections that give them their times (`.pvd`).
//!
//! A [`PolyData`] borrows what the caller already has (points, flat arrays) and [`write()`] puts it into one file, or a
//! [`Writer`] one after the other into many; a [`Series`] names the files of a run with their times. Files of both kinds appear whole or not at all: they are written beside their
//! place and renamed, so a reader that looks while the run goes on never meets half a file.
//!
//! The layout is the one that VTK reads fastest: an XML head that can be read with `head`, then one `AppendedData`
//! section of raw little-endian bytes, compressed in blocks with zlib (see `vtk/appended.rs` for the bytes).
//!
//! ```
//! # use moreau::io::vtk::{self, Array, PolyData, Series};
//! # let folder = tempfile::tempdir()?;
//! # let folder = folder.path();
//! let points = [[0.0, 0.0, 0.5], [1.0, 0.0, 0.5]];
//! let velocity = [[0.0, 0.0, -1.0], [0.0, 0.0, 0.0]];
//! let data = PolyData {
//!     points: &points,
//!     point_data: vec![Array::scalars("radius", &[0.5, 0.5]), Array::vectors("velocity", &velocity)],
//!     time: 0.25,
//!     ..PolyData::default()
//! };
//! vtk::write(&folder.join("bodies_0001.vtp"), &data)?;
//!
//! let mut series = Series::new(folder.join("bodies.pvd"));
//! series.push(data.time, "bodies_0001.vtp")?;
//! series.save()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod appended;
mod array;
mod cells;
mod check;
mod error;
mod file;
mod noise;
mod series;
#[cfg(test)]
mod tests;

pub use array::{Array, Values};
pub use cells::Cells;
pub use error::VtkError;
pub use series::Series;

use std::fmt::Write as _;
use std::path::Path;

use super::whole;
use appended::Appended;

/// Points in space, the cells on them and the arrays on both, at one time.
///
/// Two dimensions are written as z = 0. The cells are numbered as VTK numbers them: the vertices first (one for each
/// point, in order), then the lines, then the polygons; `cell_data` follows that order.
#[derive(Clone, Debug)]
pub struct PolyData<'a> {
    /// The positions.
    pub points: &'a [[f64; 3]],
    /// Whether each point is also a vertex cell. ParaView draws no point that belongs to no cell, so this is on by
    /// default; turn it off where polygons use all the points.
    pub verts: bool,
    /// Lines through `points`, by their indices.
    pub lines: &'a Cells,
    /// Polygons, by the indices of their corners.
    pub polys: &'a Cells,
    /// Arrays with one tuple a point.
    pub point_data: Vec<Array<'a>>,
    /// Arrays with one tuple a cell.
    pub cell_data: Vec<Array<'a>>,
    /// The time, written as the field array `TimeValue`, which is where ParaView looks for it.
    pub time: f64,
}

impl Default for PolyData<'_> {
    fn default() -> Self {
        let (lines, polys) = (&cells::NONE, &cells::NONE);
        Self { points: &[], verts: true, lines, polys, point_data: Vec::new(), cell_data: Vec::new(), time: 0.0 }
    }
}

impl PolyData<'_> {
    /// The number of vertex cells.
    fn vert_count(&self) -> usize {
        if self.verts { self.points.len() } else { 0 }
    }

    /// The number of cells of all kinds.
    fn cell_count(&self) -> usize {
        self.vert_count() + self.lines.len() + self.polys.len()
    }
}

/// Writes one `.vtp` file, replacing what stood at `path`.
///
/// # Errors
/// The data do not fit together (lengths, indices, names, time), in which case nothing is written, or the file cannot
/// be written. Every error names `path`.
pub fn write(path: &Path, data: &PolyData) -> Result<(), VtkError> {
    Writer::default().write(path, data)
}

/// Writes the files of a series, all of the same arrays; what one of them has in common with the one before costs little.
///
/// The files are those that [`write()`] makes, byte for byte. A writer keeps its buffers, and with them the arrays of the last file.
#[derive(Debug, Default)]
pub struct Writer {
    head: String,
    body: Appended,
}

impl Writer {
    /// Writes one `.vtp` file, replacing what stood at `path`.
    ///
    /// # Errors
    /// As for [`write()`].
    pub fn write(&mut self, path: &Path, data: &PolyData) -> Result<(), VtkError> {
        check::poly_data(path, data)?;
        self.render(data).map_err(|source| VtkError::io(path, source))?;
        // The disk is not asked to sync: these are results to look at, and a sync a frame would cost more than the frame.
        let parts = [self.head.as_bytes(), self.body.bytes(), b"\n  </AppendedData>\n</VTKFile>\n"];
        whole::write(path, &parts).map_err(|source| VtkError::io(path, source))
    }

    /// The XML up to and with the underscore that opens the appended section, and that section.
    ///
    /// The arrays are compressed first because the head must state where each of them starts.
    fn render(&mut self, data: &PolyData) -> std::io::Result<()> {
        let Self { head: x, body } = self;
        x.clear();
        body.clear();
        *x += "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" ";
        *x += "byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n  <PolyData>\n";

        let time = [data.time];
        *x += "    <FieldData>\n";
        array(x, body, &Array::scalars("TimeValue", &time), " NumberOfTuples=\"1\"")?;
        *x += "    </FieldData>\n";

        let (points, verts) = (data.points.len(), data.vert_count());
        let (lines, polys) = (data.lines.len(), data.polys.len());
        let _ = write!(x, "    <Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{verts}\"");
        let _ = writeln!(x, " NumberOfLines=\"{lines}\" NumberOfPolys=\"{polys}\">");
        for (tag, arrays) in [("PointData", &data.point_data), ("CellData", &data.cell_data)] {
            let _ = writeln!(x, "      <{tag}>");
            for a in arrays {
                array(x, body, a, "")?;
            }
            let _ = writeln!(x, "      </{tag}>");
        }
        *x += "      <Points>\n";
        array(x, body, &Array::vectors("Points", data.points), "")?;
        *x += "      </Points>\n";
        cells(x, body, "Verts", 0..verts, 1..=verts)?;
        for (tag, of) in [("Lines", data.lines), ("Polys", data.polys)] {
            cells(x, body, tag, of.points().iter().copied(), of.ends().iter().copied())?;
        }
        *x += "    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n   _";
        Ok(())
    }
}

/// One `DataArray` of the caller's.
fn array(x: &mut String, body: &mut Appended, a: &Array, extra: &str) -> std::io::Result<()> {
    let (kind, offset) = match a.values {
        Values::F64(v) => ("Float64", body.push(v.iter().map(|w| w.to_le_bytes()))?),
        Values::F32(v) => ("Float32", body.push(v.iter().map(|w| w.to_le_bytes()))?),
        Values::I32(v) => ("Int32", body.push(v.iter().map(|w| w.to_le_bytes()))?),
        Values::I64(v) => ("Int64", body.push(v.iter().map(|w| w.to_le_bytes()))?),
        Values::U8(v) => ("UInt8", body.push(v.iter().map(|w| w.to_le_bytes()))?),
    };
    let (name, components) = (file::escape(a.name), a.components);
    data_array(x, kind, &format!("Name=\"{name}\" NumberOfComponents=\"{components}\"{extra}"), offset);
    Ok(())
}

/// The cells of one kind: the point indices of all of them in a row, and where each one ends in that row.
fn cells(
    x: &mut String,
    body: &mut Appended,
    tag: &str,
    points: impl Iterator<Item = usize>,
    ends: impl Iterator<Item = usize>,
) -> std::io::Result<()> {
    let _ = writeln!(x, "      <{tag}>");
    // usize and i64 agree on every index that a slice can have, so the cast loses nothing.
    let offset = body.push(points.map(|i| (i as i64).to_le_bytes()))?;
    data_array(x, "Int64", "Name=\"connectivity\"", offset);
    let offset = body.push(ends.map(|i| (i as i64).to_le_bytes()))?;
    data_array(x, "Int64", "Name=\"offsets\"", offset);
    let _ = writeln!(x, "      </{tag}>");
    Ok(())
}

/// The line that announces an array of the appended section.
fn data_array(x: &mut String, kind: &str, attributes: &str, offset: usize) {
    let _ = writeln!(x, "        <DataArray type=\"{kind}\" {attributes} format=\"appended\" offset=\"{offset}\"/>");
}
