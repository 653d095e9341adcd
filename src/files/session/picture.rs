//! Session in the metadata of a saved picture, from which the picture is opened again.

use std::io::Read as _;
use std::path::Path;

use serde_json::{Deserializer, Value};

use crate::disk::open::NamedFile;
use crate::error::Error;

/// The keyword of the session in the metadata of a picture.
pub const KEYWORD: &str = "svbrdf:session";
/// The pictures that may have one, by extension.
const EXTENSIONS: [&str; 4] = ["png", "exr", "pdf", "svg"];
/// PNG, EXR and SVG have their metadata at the beginning; that of a PDF is at its end, and all of it is read.
const MOST_BYTES: u64 = 1 << 20;
/// Bytes between the keyword and the text.
const SEPARATORS: &[u8] = b"\0: (";

/// Whether the picture at `path` has a session in its metadata.
pub(super) fn has(path: &Path) -> bool {
    text(path).is_ok_and(|text| text.is_some())
}

/// The text of the session in the metadata of the picture at `path`; `None` where there is none.
///
/// # Errors
/// [`Error::Unreadable`].
pub(super) fn text(path: &Path) -> Result<Option<String>, Error> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if !EXTENSIONS.contains(&extension.as_str()) || !path.is_file() {
        return Ok(None);
    }
    let most = if extension == "pdf" { u64::MAX } else { MOST_BYTES };
    let mut bytes = Vec::new();
    let read = NamedFile::by_user(path).open()?.take(most).read_to_end(&mut bytes);
    read.map_err(|source| Error::unreadable(path, source))?;
    Ok(find(&bytes).map(|text| match extension.as_str() {
        "pdf" => first_value(&unescaped(text)),
        _ => first_value(text),
    }))
}

/// The bytes from the text of the session on.
fn find(bytes: &[u8]) -> Option<&[u8]> {
    let keyword = KEYWORD.as_bytes();
    let at = bytes.windows(keyword.len()).position(|part| part == keyword)?;
    let rest = &bytes[at + keyword.len()..];
    let first = rest.iter().position(|byte| !SEPARATORS.contains(byte))?;
    Some(&rest[first..])
}

/// The JSON that `bytes` begin with; where it is broken, all of them, which are then refused with the reason.
fn first_value(bytes: &[u8]) -> String {
    let mut values = Deserializer::from_slice(bytes).into_iter::<Value>();
    let end = if matches!(values.next(), Some(Ok(_))) { values.byte_offset() } else { bytes.len() };
    String::from_utf8_lossy(&bytes[..end]).into_owned()
}

/// The bytes of a string of a PDF, which has a backslash before backslashes and parentheses.
fn unescaped(bytes: &[u8]) -> Vec<u8> {
    let mut escapes = false;
    let is_kept = |byte: &&u8| {
        escapes = **byte == b'\\' && !escapes;
        !escapes
    };
    bytes.iter().filter(is_kept).copied().collect()
}

/// The JSON in ASCII and without the characters that XML escapes: the same text in every kind of picture.
pub(super) fn written(json: &Value) -> String {
    let mut units = [0; 2];
    let mut text = String::new();
    for character in json.to_string().chars() {
        if character.is_ascii() && !"<>&".contains(character) {
            text.push(character);
        } else {
            let units = character.encode_utf16(&mut units).iter();
            text.extend(units.map(|unit| format!("\\u{unit:04x}")));
        }
    }
    text
}
