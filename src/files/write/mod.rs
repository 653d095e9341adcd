//! Materials as files: one layered EXR, a packed PNG, a folder of PNG files.

mod curve;
mod exr;
mod png;

use std::path::Path;

pub use svbrdf_core::material::Depth;

use svbrdf_core::error::{Error, OutputProblem};
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;

use super::read::Preset;
use crate::atomic;

/// Kinds of files that materials are read from and not written into: as the name of a folder they are a mistake.
const NOT_WRITTEN: [&str; 12] =
    ["jpg", "jpeg", "tif", "tiff", "hdr", "npy", "npz", "gltf", "glb", "mtl", "mtlx", "json"];

/// Options for the files to write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// `None`: half in EXR, 8 bits in PNG.
    pub depth: Option<Depth>,
    /// Whose names, order and encoding the files get.
    pub like: Option<Preset>,
    /// Whether an EXR gets a rendering as its R, G and B, for programs that know no layers.
    pub preview: bool,
}

/// The kind of file that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// One layered EXR: signed normals, y up, everything linear.
    Exr { half: bool, preview: bool },
    /// Four tiles in a row, in the order and encoding of a research code that packs maps.
    Packed { sixteen: bool, like: Preset },
    /// Four PNG files, colours in sRGB.
    Folder { sixteen: bool },
    /// Four PNG files in the names and encoding of MaterialGAN.
    MaterialGan { sixteen: bool },
    /// Base colour, normals, and occlusion | roughness | metallic in one picture: loses specular that no metal has.
    Gltf { sixteen: bool },
}

impl FileKind {
    /// The kind that the extension of `path` and the `options` specify.
    ///
    /// # Errors
    /// [`Error::UnsupportedOutput`] for a kind of file that is not written, and for a depth, a preset or a preview that it has not.
    pub fn new(path: &Path, options: &WriteOptions) -> Result<Self, Error> {
        let WriteOptions { depth, like, preview } = *options;
        let refuse = |problem| Err(Error::UnsupportedOutput { path: path.to_owned(), problem });
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        if NOT_WRITTEN.contains(&extension.as_str()) {
            return refuse(OutputProblem::Kind);
        }
        let is_exr = extension == "exr";
        if matches!(depth, Some(Depth::Half | Depth::Float)) != is_exr && depth.is_some() {
            return refuse(OutputProblem::Depth);
        }
        if preview && !is_exr {
            return refuse(OutputProblem::Preview);
        }
        let sixteen = depth == Some(Depth::Sixteen);
        match (extension.as_str(), like) {
            ("exr", None) => Ok(Self::Exr { half: depth != Some(Depth::Float), preview }),
            ("exr", Some(_)) => refuse(OutputProblem::LayeredPreset),
            ("png", like) => {
                let like = like.unwrap_or(Preset::Deschaintre);
                let refused = || refuse(OutputProblem::PackedPreset);
                like.order().map_or_else(refused, |_| Ok(Self::Packed { sixteen, like }))
            }
            (_, None) => Ok(Self::Folder { sixteen }),
            (_, Some(Preset::MaterialGan)) => Ok(Self::MaterialGan { sixteen }),
            (_, Some(Preset::Gltf)) => Ok(Self::Gltf { sixteen }),
            _ => refuse(OutputProblem::FolderPreset),
        }
    }
}

/// Writes `material`: the file or folder appears when it is complete, or not at all.
///
/// # Errors
/// [`Error::Unwritable`]; a folder that is there and not empty is not replaced.
pub fn write(material: &Material<f32>, path: &Path, kind: FileKind) -> Result<(), Error> {
    write_watched(material, path, kind, &Progress::default())
}

/// [`write()`], which can be cancelled: then nothing appears.
///
/// # Errors
/// As [`write()`]; [`Error::Cancelled`].
pub fn write_watched(
    material: &Material<f32>,
    path: &Path,
    kind: FileKind,
    progress: &Progress,
) -> Result<(), Error> {
    let folder = |files: &[png::Picture<'_>], sixteen| {
        png::folder(path, material, files, sixteen, progress).map_err(|source| {
            match progress.is_cancelled() {
                true => Error::Cancelled,
                false => Error::Unwritable {
                    path: path.to_owned(),
                    source,
                    remedy: "name a folder that is not there yet, in one that is writable",
                },
            }
        })
    };
    match kind {
        FileKind::Exr { half, preview } => {
            atomic::replace(path, progress, |file| exr::write(file, material, half, preview))
        }
        FileKind::Packed { sixteen, like } => {
            atomic::replace(path, progress, |file| png::packed(file, material, like, sixteen, progress))
        }
        FileKind::Folder { sixteen } => folder(&png::PLAIN, sixteen),
        FileKind::MaterialGan { sixteen } => folder(&png::MATERIAL_GAN, sixteen),
        FileKind::Gltf { sixteen } => folder(&png::GLTF, sixteen),
    }
}
