//! Writes the files that the fuzz targets start from: small problems of every kind and storage, in both formats.
//!
//! ```sh
//! cargo run --release -p moreau-solve --features files --example fuzz_seeds -- fuzz/seeds
//! ```

use moreau_solve::files::{self, Bilateral, Blocks, Csr, Equations, Info, Iterate, ProblemFile, SparseMatrix, Storage};
use std::path::Path;

/// A matrix with a strong diagonal and an entry beside it, in storage `kind` of five.
fn matrix(kind: usize, rows: usize, columns: usize) -> SparseMatrix {
    let entries = (0..rows.min(columns)).map(|i| (i, i, 2.0 + i as f64)).chain([(0, columns - 1, 0.25), (rows - 1, 0, 0.25)]);
    let csr = Csr::from_entries(rows, columns, entries);
    let storage = match kind {
        0 => {
            let mut values = vec![0.0; rows * columns];
            csr.entries().for_each(|(i, j, x)| values[i + j * rows] = x);
            Storage::Dense(values)
        }
        1 => Storage::Blocks(Blocks {
            row_ends: vec![1, rows],
            column_ends: vec![1, columns],
            starts: vec![0, 1, 2],
            columns: vec![0, 1],
            values: (0..1 + (rows - 1) * (columns - 1)).map(|k| k as f64).collect(),
        }),
        2 => return SparseMatrix::from_entries(rows, columns, csr.entries()),
        3 => {
            let Csr { starts, indices, values, .. } = csr.transposed();
            Storage::Columns { starts, rows: indices, values }
        }
        _ => return csr.into(),
    };
    SparseMatrix { rows, columns, storage }
}

fn problem(kind: usize, global: bool, dimension: usize, rolling: bool) -> ProblemFile {
    let contacts = 1 + kind % 2;
    let size = dimension * contacts;
    let equations = if global {
        let (m, h) = (matrix(kind, 3, 3), matrix((kind + 1) % 5, 3, size));
        Equations::Global { m, h, f: vec![-1.0; 3], w: vec![0.5; size], bilateral: None }
    } else {
        Equations::Local { w: matrix(kind, size, size), q: vec![-1.0; size] }
    };
    ProblemFile::new(dimension, equations, vec![0.5; contacts], rolling.then(|| vec![0.1; contacts]))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("name the folder of seeds")?;
    let folder = Path::new(&folder);
    for (kind, storage) in ["dense", "blocks", "triplets", "columns", "rows"].into_iter().enumerate() {
        for (dimension, rolling) in [(2, false), (3, false), (3, true), (5, true)] {
            for global in [false, true] {
                let mut problem = problem(kind, global, dimension, rolling);
                let form = if global { "global" } else { "local" };
                let name = format!("{form}_{dimension}{}_{storage}", if rolling { "r" } else { "" });
                files::write(&folder.join("problem_text").join(&name).with_extension("dat"), &problem)?;
                let size = dimension * problem.contacts();
                problem.info = Info { title: Some("seed".to_owned()), description: None, math_info: Some(String::new()) };
                problem.guesses = vec![Iterate { r: vec![0.0; size], u: vec![1.0; size], v: None }];
                problem.solution = problem.guesses.first().cloned();
                if let Equations::Global { bilateral, .. } = &mut problem.equations {
                    *bilateral = (kind == 0).then(|| Bilateral { g: matrix(2, 3, 1), b: vec![0.5] });
                }
                files::write(&folder.join("problem_fclib").join(&name).with_extension("hdf5"), &problem)?;
            }
        }
    }
    Ok(())
}
