//! Materials of a data set with their predictions: the one in the window, and those that are read ahead.

use std::sync::Arc;
use std::thread;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::registration::in_one_size;
use svbrdf_gpu::Gpu;

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::Given;
use crate::jobs::answers::{Answered, Question, Work};
use crate::jobs::reading;
use crate::model::dataset::{Missing, OpenDataset};
use crate::model::material::opening::Reading;
use crate::model::material::read::{ReadMaterial, Rules};

/// Bytes of a texel in the memory of the machine and of the adapter.
const TEXEL_BYTES: usize = 88;
/// Bytes of a material with its predictions up to which others are read ahead.
const AHEAD: usize = 256 << 20;

/// A material with its predictions, read.
#[derive(Debug)]
pub struct ReadCase {
    pub case: usize,
    /// With their slots, the ground truth first; empty where it cannot be read.
    pub materials: Vec<(usize, Arc<ReadMaterial>)>,
    pub missing: Vec<Missing>,
}

impl ReadCase {
    fn bytes(&self) -> usize {
        let texels =
            self.materials.iter().map(|(_, one)| one.material().size().into_iter().product::<usize>());
        texels.sum::<usize>() * TEXEL_BYTES
    }
}

/// The material that was asked for, once it has been read; then those ahead are read.
pub fn ask(Shown { model, jobs }: Shown<'_>) -> Option<Arc<Answered<ReadCase>>> {
    let dataset = &model.dataset;
    let open = dataset.open.as_ref()?;
    let (is_of_predictions, materials) = (open.is_of_predictions(), &model.materials.all);
    let known = materials.iter().filter(|_| is_of_predictions).map(|one| one.read.clone());
    let (known, pinned): (Vec<_>, _) = (known.collect(), dataset.pinned());
    let question = |case: usize| AskCase {
        case,
        pinned: pinned.clone(),
        open: open.clone(),
        version: dataset.version(case),
        rules: Rules { mask: None, ..model.materials.rules.clone() },
        given: Given((jobs.gpu.clone(), known.clone())),
    };
    let read = jobs.answers.get(&question(dataset.wanted)).ready()?;
    if read.bytes() <= AHEAD {
        dataset.ahead.iter().for_each(|case| drop(jobs.answers.get_later(&question(*case))));
    }
    Some(read)
}

/// A material with its predictions, and predictions of a list beside it.
#[derive(Clone, Debug)]
struct AskCase {
    open: Arc<OpenDataset>,
    case: usize,
    /// The predictions of a list that are asked for beside it.
    pinned: Vec<usize>,
    /// How often its files were read again.
    version: u64,
    rules: Rules,
    /// The adapter, and what is in the window: all predictions of one ground truth have it in common.
    given: Given<(Option<Gpu>, Vec<Arc<ReadMaterial>>)>,
}

impl PartialEq for AskCase {
    fn eq(&self, other: &Self) -> bool {
        let of = |one: &Self| (Arc::as_ptr(&one.open).addr(), one.case, one.version);
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

/// A material, or why there is none.
type Column = Result<Arc<ReadMaterial>, String>;

impl AskCase {
    /// Reads a material with its predictions, several at a time.
    fn read(&self, progress: &Progress) -> ReadCase {
        let case = self.case;
        let mut found = ReadCase { case, materials: Vec::new(), missing: Vec::new() };
        let whole = match self.column((case, 0), None, progress) {
            Ok(read) => read,
            Err(problem) => {
                found.missing.push(Missing { slot: 0, name: "ground truth".to_owned(), problem });
                return found;
            }
        };
        let size = Some(whole.material().size());
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
        let truth = self.registered(&whole, &places, &mut columns).unwrap_or(whole);
        found.materials.push((0, truth.clone()));
        for (place, one) in places.into_iter().zip(columns) {
            let of_size = one.and_then(|read| {
                check_same_size(truth.material(), read.material()).map_err(|problem| problem.to_string())?;
                Ok(read)
            });
            let slot = self.open.slot(place.0, place.1);
            match of_size {
                Ok(read) => found.materials.push((slot, read)),
                Err(problem) => found.missing.push(Missing { slot, name: self.name(place), problem }),
            }
        }
        found
    }

    /// Brings the ground truth, which it returns, and the predictions to the part and the size of the first method whose registration is
    /// known and whose prediction has another size; `None` without one.
    fn registered(
        &self,
        truth: &ReadMaterial,
        places: &[(usize, usize)],
        columns: &mut [Column],
    ) -> Option<Arc<ReadMaterial>> {
        let of =
            |(place, one): (&(usize, usize), &Column)| (one.clone().ok(), self.open.registration(place.1));
        let all: Vec<_> = places.iter().zip(&*columns).map(of).collect();
        let all: Vec<_> =
            all.iter().map(|(one, way)| (one.as_ref().map(|one| one.material()), *way)).collect();
        let (cut, changed) = in_one_size(truth.material(), &all)?.ok()?;
        let gpu = self.given.0.0.as_ref();
        for (one, changed) in columns.iter_mut().zip(changed) {
            let (Ok(read), Some(material)) = (&*one, changed) else { continue };
            let present = material.map(|material| Arc::new(read.part(material, gpu)));
            *one = present.map_err(|problem| problem.to_string());
        }
        Some(Arc::new(truth.part(cut, gpu)))
    }

    /// The ground truth of a material, in column 0, or a prediction of it.
    fn column(
        &self,
        (case, column): (usize, usize),
        size: Option<[usize; 2]>,
        progress: &Progress,
    ) -> Column {
        let source = self.open.source(case, column)?;
        let Given((gpu, known)) = &self.given;
        if let Some(known) =
            known.iter().find(|one| one.source == source && one.is_of_now() && one.record.mask.is_none())
        {
            return Ok(known.clone());
        }
        let mut reading = Reading { rules: self.rules.clone(), size, ..Reading::default() };
        let read = reading::read(&mut reading, &source, gpu.as_ref(), &progress.part());
        read.map(Arc::new).map_err(|error| error.to_string())
    }

    /// What a prediction is called.
    fn name(&self, (case, column): (usize, usize)) -> String {
        match self.open.is_of_predictions() {
            true => self.open.name(case).to_owned(),
            false => self.open.methods()[column - 1].clone(),
        }
    }
}
