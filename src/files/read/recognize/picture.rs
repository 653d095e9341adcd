//! One picture that holds a whole material.

use super::{layers, packed};
use crate::error::Error;
use crate::read::decode::Decoded;
use crate::read::located::WholePicture;
use crate::read::options::ReadOptions;
use crate::read::stored::StoredMaterial;

/// The material within a decoded picture: in tiles, or in named layers.
///
/// # Errors
/// [`Error::NotPacked`], [`Error::NotAMaterial`], [`Error::NoSuchExemplar`].
pub(crate) fn material(
    located: WholePicture,
    decoded: Decoded,
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let WholePicture { file, refusal } = located;
    let Decoded { mut layers, mut notes, native, meaning } = decoded;
    let found = match layers.pop() {
        Some(only) if layers.is_empty() && !layers::is_named(&only) => {
            packed::material(file.path(), &only.raster, meaning.as_deref(), options)
        }
        last => layers::material(file.path(), layers.into_iter().chain(last).collect(), native, options),
    };
    let mut found = found.map_err(|error| match (error, refusal) {
        (Error::NotAMaterial { .. } | Error::MissingMap { .. } | Error::NotPacked { .. }, Some(refusal)) => {
            refusal
        }
        (error, _) => error,
    })?;
    notes.append(&mut found.notes);
    Ok(StoredMaterial { notes, ..found })
}
