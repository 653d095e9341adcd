//! Reading a material from files.
//!
//! `packed`, `folder`, `layers`, `gltf`, `mtl` and `mtlx` find the maps, `decode` turns a file into the samples that it stores,
//! `encoding` and `normals` turn samples into linear values. What opens is listed in `docs/formats.md`.
//!
//! Colour chunks are ignored. What the values mean is said by [`ReadOptions`]; what these leave open is found out from
//! names and pixels, and recorded as an [`Assumption`].

mod assumption;
mod decode;
mod formats;
mod grid;
pub(crate) mod interpret;
mod locate;
mod options;
mod order;
mod preset;
mod raster;
mod role;
mod samples;
mod sidecar;
mod stored;

use std::io::Cursor;
use std::path::{Path, PathBuf};

pub use assumption::{Assumption, Certainty, What};
pub use grid::Grid;
pub use interpret::report::MapReport;
pub use locate::binding::Binding;
pub use options::{
    Albedo, Energy, NonFinite, NormalCode, NormalY, ReadOptions, Reflectance, Roughness, Workflow,
};
pub use order::Order;
pub use preset::Preset;
pub use sidecar::Kept;

use crate::error::Error;
use crate::material::Material;
use crate::math::real::Real;
use crate::progress::Progress;
use decode::Decoded;
use formats::{gltf, mtl, mtlx};
use interpret::{encoding, report};
use locate::names::Role;
use locate::{binding, folder, layers, packed};
use stored::{Found, Source};

/// Extensions of the files that open as a material or as a map of one.
pub const EXTENSIONS: [&str; 19] = [
    "png", "tif", "tiff", "jpg", "jpeg", "tga", "bmp", "webp", "dds", "ktx2", "hdr", "exr", "npy", "npz",
    "gltf", "glb", "mtl", "mtlx", "json",
];
/// Extensions of files that name their textures.
const NAMING: [&str; 4] = ["gltf", "glb", "mtl", "mtlx"];

/// A material, and how it came to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Read<T> {
    pub material: Material<T>,
    /// What was taken for granted, each with its reason.
    pub assumptions: Vec<Assumption>,
    /// What else was found, one sentence each, for the user.
    pub notes: Vec<String>,
    /// The files that were read, each once, for watching. None for a material from memory.
    pub files: Vec<PathBuf>,
    /// What each map looks like as stored.
    pub maps: Vec<MapReport>,
    /// What it was read with: what the caller said and, where that was to be asked, what is kept with the material.
    pub options: ReadOptions,
    /// What is kept with the material.
    pub kept: ReadOptions,
}

impl<T> Read<T> {
    /// Notes and assumptions, a line each.
    pub fn said(&self) -> impl Iterator<Item = String> {
        self.notes.iter().cloned().chain(self.assumptions.iter().map(ToString::to_string))
    }

    /// The assumptions that could as well be otherwise.
    pub fn unsure(&self) -> impl Iterator<Item = &Assumption> {
        self.assumptions.iter().filter(|a| a.certainty == Certainty::Unsure)
    }

    /// Takes no guesses; `path` is what was read.
    ///
    /// # Errors
    /// [`Error::Guessed`].
    pub fn refuse_guesses(&self, path: &Path) -> Result<(), Error> {
        match self.unsure().map(ToString::to_string).collect::<Vec<_>>() {
            guesses if guesses.is_empty() => Ok(()),
            guesses => Err(Error::Guessed { path: path.to_owned(), guesses: guesses.join("; ") }),
        }
    }
}

/// Reads the material that `path` names: a packed or layered image, a folder, the common prefix of files, or one of them.
///
/// Each file is one step of `progress`.
///
/// # Errors
/// [`Error::Unreadable`] where there is no such file or folder, [`Error::BadImage`] where a file is no image, is
/// broken or too large, [`Error::NotAMaterial`] where a map is missing, claimed twice or gray though it is the
/// normal map, [`Error::SizesDiffer`] where maps differ in shape, [`Error::OutOfRange`] at NaN and infinity,
/// [`Error::Cancelled`].
pub fn read<T: Real>(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Read<T>, Error> {
    read_bound(path, &[], options, progress)
}

/// As [`read`], with the maps of `bindings` in the place of what is found at `path`.
///
/// # Errors
/// As [`read`].
pub fn read_bound<T: Real>(
    path: &Path,
    bindings: &[Binding],
    options: &ReadOptions,
    progress: &Progress,
) -> Result<Read<T>, Error> {
    let kept = Kept::of(path)?;
    let said = kept.clone().under(options, bindings);
    read_said(path, &kept, &said, progress)
}

/// As [`read`], but `options` stand alone: nothing of them is taken from what is [`Kept`] with the material.
///
/// # Errors
/// As [`read`].
pub fn read_as<T: Real>(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Read<T>, Error> {
    let kept = Kept::of(path)?;
    let said = Kept { options: *options, ..kept.clone() };
    read_said(path, &kept, &said, progress)
}

fn read_said<T: Real>(path: &Path, kept: &Kept, said: &Kept, progress: &Progress) -> Result<Read<T>, Error> {
    let options = &said.options.with_preset();
    let still = said.bindings.iter().filter(|binding| kept.bindings.contains(binding));
    Kept { bindings: still.cloned().collect(), ..Kept::default() }.check_maps(path)?;
    let bound = said.bindings.iter().map(Binding::load).collect::<Result<_, _>>()?;
    let mut read = finish(find(&sidecar::material_of(path)?, bound, options, progress)?, options)?;
    (read.options, read.kept) = (said.options, kept.options);
    if *kept != Kept::default() {
        let place = Kept::place(path);
        kept.credit(&place, &said.options, &mut read.assumptions, &mut read.notes);
        read.files.push(place);
    }
    Ok(read)
}

/// Reads a packed or layered image that lies in memory; `name` is the name of the material.
///
/// # Errors
/// As [`read`].
pub fn read_bytes<T: Real>(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Read<T>, Error> {
    let path = Path::new(name);
    let options = &options.with_preset();
    let decoded = decode::decode(Cursor::new(bytes), path, "material")?;
    let found = within(path, decoded, options)?;
    let read = finish(Found { name: name.to_owned(), ..found }, options)?;
    Ok(Read { files: Vec::new(), ..read })
}

fn find(
    path: &Path,
    bound: Vec<(Role, Source)>,
    options: &ReadOptions,
    progress: &Progress,
) -> Result<Found, Error> {
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
        _ => find_in_picture(path, options, progress),
    };
    let mut found = match found {
        Err(refusal @ Error::NotAMaterial { .. })
            if options.order.is_none() && !NAMING.contains(&extension.as_str()) =>
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

/// The material within the picture `path`.
fn find_in_picture(path: &Path, options: &ReadOptions, progress: &Progress) -> Result<Found, Error> {
    progress.begin(1);
    let decoded = decode::decode_file(path, "material")?;
    progress.step()?;
    within(path, decoded, options)
}

/// The material within one file: a packed picture, or one of named layers.
fn within(path: &Path, decoded: Decoded, options: &ReadOptions) -> Result<Found, Error> {
    let Decoded { mut layers, mut notes, native, meaning } = decoded;
    let mut found = match layers.pop() {
        Some(only) if layers.is_empty() && !layers::is_named(&only) => {
            packed::unpack(path, &only.raster, meaning.as_deref(), options)?
        }
        last => layers::assemble(path, layers.into_iter().chain(last).collect(), native, options)?,
    };
    notes.append(&mut found.notes);
    Ok(Found { notes, ..found })
}

fn finish<T: Real>(mut found: Found, options: &ReadOptions) -> Result<Read<T>, Error> {
    let maps = report::maps(&found);
    let transparent = |(name, source): (&str, &Source)| {
        let noted = source.raster.alpha.is_some() && name != "normal";
        noted.then(|| format!("The {name} map is partly transparent; its alpha is ignored."))
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
        kept: ReadOptions::AUTO,
    })
}
