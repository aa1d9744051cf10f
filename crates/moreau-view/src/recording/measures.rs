//! The granular measures of a run, as its `measures.csv` has them.

use serde_json::{Map, Value};
use std::path::Path;

/// So many rows a chart can show.
const ROWS: usize = 2000;

/// Columns of numbers by their names; none where the run wrote no measures.
#[derive(Default)]
pub(super) struct Measures {
    columns: Vec<(String, Vec<f64>)>,
}

impl Measures {
    /// Reads all whole rows: a run that goes on, or was killed, may have written a part of the last.
    pub(super) fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        let mut lines = whole.lines();
        let names: Vec<&str> = lines.next().map_or(Vec::new(), |header| header.split(',').collect());
        let mut columns: Vec<_> = names.iter().map(|&name| (name.to_owned(), Vec::new())).collect();
        for line in lines {
            let cells: Vec<&str> = line.split(',').collect();
            if cells.len() == columns.len() {
                // What is no number is drawn nowhere.
                columns.iter_mut().zip(cells).for_each(|((_, values), cell)| values.push(cell.parse().unwrap_or(f64::NAN)));
            }
        }
        Self { columns }
    }

    /// A column by its name; empty where there is none.
    pub(super) fn column(&self, name: &str) -> &[f64] {
        self.columns.iter().find(|(known, _)| known == name).map_or(&[], |(_, values)| values.as_slice())
    }

    /// All columns for charts, evenly thinned where they are long.
    pub(super) fn json(&self) -> Value {
        let rows = self.columns.first().map_or(0, |(_, values)| values.len());
        let every = rows.div_ceil(ROWS).max(1);
        let thinned = |values: &[f64]| values.iter().copied().step_by(every).collect::<Vec<f64>>().into();
        self.columns.iter().map(|(name, values)| (name.clone(), thinned(values))).collect::<Map<_, _>>().into()
    }
}
