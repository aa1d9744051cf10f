//! Says in the scene's own words what the reader of the format found wrong.

use super::error::{SceneError, nearest};
use super::path::KeyPath;
use super::source::{Source, path_of};
use toml::de::DeTable;

/// The error of a value that does not fit the scene.
///
/// serde hands over one sentence of fixed form; the names in it stand in backquotes.
pub(super) fn explain(source: &Source, document: &DeTable<'_>, error: &toml::de::Error) -> SceneError {
    let text = error.message();
    let span = error.span().unwrap_or(0..0);
    let path = if span.is_empty() { KeyPath::default() } else { path_of(document, &span) };
    let names: Vec<&str> = text.split('`').skip(1).step_by(2).collect();
    let (message, hint) = if let Some(rest) = text.strip_prefix("unexpected keys in table: ") {
        let (unexpected, known) = rest.split_once(", available keys: ").unwrap_or((rest, ""));
        let key = unexpected.split(", ").next().unwrap_or_default();
        unknown_key(key, &path, &known.split(", ").collect::<Vec<_>>())
    } else if text.starts_with("unknown field") && !names.is_empty() {
        unknown_key(names[0], &path, &names[1..])
    } else if text.starts_with("unknown variant") && !names.is_empty() {
        (format!("unknown name `{}`", names[0]), nearest(names[0], "names", names[1..].iter().copied()))
    } else if text.starts_with("missing field") && !names.is_empty() {
        let place = if path.0.is_empty() { "the scene".to_owned() } else { format!("`{path}`") };
        (format!("`{}` is missing", names[0]), format!("{place} needs a value for `{}`", names[0]))
    } else if let Some((found, wanted)) = text.split_once(", expected ") {
        wrong_type(found, wanted)
    } else if text.starts_with("wanted exactly 1 element") {
        ("one choice is needed here, not none and not several".to_owned(), "write it as `name = { … }`, with one name".to_owned())
    } else {
        (text.to_owned(), String::new())
    };
    source.at(span, &path, &message, &hint)
}

fn unknown_key(key: &str, path: &KeyPath, known: &[&str]) -> (String, String) {
    let table = path.parent();
    let place = if table.0.is_empty() { "at the top of the scene".to_owned() } else { format!("in [{table}]") };
    (format!("unknown key `{key}` {place}"), nearest(key, "keys", known.iter().copied()))
}

/// `found` begins with "invalid type: " or "invalid value: "; `wanted` is Rust's word for the type.
fn wrong_type(found: &str, wanted: &str) -> (String, String) {
    let found = found.split_once(": ").map_or(found, |(_, found)| found);
    let wanted = match wanted {
        "f64" => "a number",
        "u64" | "u32" | "usize" => "a whole number, 0 or more",
        "u8" => "a small whole number",
        "a sequence" => "an array",
        "a map" | "struct variant" => "a table, as in `{ key = value }`",
        "newtype variant" => "a value with this name, as in `{ name = value }`",
        _ if wanted.starts_with("struct ") => "a table, as in `{ key = value }`",
        other => other,
    };
    let found = if found == "unit variant" { "a bare name".to_owned() } else { found.replace("floating point", "the number") };
    (format!("found {found}"), format!("expected {wanted}"))
}
