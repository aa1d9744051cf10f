use super::*;
use crate::files::tests::stored;

/// [1 0 4; 2 3 0].
const ENTRIES: [(usize, usize, f64); 4] = [(0, 0, 1.0), (1, 0, 2.0), (1, 1, 3.0), (0, 2, 4.0)];

#[test]
fn all_storages_have_the_same_entries() {
    let right = Csr::from_entries(2, 3, ENTRIES.into_iter());
    for kind in 0..5 {
        let matrix = stored(kind, 2, 3, &ENTRIES);
        assert_eq!(matrix.check(), Ok(()), "storage {kind}");
        assert_eq!(matrix.csr(), right, "storage {kind}");
    }
}

#[test]
fn blocks_are_column_by_column() {
    let blocks = Blocks {
        row_ends: vec![2, 3],
        column_ends: vec![2],
        starts: vec![0, 1, 2],
        columns: vec![0, 0],
        values: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
    };
    let matrix = SparseMatrix { rows: 3, columns: 2, storage: Storage::Blocks(blocks) };
    assert_eq!(matrix.check(), Ok(()));
    let entries: Vec<_> = matrix.entries().collect();
    assert_eq!(entries, [(0, 0, 1.0), (1, 0, 2.0), (0, 1, 3.0), (1, 1, 4.0), (2, 0, 5.0), (2, 1, 6.0)]);
}

#[test]
fn a_wrong_matrix_is_refused_and_its_entries_do_not_panic() {
    let lists = |starts: &[usize], columns: &[usize]| Storage::Rows {
        starts: starts.to_vec(),
        columns: columns.to_vec(),
        values: vec![1.0; columns.len()],
    };
    let blocks = |row_ends: &[usize], columns: &[usize]| {
        Storage::Blocks(Blocks {
            row_ends: row_ends.to_vec(),
            column_ends: vec![2],
            starts: vec![0, columns.len()],
            columns: columns.to_vec(),
            values: vec![1.0; 4],
        })
    };
    for (storage, right) in [
        (Storage::Dense(vec![1.0; 3]), "3 values for 2 × 2"),
        (Storage::Dense(vec![1.0, f64::INFINITY, 0.0, 0.0]), "value 1 is not finite"),
        (Storage::Triplets { rows: vec![2], columns: vec![0], values: vec![1.0] }, "row 2, and there are 2"),
        (Storage::Triplets { rows: vec![0], columns: vec![], values: vec![1.0] }, "one length"),
        (lists(&[0, 2, 1], &[0, 1]), "the starts fall from 2 to 1"),
        (lists(&[0, 1], &[0]), "one more is right"),
        (lists(&[1, 1, 2], &[0, 1]), "starts from 1"),
        (lists(&[0, 1, 2], &[0, 7]), "column 7"),
        (blocks(&[2], &[0, 0]), "4 values do not fill"),
        (blocks(&[2], &[1]), "column of blocks 1"),
        (blocks(&[1], &[0]), "the last row end is 1; 2"),
        (blocks(&[2, 1], &[0]), "the row ends fall"),
    ] {
        let matrix = SparseMatrix { rows: 2, columns: 2, storage };
        let what = matrix.check().expect_err("wrong");
        assert!(what.contains(right), "{what}");
        let _ = matrix.csr();
    }
}
