//! STL, as text and binary.
//!
//! Binary: 80 bytes of any kind, the number of triangles (32 bits, little-endian), then 50 bytes a triangle: normal and three corners as
//! 32-bit numbers, and two bytes of any kind. Text: `facet normal … outer loop, vertex x y z` three times, `endloop endfacet`, between
//! `solid name` and `endsolid`. Binary files too may begin with `solid`; what has the length that its number of triangles asks for is binary.

use super::{LARGEST, MOST_TRIANGLES, Mesh, MeshError, Place};

const HEAD: usize = 84;
const TRIANGLE: usize = 50;

pub(super) fn read(bytes: &[u8], file: &str) -> Result<Mesh, MeshError> {
    let said = bytes.get(80..HEAD).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    if let Some(count) = said
        && count.checked_mul(TRIANGLE).and_then(|length| length.checked_add(HEAD)) == Some(bytes.len())
    {
        return binary(bytes, file);
    }
    if bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) {
        return text(bytes, file);
    }
    let length = bytes.len();
    let message = match said {
        Some(count) => format!("{length} bytes where {count} triangles take {}", HEAD as u64 + TRIANGLE as u64 * count as u64),
        None => format!("{length} bytes where the head alone takes {HEAD}"),
    };
    let hint = "expected binary STL of the length that its bytes 80 to 83 ask for, or text that begins with `solid`";
    Err(MeshError::read(file, Place::Byte(length.min(80)), message, hint))
}

fn binary(bytes: &[u8], file: &str) -> Result<Mesh, MeshError> {
    let mut soup = Mesh::default();
    for (i, triangle) in bytes[HEAD..].chunks_exact(TRIANGLE).enumerate() {
        for (k, corner) in triangle[12..48].chunks_exact(12).enumerate() {
            let mut point = [0.0; 3];
            for (x, b) in point.iter_mut().zip(corner.chunks_exact(4)) {
                *x = f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
            }
            if !point.iter().all(|x| x.is_finite()) {
                let place = Place::Byte(HEAD + TRIANGLE * i + 12 * (k + 1));
                return Err(MeshError::read(file, place, format!("a corner at {point:?}"), "expected finite coordinates"));
            }
            push(&mut soup, point);
        }
        enough(&soup, file, Place::Byte(HEAD + TRIANGLE * i))?;
    }
    Ok(soup.merged(0.0))
}

fn push(soup: &mut Mesh, point: [f64; 3]) {
    soup.points.push(point);
    let count = soup.points.len() as u32;
    if count.is_multiple_of(3) {
        soup.triangles.push([count - 3, count - 2, count - 1]);
    }
}

fn enough(soup: &Mesh, file: &str, place: Place) -> Result<(), MeshError> {
    if soup.triangles.len() <= MOST_TRIANGLES {
        return Ok(());
    }
    Err(MeshError::read(file, place, "too many triangles", format!("expected at most {MOST_TRIANGLES}")))
}

/// Where in the text a line may stand.
#[derive(Clone, Copy, PartialEq)]
enum Inside {
    Nothing,
    Solid,
    Facet,
    /// With so many corners so far.
    Loop(usize),
    Closed,
}

fn text(bytes: &[u8], file: &str) -> Result<Mesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut soup = Mesh::default();
    let (mut inside, mut last) = (Inside::Nothing, 1);
    for (i, line) in text.lines().enumerate() {
        let mut words = line.split_ascii_whitespace();
        let Some(word) = words.next() else { continue };
        last = i + 1;
        let fault = |message: String, hint: &str| Err(MeshError::read(file, Place::Line(i + 1), message, hint));
        inside = match (inside, word.to_ascii_lowercase().as_str()) {
            (Inside::Nothing, "solid") => Inside::Solid,
            (Inside::Solid, "facet") => Inside::Facet,
            (Inside::Facet, "outer") => Inside::Loop(0),
            (Inside::Loop(corners @ 0..3), "vertex") => {
                push(&mut soup, point(words, file, i + 1)?);
                enough(&soup, file, Place::Line(i + 1))?;
                Inside::Loop(corners + 1)
            }
            (Inside::Loop(3), "endloop") => Inside::Closed,
            (Inside::Closed, "endfacet") => Inside::Solid,
            (Inside::Solid, "endsolid") => Inside::Nothing,
            (Inside::Loop(3), "vertex") => return fault("a fourth corner".into(), "expected `endloop`: facets are triangles"),
            (_, word) => return fault(format!("`{}`", shown(word)), next(inside)),
        };
    }
    if inside != Inside::Nothing {
        return Err(MeshError::read(file, Place::Line(last), "the text ends within the solid", next(inside)));
    }
    Ok(soup.merged(0.0))
}

/// What may come where the text is.
fn next(inside: Inside) -> &'static str {
    match inside {
        Inside::Nothing => "expected `solid`",
        Inside::Solid => "expected `facet` or `endsolid`",
        Inside::Facet => "expected `outer loop`",
        Inside::Loop(3) => "expected `endloop`",
        Inside::Loop(_) => "expected `vertex x y z`",
        Inside::Closed => "expected `endfacet`",
    }
}

/// The three coordinates that end a line.
pub(super) fn point<'a>(mut words: impl Iterator<Item = &'a str>, file: &str, line: usize) -> Result<[f64; 3], MeshError> {
    let mut point = [0.0; 3];
    for (x, axis) in point.iter_mut().zip(["x", "y", "z"]) {
        let fault = |message: String| {
            let hint = "expected three finite numbers, below 1e60";
            MeshError::read(file, Place::Line(line), message, hint)
        };
        let word = words.next().ok_or_else(|| fault(format!("no {axis}")))?;
        let number = word.parse::<f64>().ok().filter(|x| x.abs() < LARGEST);
        *x = number.ok_or_else(|| fault(format!("`{}` for {axis}", shown(word))))?;
    }
    Ok(point)
}

/// As much of a word as a message should show.
pub(super) fn shown(word: &str) -> String {
    word.chars().take(40).collect()
}
