//! Candidates at a path: located by names, listings and documents alone, and read once its pixels are asked for.

use svbrdf_core::progress::Progress;

use super::gltf::Gltf;
use super::mtl::Mtl;
use super::mtlx::Mtlx;
use super::picture::WholePicture;
use super::set::Set;
use super::sidecar::Binding;
use crate::disk::open::NamedFile;
use crate::error::Error;
use crate::read::options::{ReadOptions, Role};
use crate::read::record::Note;
use crate::read::stored::{StoredMap, StoredMaterial};

/// All that may be at a path.
#[derive(Debug)]
pub(crate) struct Located {
    /// Maps that are specified one by one.
    pub bound: Vec<Binding>,
    /// The most likely first: where pixels refuse one, the next is tried.
    pub candidates: Vec<Candidate>,
    /// The folders that were entered because each was the only one in another without pictures, the outermost first.
    pub folders: Vec<String>,
    /// The name of the material where it is not that of the candidate.
    pub name: Option<String>,
}

impl Located {
    /// These candidates, found where the user named the material.
    pub(crate) fn new(candidates: impl IntoIterator<Item = Candidate>) -> Self {
        let candidates = candidates.into_iter().collect();
        Self { bound: Vec::new(), candidates, folders: Vec::new(), name: None }
    }

    /// Reads the first candidate that its pixels do not refuse, with the maps that are specified one by one.
    ///
    /// # Errors
    /// [`Error::NotAMaterial`] where maps are missing, claimed twice or not those that their names stand for,
    /// [`Error::NotPacked`], [`Error::BadImage`], [`Error::Unreadable`], [`Error::NoSuchExemplar`],
    /// [`Cancelled`](Error::is_cancelled).
    pub(crate) fn read(self, options: &ReadOptions, progress: &Progress) -> Result<StoredMaterial, Error> {
        let bound = self.bound.iter().map(Binding::read).collect::<Result<Vec<_>, _>>()?;
        let mut refusal = None;
        let mut candidates = self.candidates.into_iter().peekable();
        while let Some(candidate) = candidates.next() {
            match candidate.read(&bound, options, progress) {
                Ok(mut found) => {
                    let notes = self.folders.into_iter().map(|folder| Note::InFolder { folder });
                    found.notes.splice(0..0, notes);
                    return Ok(StoredMaterial { name: self.name.unwrap_or(found.name), ..found });
                }
                Err(
                    error @ (Error::NotAMaterial { .. } | Error::MissingMap { .. } | Error::NotPacked { .. }),
                ) if candidates.peek().is_some() => {
                    refusal = Some(error);
                }
                // An incomplete set tells what it lacks.
                Err(error) if error.is_cancelled() || matches!(error, Error::MissingMap { .. }) => {
                    return Err(error);
                }
                // Of several candidates the first is the one that the user named.
                Err(error) => return Err(refusal.unwrap_or(error)),
            }
        }
        Err(refusal.unwrap_or_else(|| Error::Internal("no candidate was located".to_owned())))
    }

    /// Every file that may be decoded.
    pub(crate) fn files(&self) -> impl Iterator<Item = NamedFile> + '_ {
        let bound = self.bound.iter().filter_map(|binding| binding.file().cloned());
        bound.chain(self.candidates.iter().flat_map(Candidate::files))
    }
}

/// One way in which the maps of a material may be stored.
#[derive(Debug)]
pub(crate) enum Candidate {
    Picture(WholePicture),
    Set(Set),
    Gltf(Box<Gltf>),
    Mtl(Mtl),
    Mtlx(Mtlx),
}

impl Candidate {
    /// Every file that may be decoded.
    fn files(&self) -> Vec<NamedFile> {
        match self {
            Self::Picture(picture) => vec![picture.file.clone()],
            Self::Set(set) => set.all().collect(),
            Self::Gltf(gltf) => gltf.files(),
            Self::Mtl(mtl) => mtl.files(),
            Self::Mtlx(mtlx) => mtlx.files(),
        }
    }

    fn read(
        self,
        bound: &[(Role, StoredMap)],
        options: &ReadOptions,
        progress: &Progress,
    ) -> Result<StoredMaterial, Error> {
        let mut found = match self {
            Self::Set(set) => return set.read(bound, options, progress),
            Self::Picture(picture) => picture.read(options, progress)?,
            Self::Gltf(gltf) => gltf.read(options, progress)?,
            Self::Mtl(mtl) => mtl.read(options, progress)?,
            Self::Mtlx(mtlx) => mtlx.read(options, progress)?,
        };
        for (role, map) in bound {
            found.notes.push(Note::MapSpecified { map: *role, file: map.file.clone() });
            found.replace(*role, map.clone());
        }
        Ok(found)
    }

    pub(crate) fn name(&self) -> String {
        match self {
            Self::Picture(picture) => {
                let path = picture.file.path();
                path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
            }
            Self::Set(set) => set.name.clone(),
            Self::Gltf(material) => material.name.clone(),
            Self::Mtl(material) => material.name().to_owned(),
            Self::Mtlx(surface) => surface.name.clone(),
        }
    }
}
