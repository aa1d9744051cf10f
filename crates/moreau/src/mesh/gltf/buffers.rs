//! The buffers of glTF: chunks of a binary file, texts in base64, or files beside it.

use super::whole;
use crate::mesh::{MeshError, Place, bytes_of};
use serde_json::Value;
use std::path::{Component, Path};

const MAGIC: &[u8] = b"glTF";

/// The JSON of a file and, of a binary one, the bytes behind it.
pub(super) fn chunks<'a>(bytes: &'a [u8], file: &str) -> Result<(&'a [u8], Option<&'a [u8]>), MeshError> {
    if !bytes.starts_with(MAGIC) {
        return Ok((bytes, None));
    }
    let fault = |at: usize, message: String| {
        MeshError::read(file, Place::Byte(at), message, "expected a whole file of glTF 2.0, with its JSON first")
    };
    let number = |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    if number(4) != Some(2) {
        return Err(fault(4, "not version 2 of the format".into()));
    }
    let (mut at, mut json, mut binary) = (12, None, None);
    while at < bytes.len() && binary.is_none() {
        let (Some(length), Some(kind)) = (number(at), bytes.get(at + 4..at + 8)) else { break };
        let chunk = bytes.get(at + 8..).and_then(|rest| rest.get(..length));
        let chunk = chunk.ok_or_else(|| fault(at, format!("a chunk of {length} bytes where {} follow", bytes.len() - at - 8)))?;
        match (kind, json) {
            (b"JSON", None) => json = Some(chunk),
            (b"BIN\0", Some(_)) => binary = Some(chunk),
            _ => {}
        }
        // Chunks begin at multiples of 4.
        at = at + 8 + length.next_multiple_of(4);
    }
    Ok((json.ok_or_else(|| fault(12, "no JSON".into()))?, binary))
}

/// The bytes of each buffer.
pub(super) fn read(json: &Value, binary: Option<&[u8]>, file: &str, folder: Option<&Path>) -> Result<Vec<Vec<u8>>, MeshError> {
    let all = json.get("buffers").and_then(Value::as_array).into_iter().flatten();
    all.enumerate()
        .map(|(i, buffer)| {
            let fault = |message: &str, hint: &str| MeshError::read(file, Place::File, format!("buffers[{i}] {message}"), hint);
            let length = whole(buffer.get("byteLength")).unwrap_or(0);
            let mut bytes = match (buffer.get("uri").and_then(Value::as_str), binary) {
                (None, Some(binary)) if i == 0 => binary.to_vec(),
                (None, _) => return Err(fault("has neither a uri nor a place in the file", "expected one of them")),
                (Some(uri), _) if uri.starts_with("data:") => {
                    let text = uri.split_once(";base64,").map(|(_, text)| text);
                    text.and_then(decoded).ok_or_else(|| fault("is no text in base64", "expected `data:…;base64,…`"))?
                }
                (Some(uri), _) => {
                    let name = plain(uri);
                    let hint = "expected a file in the folder of the glTF file, or below it";
                    let place = Path::new(&name);
                    let inside = place.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
                    let folder =
                        folder.filter(|_| inside && !name.is_empty()).ok_or_else(|| fault("is in another place", hint))?;
                    let place = folder.join(place);
                    if !place.is_file() {
                        return Err(fault(&format!("is not there: {}", place.display()), hint));
                    }
                    bytes_of(&place)?
                }
            };
            if bytes.len() < length {
                let message = format!("has {} bytes where the file says {length}", bytes.len());
                return Err(fault(&message, "expected a file that is whole"));
            }
            bytes.truncate(length);
            Ok(bytes)
        })
        .collect()
}

/// A path without its %-codes.
fn plain(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, tail @ ..] = rest {
        let code = tail.get(..2).and_then(|two| u8::from_str_radix(std::str::from_utf8(two).ok()?, 16).ok());
        match (first, code) {
            (b'%', Some(code)) => {
                bytes.push(code);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The bytes of a text in base64; `=` at its end fills it.
fn decoded(text: &str) -> Option<Vec<u8>> {
    let value = |c: u8| match c {
        b'A'..=b'Z' => Some(c - b'A'),
        b'a'..=b'z' => Some(c - b'a' + 26),
        b'0'..=b'9' => Some(c - b'0' + 52),
        b'+' | b'-' => Some(62),
        b'/' | b'_' => Some(63),
        _ => None,
    };
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut bits, mut held) = (0_u32, 0);
    for c in text.trim_end_matches('=').bytes() {
        bits = bits << 6 | u32::from(value(c)?);
        held += 6;
        if held >= 8 {
            held -= 8;
            bytes.push((bits >> held) as u8);
        }
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_in_base64_and_codes_of_paths_are_read() {
        for (text, bytes) in
            [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYmFy", "foobar"), ("Zm9vYg", "foob")]
        {
            assert_eq!(decoded(text).as_deref(), Some(bytes.as_bytes()));
        }
        assert_eq!(decoded("Zm9*"), None);
        assert_eq!((plain("a%20b.bin"), plain("%2e%2e/x"), plain("100%")), ("a b.bin".into(), "../x".into(), "100%".into()));
    }
}
