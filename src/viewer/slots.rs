//! The materials in the window. They are read on a worker; each is there as soon as it has been read.

use std::path::PathBuf;
use std::sync::Arc;

use eframe::egui;

use super::loaded::{Loaded, Reader, Rules};
use super::message::Message;
use super::opening::{Arrival, Item, Opening};
pub(super) use super::slot::{Slot, Target};
use super::slot::{mismatch, rename};
use super::source::{Origin, Source};
use crate::error::Error;
use crate::files::read::{ReadOptions, Sidecar};
use crate::gpu::Gpu;
use crate::samples;

/// The ground truth first, then the predictions; and the materials that are still being read.
#[derive(Debug, Default)]
pub(super) struct Slots {
    pub slots: Vec<Slot>,
    pub openings: Vec<Opening>,
    pub rules: Rules,
    /// Whether materials that change on disk are read again, so that files that are just being written are waited for.
    pub patient: bool,
    /// The paths that have been opened since they were last taken.
    pub opened: Vec<PathBuf>,
    /// The paths that have been read, whether for the first time or again, since they were last taken.
    pub read: Vec<PathBuf>,
    next_id: u64,
}

impl Slots {
    pub(super) fn ground_truth(&self) -> Option<&Slot> {
        self.slots.first()
    }

    pub(super) fn predictions(&self) -> &[Slot] {
        self.slots.get(1..).unwrap_or_default()
    }

    /// Whether there is only the built-in pair, which the first opened material replaces.
    pub(super) fn only_built_in(&self) -> bool {
        self.slots.iter().all(|s| matches!(s.loaded.origin, Origin::BuiltIn(_)))
    }

    /// What it takes to open this set of materials again.
    pub(super) fn sources(&self) -> Vec<Source> {
        self.slots.iter().map(|slot| slot.loaded.source().of_set()).collect()
    }

    /// Whether materials are being read that are not in the window yet.
    pub(super) fn expects_more(&self) -> bool {
        self.openings.iter().any(|opening| !matches!(opening.target, Target::Again(_)))
    }

    /// Starts to read `sources`; the number of this opening.
    pub(super) fn open(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        sources: Vec<Source>,
        target: Target,
    ) -> u64 {
        self.start(ctx, gpu, sources.into_iter().map(Item::Read).collect(), target)
    }

    /// Starts to read the built-in pair.
    pub(super) fn open_built_in(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>) {
        let sources = (0..samples::COUNT).map(Source::built_in).collect();
        self.open(ctx, gpu, sources, Target::Everything);
    }

    /// Makes these the materials in the window. Those that are there already are not read again.
    pub(super) fn restore(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, sources: &[Source]) {
        let mut there = self.slots.clone();
        let is = |slot: &Slot, source: &Source| {
            let there = slot.loaded.source();
            there == *source || there.of_set() == *source
        };
        let item = |source: &Source| match there.iter().position(|slot| is(slot, source)) {
            Some(index) => Item::Kept(there.remove(index)),
            None => Item::Read(source.clone()),
        };
        let items = sources.iter().map(item).collect();
        self.start(ctx, gpu, items, Target::Everything);
    }

    fn start(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, items: Vec<Item>, target: Target) -> u64 {
        if target == Target::Everything {
            // Materials that are still being read belong to the earlier set.
            self.openings.clear();
        }
        let (id, reader) = (self.new_id(), self.reader(gpu, &target));
        self.openings.push(Opening::start(ctx, id, target, items, reader));
        id
    }

    /// A reader of the materials for `target`.
    fn reader(&self, gpu: Option<&Gpu>, target: &Target) -> Reader {
        let ground_truth = self.ground_truth().filter(|ground_truth| match target {
            Target::Everything => false,
            Target::Predictions => true,
            Target::Again(id) => *id != ground_truth.id,
        });
        let size = ground_truth.map(|slot| slot.loaded.material.size());
        // A person who opens a file is told at once what is wrong with it.
        let patient = self.patient && matches!(target, Target::Again(_));
        let drafts = !matches!(target, Target::Again(_));
        Reader { gpu: gpu.cloned(), rules: self.rules, size, patient, drafts }
    }

    /// Takes over the materials that have been read since the last call; returns what went wrong.
    pub(super) fn poll(&mut self, ctx: &egui::Context) -> Vec<Message> {
        let mut problems = Vec::new();
        for mut opening in std::mem::take(&mut self.openings) {
            let (arrivals, ended) = opening.poll(ctx);
            let mut dropped = false;
            for arrival in arrivals {
                dropped |= !self.place(&opening, arrival, &mut problems);
                opening.arrived += 1;
                if dropped {
                    break;
                }
            }
            match ended {
                None if !dropped => self.openings.push(opening),
                Some(Err(error)) if !matches!(error, Error::Cancelled) => {
                    problems.push(Message::Failed(error));
                }
                _ => {}
            }
        }
        problems
    }

    /// Places a material; false where those after it are not wanted.
    fn place(&mut self, opening: &Opening, arrival: Arrival, problems: &mut Vec<Message>) -> bool {
        let is_first = opening.arrived == 0;
        let everything = opening.target == Target::Everything;
        match (arrival, &opening.target) {
            (Arrival::Failed(_, Error::Cancelled), _) => return false,
            (Arrival::Failed(source, error), target) => {
                self.mark(target, &error);
                problems.push(Message::NotRead { source, error, opening: opening.id });
                // Predictions need their ground truth: the materials in the window stay.
                let others = opening.names_after(1);
                if everything && is_first && !others.is_empty() {
                    problems.push(Message::NotOpened(others));
                }
                return !(everything && is_first);
            }
            (arrival, Target::Everything | Target::Predictions) => {
                if everything && is_first {
                    self.slots.clear();
                }
                match arrival {
                    Arrival::Kept(slot) => self.slots.push(slot),
                    Arrival::Read(loaded) => self.add(loaded, problems),
                    Arrival::Failed(..) => {}
                }
            }
            (Arrival::Read(loaded), Target::Again(id)) => self.replace(*id, loaded, problems),
            (_, Target::Again(_)) => {}
        }
        rename(&mut self.slots);
        true
    }

    /// Marks the material that could not be read again.
    fn mark(&mut self, target: &Target, error: &Error) {
        let Target::Again(id) = target else { return };
        if let Some(slot) = self.slots.iter_mut().find(|slot| slot.id == *id) {
            slot.problem = Some(format!("Not read again: {error}"));
        }
    }

    fn add(&mut self, loaded: Arc<Loaded>, problems: &mut Vec<Message>) {
        if let Some(sizes) = self.ground_truth().and_then(|ground_truth| mismatch(ground_truth, &loaded)) {
            return problems.push(Message::Refused(Box::new(sizes)));
        }
        if let Origin::Path(path) = &loaded.origin {
            self.opened.push(loaded.run.as_ref().map_or(path, |run| &run.folder).clone());
            self.read.push(path.clone());
        }
        let id = self.new_id();
        self.slots.push(Slot::new(id, loaded));
    }

    /// Replaces the material of the slot `id`. A ground truth of another size closes the predictions.
    fn replace(&mut self, id: u64, loaded: Arc<Loaded>, problems: &mut Vec<Message>) {
        let Some(index) = self.slots.iter().position(|s| s.id == id) else { return };
        self.read.push(loaded.path().to_owned());
        let new = Slot::new(self.new_id(), loaded);
        if index == 0 {
            let mismatches = self.predictions().iter().filter_map(|s| mismatch(&new, &s.loaded));
            problems.extend(mismatches.map(|sizes| Message::Closed(Box::new(sizes))));
            self.slots.retain(|s| s.id == id || mismatch(&new, &s.loaded).is_none());
        } else if let Some(sizes) = self.ground_truth().and_then(|gt| mismatch(gt, &new.loaded)) {
            return problems.push(Message::Refused(Box::new(sizes)));
        }
        self.slots[index] = new;
    }

    /// A number that no material has had.
    pub(super) fn new_id(&mut self) -> u64 {
        self.next_id += 1;
        self.next_id
    }

    /// Reads materials from files again: all of them, or those of the given indices.
    pub(super) fn reload(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, only: Option<&[usize]>) {
        for index in 0..self.slots.len() {
            if only.is_none_or(|only| only.contains(&index)) {
                self.again(ctx, gpu, index, |_| {});
            }
        }
    }

    /// Reads the step at `path` of the training run in slot `index`.
    pub(super) fn show_step(&mut self, ctx: &egui::Context, gpu: Option<&Gpu>, index: usize, path: PathBuf) {
        self.again(ctx, gpu, index, |source| source.origin = Origin::Path(path));
    }

    /// Reads the material at `index` again with these options alone.
    pub(super) fn read_as(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        index: usize,
        options: ReadOptions,
    ) {
        self.again(ctx, gpu, index, |source| source.exactly = Some(options));
    }

    /// Reads the material at `index` again, with changes of its source; a reading of it that is under way is cancelled.
    fn again(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        index: usize,
        change: impl FnOnce(&mut Source),
    ) {
        let Some(slot) = self.slots.get(index) else { return };
        if matches!(slot.loaded.origin, Origin::BuiltIn(_)) {
            return;
        }
        let (mut source, target) = (slot.loaded.source(), Target::Again(slot.id));
        change(&mut source);
        self.openings.retain(|o| o.target != target);
        self.open(ctx, gpu, vec![source], target);
    }

    /// Saves the assumptions specified for the material at `index` in a sidecar file, and opens it again.
    ///
    /// # Errors
    /// Those of [`Sidecar`].
    pub(super) fn save_assumptions(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        index: usize,
    ) -> Result<(), Error> {
        let Some(slot) = self.slots.get(index) else { return Ok(()) };
        let Origin::Path(path) = &slot.loaded.origin else { return Ok(()) };
        Sidecar { options: slot.loaded.read, ..Sidecar::load(path)? }.save(path)?;
        self.again(ctx, gpu, index, |source| (source.asked, source.exactly) = (ReadOptions::AUTO, None));
        Ok(())
    }

    /// Closes the prediction in slot `index`.
    pub(super) fn close(&mut self, index: usize) {
        if index > 0 && index < self.slots.len() {
            self.slots.remove(index);
            rename(&mut self.slots);
        }
    }

    /// Makes the material in slot `index` the ground truth; the old one becomes a prediction in its place.
    pub(super) fn make_ground_truth(&mut self, index: usize) {
        if index < self.slots.len() {
            self.slots.swap(0, index);
        }
    }
}
