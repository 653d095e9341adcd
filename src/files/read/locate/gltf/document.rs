//! The document of a glTF as far as materials need it: meshes, animations and all else may be damaged or unknown.

use std::path::Path;

use gltf::json::{Root, Value};
use gltf::{Document, Glb};

use crate::disk::lfs;
use crate::disk::memory::{self, Reserved};
use crate::disk::panics::caught;
use crate::error::Error;

/// Parts of a glTF that materials need.
const PARTS: [&str; 7] = ["asset", "buffers", "bufferViews", "images", "materials", "samplers", "textures"];

/// The document of a glTF.
pub(super) struct GltfDocument {
    pub parsed: Document,
    /// All of it but pictures and buffers, as the file declares it.
    pub declared: Value,
    /// The binary part.
    pub blob: Option<Vec<u8>>,
    /// The memory of all of these.
    pub reserved: Reserved,
}

/// The document of the file `path`, whose bytes these are.
///
/// # Errors
/// [`Error::BadImage`]; [`Error::Memory`].
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<GltfDocument, Error> {
    lfs::refuse_pointer(path, bytes)?;
    let invalid = |found: &str| bad(path, format!("expected valid glTF, found: {found}"));
    let contradiction = |_| invalid("a contradiction in its lengths");
    let (json, blob) = if bytes.starts_with(b"glTF") {
        // gltf 1.4.1 panics at some lengths that a damaged glb claims.
        let glb = caught(|| Glb::from_slice(bytes)).map_err(contradiction)?;
        let Glb { json, bin, .. } = glb.map_err(|e| invalid(&e.to_string()))?;
        (json.into_owned(), bin.map(|bin| bin.into_owned()))
    } else {
        (bytes.to_vec(), None)
    };
    let reserved = memory::reserve(bytes_of(&json), || format!("the document of {}", path.display()))?;
    let mut value: Value = serde_json::from_slice(&json).map_err(|e| invalid(&e.to_string()))?;
    let parts = value.as_object_mut().ok_or_else(|| invalid("no object"))?;
    // Extensions that a file requires mostly concern its meshes; extensions of a texture show in the texture.
    let mut declared = parts.clone();
    declared.retain(|name, _| !["images", "buffers"].contains(&name.as_str()));
    parts.retain(|name, _| PARTS.contains(&name.as_str()));
    let root: Root = serde_json::from_value(value).map_err(|e| invalid(&e.to_string()))?;
    // gltf 1.4.1 panics at images that lead nowhere.
    let leads = |i: &gltf::json::Image| i.uri.is_some() || (i.buffer_view.is_some() && i.mime_type.is_some());
    if !root.images.iter().all(leads) {
        return Err(bad(path, "expected images with a uri, or a bufferView and a mimeType".to_owned()));
    }
    let document = caught(|| Document::from_json(root)).map_err(contradiction)?;
    let parsed = document.map_err(|e| invalid(&e.to_string()))?;
    Ok(GltfDocument { parsed, declared: declared.into(), blob, reserved })
}

/// The memory that a document takes at most: twice as JSON, and once as the objects of glTF.
fn bytes_of(json: &[u8]) -> u64 {
    /// An object in bytes: a node of each map, and the largest object of glTF, a material.
    const OBJECT: u64 = 2200;
    /// A value of an array or a map, with room to grow, in bytes.
    const VALUE: u64 = 128;
    let count = |searched: u8| json.iter().filter(|byte| **byte == searched).count() as u64;
    4 * json.len() as u64 + OBJECT * count(b'{') + VALUE * (count(b',') + count(b'['))
}

/// The array of this name in the document; empty where there is none.
pub(super) fn array<'a>(document: &'a Value, name: &str) -> &'a [Value] {
    document.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

pub(super) fn bad(path: &Path, problem: String) -> Error {
    Error::BadImage { path: path.to_owned(), problem, remedy: "export it again".to_owned() }
}
