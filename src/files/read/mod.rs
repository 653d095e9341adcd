//! Reading: a material from files, in stages that go one way.
//!
//! | stage | from | to |
//! |---|---|---|
//! | `formats` | a path | maps by role as stored (`stored`): a file or folder for each format, which locates, decodes and recognizes |
//! | `interpret` | stored maps | evidence of pixels, and the planes of a [`Material`](svbrdf_core::material::Material), with the [record](Read) of its reading |
//!
//! A path enters as a [`MaterialPath`]. [`read()`] is the short form; [`read_bytes`] begins with a picture in memory; a photograph, which is no
//! material, is [decoded](read_photograph) alone.
//!
//! `docs/formats.md` lists every form that opens. Colour chunks are ignored. [`ReadOptions`] specify how values are stored; the
//! rest is inferred from names and pixels, and recorded as an [`Assumption`].

pub(crate) mod decode;
mod formats;
mod interpret;
mod names;
pub(crate) mod options;
mod photograph;
mod raster;
mod record;
mod result;
mod storage;
mod stored;

use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub use formats::{Binding, Sidecar, is_prefix};
pub use interpret::read_mask;
pub use names::{EXTENSIONS, sets};
pub use options::{
    Albedo, Energy, NonFinite, NormalEncoding, NormalY, Order, Preset, ReadOptions, Reflectance, Role,
    Roughness, TileGrid, Workflow,
};
pub use photograph::{Photograph, read_photograph};
pub use record::{Assumption, Certainty, Evidence, Ground, Note, Reason, Subject, Unused, What};
pub use result::{MapContent, Read};
pub use storage::Storage;

use sha2::{Digest as _, Sha256};

use svbrdf_core::math::real::Real;
use svbrdf_core::progress::Progress;

use crate::disk::open::{NamedFile, hexadecimal};
use crate::disk::{inputs, memory};
use crate::error::Error;

use formats::WholePicture;
use stored::StoredMaterial;

/// Reads the material at `path`: a packed or layered image, a folder, the common prefix of files, or one of them.
/// The short form of [`MaterialPath::read`].
///
/// # Errors
/// As [`MaterialPath::read`].
pub fn read<T: Real>(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Read<T>, Error> {
    MaterialPath::new(path, options).read(progress)
}

/// The number of materials of an npz file of batches, of which `FILE/0001` is the first; `None` of other files.
pub fn batch(path: &Path) -> Option<usize> {
    is_npz(path).then(|| decode::batch(&NamedFile::by_user(path))).flatten()
}

fn is_npz(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("npz"))
}

/// A path with a material, and how it is specified: whatever is read from files begins here.
#[derive(Clone, Copy, Debug)]
pub struct MaterialPath<'a> {
    path: &'a Path,
    options: ReadOptions,
    bindings: &'a [Binding],
}

impl<'a> MaterialPath<'a> {
    /// The material at `path`, whose sidecar file completes `options`. `batch.npz/0003` is the third material of a batch.
    pub fn new(path: &'a Path, options: &ReadOptions) -> Self {
        let number = || path.file_name()?.to_str()?.parse::<usize>().ok()?.checked_sub(1);
        let in_batch = path.parent().filter(|file| is_npz(file) && file.is_file()).zip(number());
        let (path, options) = match in_batch {
            Some((file, number)) => (file, ReadOptions { exemplar: Some(number), ..*options }),
            None => (path, *options),
        };
        Self { path, options, bindings: &[] }
    }

    /// With the maps of `bindings` in place of those at the path.
    #[must_use]
    pub fn bound(self, bindings: &'a [Binding]) -> Self {
        Self { bindings, ..self }
    }

    /// Reads the material. Each file is one step of `progress`.
    ///
    /// # Errors
    /// [`Error::Unreadable`] where there is no such file or folder, [`Error::BadImage`] where a file is no image, is
    /// broken or too large, [`Error::NotAMaterial`] where a map is missing, claimed twice or gray though it is the
    /// normal map, [`Error::NotPacked`] where a picture is no packed image, [`Error::MapSizesDiffer`] where maps differ in
    /// shape, [`Error::NotFinite`] at NaN and infinity, [`Error::NoSuchExemplar`], [`Error::BadSidecar`],
    /// [`Cancelled`](Error::is_cancelled).
    pub fn read<T: Real>(&self, progress: &Progress) -> Result<Read<T>, Error> {
        let used = self.used()?;
        let options = &used.options.with_preset();
        let located = formats::locate(self.path, options, &used.bindings)?;
        let mut read = finish(located.read(options, progress)?, options)?;
        if let Some(file) = used.file {
            read.files.push(file.clone());
            let how =
                format!("{} specifies how the material is read, unless an option does.", file.display());
            read.notes.insert(0, Note::Told(how));
        }
        read.files.iter().for_each(|file| inputs::protect(file));
        Ok(Read { options: used.options, ..read })
    }

    /// What its reading depends on.
    ///
    /// # Errors
    /// Where the material cannot be located, or one of the files not be read.
    pub fn dependencies(&self) -> Result<Dependencies, Error> {
        let used = self.used()?;
        let located = formats::locate(self.path, &used.options.with_preset(), &used.bindings)?;
        let mut hash = Sha256::new();
        hash.update(format!("{used:?} {located:?}"));
        let mut files = Vec::new();
        for file in located.files() {
            let digest = file.digest()?;
            hash.update(&digest);
            files.push((file.path().to_owned(), digest));
        }
        Ok(Dependencies { sha256: hexadecimal(hash), files })
    }

    /// The names that the material may have once it is read, found without its pixels; at least one.
    pub fn possible_names(&self) -> Vec<String> {
        let options = self.used().map_or(self.options, |used| used.options);
        let found = formats::names(self.path, &options.with_preset()).unwrap_or_default();
        if found.is_empty() {
            vec![self.path.file_stem().unwrap_or(self.path.as_os_str()).to_string_lossy().into_owned()]
        } else {
            found
        }
    }

    /// What is specified here, and in the sidecar file where nothing is.
    fn used(&self) -> Result<Sidecar, Error> {
        Ok(Sidecar::load(self.path)?.overridden_by(&self.options, self.bindings))
    }
}

/// What the reading of a material depends on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dependencies {
    /// In hexadecimal: of the options, also those of the sidecar file, of what was located by names, listings and documents, and of the content of `files`.
    pub sha256: String,
    /// Every file that may be decoded, with its SHA-256.
    pub files: Vec<(PathBuf, String)>,
}

/// Reads a packed or layered image from memory; `name` is the name of the material.
///
/// # Errors
/// As [`read`].
pub fn read_bytes<T: Real>(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Read<T>, Error> {
    let options = &options.with_preset();
    let decoded =
        decode::from_reader(decode::reader(Cursor::new(bytes)), Path::new(name), Subject::Material)?;
    let stored = WholePicture::by_user(Path::new(name)).recognized(decoded, options)?;
    let read = finish(StoredMaterial { name: name.to_owned(), ..stored }, options)?;
    Ok(Read { files: Vec::new(), ..read })
}

fn finish<T: Real>(mut stored: StoredMaterial, options: &ReadOptions) -> Result<Read<T>, Error> {
    let [width, height] = stored.colour.raster.size();
    // Three planes each of normals, diffuse and specular, one of roughness.
    let bytes = (width as u64).saturating_mul(height as u64).saturating_mul(10 * size_of::<T>() as u64);
    let memory = memory::reserve(bytes, || format!("the material {}", stored.name))?;
    let maps = result::reports(&stored);
    let mask = interpret::mask(&mut stored, options);
    let material = interpret::interpret(&mut stored, options)?;
    Ok(Read {
        material,
        mask,
        assumptions: stored.assumptions,
        notes: stored.notes,
        files: stored.files,
        maps,
        options: *options,
        memory: Arc::new(memory),
    })
}
