//! Height fields.

use super::stl::shown;
use super::{MOST_TRIANGLES, Mesh, MeshError, Place};

/// Heights over a rectangular grid: `rows[j][i]` is z at x = `spacing[0]` i, y = `spacing[1]` j, from the origin on.
#[derive(Clone, Debug, PartialEq)]
pub struct Heights {
    /// The place of `rows[0][0]` at height 0, m.
    pub origin: [f64; 3],
    /// Distance of neighbours along x and along y, m.
    pub spacing: [f64; 2],
    /// Heights, m; rows of one length.
    pub rows: Vec<Vec<f64>>,
}

impl Heights {
    /// The heights of a file of numbers: a row a line, numbers set apart by commas, semicolons or blanks. Empty lines and those that begin
    /// with `#` are passed over.
    ///
    /// # Errors
    /// What is no number or a row of another length, with its line.
    pub fn rows_of(text: &str, file: &str) -> Result<Vec<Vec<f64>>, MeshError> {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for (i, line) in text.lines().enumerate() {
            let fault = |message: String, hint: String| MeshError::read(file, Place::Line(i + 1), message, hint);
            let words = line.split(|c: char| c == ',' || c == ';' || c.is_whitespace()).filter(|word| !word.is_empty());
            if line.trim_start().starts_with('#') {
                continue;
            }
            let number = |word: &str| {
                let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
                number.ok_or_else(|| fault(format!("`{}`", shown(word)), "expected a finite number".into()))
            };
            let row = words.map(number).collect::<Result<Vec<f64>, _>>()?;
            if let Some(first) = rows.first().filter(|first| !row.is_empty() && first.len() != row.len()) {
                return Err(fault(format!("{} heights", row.len()), format!("expected {}, as in the first row", first.len())));
            }
            if !row.is_empty() {
                rows.push(row);
            }
        }
        Ok(rows)
    }

    /// The surface: each cell of the grid as two triangles that face up, cut from its corner of lowest x and y to that of highest. A rugged
    /// cell is so made plane on both sides of that line, whichever way it bends.
    ///
    /// # Errors
    /// Fewer than two rows or columns, rows of different lengths, or too many cells.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        let (columns, rows) = (self.rows.first().map_or(0, Vec::len), self.rows.len());
        let wrong = |what, value: usize, range| Err(MeshError::Setting { what, value: value as f64, range });
        if columns < 2 {
            return wrong("the number of heights in a row", columns, "at least 2");
        }
        if rows < 2 {
            return wrong("the number of rows of heights", rows, "at least 2");
        }
        if let Some(other) = self.rows.iter().find(|row| row.len() != columns) {
            return wrong("the number of heights in a later row", other.len(), "as many as in the first row");
        }
        for value in self.spacing {
            if !(value > 0.0 && value.is_finite()) {
                return Err(MeshError::Setting { what: "the spacing of heights", value, range: "a positive number, in m" });
            }
        }
        let cells = (columns - 1).saturating_mul(rows - 1);
        if cells > MOST_TRIANGLES / 2 {
            return Err(MeshError::TooMany { count: cells, what: "cells of a height field", most: MOST_TRIANGLES / 2 });
        }
        let ([x, y, z], [dx, dy]) = (self.origin, self.spacing);
        let mut mesh = Mesh::default();
        for (j, row) in self.rows.iter().enumerate() {
            mesh.points.extend(row.iter().enumerate().map(|(i, height)| [x + i as f64 * dx, y + j as f64 * dy, z + height]));
        }
        for j in 0..rows - 1 {
            for i in 0..columns - 1 {
                let [low, high] = [(j * columns + i) as u32, ((j + 1) * columns + i) as u32];
                mesh.triangles.push([low, low + 1, high + 1]);
                mesh.triangles.push([low, high + 1, high]);
            }
        }
        Ok(mesh)
    }
}
