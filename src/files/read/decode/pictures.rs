//! The pictures of a located material, decoded at once.

use rayon::prelude::*;

use svbrdf_core::progress::Progress;

use super::reader::Reader;
use super::{Decoded, Layer, from_reader, one, whole};
use crate::error::Error;
use crate::read::located::binding::{BoundSource, LocatedBinding};
use crate::read::located::gltf::LocatedGltf;
use crate::read::located::mtl::LocatedMtl;
use crate::read::located::mtlx::LocatedMtlx;
use crate::read::located::picture::{LocatedPicture, PictureSource};
use crate::read::located::set::LocatedSet;
use crate::read::located::{Candidate, WholePicture};
use crate::read::raster::Raster;
use crate::read::record::{Note, Subject};
use crate::read::stored::StoredMap;

/// A picture of a material, and what its decoder noticed.
#[derive(Clone, Debug)]
pub(crate) struct DecodedPicture {
    pub map: StoredMap,
    /// All that is stored, where the picture is another part of the plane.
    pub uncropped: Option<Raster>,
    pub notes: Vec<Note>,
}

/// A candidate with its pictures, in the order in which they were located.
#[derive(Debug)]
pub(crate) enum DecodedCandidate {
    Picture(WholePicture, Decoded),
    Set(LocatedSet, Vec<DecodedPicture>),
    Gltf(LocatedGltf, Vec<DecodedPicture>),
    Mtl(LocatedMtl, Vec<DecodedPicture>),
    Mtlx(LocatedMtlx, Vec<DecodedPicture>),
}

/// Decodes the pictures of a candidate; each is one step of `progress`.
///
/// Pictures that are needed only where the pixels of others are not those of their map stay undecoded.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`], [`Cancelled`](Error::is_cancelled).
pub(in crate::read) fn candidate(
    candidate: Candidate,
    progress: &Progress,
) -> Result<DecodedCandidate, Error> {
    Ok(match candidate {
        Candidate::Picture(picture) => {
            progress.begin(1);
            let decoded = whole(&picture.file, Subject::Material)?;
            progress.step()?;
            DecodedCandidate::Picture(picture, decoded)
        }
        Candidate::Set(set) => {
            let pictures: Vec<_> = set.pictures().collect();
            let decoded = all(&pictures, progress)?;
            DecodedCandidate::Set(set, decoded)
        }
        Candidate::Gltf(mut gltf) => {
            // Dropped once they are decoded: they hold the bytes of embedded pictures.
            let decoded = all(&std::mem::take(&mut gltf.pictures), progress)?;
            DecodedCandidate::Gltf(gltf, decoded)
        }
        Candidate::Mtl(mtl) => {
            let pictures: Vec<_> = mtl.textures.iter().map(|texture| texture.picture.clone()).collect();
            let decoded = all(&pictures, progress)?;
            DecodedCandidate::Mtl(mtl, decoded)
        }
        Candidate::Mtlx(mtlx) => {
            let decoded = all(&mtlx.pictures, progress)?;
            DecodedCandidate::Mtlx(mtlx, decoded)
        }
    })
}

fn all(pictures: &[LocatedPicture], progress: &Progress) -> Result<Vec<DecodedPicture>, Error> {
    progress.begin(pictures.len() as u64);
    let decode = |picture: &LocatedPicture| {
        let decoded = decoded(picture);
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
    for DecodedPicture { map, uncropped, notes } in all {
        let Some(stored) = uncropped.take() else { continue };
        if sizes.contains(&stored.size()) && !sizes.contains(&map.raster.size()) {
            map.raster = stored;
            notes.retain(|note| !matches!(note, Note::PartialData { .. }));
            notes.push(Note::DataWindow { layer: String::new() });
        }
    }
}

fn decoded(LocatedPicture { source, subject }: &LocatedPicture) -> Result<DecodedPicture, Error> {
    match source {
        PictureSource::File(file) => {
            let (Layer { raster, uncropped, .. }, notes) = one(file, *subject)?;
            let map = StoredMap { raster, file: file.path().to_owned(), part: String::new() };
            Ok(DecodedPicture { map, uncropped, notes })
        }
        PictureSource::Embedded { within, bytes } => {
            let Decoded { layers, notes, .. } = from_reader(Reader::of_bytes(bytes), within, *subject)?;
            let raster = layers.into_iter().next().map(|layer| layer.raster);
            let raster = raster.ok_or_else(|| Error::BadImage {
                path: within.clone(),
                problem: format!("{subject}: expected a picture, found none"),
                remedy: "export it again".to_owned(),
            })?;
            let map = StoredMap { raster, file: within.clone(), part: subject.to_string() };
            Ok(DecodedPicture { map, uncropped: None, notes })
        }
    }
}

/// The picture of a binding, or all layers of its file where it names a part.
#[derive(Debug)]
pub(crate) enum DecodedBinding {
    Constant(Vec<f32>),
    Whole(Raster),
    Parts(Vec<Layer>, String),
}

/// Decodes the file of a binding.
///
/// # Errors
/// [`Error::Unreadable`], [`Error::BadImage`].
pub(in crate::read) fn binding(binding: &LocatedBinding) -> Result<DecodedBinding, Error> {
    let subject = Subject::Map(binding.role);
    match &binding.source {
        BoundSource::Constant(values) => Ok(DecodedBinding::Constant(values.clone())),
        BoundSource::File { file, part: None } => Ok(DecodedBinding::Whole(one(file, subject)?.0.raster)),
        BoundSource::File { file, part: Some(part) } => {
            Ok(DecodedBinding::Parts(whole(file, subject)?.layers, part.clone()))
        }
    }
}
