//! A located material of a Wavefront `.mtl`.

use std::path::PathBuf;

use super::picture::LocatedPicture;
use crate::read::options::Role;

/// Statements for normals, the plainest first; those of `bump` may also hold heights.
pub(crate) const NORMALS: [&str; 2] = ["norm", "map_kn"];
pub(crate) const BUMPS: [&str; 2] = ["map_bump", "bump"];

/// A material of an `.mtl`, its pictures located.
#[derive(Debug)]
pub(crate) struct LocatedMtl {
    pub path: PathBuf,
    pub entry: MtlEntry,
    /// The pictures of the entry that are read.
    pub textures: Vec<MtlTexture>,
    /// The statement of a picture of roughness and metallic.
    pub packed: Option<(&'static str, Role)>,
    pub is_by_blender: bool,
    /// The names of all materials of the file, and which of them this is.
    pub materials: (Vec<String>, usize),
}

/// A material: its statements, each a keyword in lower case and the rest of its line.
#[derive(Debug)]
pub(crate) struct MtlEntry {
    pub name: String,
    pub lines: Vec<(String, String)>,
}

/// A picture that a statement names.
#[derive(Debug)]
pub(crate) struct MtlTexture {
    /// The keyword of the statement.
    pub key: &'static str,
    /// The file as the statement names it.
    pub named: String,
    /// The file that is there: beside the `.mtl`, or as named.
    pub file: PathBuf,
    pub picture: LocatedPicture,
    /// The one channel that is taken; 3 is alpha.
    pub channel: Option<usize>,
    /// Options that change the look, and are not used.
    pub unused_options: Vec<String>,
}

/// Whether a statement of this keyword names a picture.
pub(crate) fn names_picture(key: &str) -> bool {
    /// Statements that name pictures although they do not begin with `map_`.
    const PICTURES: [&str; 5] = ["norm", "bump", "disp", "decal", "refl"];
    key.starts_with("map_") || PICTURES.contains(&key)
}
