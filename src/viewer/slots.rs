//! The materials in the window. They are read on a worker, and replaced once the new ones have been read.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::loaded::{Loaded, Origin, Reader, Rules, file_name, loaded};
use super::message::{Message, SizeMismatch};
use super::worker::Task;
use crate::error::Error;
use crate::files::read::{self, ReadOptions, Sidecar};
use crate::gpu::Gpu;
use crate::report::distinct_names;
use crate::samples;

/// A material in the window. Its id is never used again: it is the key of everything derived from the material.
#[derive(Clone, Debug)]
pub struct Slot {
    pub id: u64,
    pub loaded: Arc<Loaded>,
    /// Its name, unique among the slots.
    name: String,
}

impl Slot {
    fn new(id: u64, loaded: Loaded) -> Self {
        let name = loaded.material.name().to_owned();
        Self { id, loaded: Arc::new(loaded), name }
    }

    pub fn name(&self) -> &str {
        &self.name
    }
}

/// Where materials go once they have been read.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// The first replaces the ground truth, the others the predictions.
    Everything,
    /// All are added as predictions.
    Predictions,
    /// The one replaces the slot of this id, which stays where it is.
    Again(u64),
}

/// Materials that are being read.
#[derive(Debug)]
pub struct Opening {
    pub what: String,
    target: Target,
    pub task: Task<Vec<Result<Loaded, Error>>>,
}

/// The ground truth first, then the predictions; and the materials that are still being read.
#[derive(Debug, Default)]
pub struct Slots {
    pub slots: Vec<Slot>,
    pub openings: Vec<Opening>,
    pub rules: Rules,
    /// The paths that have been opened since they were last taken.
    pub opened: Vec<PathBuf>,
    next_id: u64,
}

impl Slots {
    pub fn ground_truth(&self) -> Option<&Slot> {
        self.slots.first()
    }

    pub fn predictions(&self) -> &[Slot] {
        self.slots.get(1..).unwrap_or_default()
    }

    /// Whether there is only the built-in pair, which the first opened material replaces.
    pub fn only_built_in(&self) -> bool {
        self.slots.iter().all(|s| s.loaded.origin == Origin::BuiltIn)
    }

    /// Starts to read `sources`, each with its options.
    pub fn open(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        sources: Vec<(PathBuf, ReadOptions)>,
        target: Target,
    ) {
        let mut reader = self.reader(gpu, &target);
        let what = sources.iter().map(|(p, _)| file_name(p)).collect::<Vec<_>>().join(", ");
        let task = Task::start(ctx, move |progress| {
            let one = |(path, options): (PathBuf, ReadOptions)| {
                let read = read::read::<f32>(&path, &options, progress)?;
                reader.take(path, options, read)
            };
            Ok(sources.into_iter().map(one).collect())
        });
        self.openings.push(Opening { what, target, task });
    }

    /// A reader of the materials for `target`.
    fn reader(&self, gpu: Option<&Gpu>, target: &Target) -> Reader {
        let ground_truth = self.ground_truth().filter(|ground_truth| match target {
            Target::Everything => false,
            Target::Predictions => true,
            Target::Again(id) => *id != ground_truth.id,
        });
        let size = ground_truth.map(|slot| slot.loaded.material.size());
        Reader { gpu: gpu.cloned(), rules: self.rules, size }
    }

    /// Starts to read the built-in pair.
    pub fn open_built_in(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>) {
        let gpu = gpu.cloned();
        let task = Task::start(ctx, move |_| {
            let samples = samples::load::<f32>()?;
            let all = std::iter::once(samples.ground_truth).chain(samples.predictions);
            Ok(all
                .map(|read| Ok(loaded(Origin::BuiltIn, ReadOptions::default(), read, gpu.as_ref())))
                .collect())
        });
        self.openings.push(Opening { what: "built-in pair".to_owned(), target: Target::Everything, task });
    }

    /// Takes over the materials that have been read since the last call; returns what went wrong.
    pub fn poll(&mut self, ctx: &egui::Context) -> Vec<Message> {
        let mut problems = Vec::new();
        let mut finished = Vec::new();
        self.openings.retain(|opening| match opening.task.poll(ctx) {
            None => true,
            Some(result) => {
                finished.push((opening.target.clone(), result));
                false
            }
        });
        for (target, result) in finished {
            let all = result.unwrap_or_else(|e| vec![Err(e)]);
            self.place(target, all, &mut problems);
        }
        problems
    }

    fn place(&mut self, target: Target, all: Vec<Result<Loaded, Error>>, problems: &mut Vec<Message>) {
        let mut loaded: Vec<Loaded> = Vec::new();
        let failed_first = matches!(all.first(), Some(Err(_)));
        for result in all {
            match result {
                Ok(one) => loaded.push(one),
                Err(Error::Cancelled) => {}
                Err(error) => problems.push(Message::Failed(error)),
            }
        }
        match target {
            // Predictions need their ground truth: the materials in the window stay.
            Target::Everything if failed_first || loaded.is_empty() => {
                let names: Vec<_> = loaded.iter().map(|one| one.material.name().to_owned()).collect();
                if !names.is_empty() {
                    problems.push(Message::NotOpened(names));
                }
            }
            Target::Everything => {
                self.slots.clear();
                loaded.into_iter().for_each(|one| self.add(one, problems));
            }
            Target::Predictions => loaded.into_iter().for_each(|one| self.add(one, problems)),
            Target::Again(id) => loaded.into_iter().for_each(|one| self.replace(id, one, problems)),
        }
        self.rename();
    }

    fn add(&mut self, loaded: Loaded, problems: &mut Vec<Message>) {
        if let Some(sizes) = self.ground_truth().and_then(|ground_truth| mismatch(ground_truth, &loaded)) {
            return problems.push(Message::Refused(sizes));
        }
        if let Origin::Path(path) = &loaded.origin {
            self.opened.push(path.clone());
        }
        let id = self.new_id();
        self.slots.push(Slot::new(id, loaded));
    }

    /// Replaces the material of the slot `id`. A ground truth of another size closes the predictions.
    fn replace(&mut self, id: u64, loaded: Loaded, problems: &mut Vec<Message>) {
        let Some(index) = self.slots.iter().position(|s| s.id == id) else { return };
        let new = Slot::new(self.new_id(), loaded);
        if index == 0 {
            let mismatches = self.predictions().iter().filter_map(|s| mismatch(&new, &s.loaded));
            problems.extend(mismatches.map(Message::Closed));
            self.slots.retain(|s| s.id == id || mismatch(&new, &s.loaded).is_none());
        } else if let Some(sizes) = self.ground_truth().and_then(|gt| mismatch(gt, &new.loaded)) {
            return problems.push(Message::Refused(sizes));
        }
        self.slots[index] = new;
    }

    /// Gives every slot a unique name.
    fn rename(&mut self) {
        let named: Vec<_> = self.slots.iter().map(|s| (s.loaded.material.name(), s.loaded.path())).collect();
        let names = distinct_names(&named);
        self.slots.iter_mut().zip(names).for_each(|(slot, name)| slot.name = name);
    }

    fn new_id(&mut self) -> u64 {
        self.next_id += 1;
        self.next_id
    }

    /// Reads materials from files again: all of them, or those of the given indices.
    pub fn reload(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, only: Option<&[usize]>) {
        for index in 0..self.slots.len() {
            if only.is_none_or(|only| only.contains(&index)) {
                let Loaded { asked, read, kept, .. } = *self.slots[index].loaded;
                if read == asked.over(kept) {
                    self.open_again(ctx, gpu, index, asked);
                } else {
                    self.read_as(ctx, gpu, index, read);
                }
            }
        }
    }

    /// Opens the material at `index` again, as if for the first time.
    fn open_again(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, index: usize, options: ReadOptions) {
        let Some((path, target)) = self.again(index) else { return };
        self.open(ctx, gpu, vec![(path, options)], target);
    }

    /// Reads the material at `index` again with these options alone.
    pub fn read_as(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, index: usize, options: ReadOptions) {
        let Some((path, target)) = self.again(index) else { return };
        let (asked, what) = (self.slots[index].loaded.asked, file_name(&path));
        let mut reader = self.reader(gpu, &target);
        let task = Task::start(ctx, move |progress| {
            let read = read::read_as::<f32>(&path, &options, progress);
            Ok(vec![read.and_then(|read| reader.take(path, asked, read))])
        });
        self.openings.push(Opening { what, target, task });
    }

    /// Path and target of the material at `index`, to read it again; a reading of it that is under way is cancelled.
    fn again(&mut self, index: usize) -> Option<(PathBuf, Target)> {
        let slot = self.slots.get(index)?;
        let Origin::Path(path) = &slot.loaded.origin else { return None };
        let (path, target) = (path.clone(), Target::Again(slot.id));
        self.openings.retain(|o| o.target != target);
        Some((path, target))
    }

    /// Saves the assumptions specified for the material at `index` in a sidecar file, and opens it again.
    ///
    /// # Errors
    /// Those of [`Sidecar`].
    pub fn save_assumptions(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        index: usize,
    ) -> Result<(), Error> {
        let Some(slot) = self.slots.get(index) else { return Ok(()) };
        let Origin::Path(path) = &slot.loaded.origin else { return Ok(()) };
        Sidecar { options: slot.loaded.read, ..Sidecar::load(path)? }.save(path)?;
        self.open_again(ctx, gpu, index, ReadOptions::AUTO);
        Ok(())
    }

    /// Closes the prediction in slot `index`.
    pub fn close(&mut self, index: usize) {
        if index > 0 && index < self.slots.len() {
            self.slots.remove(index);
            self.rename();
        }
    }

    /// Makes the material in slot `index` the ground truth; the old one becomes a prediction in its place.
    pub fn make_ground_truth(&mut self, index: usize) {
        if index < self.slots.len() {
            self.slots.swap(0, index);
        }
    }
}

/// The two sizes, where `prediction` has not that of the ground truth.
fn mismatch(ground_truth: &Slot, prediction: &Loaded) -> Option<SizeMismatch> {
    let [gt, prediction] = [&ground_truth.loaded.material, &prediction.material];
    (gt.size() != prediction.size()).then(|| SizeMismatch {
        prediction: prediction.name().to_owned(),
        prediction_size: prediction.size(),
        ground_truth: gt.name().to_owned(),
        ground_truth_size: gt.size(),
    })
}
