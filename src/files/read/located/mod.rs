//! Located materials: the files and pictures that hold the maps of a material, found by names and documents alone.
//!
//! Locating hands these to decoding and recognition; no pixel has been read yet.

pub(super) mod binding;
pub(super) mod gltf;
pub(super) mod mtl;
pub(super) mod mtlx;
pub(super) mod picture;
pub(super) mod set;
pub(super) mod surface_model;

use crate::error::Error;

use crate::disk::open::NamedFile;

use binding::{BoundSource, LocatedBinding};
use gltf::LocatedGltf;
use mtl::LocatedMtl;
use mtlx::LocatedMtlx;
use picture::{LocatedPicture, PictureSource};
use set::LocatedSet;

/// All that may be at a path.
#[derive(Debug)]
pub(crate) struct Located {
    /// Maps that are specified one by one.
    pub bound: Vec<LocatedBinding>,
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

    /// Every file that may be decoded, neighbours excepted.
    pub(crate) fn files(&self) -> impl Iterator<Item = NamedFile> + '_ {
        let bound = self.bound.iter().filter_map(|binding| match &binding.source {
            BoundSource::File { file, .. } => Some(file.clone()),
            BoundSource::Constant(_) => None,
        });
        bound.chain(self.candidates.iter().flat_map(Candidate::files))
    }
}

/// One way in which the maps of a material may be stored.
#[derive(Debug)]
pub(crate) enum Candidate {
    Picture(WholePicture),
    Set(LocatedSet),
    Gltf(LocatedGltf),
    Mtl(LocatedMtl),
    Mtlx(LocatedMtlx),
}

impl Candidate {
    /// Every file that may be decoded, neighbours excepted.
    fn files(&self) -> Vec<NamedFile> {
        let of = |picture: &LocatedPicture| match &picture.source {
            PictureSource::File(file) => Some(file.clone()),
            PictureSource::Embedded { .. } => None,
        };
        match self {
            Self::Picture(picture) => vec![picture.file.clone()],
            Self::Set(set) => set.files.names().map(|name| set.file(name)).collect(),
            Self::Gltf(gltf) => {
                let embedded = gltf.buffers.iter().cloned().chain([NamedFile::by_user(&gltf.path)]);
                gltf.pictures.iter().filter_map(of).chain(embedded).collect()
            }
            Self::Mtl(mtl) => mtl.textures.iter().filter_map(|texture| of(&texture.picture)).collect(),
            Self::Mtlx(mtlx) => mtlx.pictures.iter().filter_map(of).collect(),
        }
    }

    /// The name of the material.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Picture(picture) => {
                let path = picture.file.path();
                path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
            }
            Self::Set(set) => set.name.clone(),
            Self::Gltf(material) => material.name.clone(),
            Self::Mtl(material) => material.entry.name.clone(),
            Self::Mtlx(surface) => surface.name.clone(),
        }
    }
}

/// A picture that may hold a whole material, in tiles or layers.
#[derive(Debug)]
pub(crate) struct WholePicture {
    pub file: NamedFile,
    /// The error where its pixels are those of no packed picture; `None`: the error of its recognition.
    pub refusal: Option<Error>,
}
