//! One picture that holds a whole material.

use std::path::Path;

use super::{layers, packed};
use crate::error::Error;
use crate::files::read::decode::{self, Decoded};
use crate::files::read::note::Subject;
use crate::files::read::options::ReadOptions;
use crate::files::read::stored::StoredMaterial;
use crate::progress::Progress;

/// Reads the material within the picture `path`.
///
/// # Errors
/// As `read`.
pub(crate) fn open(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
    progress.begin(1);
    let decoded = decode::decode_file(path, Subject::Material)?;
    progress.step()?;
    assemble(path, decoded, options)
}

/// The material within one decoded file: a packed picture, or one of named layers.
///
/// # Errors
/// [`Error::NotPacked`], [`Error::NotAMaterial`].
pub(crate) fn assemble(
    path: &Path,
    decoded: Decoded,
    options: &ReadOptions,
) -> Result<StoredMaterial, Error> {
    let Decoded { mut layers, mut notes, native, meaning } = decoded;
    let mut found = match layers.pop() {
        Some(only) if layers.is_empty() && !layers::is_named(&only) => {
            packed::unpack(path, &only.raster, meaning.as_deref(), options)?
        }
        last => layers::assemble(path, layers.into_iter().chain(last).collect(), native, options)?,
    };
    notes.append(&mut found.notes);
    Ok(StoredMaterial { notes, ..found })
}
