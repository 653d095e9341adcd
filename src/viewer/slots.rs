//! The materials in the window: read on a worker, kept whole, replaced only by what has been read.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::loaded::{Loaded, Origin, Reader, Rules, file_name, loaded};
use super::worker::Job;
use crate::error::Error;
use crate::files::read::{self, Sidecar, ReadOptions};
use crate::gpu::Gpu;
use crate::loss;
use crate::report::distinct_names;
use crate::samples;

/// A material in the window, with a number that no other one ever had: the key of everything derived from it.
#[derive(Clone, Debug)]
pub struct Slot {
    pub id: u64,
    pub loaded: Arc<Loaded>,
    /// What tells it from the others.
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

/// What becomes of materials that are being read.
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
    pub job: Job<Vec<Result<Loaded, Error>>>,
}

/// The ground truth first, then the predictions; and what is still being read.
#[derive(Debug, Default)]
pub struct Slots {
    pub slots: Vec<Slot>,
    pub openings: Vec<Opening>,
    pub rules: Rules,
    /// What has been opened by a path since this was last taken.
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

    /// Whether nothing but the built-in pair is here: then what a person opens replaces it.
    pub fn only_built_in(&self) -> bool {
        self.slots.iter().all(|s| s.loaded.origin == Origin::BuiltIn)
    }

    /// Starts to read `sources`, each under its options.
    pub fn open(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        sources: Vec<(PathBuf, ReadOptions)>,
        target: Target,
    ) {
        let mut reader = self.reader(gpu, &target);
        let what = sources.iter().map(|(p, _)| file_name(p)).collect::<Vec<_>>().join(", ");
        let job = Job::start(ctx, move |progress| {
            let one = |(path, options): (PathBuf, ReadOptions)| {
                let read = read::read::<f32>(&path, &options, progress)?;
                reader.take(path, options, read)
            };
            Ok(sources.into_iter().map(one).collect())
        });
        self.openings.push(Opening { what, target, job });
    }

    /// A reader of what goes to `target`.
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
        let job = Job::start(ctx, move |_| {
            let samples = samples::load::<f32>()?;
            let all = std::iter::once(samples.ground_truth).chain(samples.predictions);
            Ok(all
                .map(|read| Ok(loaded(Origin::BuiltIn, ReadOptions::default(), read, gpu.as_ref())))
                .collect())
        });
        self.openings.push(Opening { what: "built-in pair".to_owned(), target: Target::Everything, job });
    }

    /// Takes over what has been read since the last call; returns the errors, for the user.
    pub fn poll(&mut self, ctx: &egui::Context) -> Vec<String> {
        let mut errors = Vec::new();
        let mut finished = Vec::new();
        self.openings.retain(|opening| match opening.job.poll(ctx) {
            None => true,
            Some(result) => {
                finished.push((opening.target.clone(), result));
                false
            }
        });
        for (target, result) in finished {
            let all = result.unwrap_or_else(|e| vec![Err(e)]);
            self.place(target, all, &mut errors);
        }
        errors
    }

    fn place(&mut self, target: Target, all: Vec<Result<Loaded, Error>>, errors: &mut Vec<String>) {
        let mut loaded: Vec<Loaded> = Vec::new();
        let failed_first = matches!(all.first(), Some(Err(_)));
        for result in all {
            match result {
                Ok(one) => loaded.push(one),
                Err(Error::Cancelled) => {}
                Err(error) => errors.push(error.to_string()),
            }
        }
        match target {
            // Without its ground truth a prediction is no prediction: keep what was there.
            Target::Everything if failed_first || loaded.is_empty() => {
                let left = loaded.iter().map(|one| one.material.name()).collect::<Vec<_>>().join(", ");
                if !left.is_empty() {
                    errors.push(format!("without its ground truth this was not opened either: {left}"));
                }
            }
            Target::Everything => {
                self.slots.clear();
                loaded.into_iter().for_each(|one| self.add(one, errors));
            }
            Target::Predictions => loaded.into_iter().for_each(|one| self.add(one, errors)),
            Target::Again(id) => loaded.into_iter().for_each(|one| self.replace(id, one, errors)),
        }
        self.tell_apart();
    }

    fn add(&mut self, loaded: Loaded, errors: &mut Vec<String>) {
        if let Some(misfit) = self.ground_truth().and_then(|ground_truth| misfit(ground_truth, &loaded)) {
            return errors.push(misfit);
        }
        if let Origin::Path(path) = &loaded.origin {
            self.opened.push(path.clone());
        }
        let id = self.new_id();
        self.slots.push(Slot::new(id, loaded));
    }

    /// Puts `loaded` in the place of the slot `id`. A ground truth of another size sends the predictions away.
    fn replace(&mut self, id: u64, loaded: Loaded, errors: &mut Vec<String>) {
        let Some(index) = self.slots.iter().position(|s| s.id == id) else { return };
        let new = Slot::new(self.new_id(), loaded);
        if index == 0 {
            let misfits = self.predictions().iter().filter_map(|s| misfit(&new, &s.loaded));
            errors.extend(misfits.map(|text| format!("a prediction was closed: {text}")));
            self.slots.retain(|s| s.id == id || misfit(&new, &s.loaded).is_none());
        } else if let Some(text) = self.ground_truth().and_then(|gt| misfit(gt, &new.loaded)) {
            return errors.push(text);
        }
        self.slots[index] = new;
    }

    /// Gives every slot a name of its own.
    fn tell_apart(&mut self) {
        let named: Vec<_> = self.slots.iter().map(|s| (s.loaded.material.name(), s.loaded.path())).collect();
        let names = distinct_names(&named);
        self.slots.iter_mut().zip(names).for_each(|(slot, name)| slot.name = name);
    }

    fn new_id(&mut self) -> u64 {
        self.next_id += 1;
        self.next_id
    }

    /// Reads again what came from files: all of them, or those whose index is given.
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

    /// Reads the material at `index` again under other options, which now stand alone.
    pub fn read_as(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, index: usize, options: ReadOptions) {
        let Some((path, target)) = self.again(index) else { return };
        let (asked, what) = (self.slots[index].loaded.asked, file_name(&path));
        let mut reader = self.reader(gpu, &target);
        let job = Job::start(ctx, move |progress| {
            let read = read::read_as::<f32>(&path, &options, progress);
            Ok(vec![read.and_then(|read| reader.take(path, asked, read))])
        });
        self.openings.push(Opening { what, target, job });
    }

    /// Where the material at `index` came from, and its place; it is not read twice at once.
    fn again(&mut self, index: usize) -> Option<(PathBuf, Target)> {
        let slot = self.slots.get(index)?;
        let Origin::Path(path) = &slot.loaded.origin else { return None };
        let (path, target) = (path.clone(), Target::Again(slot.id));
        self.openings.retain(|o| o.target != target);
        Some((path, target))
    }

    /// Keeps what is said about the material at `index` in a file beside it, and opens it again.
    ///
    /// # Errors
    /// Those of [`Sidecar`].
    pub fn keep(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, index: usize) -> Result<(), Error> {
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
            self.tell_apart();
        }
    }

    /// Makes the material in slot `index` the ground truth; the old one becomes a prediction in its place.
    pub fn make_ground_truth(&mut self, index: usize) {
        if index < self.slots.len() {
            self.slots.swap(0, index);
        }
    }
}

/// Why `prediction` cannot stand beside the ground truth, for the user.
fn misfit(ground_truth: &Slot, prediction: &Loaded) -> Option<String> {
    let [a, b] = [&ground_truth.loaded.material, &prediction.material];
    loss::check_same_size(a, b).err()?;
    let [[w, h], [gt_w, gt_h]] = [b.size(), a.size()];
    Some(format!(
        "{} is {w} x {h}, the ground truth {} is {gt_w} x {gt_h}: tick \"Fit sizes\" under Materials, and open it again",
        b.name(),
        a.name()
    ))
}
