//! The files, read back by a small decoder that shares no code with the writer.

use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;

use super::appended::BLOCK;
use super::{Array, Cells, PolyData, Series, Values, VtkError, Writer, write};

/// A file taken apart: its XML head, and the appended bytes behind the underscore.
struct Parts {
    head: String,
    body: Vec<u8>,
}

impl Parts {
    fn read(path: &Path) -> Self {
        let bytes = fs::read(path).unwrap();
        let mark = b"<AppendedData encoding=\"raw\">\n   _";
        let at = bytes.windows(mark.len()).position(|w| w == mark).unwrap() + mark.len();
        let tail = b"\n  </AppendedData>\n</VTKFile>\n";
        assert!(bytes.ends_with(tail));
        Self { head: String::from_utf8(bytes[..at].to_vec()).unwrap(), body: bytes[at..bytes.len() - tail.len()].to_vec() }
    }

    /// The first line of the head that contains `text`.
    fn line(&self, text: &str) -> &str {
        self.head.lines().find(|l| l.contains(text)).unwrap_or_else(|| panic!("no {text} in {}", self.head))
    }

    /// The inflated bytes of the first array after `section` with this (escaped) name.
    fn bytes(&self, section: &str, name: &str) -> Vec<u8> {
        let at = self.head.find(&format!("<{section}>")).unwrap();
        let line = self.head[at..].lines().find(|l| l.contains(&format!("Name=\"{name}\""))).unwrap();
        let offset: usize = line.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        let word = |i: usize| {
            let at = offset + 8 * i;
            u64::from_le_bytes(self.body[at..at + 8].try_into().unwrap()) as usize
        };
        let (blocks, full, last) = (word(0), word(1), word(2));
        let mut at = offset + 8 * (3 + blocks);
        let mut out = Vec::new();
        for b in 0..blocks {
            let before = out.len();
            ZlibDecoder::new(&self.body[at..at + word(3 + b)]).read_to_end(&mut out).unwrap();
            assert_eq!(out.len() - before, if b + 1 == blocks && last > 0 { last } else { full });
            at += word(3 + b);
        }
        out
    }

    fn f64s(&self, section: &str, name: &str) -> Vec<f64> {
        self.bytes(section, name).chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn i64s(&self, section: &str, name: &str) -> Vec<i64> {
        self.bytes(section, name).chunks_exact(8).map(|b| i64::from_le_bytes(b.try_into().unwrap())).collect()
    }
}

#[test]
fn the_head_says_what_a_reader_needs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtp");
    let points = [[0.0; 3], [1.0; 3], [2.0; 3]];
    let polys = Cells::from_iter([[0, 1, 2]]);
    let cell_data = vec![Array::scalars("kind", &[0_u8, 0, 0, 1])];
    write(&path, &PolyData { points: &points, polys: &polys, cell_data, ..PolyData::default() }).unwrap();
    let parts = Parts::read(&path);
    let root = parts.line("<VTKFile");
    for wanted in ["PolyData", "LittleEndian", "header_type=\"UInt64\"", "compressor=\"vtkZLibDataCompressor\""] {
        assert!(root.contains(wanted), "{root}");
    }
    assert!(parts.line("<Piece").contains("NumberOfPoints=\"3\" NumberOfVerts=\"3\" NumberOfLines=\"0\" NumberOfPolys=\"1\""));
    assert!(parts.line("TimeValue").contains("NumberOfTuples=\"1\""));
    assert!(parts.line("\"Points\"").contains("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\""));
    assert!(parts.line("\"kind\"").contains("type=\"UInt8\""));
}

#[test]
fn every_number_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtp");
    // More than two blocks of positions, exactly one of radii, and a part of one of materials.
    let n = BLOCK / 8;
    let points: Vec<[f64; 3]> = (0..n).map(|i| [(i as f64).sin(), 1.0 / (i as f64 + 1.0), f64::MIN_POSITIVE]).collect();
    let radius: Vec<f64> = (0..n).map(|i| (i as f64).sqrt()).collect();
    let single: Vec<f32> = radius.iter().map(|&r| r as f32).collect();
    let material: Vec<i32> = (0..n as i32).map(|i| -i).collect();
    let id: Vec<i64> = (0..n as i64).map(|i| i << 33).collect();
    let flags: Vec<u8> = (0..3 * n).map(|i| i as u8).collect();
    let point_data = vec![
        Array::scalars("radius", &radius),
        Array::scalars("single", &single),
        Array::scalars("material", &material),
        Array::scalars("id", &id),
        Array { name: "flags", components: 3, values: Values::U8(&flags) },
    ];
    write(&path, &PolyData { points: &points, point_data, time: 0.1 + 0.2, ..PolyData::default() }).unwrap();
    let parts = Parts::read(&path);
    assert_eq!(parts.f64s("FieldData", "TimeValue"), [0.1 + 0.2]);
    assert_eq!(parts.f64s("Points", "Points"), points.as_flattened());
    assert_eq!(parts.f64s("PointData", "radius"), radius);
    assert_eq!(parts.bytes("PointData", "single"), single.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<_>>());
    assert_eq!(parts.bytes("PointData", "material"), material.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<_>>());
    assert_eq!(parts.i64s("PointData", "id"), id);
    assert_eq!(parts.bytes("PointData", "flags"), flags);
    assert_eq!(parts.i64s("Verts", "connectivity"), (0..n as i64).collect::<Vec<_>>());
    assert_eq!(parts.i64s("Verts", "offsets"), (1..=n as i64).collect::<Vec<_>>());
}

#[test]
fn a_writer_makes_of_each_frame_the_file_that_it_would_be_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (ours, alone) = (folder.path().join("a.vtp"), folder.path().join("b.vtp"));
    let mut writer = Writer::default();
    // Some arrays stay as they are, some change, some grow and shrink, one is there now and then, and some data are refused.
    for (frame, n) in [(0, 2000), (1, 2000), (2, 20_000), (3, 1), (4, 0), (5, 2000), (5, 2000)] {
        let points: Vec<[f64; 3]> = (0..n).map(|i| [(0.7 * f64::from(i)).sin(), f64::from(frame), 1.0]).collect();
        let (radius, id): (Vec<f64>, Vec<i64>) = (0..n).map(|i| (f64::from(i).sqrt(), i64::from(i))).unzip();
        let mut point_data = vec![Array::scalars("radius", &radius), Array::scalars("id", &id)];
        point_data.truncate(if frame == 3 { 1 } else { 2 });
        let data = PolyData { points: &points, point_data, time: f64::from(frame), ..PolyData::default() };
        assert!(writer.write(&ours, &PolyData { time: f64::NAN, ..data.clone() }).is_err());
        writer.write(&ours, &data).unwrap();
        write(&alone, &data).unwrap();
        assert!(fs::read(&ours).unwrap() == fs::read(&alone).unwrap(), "frame {frame}");
        assert_eq!(Parts::read(&ours).f64s("Points", "Points"), points.as_flattened());
    }
}

#[test]
fn lines_and_polygons_are_lists_with_ends() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtp");
    let points = [[0.0; 3]; 5];
    let lines = Cells::from_iter([vec![4, 0], vec![3, 2, 1], vec![0, 2]]);
    let polys = Cells::from_iter([vec![0, 1, 2], vec![1, 4, 3, 2]]);
    let data = PolyData { points: &points, verts: false, lines: &lines, polys: &polys, ..PolyData::default() };
    write(&path, &PolyData { cell_data: vec![Array::scalars("kind", &[0_u8, 1, 2, 3, 4])], ..data.clone() }).unwrap();
    let parts = Parts::read(&path);
    assert!(parts.line("<Piece").contains("NumberOfVerts=\"0\" NumberOfLines=\"3\" NumberOfPolys=\"2\""));
    assert_eq!(parts.i64s("Lines", "connectivity"), [4, 0, 3, 2, 1, 0, 2]);
    assert_eq!(parts.i64s("Lines", "offsets"), [2, 5, 7]);
    assert_eq!(parts.i64s("Polys", "connectivity"), [0, 1, 2, 1, 4, 3, 2]);
    assert_eq!(parts.i64s("Polys", "offsets"), [3, 7]);
    assert!(parts.i64s("Verts", "connectivity").is_empty());
}

#[test]
fn nothing_is_a_valid_data_set() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtp");
    let point_data = vec![Array::vectors("normal", &[]), Array::scalars("status", &[0_i32; 0])];
    write(&path, &PolyData { point_data, time: 2.0, ..PolyData::default() }).unwrap();
    let parts = Parts::read(&path);
    assert!(parts.line("<Piece").contains("NumberOfPoints=\"0\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfPolys=\"0\""));
    assert!(parts.f64s("PointData", "normal").is_empty());
    assert!(parts.bytes("PointData", "status").is_empty());
    assert_eq!(parts.f64s("FieldData", "TimeValue"), [2.0]);
}

#[test]
fn names_are_escaped_and_bad_ones_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtp");
    let points = [[0.0; 3]];
    let one = [1.0];
    let with = |names: &[&'static str]| {
        let point_data = names.iter().map(|name| Array::scalars(name, &one)).collect();
        write(&path, &PolyData { points: &points, point_data, ..PolyData::default() })
    };
    with(&["a<b & \"c\" 'µ'>"]).unwrap();
    assert_eq!(Parts::read(&path).f64s("PointData", "a&lt;b &amp; &quot;c&quot; &apos;µ&apos;&gt;"), [1.0]);
    for names in [&[""][..], &["a\u{1}"], &["twice", "twice"]] {
        assert!(matches!(with(names), Err(VtkError::Name { .. })), "{names:?}");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtp");
    let points = [[0.0; 3]; 2];
    let base = PolyData { points: &points, ..PolyData::default() };
    write(&path, &base).unwrap();
    let before = fs::read(&path).unwrap();

    let refused = |data: &PolyData| write(&path, data).unwrap_err();
    let short = refused(&PolyData { point_data: vec![Array::scalars("mass", &[1.0])], ..base.clone() });
    assert!(matches!(&short, VtkError::Length { place: "point", found: 1, count: 2, components: 1, .. }), "{short}");
    assert!(short.to_string().contains("a.vtp") && short.to_string().contains("mass"), "{short}");
    let cells = refused(&PolyData { cell_data: vec![Array::scalars("law", &[1, 2, 3])], ..base.clone() });
    assert!(matches!(&cells, VtkError::Length { place: "cell", found: 3, count: 2, .. }), "{cells}");
    for components in [0, 3, usize::MAX] {
        let array = Array { name: "v", components, values: Values::F64(&[0.0, 0.0]) };
        assert!(matches!(refused(&PolyData { point_data: vec![array], ..base.clone() }), VtkError::Length { .. }));
    }
    let cells = Cells::from_iter([vec![0, 1, 0], vec![1, 0, 2]]);
    let index = refused(&PolyData { polys: &cells, ..base.clone() });
    assert!(matches!(index, VtkError::Index { kind: "polygon", cell: 1, index: 2, points: 2, .. }), "{index}");
    let index = refused(&PolyData { lines: &cells, ..base.clone() });
    assert!(index.to_string().contains("line 1 names point 2"), "{index}");
    assert!(matches!(refused(&PolyData { time: f64::NAN, ..base.clone() }), VtkError::Time { .. }));

    assert_eq!(fs::read(&path).unwrap(), before);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays behind");
}

#[test]
fn an_unwritable_place_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing");
    for error in [write(&missing.join("a.vtp"), &PolyData::default()), Series::new(missing.join("a.pvd")).save()] {
        let error = error.unwrap_err();
        assert!(matches!(error, VtkError::Io { .. }));
        assert!(error.to_string().contains(&missing.display().to_string()), "{error}");
    }
    // A folder in the way of the file: the temporary file can be written, the rename cannot be done.
    let taken = folder.path().join("taken.vtp");
    fs::create_dir(&taken).unwrap();
    assert!(write(&taken, &PolyData::default()).unwrap_err().to_string().contains("taken.vtp"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays behind");
}

#[test]
fn a_series_lists_its_frames_each_time_it_is_saved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bodies.pvd");
    let mut series = Series::new(&path);
    series.save().unwrap();
    assert!(series.is_empty() && fs::read_to_string(&path).unwrap().contains("</Collection>"));
    for (i, time) in [0.0, 0.1 + 0.2, 1e-30].into_iter().enumerate() {
        series.push(time, &format!("bodies/{i}&.vtp")).unwrap();
        series.save().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text.matches("<DataSet ").count(), i + 1);
        assert!(text.contains(&format!("timestep=\"{time:?}\" part=\"0\" file=\"bodies/{i}&amp;.vtp\"")), "{text}");
        assert!(text.ends_with("  </Collection>\n</VTKFile>\n"));
    }
    assert!(matches!(series.push(f64::INFINITY, "x.vtp"), Err(VtkError::Time { .. })));
    assert!(matches!(series.push(1.0, ""), Err(VtkError::Name { .. })));
    assert_eq!((series.len(), series.path()), (3, path.as_path()));
}

#[cfg(unix)]
#[test]
fn files_are_as_readable_as_any_other() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (ours, plain) = (folder.path().join("a.vtp"), folder.path().join("plain"));
    write(&ours, &PolyData::default()).unwrap();
    fs::write(&plain, "").unwrap();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}
