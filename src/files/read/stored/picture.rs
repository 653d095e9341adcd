//! Pictures of a material: where their bytes are and what they are expected to be, decoded when they are asked for.

use std::fmt;
use std::io::Cursor;
use std::path::PathBuf;

use rayon::prelude::*;

use svbrdf_core::progress::Progress;

use super::material::StoredMap;
use super::material::StoredMaterial;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::decode::{Decoded, Layer, from_reader, one, reader};
use crate::read::options::Role;
use crate::read::raster::Raster;
use crate::read::record::{Note, Subject};

#[derive(Clone, Debug)]
pub(crate) struct Picture {
    pub source: PictureSource,
    pub subject: Subject,
}

/// The place of the bytes of a picture.
#[derive(Clone)]
pub(crate) enum PictureSource {
    File(NamedFile),
    Embedded { within: PathBuf, bytes: Vec<u8> },
}

/// Without the bytes: there may be millions.
impl fmt::Debug for PictureSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(file) => f.debug_tuple("File").field(file).finish(),
            Self::Embedded { within, .. } => f.debug_tuple("Embedded").field(within).finish(),
        }
    }
}

/// A picture of a material, and what its decoder noticed.
#[derive(Clone, Debug)]
pub(crate) struct DecodedPicture {
    pub map: StoredMap,
    pub subject: Subject,
    /// All that is stored, where the picture is another part of the plane.
    uncropped: Option<Raster>,
    /// The encoding that this program wrote into it.
    pub meaning: Option<String>,
    pub notes: Vec<Note>,
}

impl Picture {
    pub(crate) fn of_file(file: NamedFile, role: Role) -> Self {
        Self { source: PictureSource::File(file), subject: Subject::Map(role) }
    }

    /// Its file, where it has one of its own.
    pub(crate) fn file(&self) -> Option<&NamedFile> {
        match &self.source {
            PictureSource::File(file) => Some(file),
            PictureSource::Embedded { .. } => None,
        }
    }

    fn decoded(&self) -> Result<DecodedPicture, Error> {
        match &self.source {
            PictureSource::File(file) => {
                let (Layer { raster, uncropped, meaning, .. }, notes) = one(file, self.subject)?;
                let map = StoredMap { raster, file: file.path().to_owned(), part: String::new() };
                Ok(DecodedPicture { map, subject: self.subject, uncropped, meaning, notes })
            }
            PictureSource::Embedded { within, bytes } => {
                let Decoded { layers, notes, .. } =
                    from_reader(reader(Cursor::new(bytes)), within, self.subject)?;
                let raster = layers.into_iter().next().map(|layer| layer.raster);
                let raster = raster.ok_or_else(|| Error::BadImage {
                    path: within.clone(),
                    problem: format!("{}: expected a picture, found none", self.subject),
                    remedy: "export it again".to_owned(),
                })?;
                let map = StoredMap { raster, file: within.clone(), part: self.subject.to_string() };
                Ok(DecodedPicture { map, subject: self.subject, uncropped: None, meaning: None, notes })
            }
        }
    }
}

/// Decodes pictures at once, in their order; each is one step of `progress`.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`], [`Cancelled`](Error::is_cancelled).
pub(crate) fn decoded<'a>(
    pictures: impl IntoIterator<Item = &'a Picture>,
    progress: &Progress,
) -> Result<Vec<DecodedPicture>, Error> {
    let pictures: Vec<_> = pictures.into_iter().collect();
    progress.begin(pictures.len() as u64);
    let decode = |picture: &&Picture| {
        let decoded = picture.decoded();
        progress.step()?;
        decoded
    };
    // All are decoded before the first error is taken: so the same one is reported every time.
    let all: Vec<_> = pictures.par_iter().map(decode).collect();
    let mut all = all.into_iter().collect::<Result<Vec<_>, _>>()?;
    use_all_that_is_stored(&mut all);
    Ok(all)
}

/// Pictures whose display window alone has not the size of the other maps are meant as they are stored.
fn use_all_that_is_stored(all: &mut [DecodedPicture]) {
    let plain = |picture: &DecodedPicture| picture.uncropped.is_none().then(|| picture.map.raster.size());
    let sizes: Vec<_> = all.iter().filter_map(plain).collect();
    for DecodedPicture { map, uncropped, notes, .. } in all {
        let Some(stored) = uncropped.take() else { continue };
        if sizes.contains(&stored.size()) && !sizes.contains(&map.raster.size()) {
            map.raster = stored;
            notes.retain(|note| !matches!(note, Note::PartialData { .. }));
            notes.push(Note::DataWindow { layer: String::new() });
        }
    }
}

/// Adds what the decoders of the pictures of a document noticed and `counts`, each once.
pub(crate) fn notice(
    found: &mut StoredMaterial,
    pictures: &[DecodedPicture],
    counts: impl Fn(&Note) -> bool,
) {
    for note in pictures.iter().flat_map(|picture| &picture.notes).filter(|note| counts(note)) {
        if !found.notes.contains(note) {
            found.notes.push(note.clone());
        }
    }
}
