//! Documents beside the pictures of a set that list them, too: glTF, MaterialX, MTL, texture sets of Minecraft, and resources of Godot.

use std::path::Path;

use super::godot;
use crate::disk::open::NamedFile;
use crate::read::located::set::{ListingDocument, SetFiles};
use crate::read::options::NormalY;
use crate::read::options::extensions;

/// Longest document in bytes that is searched for names.
const LONGEST: u64 = 4 << 20;

/// The documents among the files `names` of `folder` that name a file of the set.
pub(super) fn beside(folder: &Path, names: &[String], set: &SetFiles) -> Vec<ListingDocument> {
    let listing = |name: &String| {
        let extension = extensions::of_name(name);
        let opens =
            ["gltf", "mtlx", "mtl"].contains(&extension.as_str()) || name.ends_with(".texture_set.json");
        let is_listing = opens || extension == "tres";
        let path = folder.join(name);
        if !is_listing || !path.metadata().is_ok_and(|meta| meta.len() <= LONGEST) {
            return None;
        }
        let bytes = NamedFile::by_file(path, folder).bytes().ok()?;
        let text = String::from_utf8_lossy(&bytes);
        let is_named = |file: &String| {
            // A texture set names files without their extension.
            let stem = Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
            text.contains(file) || (extension == "json" && text.contains(&format!("\"{stem}\"")))
        };
        let files: Vec<_> = set.files.iter().map(|file| file.file.clone()).filter(is_named).collect();
        let is_directx = text.contains("ASOBO_normal_map_convention") && text.contains("DirectX");
        let normal_y = match extension.as_str() {
            "gltf" if is_directx => Some(NormalY::Down),
            "gltf" | "mtlx" | "tres" => Some(NormalY::Up),
            _ => None,
        };
        let grays = if extension == "tres" { godot::grays(&text) } else { Vec::new() };
        (!files.is_empty()).then(|| ListingDocument { name: name.clone(), files, normal_y, opens, grays })
    };
    names.iter().filter_map(listing).collect()
}
