//! Recognition: which decoded picture is which map, by names, documents and pixels.

mod binding;
mod field;
mod gltf;
mod hints;
mod layers;
mod mtl;
mod mtlx;
mod mtlx_input;
mod packed;
mod partial_set;
mod picture;
mod roles;
mod scaled_normals;
mod set;

pub(super) use binding::recognized as binding;
pub(super) use picture::material as picture;

use svbrdf_core::error::Error;

use crate::read::decode::pictures::DecodedCandidate;
use crate::read::options::{ReadOptions, Role};
use crate::read::record::{Note, SpecifiedBy};
use crate::read::stored::{StoredMap, StoredMaterial};

/// The material of a candidate with the maps `bound`.
///
/// # Errors
/// [`Error::NotAMaterial`] where maps are missing, claimed twice or not those that their names stand for,
/// [`Error::NotPacked`], [`Error::BadImage`] where a document is broken, [`Error::MapSizesDiffer`],
/// [`Error::NoSuchExemplar`].
pub(super) fn candidate(
    candidate: DecodedCandidate,
    bound: &[(Role, StoredMap)],
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let outside = outside(&candidate);
    let mut found = match candidate {
        DecodedCandidate::Set(set, pictures) => return set::material(&set, pictures, bound, options),
        DecodedCandidate::Picture(located, decoded) => picture::material(located, decoded, options)?,
        DecodedCandidate::Gltf(located, pictures) => gltf::material(located, pictures, options)?,
        DecodedCandidate::Mtl(located, pictures) => mtl::material(&located, pictures, options)?,
        DecodedCandidate::Mtlx(located, pictures) => mtlx::material(&located, pictures, options)?,
    };
    let new: Vec<Note> = outside.into_iter().filter(|note| !found.notes.contains(note)).collect();
    found.notes.extend(new);
    for (role, map) in bound {
        found.notes.push(Note::MapSpecified { map: *role, file: map.file.clone(), by: SpecifiedBy::Caller });
        found.replace(*role, map.clone());
    }
    Ok(found)
}

/// The notes about pictures outside of the folder of the document that names them, each once.
fn outside(candidate: &DecodedCandidate) -> Vec<Note> {
    let pictures = match candidate {
        DecodedCandidate::Gltf(_, pictures) => pictures,
        DecodedCandidate::Mtl(_, pictures) | DecodedCandidate::Mtlx(_, pictures) => pictures,
        DecodedCandidate::Picture(..) | DecodedCandidate::Set(..) => return Vec::new(),
    };
    let mut notes: Vec<Note> = Vec::new();
    for note in pictures.iter().flat_map(|picture| &picture.notes) {
        if matches!(note, Note::OutsideFolder { .. }) && !notes.contains(note) {
            notes.push(note.clone());
        }
    }
    notes
}

/// `found` within these folders, the outermost first, with this name in place of its own.
pub(super) fn within(mut found: StoredMaterial, folders: &[String], name: Option<String>) -> StoredMaterial {
    let notes = folders.iter().map(|folder| Note::InFolder { folder: folder.clone() });
    found.notes.splice(0..0, notes);
    StoredMaterial { name: name.unwrap_or(found.name), ..found }
}
