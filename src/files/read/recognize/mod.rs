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

use crate::error::Error;

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
    let noticed = noticed(&candidate);
    let mut found = match candidate {
        DecodedCandidate::Set(set, pictures) => return set::material(&set, pictures, bound, options),
        DecodedCandidate::Picture(located, decoded) => picture::material(located, decoded, options)?,
        DecodedCandidate::Gltf(located, pictures) => gltf::material(located, pictures, options)?,
        DecodedCandidate::Mtl(located, pictures) => mtl::material(&located, pictures, options)?,
        DecodedCandidate::Mtlx(located, pictures) => mtlx::material(&located, pictures, options)?,
    };
    let new: Vec<Note> = noticed.into_iter().filter(|note| !found.notes.contains(note)).collect();
    found.notes.extend(new);
    for (role, map) in bound {
        found.notes.push(Note::MapSpecified { map: *role, file: map.file.clone(), by: SpecifiedBy::Caller });
        found.replace(*role, map.clone());
    }
    Ok(found)
}

/// What the decoders of the pictures that a document names noticed, each once.
fn noticed(candidate: &DecodedCandidate) -> Vec<Note> {
    // glTF specifies how colours are stored, whatever its pictures declare (glTF 2.0, 5.19).
    let (pictures, is_specified) = match candidate {
        DecodedCandidate::Gltf(_, pictures) => (pictures, true),
        DecodedCandidate::Mtl(_, pictures) | DecodedCandidate::Mtlx(_, pictures) => (pictures, false),
        DecodedCandidate::Picture(..) | DecodedCandidate::Set(..) => return Vec::new(),
    };
    let is_of_colours =
        |note: &Note| matches!(note, Note::LinearChunk(..) | Note::Profile(_) | Note::PrimariesChunk(..));
    let is_void = |note: &Note| is_specified && is_of_colours(note);
    let mut notes: Vec<Note> = Vec::new();
    for note in pictures.iter().flat_map(|picture| &picture.notes) {
        if !is_void(note) && !notes.contains(note) {
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
