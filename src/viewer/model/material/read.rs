//! Read material: the four maps of a material, with all that was learnt in reading them.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use svbrdf_core::material::Material;
use svbrdf_evaluate::diagnose::Storage;
use svbrdf_files::disk::memory::Reserved;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::read::{Assumption, MapReport, Note, Read, ReadOptions};
use svbrdf_files::steps::RunId;

use svbrdf_files::source::{MaterialSource, Place};

use crate::error::Error;

/// What identifies the maps of a material: the reading that brought them, and the stamp of the files that were read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId {
    /// Never used twice.
    reading: u64,
    stamp: Stamp,
}

impl MaterialId {
    /// The id of this number, for tests.
    #[cfg(test)]
    pub fn numbered(reading: u64) -> Self {
        Self { reading, stamp: Stamp::default() }
    }

    fn new(files: &[(PathBuf, Option<Stamp>)]) -> Self {
        static READINGS: AtomicU64 = AtomicU64::new(0);
        let stamps = files.iter().filter_map(|(_, stamp)| *stamp);
        let stamp = stamps.fold(Stamp::default(), Stamp::with);
        Self { reading: READINGS.fetch_add(1, Ordering::Relaxed), stamp }
    }
}

/// A material that has been read.
#[derive(Debug)]
pub struct ReadMaterial {
    pub id: MaterialId,
    /// The name that it is given; `None` for that of its files.
    pub name: Option<String>,
    pub place: Place,
    /// The options specified when it was opened.
    pub specified: ReadOptions,
    /// The options it was read with: those specified or saved, and those chosen since.
    pub options: ReadOptions,
    /// The options saved in its sidecar file.
    pub saved: ReadOptions,
    /// Whether it is resized to the ground truth.
    pub fit: bool,
    /// The training run that it is a step of.
    pub run: Option<RunId>,
    pub material: Material<f32>,
    /// How its maps are stored, for its diagnosis.
    pub storage: Storage,
    /// Remarks on the reading.
    pub notes: Vec<Note>,
    pub assumptions: Vec<Assumption>,
    /// Each map as stored.
    pub maps: Vec<MapReport>,
    /// The files that were read, each with its stamp.
    pub files: Vec<(PathBuf, Option<Stamp>)>,
    /// The memory of the material. It counts towards the limit while this lives.
    pub memory: Arc<Reserved>,
}

impl ReadMaterial {
    /// The material of what was read from `source`.
    pub fn new(source: MaterialSource, read: Read<f32>) -> Self {
        let storage = read.storage();
        let files: Vec<_> =
            read.files.into_iter().map(|path| (Stamp::of(&path), path)).map(|(s, p)| (p, s)).collect();
        let Read { material, assumptions, notes, maps, options, saved, memory, .. } = read;
        let MaterialSource { name, place, options: specified, fit, run, .. } = source;
        let id = MaterialId::new(&files);
        Self {
            id,
            name,
            place,
            specified,
            options,
            saved,
            fit,
            run,
            material,
            storage,
            notes,
            assumptions,
            maps,
            files,
            memory,
        }
    }

    /// The path it was read from; empty for a built-in one.
    pub fn path(&self) -> &Path {
        match &self.place {
            Place::BuiltIn(_) => Path::new(""),
            Place::Path(path) => path,
        }
    }

    /// This material with other maps, which no file holds.
    pub fn with_material(&self, material: Material<f32>) -> Self {
        let Self { name, place, specified, options, saved, fit, run, .. } = self;
        Self {
            id: MaterialId::new(&[]),
            name: name.clone(),
            place: place.clone(),
            specified: *specified,
            options: *options,
            saved: *saved,
            fit: *fit,
            run: run.clone(),
            material,
            storage: self.storage.clone(),
            notes: Vec::new(),
            assumptions: Vec::new(),
            maps: Vec::new(),
            files: Vec::new(),
            memory: self.memory.clone(),
        }
    }

    /// The training run that it is a step of, and the number of the step.
    pub fn step(&self) -> Option<(&RunId, u64)> {
        let (_, number) = RunId::of_step(self.path())?;
        Some((self.run.as_ref()?, number))
    }

    /// What it takes to open it again.
    pub fn source(&self) -> MaterialSource {
        let is_chosen =
            matches!(self.place, Place::Path(_)) && self.options != self.specified.over(self.saved);
        let chosen = is_chosen.then_some(self.options);
        let (place, run) = (self.place.clone(), self.run.clone());
        let (name, options, fit) = (self.name.clone(), self.specified, self.fit);
        MaterialSource { name, place, options, chosen, fit, run }
    }
}

/// Rules for every material that is opened.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rules {
    /// Whether a guess is an error.
    pub strict: bool,
    /// Whether a prediction of another size is resized to the ground truth.
    pub fit: bool,
}

impl Rules {
    /// Takes in the material at `path`; the first one sets the `size`, where there is none yet.
    ///
    /// # Errors
    /// [`Guessed`](svbrdf_files::Error::Guessed) where guesses are errors,
    /// [`SizesDiffer`](svbrdf_core::error::Error::SizesDiffer) where it cannot be resized.
    pub fn take(
        self,
        path: &Path,
        mut source: MaterialSource,
        mut read: Read<f32>,
        size: &mut Option<[usize; 2]>,
    ) -> Result<ReadMaterial, Error> {
        if self.strict {
            read.refuse_guesses(path)?;
        }
        if let Some(name) = source.material_name(path) {
            read.material = read.material.renamed(name);
        }
        source.fit |= self.fit;
        let from = read.material.size();
        let size = *size.get_or_insert(from);
        if source.fit && from != size {
            read.material = read.material.resized(size)?;
            read.notes.push(Note::Resized { from, to: size });
        }
        Ok(ReadMaterial::new(source, read))
    }
}
