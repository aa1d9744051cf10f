use super::hdf5::Branch;
use super::*;

/// What a test puts in place of a part of a sound file.
type Change<'a> = (&'a str, &'a dyn Fn(&mut Branch, &str));

fn put(group: &mut Branch, name: &str, changes: &[Change<'_>], usual: impl FnOnce(&mut Branch)) {
    match changes.iter().find(|change| change.0 == name) {
        Some(change) => change.1(group, name.rsplit('/').next().unwrap_or(name)),
        None => usual(group),
    }
}

/// A local problem of one contact in the plane, W = diag(2, 4) by rows, with changes; `root` names its group.
fn file(root: &str, changes: &[Change<'_>]) -> Vec<u8> {
    let mut branch = Branch::new(root);
    put(&mut branch, "spacedim", changes, |g| g.indices("spacedim", &[2]).expect("small"));
    branch
        .group("W", |g| {
            for (name, value) in [("m", 2), ("n", 2), ("nz", -2), ("nzmax", 2)] {
                put(g, &format!("W/{name}"), changes, |g| g.integers(name, [value].into_iter()).expect("small"));
            }
            put(g, "W/p", changes, |g| g.indices("p", &[0, 1, 2]).expect("small"));
            put(g, "W/i", changes, |g| g.indices("i", &[0, 1]).expect("small"));
            put(g, "W/x", changes, |g| g.reals("x", &[2.0, 4.0]));
            Ok(())
        })
        .expect("a group");
    branch
        .group("vectors", |g| {
            put(g, "q", changes, |g| g.reals("q", &[-1.0, 3.0]));
            put(g, "mu", changes, |g| g.reals("mu", &[0.5]));
            Ok(())
        })
        .expect("a group");
    hdf5::bytes(vec![branch]).expect("a file")
}

fn refused(root: &str, changes: &[Change<'_>]) -> String {
    read_fclib(&file(root, changes)).expect_err("a wrong file").to_string()
}

#[test]
fn the_three_forms_of_a_matrix_are_one() {
    let right = read_fclib(&file("fclib_local", &[])).expect("sound");
    let form = |value: i64| move |g: &mut Branch, name: &str| g.integers(name, [value].into_iter()).expect("small");
    let columns = read_fclib(&file("fclib_local", &[("W/nz", &form(-1))])).expect("sound");
    // Lists that are longer than there are entries.
    let triplets = read_fclib(&file(
        "fclib_local",
        &[
            ("W/nz", &form(2)),
            ("W/p", &|g, name| g.indices(name, &[0, 1, 9, 9]).expect("small")),
            ("W/i", &|g, name| g.indices(name, &[0, 1, 9, 9]).expect("small")),
            ("W/x", &|g, name| g.reals(name, &[2.0, 4.0, 9.0, 9.0])),
        ],
    ));
    assert_eq!(columns.same_as(&right), Ok(()));
    assert_eq!(triplets.expect("sound").same_as(&right), Ok(()));
}

#[test]
fn sizes_decide_on_the_components_of_rolling_contacts() {
    for (dimension, claimed, good) in [(3, 2, true), (3, 3, true), (3, 5, false), (5, 3, true), (5, 5, true), (5, 2, false)] {
        let mut root = Branch::new("fclib_local_rolling");
        root.indices("spacedim", &[claimed]).expect("small");
        let written = root.group("W", |g| {
            g.indices("m", &[dimension])?;
            g.indices("n", &[dimension])?;
            g.indices("nz", &[0])?;
            g.indices("p", &[])?;
            g.indices("i", &[])?;
            g.reals("x", &[]);
            Ok(())
        });
        written.expect("a group");
        let written = root.group("vectors", |g| {
            g.reals("q", &vec![1.0; dimension]);
            g.reals("mu", &[0.5]);
            g.reals("mu_r", &[0.25]);
            Ok(())
        });
        written.expect("a group");
        let read = read_fclib(&hdf5::bytes(vec![root]).expect("a file"));
        assert_eq!(read.as_ref().map(|p| p.dimension).ok(), good.then_some(dimension), "{read:?}");
    }
}

#[test]
fn equality_constraints_are_kept() {
    let mut problem = read_fclib(&file("fclib_local", &[])).expect("sound");
    let identity = SparseMatrix::from_entries(2, 2, (0..2).map(|i| (i, i, 1.0)));
    let bilateral = Some(Bilateral { g: SparseMatrix::from_entries(2, 1, [(1, 0, 1.0)].into_iter()), b: vec![0.5] });
    problem.equations = Equations::Global { m: identity.clone(), h: identity, f: vec![0.0; 2], w: vec![0.0; 2], bilateral };
    let back = read_fclib(&write_fclib(&problem).expect("a file")).expect("sound");
    assert_eq!(back, problem);
    assert!(crate::files::write_text(&problem).expect_err("no place").to_string().starts_with("G: "));
}

#[test]
fn errors_name_the_dataset() {
    let integer = |value: i64| move |g: &mut Branch, name: &str| g.integers(name, [value].into_iter()).expect("small");
    let numbers = |values: &'static [usize]| move |g: &mut Branch, name: &str| g.indices(name, values).expect("small");
    let reals = |values: &'static [f64]| move |g: &mut Branch, name: &str| g.reals(name, values);
    let nothing = |_: &mut Branch, _: &str| {};
    let cases: [(Change<'_>, &str); 14] = [
        (("W/m", &integer(-3)), "fclib_local/W/m: -3; it is not negative"),
        (("W/m", &integer(1 << 30)), "fclib_local/W: 3 starts for 1073741824"),
        (("W/m", &numbers(&[2, 2])), "fclib_local/W/m: 2 numbers; a single one"),
        (("W/nz", &integer(-7)), "fclib_local/W/nz: -7; -2 for rows"),
        (("W/nz", &integer(9)), "fclib_local/W/nz: 9 entries, and x has 2"),
        (("W/p", &numbers(&[0, 2, 1])), "fclib_local/W: the starts fall"),
        (("W/p", &|g, name| g.integers(name, [0, -1, 2].into_iter()).expect("small")), "fclib_local/W/p: number 1 is -1"),
        (("W/i", &numbers(&[0, 5])), "fclib_local/W: entry 1 is in column 5"),
        (("W/x", &numbers(&[1, 2])), "fclib_local/W/x: holds i32; real numbers are right"),
        (("W/x", &reals(&[1.0, f64::NAN])), "fclib_local/W/x: number 1 is NaN"),
        (("W/x", &nothing), "fclib_local/W/x: cannot be read"),
        (("q", &reals(&[1.0, 2.0, 3.0])), "fclib_local/spacedim: 2 for 1 contacts of 3 components"),
        (("mu", &reals(&[-1.0])), "mu: -1 at contact 0"),
        (("spacedim", &integer(3)), "fclib_local/spacedim: 3 for 1 contacts of 2"),
    ];
    for (change, right) in cases {
        let message = refused("fclib_local", &[change]);
        assert!(message.starts_with(right), "{message}");
    }
    assert!(refused("fclib_other", &[]).starts_with("/: 0 groups hold problems"));
    assert!(refused("fclib_global", &[]).starts_with("fclib_global/M/m: cannot be read"));
    assert!(read_fclib(b"no HDF5").expect_err("text").to_string().starts_with("is not a sound HDF5 file"));
    assert!(read_fclib(b"\x89HDF\r\n\x1a\n").expect_err("short").to_string().starts_with("is not a sound HDF5 file"));
}

/// Ten million zeros take ten kilobytes when deflated; a file that small does not stand for so many.
#[test]
fn datasets_that_claim_too_much_are_not_read() {
    let zeros = vec![0.0; 10_000_000];
    let mut file = hdf5_pure::FileBuilder::new();
    let mut root = file.create_group("fclib_local");
    let mut vectors = root.create_group("vectors");
    vectors.create_dataset("mu").with_f64_data(&zeros).with_shape(&[10_000_000]).with_chunks(&[1_000_000]).with_deflate(9);
    root.add_group(vectors.finish());
    file.add_group(root.finish());
    let bytes = file.finish().expect("a file");
    let message = Archive::open(&bytes).expect("sound").reals("fclib_local/vectors/mu").expect_err("too much").to_string();
    assert!(message.contains("claims 10000000 elements of 8 bytes, more than the file can stand for"), "{message}");
}
