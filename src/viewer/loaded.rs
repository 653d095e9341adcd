//! A material as the window keeps it, and what is asked of it.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::error::Error;
use crate::files::read::{Assumption, MapReport, Note, Read, ReadOptions};
use crate::gpu::{Gpu, MaterialTextures};
use crate::material::Material;

/// Where a material came from.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    BuiltIn,
    Path(PathBuf),
}

/// A material that has been read and, where there is an adapter, uploaded.
#[derive(Debug)]
pub struct Loaded {
    pub origin: Origin,
    /// What was said when it was opened.
    pub(super) asked: ReadOptions,
    /// What it was read with: what was said, or is kept with it, or chosen since.
    pub read: ReadOptions,
    /// What is kept with it.
    pub kept: ReadOptions,
    pub material: Material<f32>,
    /// What was assumed in reading, for the user.
    pub notes: Vec<Note>,
    pub assumptions: Vec<Assumption>,
    /// What each map looks like as stored.
    pub maps: Vec<MapReport>,
    /// The files that were read, each with the time at which it was last changed.
    pub files: Vec<(PathBuf, Option<SystemTime>)>,
    /// `None` without an adapter; an error where the adapter cannot hold the material.
    pub textures: Option<Result<MaterialTextures, String>>,
}

impl Loaded {
    /// Where it was read from; nothing where it is built in.
    pub fn path(&self) -> &Path {
        match &self.origin {
            Origin::BuiltIn => Path::new(""),
            Origin::Path(path) => path,
        }
    }
}

/// What is asked of every material that is opened.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rules {
    /// A guess is an error.
    pub strict: bool,
    /// A prediction of another size is resized to the ground truth.
    pub fit: bool,
}

/// Reads materials on a worker.
pub(super) struct Reader {
    pub(super) gpu: Option<Gpu>,
    pub(super) rules: Rules,
    /// The ground truth's size, once that is known.
    pub(super) size: Option<[usize; 2]>,
}

impl Reader {
    /// The material at `path` as the window keeps it; the first one read sets the size where there is none yet.
    pub(super) fn take(
        &mut self,
        path: PathBuf,
        asked: ReadOptions,
        mut read: Read<f32>,
    ) -> Result<Loaded, Error> {
        if self.rules.strict {
            read.refuse_guesses(&path)?;
        }
        let from = read.material.size();
        let size = *self.size.get_or_insert(from);
        if self.rules.fit && from != size {
            read.material = read.material.resized(size)?;
            read.notes.push(Note::Resized { from, to: size });
        }
        Ok(loaded(Origin::Path(path), asked, read, self.gpu.as_ref()))
    }
}

pub(super) fn loaded(origin: Origin, asked: ReadOptions, read: Read<f32>, gpu: Option<&Gpu>) -> Loaded {
    let textures = gpu.map(|gpu| MaterialTextures::upload(gpu, &read.material).map_err(|e| e.to_string()));
    let files = read.files.into_iter().map(|path| (changed(&path), path)).map(|(t, p)| (p, t)).collect();
    let Read { material, assumptions, notes, maps, options, saved: kept, .. } = read;
    Loaded { origin, asked, read: options, kept, material, notes, assumptions, maps, files, textures }
}

/// When a file was last changed; `None` where that cannot be told.
pub fn changed(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|m| m.modified()).ok()
}

/// The last part of a path, for people.
pub fn file_name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned())
}
