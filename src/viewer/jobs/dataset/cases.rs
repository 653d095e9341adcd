//! Materials of a data set with their predictions: the one in the window, and those that are read ahead.

use std::sync::Arc;
use std::thread;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::progress::Progress;
use svbrdf_gpu::Gpu;

use crate::error::Error;
use crate::jobs::answers::content::Given;
use crate::jobs::answers::{Answered, Answers, Question, Work};
use crate::jobs::reading::read::{MaterialReader, read_with_retries};
use crate::jobs::reading::upload::Uploaded;
use crate::model::Model;
use crate::model::dataset::{Missing, OpenDataset};
use crate::model::material::read::{MaterialId, ReadMaterial, Rules};

/// Bytes of a texel in the memory of the machine and of the adapter.
const TEXEL_BYTES: usize = 88;
/// Bytes of a material with its predictions up to which others are read ahead.
const AHEAD: usize = 256 << 20;

/// A material with its predictions, read.
#[derive(Debug)]
pub struct ReadCase {
    pub case: usize,
    /// The predictions of a list that were asked for beside it.
    pub pinned: Vec<usize>,
    /// With their slots, the ground truth first; empty where it cannot be read.
    pub materials: Vec<(usize, Arc<ReadMaterial>)>,
    /// Of each material, where there is an adapter.
    pub uploads: Vec<(MaterialId, Arc<Uploaded>)>,
    pub missing: Vec<Missing>,
}

impl ReadCase {
    fn bytes(&self) -> usize {
        let texels =
            self.materials.iter().map(|(_, one)| one.material().size().into_iter().product::<usize>());
        texels.sum::<usize>() * TEXEL_BYTES
    }
}

/// The materials of a data set that the window has, the one that is waited for first, then those ahead.
pub type ReadCases = Vec<Arc<Answered<ReadCase>>>;

/// Asks for the material that was asked for, and for those ahead once it is there. `known` are the latest that were.
pub fn ask(
    answers: &Answers,
    gpu: Option<&Gpu>,
    model: &Model,
    (read_again, known): (u64, &ReadCases),
) -> ReadCases {
    let dataset = &model.dataset;
    let Some(open) = &dataset.open else { return Vec::new() };
    // All predictions of one ground truth have it in common.
    let known = if open.is_of_predictions() { known.clone() } else { Vec::new() };
    let question = |case: usize| AskCase {
        case,
        pinned: dataset.pinned(),
        open: open.clone(),
        read_again,
        rules: model.materials.rules,
        gpu: Given(gpu.cloned()),
        known: Given(known.clone()),
    };
    let mut cases: ReadCases = answers.get(&question(dataset.wanted)).ready().into_iter().collect();
    if cases.iter().any(|case| case.bytes() <= AHEAD) {
        cases.extend(dataset.ahead.iter().filter_map(|case| answers.get_later(&question(*case)).ready()));
    }
    cases
}

/// A material with its predictions, and predictions of a list beside it.
#[derive(Clone, Debug)]
struct AskCase {
    open: Arc<OpenDataset>,
    case: usize,
    pinned: Vec<usize>,
    /// How often files were read again.
    read_again: u64,
    rules: Rules,
    gpu: Given<Option<Gpu>>,
    /// What has the ground truth of all, and the pinned predictions, once they are read.
    known: Given<ReadCases>,
}

impl PartialEq for AskCase {
    fn eq(&self, other: &Self) -> bool {
        let of = |one: &Self| (Arc::as_ptr(&one.open).addr(), one.case, one.read_again);
        of(self) == of(other) && self.pinned == other.pinned && self.rules == other.rules
    }
}

impl Question for AskCase {
    type Answer = ReadCase;
    // What is not asked for may be large.
    const KEPT: usize = 0;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<ReadCase, Error> {
        Ok(self.read(work.progress()))
    }
}

/// A material that was read and sent to the adapter.
type Present = (Arc<ReadMaterial>, Option<Arc<Uploaded>>);

/// The same, or why there is none.
type Column = Result<Present, String>;

impl AskCase {
    /// Reads a material with its predictions, several at a time.
    fn read(&self, progress: &Progress) -> ReadCase {
        let case = self.case;
        let (pinned, missing) = (self.pinned.clone(), Vec::new());
        let mut found = ReadCase { case, pinned, materials: Vec::new(), uploads: Vec::new(), missing };
        let (truth, uploaded) = match self.column((case, 0), None, progress) {
            Ok(read) => read,
            Err(problem) => {
                found.missing.push(Missing { slot: 0, name: "ground truth".to_owned(), problem });
                return found;
            }
        };
        let size = Some(truth.material().size());
        let pinned = self.pinned.iter().filter(|pinned| **pinned != case).map(|pinned| (*pinned, 1));
        let places: Vec<(usize, usize)> =
            (1..=self.open.methods().len()).map(|column| (case, column)).chain(pinned).collect();
        let threads = thread::available_parallelism().map_or(1, usize::from).min(4);
        let mut columns: Vec<Column> = Vec::new();
        for group in places.chunks(threads) {
            columns.extend(thread::scope(|scope| {
                let start = |place: &(usize, usize)| {
                    let place = *place;
                    scope.spawn(move || self.column(place, size, progress))
                };
                let started: Vec<_> = group.iter().map(start).collect();
                let failed = |_| Err("its reading has failed".to_owned());
                started.into_iter().map(|one| one.join().unwrap_or_else(failed)).collect::<Vec<_>>()
            }));
        }
        let whole = (truth, uploaded);
        let (truth, uploaded) = self.registered(&whole, &places, &mut columns).unwrap_or(whole);
        found.uploads.extend(uploaded.map(|uploaded| (truth.id, uploaded)));
        found.materials.push((0, truth.clone()));
        for (place, one) in places.into_iter().zip(columns) {
            let of_size = one.and_then(|(read, uploaded)| {
                check_same_size(truth.material(), read.material()).map_err(|problem| problem.to_string())?;
                Ok((read, uploaded))
            });
            match of_size {
                Ok((read, uploaded)) => {
                    found.uploads.extend(uploaded.map(|uploaded| (read.id, uploaded)));
                    found.materials.push((self.slot(place), read));
                }
                Err(problem) => {
                    let (slot, name) = (self.slot(place), self.name(place));
                    found.missing.push(Missing { slot, name, problem });
                }
            }
        }
        found
    }

    /// Brings the ground truth, which it returns, and the predictions to the part and the size of the first method whose registration is
    /// known and whose prediction has another size; `None` without one.
    fn registered(
        &self,
        (truth, _): &Present,
        places: &[(usize, usize)],
        columns: &mut [Column],
    ) -> Option<Present> {
        let of = |place: &(usize, usize)| {
            self.open.reading.registrations.get(self.open.methods().get(place.1.checked_sub(1)?)?).copied()
        };
        let size = truth.material().size();
        let sample = |(place, one): (&(usize, usize), &Column)| {
            let (read, _) = one.as_ref().ok().filter(|(read, _)| read.material().size() != size)?;
            Some((of(place)?, read.clone()))
        };
        let (registration, sample) = places.iter().zip(&*columns).find_map(sample)?;
        let part = |whole: &ReadMaterial| registration.applied([whole.material(), sample.material()]);
        let present = |read: &ReadMaterial, material| {
            let read = Arc::new(read.part(material));
            let uploaded = self.gpu.0.as_ref().map(|gpu| Arc::new(Uploaded::new(gpu, read.material())));
            (read, uploaded)
        };
        let [cut, _] = part(truth).ok()?;
        for (place, one) in places.iter().zip(columns) {
            let Ok((read, _)) = one else { continue };
            let material = if read.material().size() == size {
                part(read).map(|[cut, _]| cut)
            } else if of(place) == Some(registration) {
                registration.applied([truth.material(), read.material()]).map(|[_, prediction]| prediction)
            } else {
                continue;
            };
            *one = material.map(|material| present(read, material)).map_err(|problem| problem.to_string());
        }
        Some(present(truth, cut))
    }

    /// The ground truth of a material, in column 0, or a prediction of it.
    fn column(
        &self,
        (case, column): (usize, usize),
        size: Option<[usize; 2]>,
        progress: &Progress,
    ) -> Column {
        let source = self.open.source(case, column)?;
        for known in &self.known.0 {
            if let Some((_, read)) = known.materials.iter().find(|(_, one)| one.source == source) {
                let uploaded = known.uploads.iter().find(|(id, _)| *id == read.id);
                return Ok((read.clone(), uploaded.map(|(_, uploaded)| uploaded.clone())));
            }
        }
        let mut reader = MaterialReader { rules: self.rules, size, retries: false };
        let read =
            read_with_retries(&source, &mut reader, &progress.part()).map_err(|error| error.to_string())?;
        let uploaded = self.gpu.0.as_ref().map(|gpu| Arc::new(Uploaded::new(gpu, read.material())));
        Ok((Arc::new(read), uploaded))
    }

    /// The slot of a prediction: that of its method, or its place among the predictions of one ground truth.
    fn slot(&self, (case, column): (usize, usize)) -> usize {
        if self.open.is_of_predictions() { case + 1 } else { column }
    }

    /// What a prediction is called.
    fn name(&self, (case, column): (usize, usize)) -> String {
        match self.open.is_of_predictions() {
            true => self.open.name(case).to_owned(),
            false => self.open.methods()[column - 1].clone(),
        }
    }
}
