//! Documents beside the pictures of a set that list them, too: glTF, MaterialX and MTL.

use std::path::Path;

use crate::disk::open::NamedFile;
use crate::read::located::set::{ListingDocument, SetFiles};
use crate::read::options::NormalY;
use crate::read::options::extensions;

/// Longest document in bytes that is searched for names.
const LONGEST: u64 = 4 << 20;

/// The documents among the files `names` of `folder` that name a file of the set.
pub(super) fn beside(folder: &Path, names: &[String], set: &SetFiles) -> Vec<ListingDocument> {
    let listing = |name: &String| {
        let normal_y = match extensions::of_name(name).as_str() {
            "gltf" | "mtlx" => Some(NormalY::Up),
            "mtl" => None,
            _ => return None,
        };
        let path = folder.join(name);
        if !path.metadata().is_ok_and(|meta| meta.len() <= LONGEST) {
            return None;
        }
        let bytes = NamedFile::by_file(path, folder).bytes().ok()?;
        let text = String::from_utf8_lossy(&bytes);
        let is_named = |file: &String| text.contains(file);
        let files: Vec<_> = set.files.iter().map(|file| file.file.clone()).filter(is_named).collect();
        (!files.is_empty()).then(|| ListingDocument { name: name.clone(), files, normal_y })
    };
    names.iter().filter_map(listing).collect()
}
