//! Materials as files: one layered EXR, a packed PNG, a folder of PNG files, binary glTF.

mod exr;
mod glb;
mod png;

use std::path::Path;

pub use svbrdf_core::material::Depth;

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;

use crate::disk::atomic;
use crate::error::{Error, OutputProblem};

/// The kind of file that is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// One layered EXR: signed normals, y up, everything linear.
    Exr { half: bool },
    /// Four tiles N D R S in a row, linear.
    Packed { sixteen: bool },
    /// Four PNG files, colours in sRGB.
    Folder { sixteen: bool },
    /// A plane with the material, as binary glTF with PNG pictures in it.
    Glb { sixteen: bool },
}

impl FileKind {
    /// The kind that the extension of `path` and the `depth` specify; `None`: half in a layered EXR, else 8 bits. A folder exists, ends with
    /// `/` or has no extension.
    ///
    /// # Errors
    /// [`Error::UnsupportedOutput`] for a kind of file that is not written, and for a depth that it has not.
    pub fn new(path: &Path, depth: Option<Depth>) -> Result<Self, Error> {
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
        Ok(match extension {
            "exr" => Self::Exr { half: depth != Some(Depth::Float) },
            "glb" => Self::Glb { sixteen },
            "png" => Self::Packed { sixteen },
            _ => Self::Folder { sixteen },
        })
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
    match kind {
        FileKind::Exr { half } => {
            atomic::replace(path, progress, |file| exr::write(file, material, half))?;
        }
        FileKind::Packed { sixteen } => {
            atomic::replace(path, progress, |file| png::packed(file, material, sixteen, progress))?;
        }
        FileKind::Folder { sixteen } => {
            let remedy = "name a folder that is not there yet, in one that is writable";
            let written = png::folder(path, material, sixteen, progress);
            written.map_err(|source| Error::unwritten(path, source, remedy, progress))?;
        }
        FileKind::Glb { sixteen } => {
            let ior = glb::ior(material, sixteen);
            atomic::replace(path, progress, |file| glb::write(file, material, ior, sixteen, progress))?;
            return Ok(ior.map(|_| "programs without KHR_materials_specular show specular 0.04"));
        }
    }
    Ok(None)
}
