//! STL, as text and binary.
//!
//! Binary: 80 bytes of any kind, the number of triangles (32 bits, little-endian), then 50 bytes a triangle: normal and three corners as
//! 32-bit numbers, and two bytes of any kind. Text: `facet normal … outer loop, vertex x y z` three times, `endloop endfacet`, between
//! `solid name` and `endsolid`, in words of any case with any blanks between.
//!
//! Binary files too may begin with `solid`: a file of the length that its number of triangles asks for is binary, and so is one without
//! the words of text after its first 80 bytes. A number of triangles that is wrong is remarked where the triangles are whole.

mod text;

use super::vector::{dot, length, twice_area};
use super::{LARGEST, MOST_TRIANGLES, Mesh, MeshError, MeshFile, Object, Place};

const HEAD: usize = 84;
const TRIANGLE: usize = 50;

/// By which part the length and direction of a normal may differ from what they should be.
const NORMAL: f64 = 0.02;

pub(super) fn read(bytes: &[u8], file: &str) -> Result<MeshFile, MeshError> {
    let reported = bytes.get(80..HEAD).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    let has_length = |count: usize| count.checked_mul(TRIANGLE).and_then(|n| n.checked_add(HEAD)) == Some(bytes.len());
    match reported {
        Some(count) if has_length(count) => binary(bytes, count, file),
        _ if text::is_text(bytes) => text::read(bytes, file),
        Some(count) => binary_of_other_length(bytes, count, file),
        None => {
            let message = format!("{} bytes where the head alone takes {HEAD}", bytes.len());
            Err(MeshError::read(file, Place::Byte(bytes.len().min(80)), message, EXPECTED))
        }
    }
}

const EXPECTED: &str = "expected binary STL of the length that its bytes 80 to 83 ask for, or text that begins with `solid`";

/// Reads a file that is longer or shorter than its number of triangles asks for. Bytes after the last triangle are left out. Triangles
/// beyond the reported number are read if they look like triangles; a file that ends within one is refused.
fn binary_of_other_length(bytes: &[u8], reported: usize, file: &str) -> Result<MeshFile, MeshError> {
    let body = &bytes[HEAD..];
    let whole = body.len() / TRIANGLE;
    let looks_right = |i: usize| is_triangle(&body[TRIANGLE * i..][..TRIANGLE]);
    let count = if reported > whole {
        // A wrong number, or a file that was cut.
        (whole > 0 && whole * TRIANGLE == body.len() && (0..whole).all(looks_right)).then_some(whole)
    } else {
        // Bytes after the triangles look like triangles by chance alone.
        Some((reported..whole).find(|&i| !looks_right(i)).unwrap_or(whole)).filter(|&count| count > 0)
    };
    let Some(count) = count else {
        let asked = HEAD as u64 + TRIANGLE as u64 * reported as u64;
        let message = format!("{} bytes where {reported} triangles take {asked}", bytes.len());
        return Err(MeshError::read(file, Place::Byte(80), message, EXPECTED));
    };
    let mut found = binary(bytes, count, file)?;
    if count != reported {
        found.remarks.push(format!(
            "{file}: the number of triangles is given as {reported}, and there are {count}; all {count} were read"
        ));
    }
    let rest = body.len() - TRIANGLE * count;
    if rest > 0 {
        found.remarks.push(format!("{file}: {rest} bytes after the last triangle were left out"));
    }
    Ok(found)
}

/// Reads the first `count` triangles, which must be there.
fn binary(bytes: &[u8], count: usize, file: &str) -> Result<MeshFile, MeshError> {
    if count > MOST_TRIANGLES {
        return Err(MeshError::read(file, Place::Byte(80), "too many triangles", format!("expected at most {MOST_TRIANGLES}")));
    }
    let mut soup = Mesh::default();
    for (i, triangle) in bytes[HEAD..].chunks_exact(TRIANGLE).take(count).enumerate() {
        for (k, corner) in triangle[12..48].chunks_exact(12).enumerate() {
            let point = vector(corner);
            if !point.iter().all(|x| x.is_finite()) {
                let place = Place::Byte(HEAD + TRIANGLE * i + 12 * (k + 1));
                return Err(MeshError::read(file, place, format!("a corner at {point:?}"), "expected finite coordinates"));
            }
            push(&mut soup, point);
        }
    }
    let all = Object { name: None, triangles: (0..soup.triangles.len() as u32).collect() };
    Ok(MeshFile { mesh: soup, objects: vec![all], remarks: Vec::new() }.merged(0.0))
}

/// True if 50 bytes look like a triangle: finite corners that differ, and a normal that is zero, of length 1, or square to the triangle.
fn is_triangle(bytes: &[u8]) -> bool {
    let normal = vector(bytes);
    let corners = [1, 2, 3].map(|k| vector(&bytes[12 * k..]));
    if !corners.iter().flatten().all(|x| x.is_finite()) || corners[0] == corners[1] && corners[1] == corners[2] {
        return false;
    }
    let (size, square) = (length(normal), twice_area(corners));
    size == 0.0 || (size - 1.0).abs() <= NORMAL || dot(normal, square).abs() >= (1.0 - NORMAL) * size * length(square)
}

/// Three numbers of 32 bits.
fn vector(bytes: &[u8]) -> [f64; 3] {
    [0, 4, 8].map(|at| f64::from(f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])))
}

/// Adds a corner, and with each third one a triangle.
fn push(soup: &mut Mesh, point: [f64; 3]) {
    soup.points.push(point);
    let count = soup.points.len() as u32;
    if count.is_multiple_of(3) {
        soup.triangles.push([count - 3, count - 2, count - 1]);
    }
}

/// The three coordinates that come next.
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
