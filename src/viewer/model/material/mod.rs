//! Material list: the materials in the window, the ground truth first, and what it takes to read them again.

pub mod loaded;
pub mod opening;
pub mod photograph;
pub mod read;
pub mod textures;

use std::sync::Arc;

use svbrdf_files::read::ReadOptions;
use svbrdf_files::source::{MaterialSource, Place};

use crate::message::Message;
use loaded::{LoadedMaterial, mismatch, rename};
use opening::{Arrival, Item, Opening, Reading, Target};
use read::{MaterialId, ReadMaterial, Rules};

/// The materials in the window.
#[derive(Clone, Debug, Default)]
pub struct MaterialList {
    /// The ground truth first, then the predictions.
    pub all: Vec<LoadedMaterial>,
    pub rules: Rules,
    /// The sets of materials that are being read, the latest last.
    pub openings: Vec<Opening>,
}

impl MaterialList {
    pub fn ground_truth(&self) -> Option<&LoadedMaterial> {
        self.all.first()
    }

    /// What is open, in a few words; `None` where nothing is.
    pub fn title(&self) -> Option<String> {
        let (ground_truth, predictions) = self.all.split_first()?;
        let name = ground_truth.name();
        Some(match predictions {
            [] => name.to_owned(),
            [one] => format!("{name}, {}", one.name()),
            several => format!("{name}, {} predictions", several.len()),
        })
    }

    pub fn predictions(&self) -> &[LoadedMaterial] {
        self.all.get(1..).unwrap_or_default()
    }

    /// Whether there are only built-in materials, which the first opened material replaces.
    pub fn only_built_in(&self) -> bool {
        self.all.iter().all(|one| matches!(one.read.source.place, Place::BuiltIn(_)))
    }

    /// How materials are read that are added to those in the window: as the last of them that comes from a file.
    pub fn read_of_added(&self) -> ReadOptions {
        let from_files = self.all.iter().rev().find(|one| matches!(one.read.source.place, Place::Path(_)));
        from_files.map_or(ReadOptions::AUTO, |one| ReadOptions { exemplar: None, ..one.read.record.options })
    }

    /// Whether the files of a material hold something else by now, so that results of the materials are stale.
    pub fn is_stale(&self) -> bool {
        self.all.iter().any(LoadedMaterial::is_stale)
    }

    /// Of each prediction, whether results of it and of the ground truth are stale.
    pub fn stale_predictions(&self) -> Vec<bool> {
        let of_ground_truth = self.ground_truth().is_some_and(LoadedMaterial::is_stale);
        self.predictions().iter().map(|one| of_ground_truth || one.is_stale()).collect()
    }

    /// What it takes to open this set of materials again.
    pub fn sources(&self) -> Vec<MaterialSource> {
        self.all.iter().map(|one| one.read.reopened()).collect()
    }

    /// The opening that makes these the materials in the window. Those that are there already are not read again.
    pub fn restore(&self, sources: &[MaterialSource]) -> Opening {
        let mut there = self.all.clone();
        let item = |source: &MaterialSource| match there.iter().position(|one| one.read.reopened() == *source)
        {
            Some(index) => Item::Loaded(there.remove(index)),
            None => Item::Read(Box::new(source.clone())),
        };
        Opening::new(sources.iter().map(item), Target::Everything)
    }

    /// Begins to read materials. All of them cancel every other opening, and one that is read again the others of this one.
    pub fn open(&mut self, mut opening: Opening, retries: bool) {
        match &opening.target {
            Target::Everything => self.openings.clear(),
            Target::Predictions => {}
            again @ Target::Again(_) => self.openings.retain(|one| one.target != *again),
        }
        // A file that is opened by hand and cannot be read is reported at once.
        let retries = retries && matches!(opening.target, Target::Again(_));
        let truth = self.truth_for(&opening.target);
        let (size, mask) =
            (truth.map(|one| one.material().size()), truth.and_then(|one| one.read.record.mask.clone()));
        opening.reading = Reading { rules: self.rules.clone(), size, mask, retries };
        self.openings.push(opening);
    }

    /// Whether materials are being read that are not in the window yet.
    pub fn expect_more(&self) -> bool {
        self.openings.iter().any(|one| !matches!(one.target, Target::Again(_)))
    }

    /// Whether the opening of this number is going on and none of its materials is there yet.
    pub fn is_waiting(&self, number: u64) -> bool {
        self.openings.iter().any(|one| one.number == number && one.arrived == 0)
    }

    /// The ground truth that materials for `target` are compared with; `None` where they bring their own.
    fn truth_for(&self, target: &Target) -> Option<&LoadedMaterial> {
        let stays = |ground_truth: &&LoadedMaterial| match target {
            Target::Everything => false,
            Target::Predictions => true,
            Target::Again(id) => *id != ground_truth.id(),
        };
        self.ground_truth().filter(stays)
    }

    /// Puts these into the place of all others with their slots, the ground truth first; predictions have its size.
    pub fn replace_all(&mut self, materials: &[(usize, Arc<ReadMaterial>)]) {
        let one = |(slot, read): &(usize, Arc<ReadMaterial>)| LoadedMaterial::new(read.clone()).at(*slot);
        self.all = materials.iter().map(one).collect();
        rename(&mut self.all);
    }

    /// Adds a material in the slot after all others.
    fn push(&mut self, material: LoadedMaterial) {
        let slot = self.all.last().map_or(0, |last| last.slot + 1);
        self.all.push(material.at(slot));
    }

    /// Places a material; false where those after it are not wanted.
    pub fn place(&mut self, of: &Opening, arrival: Arrival, problems: &mut Vec<Message>) -> bool {
        let replaces_all = of.target == Target::Everything && of.arrived == 0;
        match (arrival, &of.target) {
            (Arrival::Failed(_, error), _) if error.is_cancelled() => return false,
            (Arrival::Failed(source, error), target) => {
                self.mark(target, &error);
                problems.push(Message::NotRead { source, error, opening: of.number });
                // Predictions need their ground truth: the materials in the window stay.
                if replaces_all && of.items.len() > 1 {
                    let others = (1..of.items.len()).map(|place| of.name(place));
                    problems.push(Message::NotOpened(others.collect()));
                }
                return !replaces_all;
            }
            (arrival, Target::Everything | Target::Predictions) => {
                if replaces_all {
                    self.all.clear();
                }
                match arrival {
                    Arrival::Loaded(material) => self.push(material),
                    Arrival::Read(read) => self.add(read, problems),
                    Arrival::Failed(..) => {}
                }
            }
            (Arrival::Read(read), Target::Again(id)) => self.replace(*id, read, problems),
            (_, Target::Again(_)) => {}
        }
        rename(&mut self.all);
        true
    }

    /// Marks the material that could not be read again as stale.
    fn mark(&mut self, target: &Target, problem: &dyn std::fmt::Display) {
        let Target::Again(id) = target else { return };
        if let Some(material) = self.all.iter_mut().find(|one| one.id() == *id) {
            material.problem = Some(format!("Not read again: {problem}"));
        }
    }

    fn add(&mut self, read: Arc<ReadMaterial>, problems: &mut Vec<Message>) {
        if let Some(sizes) = self.ground_truth().and_then(|ground_truth| mismatch(ground_truth, &read)) {
            return problems.push(Message::Refused(Box::new(sizes)));
        }
        self.push(LoadedMaterial::new(read));
    }

    /// Replaces the material of this id. A ground truth of another size closes the predictions; a prediction of another size is
    /// refused, and the one in the window is stale from then on.
    fn replace(&mut self, id: MaterialId, read: Arc<ReadMaterial>, problems: &mut Vec<Message>) {
        let Some(index) = self.all.iter().position(|one| one.id() == id) else { return };
        let new = LoadedMaterial::new(read).at(self.all[index].slot);
        if index == 0 {
            let mismatches = self.predictions().iter().filter_map(|one| mismatch(&new, &one.read));
            problems.extend(mismatches.map(|sizes| Message::Closed(Box::new(sizes))));
            self.all.retain(|one| one.id() == id || mismatch(&new, &one.read).is_none());
        } else if let Some(sizes) = self.ground_truth().and_then(|gt| mismatch(gt, &new.read)) {
            self.mark(&Target::Again(id), &sizes.text);
            return problems.push(Message::Refused(Box::new(sizes)));
        }
        self.all[index] = new;
    }

    /// The openings that read materials from files again: all of them, or those at the given indices.
    pub fn reload(&self, only: Option<&[usize]>) -> Vec<Opening> {
        let is_wanted = |index: &usize| only.is_none_or(|only| only.contains(index));
        (0..self.all.len()).filter(is_wanted).filter_map(|index| self.again(index, |_| {})).collect()
    }

    /// The opening that reads the material at `index` again with these options alone.
    pub fn read_as(&self, index: usize, options: ReadOptions) -> Option<Opening> {
        self.again(index, |source| source.options = options)
    }

    /// The opening that reads the material at `index` again, with changes of its source; `None` for a built-in one.
    fn again(&self, index: usize, change: impl FnOnce(&mut MaterialSource)) -> Option<Opening> {
        let material = self.all.get(index)?;
        if index == 0 && self.rules.mask.is_some() {
            // All have the mask of the ground truth.
            let mut sources = self.sources();
            change(&mut sources[0]);
            return Some(Opening::of_sources(sources, Target::Everything));
        }
        if matches!(material.read.source.place, Place::BuiltIn(_)) {
            return None;
        }
        let (mut source, target) = (material.read.reopened(), Target::Again(material.id()));
        change(&mut source);
        Some(Opening::of_sources([source], target))
    }

    /// Closes the prediction at `index`. Those after it move up, unless they are methods of a data set.
    pub fn close(&mut self, index: usize) {
        if index > 0 && index < self.all.len() {
            let is_plain = self.all.iter().enumerate().all(|(place, one)| one.slot == place);
            self.all.remove(index);
            self.all.iter_mut().skip(index).for_each(|one| one.slot -= usize::from(is_plain));
            rename(&mut self.all);
        }
    }

    /// Makes the material at `index` the ground truth; the old one becomes a prediction in its place.
    pub fn make_ground_truth(&mut self, index: usize) {
        if index < self.all.len() {
            self.all.swap(0, index);
            self.all[index].slot = std::mem::take(&mut self.all[0].slot);
        }
    }
}
