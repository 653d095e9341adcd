//! Materials as files: one layered EXR, a packed PNG, a folder of PNG files, binary glTF.

mod exr;
mod glb;
mod png;

use std::path::Path;

pub use svbrdf_core::material::Depth;

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;

use super::read::Preset;
use crate::disk::atomic;
use crate::error::{Error, OutputProblem};

/// Options for the files to write.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// `None`: half in a layered EXR, else 8 bits.
    pub depth: Option<Depth>,
    /// Whose names, order and encoding the files get.
    pub like: Option<Preset>,
}

/// The kind of file that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// One layered EXR: signed normals, y up, everything linear.
    Exr { half: bool },
    /// Four tiles in a row, in the order and encoding of a research code that packs maps.
    Packed { sixteen: bool, like: Preset },
    /// Four PNG files, colours in sRGB.
    Folder { sixteen: bool },
    /// Four PNG files in the names and encoding of MaterialGAN.
    MaterialGan { sixteen: bool },
    /// A plane with the material, as binary glTF with PNG pictures in it.
    Glb { sixteen: bool },
}

impl FileKind {
    /// The kind that the extension of `path` and the `options` specify. A folder exists, ends with `/` or has no extension.
    ///
    /// # Errors
    /// [`Error::UnsupportedOutput`] for a kind of file that is not written, and for a depth or a preset that it has not.
    pub fn new(path: &Path, options: &WriteOptions) -> Result<Self, Error> {
        let WriteOptions { depth, like } = *options;
        let refuse = |problem| Err(Error::UnsupportedOutput { path: path.to_owned(), problem });
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let extension = if is_folder(path) { "" } else { &extension };
        if !["", "exr", "png", "glb"].contains(&extension) {
            return refuse(OutputProblem::Kind);
        }
        let depths: &[Depth] = match extension {
            "exr" => &[Depth::Half, Depth::Float],
            _ => &[Depth::Eight, Depth::Sixteen],
        };
        if depth.is_some_and(|depth| !depths.contains(&depth)) {
            return refuse(OutputProblem::Depth);
        }
        let sixteen = depth == Some(Depth::Sixteen);
        match (extension, like) {
            ("exr", None) => Ok(Self::Exr { half: depth != Some(Depth::Float) }),
            ("glb", None) => Ok(Self::Glb { sixteen }),
            ("exr" | "glb", Some(_)) => refuse(OutputProblem::NoPreset),
            ("png", like) => {
                let like = like.unwrap_or(Preset::Deschaintre);
                let refused = || refuse(OutputProblem::PackedPreset);
                like.order().map_or_else(refused, |_| Ok(Self::Packed { sixteen, like }))
            }
            (_, None) => Ok(Self::Folder { sixteen }),
            (_, Some(Preset::MaterialGan)) => Ok(Self::MaterialGan { sixteen }),
            _ => refuse(OutputProblem::FolderPreset),
        }
    }
}

/// Whether `path` names a folder whatever its extension: one that exists, or that ends with a separator.
fn is_folder(path: &Path) -> bool {
    let last = path.as_os_str().to_string_lossy().chars().next_back();
    path.is_dir() || last.is_some_and(std::path::is_separator)
}

/// Writes `material`: the file or folder appears when it is complete, or not at all. Returns a note where some programs show less
/// than the file has.
///
/// # Errors
/// [`Error::Unwritable`]; a folder that is there and not empty is not replaced.
pub fn write(material: &Material<f32>, path: &Path, kind: FileKind) -> Result<Option<&'static str>, Error> {
    write_watched(material, path, kind, &Progress::default())
}

/// [`write()`], which can be cancelled: then nothing appears.
///
/// # Errors
/// As [`write()`]; [`Cancelled`](Error::is_cancelled).
pub fn write_watched(
    material: &Material<f32>,
    path: &Path,
    kind: FileKind,
    progress: &Progress,
) -> Result<Option<&'static str>, Error> {
    atomic::check_folder(path)?;
    let folder = |files: &[png::FolderPicture<'_>], sixteen| {
        let remedy = "name a folder that is not there yet, in one that is writable";
        let written = png::folder(path, material, files, sixteen, progress);
        written.map_err(|source| Error::unwritten(path, source, remedy, progress))
    };
    match kind {
        FileKind::Exr { half } => {
            atomic::replace(path, progress, |file| exr::write(file, material, half))?;
        }
        FileKind::Packed { sixteen, like } => {
            atomic::replace(path, progress, |file| png::packed(file, material, like, sixteen, progress))?;
        }
        FileKind::Folder { sixteen } => folder(&png::PLAIN, sixteen)?,
        FileKind::MaterialGan { sixteen } => folder(&png::MATERIAL_GAN, sixteen)?,
        FileKind::Glb { sixteen } => {
            let ior = glb::ior(material, sixteen);
            atomic::replace(path, progress, |file| glb::write(file, material, ior, sixteen, progress))?;
            return Ok(ior.map(|_| "programs without KHR_materials_specular show specular 0.04"));
        }
    }
    Ok(None)
}
