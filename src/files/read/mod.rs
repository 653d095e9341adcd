//! Reading a material from files.
//!
//! `locate` and `formats` find the maps, `decode` turns a file into the samples that it stores, and `interpret` turns
//! samples into linear values. What opens is listed in `docs/formats.md`.
//!
//! Colour chunks are ignored. [`ReadOptions`] specify what the values mean; what these leave open is inferred from names
//! and pixels, and recorded as an [`Assumption`].

mod assumption;
mod buffer;
mod choices;
mod decode;
mod evidence;
mod extensions;
mod formats;
mod grid;
pub(crate) mod interpret;
mod layered_options;
mod locate;
mod note;
mod note_text;
mod options;
mod order;
mod outside;
mod photograph;
mod pictures;
mod preset;
mod raster;
mod reason;
mod reason_text;
mod role;
mod samples;
mod sidecar;
mod spread;
mod storage_convention;
mod stored;

use std::io::Cursor;
use std::path::{Path, PathBuf};

pub use assumption::{Assumption, Certainty, What};
pub use evidence::Evidence;
pub use extensions::EXTENSIONS;
pub use grid::TileGrid;
pub use interpret::report::MapReport;
pub use locate::binding::Binding;
pub(crate) use locate::names::Label;
pub use note::{Gray, Note, SpecifiedBy, Subject, Unused};
pub use options::{
    Albedo, Energy, NonFinite, NormalEncoding, NormalY, ReadOptions, Reflectance, Roughness, Workflow,
};
pub use order::Order;
pub use photograph::{Photograph, PhotographOptions, Transfer, read_photograph};
pub use preset::Preset;
pub use reason::Reason;
pub use role::Role;
pub use sidecar::Sidecar;
pub use storage_convention::StorageConvention;

use crate::error::Error;
use crate::material::{Material, Planes};
use crate::math::real::Real;
use crate::progress::Progress;
use extensions::LISTING;
use formats::{gltf, mtl, mtlx};
use interpret::{encoding, report};
use locate::{binding, folder, picture};
use stored::{StoredMap, StoredMaterial};

/// A material, and how it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Read<T> {
    pub material: Material<T>,
    /// What was assumed, each with its reason.
    pub assumptions: Vec<Assumption>,
    /// What else was noticed.
    pub notes: Vec<Note>,
    /// The files that were read, each once, for watching. None for a material from memory.
    pub files: Vec<PathBuf>,
    /// What each map looks like as stored.
    pub maps: Vec<MapReport>,
    /// The options that it was read with: those of the caller and, unless it excluded them, those of the sidecar file.
    pub options: ReadOptions,
    /// The options of the sidecar file.
    pub saved: ReadOptions,
}

impl<T> Read<T> {
    /// Notes and assumptions, a line each.
    pub fn messages(&self) -> impl Iterator<Item = String> {
        self.notes.iter().map(ToString::to_string).chain(self.assumptions.iter().map(ToString::to_string))
    }

    /// The names of the materials of a file of several, and which of them this is, from 0: without
    /// [`ReadOptions::exemplar`] the default.
    pub fn materials(&self) -> Option<(&[String], usize)> {
        self.notes.iter().find_map(|note| match note {
            Note::Materials { names, index } => Some((names.as_slice(), *index)),
            _ => None,
        })
    }

    /// The assumptions whose alternatives are as plausible.
    pub fn unsure(&self) -> impl Iterator<Item = &Assumption> {
        self.assumptions.iter().filter(|a| a.certainty == Certainty::Unsure)
    }

    /// Refuses guesses; `path` is what was read.
    ///
    /// What passes is read by what the user, a specification, or the names of files, layers and formats say: nothing is
    /// unsure, the interpretation of no value rests on a measurement of pixels alone, and nothing that changes the look
    /// is ignored.
    ///
    /// # Errors
    /// [`Error::Guessed`].
    pub fn refuse_guesses(&self, path: &Path) -> Result<(), Error> {
        let assumptions = self.assumptions.iter().filter(|a| a.is_guess()).map(ToString::to_string);
        let ignored = self.notes.iter().filter(|note| note.changes_look()).map(ToString::to_string);
        match assumptions.chain(ignored).collect::<Vec<_>>() {
            guesses if guesses.is_empty() => Ok(()),
            guesses => Err(Error::Guessed { path: path.to_owned(), guesses: guesses.join("; ") }),
        }
    }
}

/// Reads the material at `path`: a packed or layered image, a folder, the common prefix of files, or one of them.
///
/// Each file is one step of `progress`.
///
/// # Errors
/// [`Error::Unreadable`] where there is no such file or folder, [`Error::BadImage`] where a file is no image, is
/// broken or too large, [`Error::NotAMaterial`] where a map is missing, claimed twice or gray though it is the
/// normal map, [`Error::NotPacked`] where a picture is no packed image, [`Error::MapSizesDiffer`] where maps differ in
/// shape, [`Error::NotFinite`] at NaN and infinity, [`Error::NoSuchExemplar`], [`Error::NoTextures`],
/// [`Error::BadSidecar`], [`Error::Cancelled`].
pub fn read<T: Real>(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Read<T>, Error> {
    read_bound(path, &[], options, progress)
}

/// As [`read`], with the maps of `bindings` in place of those at `path`.
///
/// # Errors
/// As [`read`].
pub fn read_bound<T: Real>(
    path: &Path,
    bindings: &[Binding],
    options: &ReadOptions,
    progress: &Progress,
) -> Result<Read<T>, Error> {
    let saved = Sidecar::load(path)?;
    let used = saved.clone().overridden_by(options, bindings);
    read_with(path, &saved, &used, progress)
}

/// As [`read`], but with exactly these `options`: the sidecar file is not used.
///
/// # Errors
/// As [`read`].
pub fn read_as<T: Real>(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Read<T>, Error> {
    let saved = Sidecar::load(path)?;
    let used = Sidecar { options: *options, ..saved.clone() };
    read_with(path, &saved, &used, progress)
}

/// The planes of a material and their (width, height), as [`read`], but with the lengths that normals are stored with.
///
/// # Errors
/// As [`read`]. Values are not checked as those of a [`Material`] are.
pub fn read_unnormalized<T: Real>(
    path: &Path,
    options: &ReadOptions,
    progress: &Progress,
) -> Result<(Planes<T>, [usize; 2]), Error> {
    let saved = Sidecar::load(path)?;
    let used = saved.clone().overridden_by(options, &[]);
    encoding::planes(&mut located(path, &saved, &used, progress)?, &used.options.with_preset())
}

fn read_with<T: Real>(
    path: &Path,
    saved: &Sidecar,
    used: &Sidecar,
    progress: &Progress,
) -> Result<Read<T>, Error> {
    let mut read = finish(located(path, saved, used, progress)?, &used.options.with_preset())?;
    (read.options, read.saved) = (used.options, saved.options);
    if *saved != Sidecar::default() {
        let file = Sidecar::path_for(path);
        saved.attribute(&file, &used.options, &mut read.assumptions, &mut read.notes);
        read.files.push(file);
    }
    Ok(read)
}

/// What is stored at `path`, with the maps that `used` binds.
fn located(
    path: &Path,
    saved: &Sidecar,
    used: &Sidecar,
    progress: &Progress,
) -> Result<StoredMaterial, Error> {
    let remaining = used.bindings.iter().filter(|binding| saved.bindings.contains(binding));
    Sidecar { bindings: remaining.cloned().collect(), ..Sidecar::default() }.check_maps(path)?;
    let bound = used.bindings.iter().map(Binding::load).collect::<Result<_, _>>()?;
    find(&sidecar::material_of(path)?, bound, &used.options.with_preset(), progress)
}

/// Reads a packed or layered image from memory; `name` is the name of the material.
///
/// # Errors
/// As [`read`].
pub fn read_bytes<T: Real>(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Read<T>, Error> {
    let path = Path::new(name);
    let options = &options.with_preset();
    let decoded = decode::decode(Cursor::new(bytes), path, Subject::Material)?;
    let found = picture::assemble(path, decoded, options)?;
    let read = finish(StoredMaterial { name: name.to_owned(), ..found }, options)?;
    Ok(Read { files: Vec::new(), ..read })
}

fn find(
    path: &Path,
    bound: Vec<(Role, StoredMap)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Result<StoredMaterial, Error> {
    if path.is_dir() {
        return folder::open(path, path, "", bound, options, progress);
    }
    if !path.exists()
        && let Some(prefix) = path.file_name()
    {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        return folder::open(path, folder, &prefix.to_string_lossy(), bound, options, progress);
    }
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let found = match extension.as_str() {
        "gltf" | "glb" => gltf::open(path, options, progress),
        "mtl" => mtl::open(path, options, progress),
        "mtlx" => mtlx::open(path, options, progress),
        _ => picture::open(path, options, progress),
    };
    let mut found = match found {
        Err(refusal @ (Error::NotAMaterial { .. } | Error::NotPacked { .. }))
            if options.order.is_none() && !LISTING.contains(&extension.as_str()) =>
        {
            return folder::open_around(path, bound, options, progress).and_then(Result::ok).ok_or(refusal);
        }
        found => found?,
    };
    for (role, source) in bound {
        found.notes.push(binding::note(role, &source.file));
        found.replace(role, source);
    }
    Ok(found)
}

fn finish<T: Real>(mut found: StoredMaterial, options: &ReadOptions) -> Result<Read<T>, Error> {
    let maps = report::maps(&found);
    let transparent = |(map, source): (Role, &StoredMap)| {
        let noted = source.raster.alpha.is_some() && map != Role::Normal;
        noted.then_some(Note::AlphaIgnored { map })
    };
    let noted: Vec<_> = found.sources().into_iter().filter_map(transparent).collect();
    found.notes.extend(noted);
    let (planes, [width, height]) = encoding::planes(&mut found, options)?;
    let material = Material::new(found.name, width, height, planes)?;
    Ok(Read {
        material,
        assumptions: found.assumptions,
        notes: found.notes,
        files: found.files,
        maps,
        options: *options,
        saved: ReadOptions::AUTO,
    })
}
