//! A material in the window, with all that was learnt in reading it.

use std::path::{Path, PathBuf};

use super::source::{Origin, Source};
use super::uploaded::Uploaded;
use crate::error::Error;
use crate::files::read::{Assumption, MapReport, Note, Read, ReadOptions};
use crate::files::stamp::Stamp;
use crate::files::steps::RunId;
use crate::gpu::Gpu;
use crate::material::Material;

/// A material that has been read and, where there is an adapter, uploaded.
#[derive(Debug)]
pub(super) struct Loaded {
    pub origin: Origin,
    /// The options specified when it was opened.
    pub(super) asked: ReadOptions,
    /// The options it was read with: those specified or saved, and those chosen since.
    pub read: ReadOptions,
    /// The options saved in its sidecar file.
    pub kept: ReadOptions,
    /// Whether it is resized to the ground truth.
    pub(super) fit: bool,
    /// The training run that it is a step of.
    pub run: Option<RunId>,
    pub material: Material<f32>,
    /// Remarks on the reading.
    pub notes: Vec<Note>,
    pub assumptions: Vec<Assumption>,
    /// Each map as stored.
    pub maps: Vec<MapReport>,
    /// The files that were read, each with its stamp.
    pub files: Vec<(PathBuf, Option<Stamp>)>,
    /// `None` without an adapter.
    pub textures: Option<Uploaded>,
}

impl Loaded {
    /// The path it was read from; empty for a built-in one.
    pub(super) fn path(&self) -> &Path {
        match &self.origin {
            Origin::BuiltIn(_) => Path::new(""),
            Origin::Path(path) => path,
        }
    }

    /// This material with other maps, which no file holds.
    pub(super) fn with_material(&self, material: Material<f32>, gpu: Option<&Gpu>) -> Self {
        let textures = gpu.map(|gpu| Uploaded::all(gpu, &material));
        let Self { origin, asked, read, kept, fit, run, .. } = self;
        Self {
            origin: origin.clone(),
            asked: *asked,
            read: *read,
            kept: *kept,
            fit: *fit,
            run: run.clone(),
            material,
            notes: Vec::new(),
            assumptions: Vec::new(),
            maps: Vec::new(),
            files: Vec::new(),
            textures,
        }
    }

    /// Sends to the adapter what is missing there.
    pub(super) fn complete_upload(&self, gpu: &Gpu) {
        self.textures.iter().for_each(|uploaded| uploaded.complete(gpu, &self.material));
    }

    /// The training run that it is a step of, and the number of the step.
    pub(super) fn step(&self) -> Option<(&RunId, u64)> {
        let (_, number) = RunId::of_step(self.path())?;
        Some((self.run.as_ref()?, number))
    }

    /// What it takes to open it again.
    pub(super) fn source(&self) -> Source {
        let chosen = matches!(self.origin, Origin::Path(_)) && self.read != self.asked.over(self.kept);
        let exactly = chosen.then_some(self.read);
        let (origin, run) = (self.origin.clone(), self.run.clone());
        Source { origin, asked: self.asked, exactly, fit: self.fit, run }
    }
}

/// Rules for every material that is opened.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rules {
    /// Whether a guess is an error.
    pub strict: bool,
    /// Whether a prediction of another size is resized to the ground truth.
    pub fit: bool,
}

/// Reads materials on a worker.
pub(super) struct Reader {
    pub(super) gpu: Option<Gpu>,
    pub(super) rules: Rules,
    /// The size of the ground truth, once it is known.
    pub(super) size: Option<[usize; 2]>,
    /// Whether a file that cannot be read is waited for, where it was written a moment ago.
    pub(super) patient: bool,
    /// Whether drafts of materials are of use: where nothing is seen before.
    pub(super) drafts: bool,
}

impl Reader {
    /// Takes in the material at `path`; the first one sets the size, where there is none yet.
    pub(super) fn take(
        &mut self,
        path: &Path,
        mut source: Source,
        mut read: Read<f32>,
    ) -> Result<Loaded, Error> {
        if self.rules.strict {
            read.refuse_guesses(path)?;
        }
        if let (Some(run), Some((_, number))) = (&source.run, RunId::of_step(path)) {
            read.material = read.material.renamed(run.step_name(number));
        }
        source.fit |= self.rules.fit;
        let from = read.material.size();
        let size = *self.size.get_or_insert(from);
        if source.fit && from != size {
            read.material = read.material.resized(size)?;
            read.notes.push(Note::Resized { from, to: size });
        }
        Ok(loaded(source, read, self))
    }
}

/// The material of what was read; of its textures perhaps a draft.
pub(super) fn loaded(source: Source, read: Read<f32>, reader: &Reader) -> Loaded {
    let upload = if reader.drafts { Uploaded::start } else { Uploaded::all };
    let textures = reader.gpu.as_ref().map(|gpu| upload(gpu, &read.material));
    let files = read.files.into_iter().map(|path| (Stamp::of(&path), path)).map(|(s, p)| (p, s)).collect();
    let Read { material, assumptions, notes, maps, options, saved: kept, .. } = read;
    let Source { origin, asked, fit, run, .. } = source;
    Loaded {
        origin,
        asked,
        read: options,
        kept,
        fit,
        run,
        material,
        notes,
        assumptions,
        maps,
        files,
        textures,
    }
}
