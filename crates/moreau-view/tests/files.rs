//! Files can be read by others, and appear whole or not at all.

use moreau_view::picture::flat::{Drawing, Figure, Link, Outline, Window};
use moreau_view::picture::movie::Movie;
use moreau_view::picture::{Error, Image};
use std::fs::File;
use std::io::BufReader;

fn plain(size: [usize; 2], pixel: [u8; 4]) -> Image {
    Image { size, pixels: vec![pixel; size[0] * size[1]] }
}

fn decoded(png: &[u8]) -> Image {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    Image { size: [info.width as usize, info.height as usize], pixels: bytes.as_chunks().0.to_vec() }
}

#[test]
fn a_png_comes_back_as_it_was() {
    let mut image = plain([7, 3], [10, 20, 30, 255]);
    image.pixels[8] = [1, 2, 3, 4];
    assert_eq!(decoded(&image.png()), image);
    let folder = tempfile::tempdir().unwrap();
    image.save(folder.path().join("a.png")).unwrap();
    assert_eq!(decoded(&std::fs::read(folder.path().join("a.png")).unwrap()), image);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// A disk on the ground, a triangle, and a force between them.
fn drawing() -> Drawing {
    let triangle = Outline::Polygons(vec![vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]]);
    Drawing {
        title: "Disk & triangle <1>".into(),
        figures: vec![
            Figure::new(Outline::HalfPlane { normal: [0.0, 1.0] }),
            Figure { position: [0.0, 1.0], colour: [0, 114, 178], ..Figure::new(Outline::Disk { radius: 1.0 }) },
            Figure { position: [1.5, 0.0], opacity: 0.5, ..Figure::new(triangle) },
            Figure { position: [f64::NAN, 0.0], ..Figure::new(Outline::Disk { radius: 1.0 }) },
        ],
        links: vec![Link { from: [0.0, 1.0], to: [1.8, 0.3], width: 0.1, colour: [213, 94, 0] }],
        spokes: true,
        window: Some(Window { min: [-2.0, -1.0], max: [4.0, 3.0] }),
        width: 300.0,
        ..Drawing::default()
    }
}

#[test]
fn svg_is_xml_with_a_title_and_every_figure() {
    let text = drawing().svg().unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("viewBox"), Some("0 0 300 200"));
    assert_eq!(root.first_element_child().unwrap().text(), Some("Disk & triangle <1>"));
    let count = |name: &str| document.descendants().filter(|n| n.has_tag_name(("http://www.w3.org/2000/svg", name))).count();
    // Hatches, ground, spoke, link.
    assert_eq!([count("circle"), count("polygon"), count("path")], [1, 1, 4]);
    let circle = document.descendants().find(|n| n.tag_name().name() == "circle").unwrap();
    assert_eq!(["cx", "cy", "r"].map(|a| circle.attribute(a).unwrap()), ["100", "100", "50"]);
}

#[test]
fn pdf_has_its_head_its_end_and_its_page() {
    let bytes = drawing().pdf().unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.starts_with("%PDF-1.") && text.trim_end().ends_with("%%EOF"));
    assert!(text.contains("/MediaBox [0 0 300 200]") && text.contains("/ca 0.5"));
}

#[test]
fn pixels_of_the_plane_are_where_they_belong() {
    let image = drawing().image(600).unwrap();
    assert_eq!(image.size, [600, 400]);
    let at = |x: usize, y: usize| image.pixels[y * 600 + x];
    assert_eq!(at(200 - 60, 200), [0, 114, 178, 255]);
    assert_eq!(at(290, 235)[..3], [213, 94, 0]);
    assert_eq!(at(5, 5)[3], 0);
}

#[test]
fn a_gif_shows_every_image() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    let mut movie = Movie::open(&path, [20, 10], 30.0).unwrap();
    let colours = [[255, 255, 255, 255], [0, 114, 178, 255], [0, 114, 178, 255], [0, 0, 0, 0]];
    for colour in colours {
        movie.add(&plain([20, 10], colour)).unwrap();
    }
    assert!(!path.exists());
    movie.finish().unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);

    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut reader = options.read_info(BufReader::new(File::open(&path).unwrap())).unwrap();
    assert_eq!((reader.width(), reader.height()), (20, 10));
    let mut shown = vec![[0; 4]; 200];
    let mut delays = Vec::new();
    for expected in [[255, 255, 255], [0, 114, 178], [0, 114, 178], [255, 255, 255]] {
        let frame = reader.read_next_frame().unwrap().unwrap();
        for (i, pixel) in frame.buffer.as_chunks::<4>().0.iter().enumerate() {
            let (x, y) =
                (usize::from(frame.left) + i % usize::from(frame.width), usize::from(frame.top) + i / usize::from(frame.width));
            if pixel[3] > 0 {
                shown[20 * y + x] = *pixel;
            }
        }
        delays.push(frame.delay);
        assert!(shown.iter().all(|p| (0..3).all(|k| p[k].abs_diff(expected[k]) <= 2)), "{:?} for {expected:?}", shown[0]);
    }
    assert!(reader.read_next_frame().unwrap().is_none());
    assert_eq!(delays, [3, 4, 3, 3]);
}

#[test]
fn a_movie_that_is_dropped_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut movie = Movie::open(folder.path().join("a.gif"), [4, 4], 10.0).unwrap();
    movie.add(&plain([4, 4], [0; 4])).unwrap();
    drop(movie);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn an_mp4_is_made_where_ffmpeg_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mp4");
    match Movie::open(&path, [33, 17], 25.0) {
        Ok(mut movie) => {
            for i in 0..10 {
                movie.add(&plain([33, 17], [25 * i, 100, 50, 255])).unwrap();
            }
            movie.finish().unwrap();
            let bytes = std::fs::read(&path).unwrap();
            assert_eq!(&bytes[4..8], b"ftyp");
        }
        Err(error) => assert!(matches!(error, Error::NoFfmpeg(_)), "{error}"),
    }
}

#[test]
fn errors_say_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let nowhere = folder.path().join("missing").join("a.png");
    let error = plain([2, 2], [0; 4]).save(&nowhere).unwrap_err();
    assert!(matches!(&error, Error::Write { path, .. } if *path == nowhere), "{error}");
    assert!(matches!(drawing().save(folder.path().join("a.svg").join("b.svg")), Err(Error::Write { .. })));
    assert!(matches!(drawing().save("a.doc"), Err(Error::Format { .. })));
    assert!(matches!(Movie::open("a.avi", [2, 2], 10.0), Err(Error::Format { .. })));
    assert!(matches!(Movie::open(nowhere.with_extension("gif"), [2, 2], 10.0), Err(Error::Write { .. })));
    assert!(matches!(Movie::open("a.gif", [2, 0], 10.0), Err(Error::Size(_))));
    assert!(matches!(Movie::open("a.gif", [2, 2], f64::NAN), Err(Error::Rate(..))));
    let mut movie = Movie::open(folder.path().join("a.gif"), [2, 2], 10.0).unwrap();
    assert!(matches!(movie.add(&plain([3, 2], [0; 4])), Err(Error::Frame { .. })));
    assert!(matches!(movie.finish(), Err(Error::Empty(_))));
    let no_area = Drawing { window: Some(Window { min: [0.0; 2], max: [0.0, 1.0] }), ..drawing() };
    assert!(no_area.svg().is_err());
}
