//! Losses of a data set: those of the results folder at once, the others in the background, what is in sight first.

use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{Case, DatasetSettings, Evaluation, MaterialResult, Pick, counted_loss};
use svbrdf_files::convention::ChosenConvention;

use crate::error::Error;
use crate::jobs::work::job::{Job, Worker};
use crate::jobs::work::priority;
use crate::jobs::work::waker::Waker;
use crate::model::dataset::OpenDataset;
use crate::model::dataset::list::CaseLosses;

/// Of several predictions of a material, the first is the one that counts and that the window shows.
pub const PICK: Pick = Pick::Fixed;

/// The losses as far as they are known.
#[derive(Debug, Default)]
pub struct DatasetLosses {
    convention: ChosenConvention,
    results: Vec<Option<Arc<MaterialResult>>>,
    rows: Vec<Option<CaseLosses>>,
    /// Counts the changes.
    pub generation: u64,
    /// How often a material was read again.
    pub read_again: u64,
    /// The largest loss that is known.
    pub largest: f64,
    /// What is computed first.
    first: Arc<Mutex<Vec<usize>>>,
    job: Option<Job<(), Update>>,
    /// Whether the last job has failed, which is not tried again by itself.
    has_failed: bool,
    /// What a user should know about the results folder.
    pub notes: Vec<String>,
}

#[derive(Debug)]
enum Update {
    Result(MaterialResult),
    Notes(Vec<String>),
}

impl DatasetLosses {
    /// The losses of a material, once they are known.
    pub fn row(&self, case: usize) -> Option<&CaseLosses> {
        self.rows.get(case)?.as_ref()
    }

    /// The number of materials whose losses are known.
    pub fn count(&self) -> usize {
        self.results.iter().flatten().count()
    }

    pub fn results(&self) -> impl Iterator<Item = &Arc<MaterialResult>> {
        self.results.iter().flatten()
    }

    /// The settings of the losses, in the convention of the window.
    pub fn settings(&self, open: &OpenDataset) -> DatasetSettings {
        DatasetSettings { convention: self.convention.clone(), ..open.settings.clone() }
    }

    /// Computes the losses of a material again: its files have changed.
    pub fn forget(&mut self, case: usize) {
        if let Some(result) = self.results.get_mut(case) {
            (*result, self.rows[case]) = (None, None);
            self.generation += 1;
            self.read_again += 1;
            (self.job, self.has_failed) = (None, false);
        }
    }

    /// Takes over results, and computes those that are missing, the `first` ones first.
    pub(super) fn follow(
        &mut self,
        waker: &Waker,
        open: &Arc<OpenDataset>,
        convention: &ChosenConvention,
        first: &[usize],
    ) -> Option<Error> {
        if self.convention != *convention || self.results.len() != open.cases.len() {
            let count = open.cases.len();
            let generation = self.generation + 1;
            let read_again = self.read_again;
            *self = Self { convention: convention.clone(), generation, read_again, ..Self::default() };
            (self.results, self.rows) = (vec![None; count], vec![None; count]);
        }
        *self.first.lock().unwrap_or_else(PoisonError::into_inner) = first.to_vec();
        let error = self.take(open);
        let missing: Vec<usize> =
            (0..self.results.len()).filter(|case| self.results[*case].is_none()).collect();
        if self.job.is_none() && !self.has_failed && !missing.is_empty() {
            let work =
                LossesWork { settings: self.settings(open), open: open.clone(), first: self.first.clone() };
            let progress = Progress::default();
            progress.begin(open.cases.len() as u64);
            self.job = Some(Job::stream(waker, progress, move |worker| work.run(missing, worker)));
        }
        error
    }

    fn take(&mut self, open: &OpenDataset) -> Option<Error> {
        let job = self.job.as_ref()?;
        let ended = job.poll();
        for update in job.updates() {
            match update {
                Update::Notes(notes) => self.notes = notes,
                Update::Result(result) => self.add(open, result),
            }
        }
        let error = ended?.err();
        (self.job, self.has_failed) = (None, error.is_some());
        error.filter(|error| !error.is_cancelled())
    }

    fn add(&mut self, open: &OpenDataset, result: MaterialResult) {
        let by_method: Vec<_> =
            open.methods().iter().map(|method| counted_loss(&result, method, PICK)).collect();
        let problems =
            result.predictions.iter().filter_map(|one| Some((one.method.clone(), one.error.clone()?)));
        let losses = || by_method.iter().flatten().map(|known| known.loss);
        self.largest = losses().fold(self.largest, f64::max);
        let is_below_floor = losses().any(|loss| result.is_below_floor(Some(loss)));
        let case = result.index;
        if let Some(row) = self.rows.get_mut(case) {
            *row = Some(CaseLosses { problems: problems.collect(), is_below_floor, by_method });
            self.results[case] = Some(Arc::new(result));
            self.generation += 1;
        }
    }
}

/// What the worker works with.
struct LossesWork {
    settings: DatasetSettings,
    open: Arc<OpenDataset>,
    first: Arc<Mutex<Vec<usize>>>,
}

impl LossesWork {
    fn run(&self, missing: Vec<usize>, worker: &Worker<Update>) -> Result<(), Error> {
        let (open, progress) = (&self.open, &worker.progress);
        let evaluation = |results| Evaluation::new(&self.settings, &open.reading, results, progress);
        let opened = evaluation(open.results.as_deref());
        let refused = opened.as_ref().err().map(ToString::to_string);
        worker.report(Update::Notes(refused.clone().into_iter().collect()))?;
        let evaluation = opened.or_else(|_| evaluation(None))?;
        let mut left = Vec::new();
        for case in missing {
            match evaluation.known(&open.cases[case]) {
                Some(result) => worker.report(Update::Result(result))?,
                None => left.push(case),
            }
        }
        // Threads of its own: in those of the window, a flip would wait for the end of a loss.
        let pool = priority::background_pool().map_err(|error| Error::internal(error.to_string()))?;
        while !left.is_empty() {
            let next = self.next(&mut left, pool.current_num_threads());
            let compute = |case: &&Case| worker.report(Update::Result(evaluation.material(case)?));
            pool.install(|| next.par_iter().try_for_each(|case| compute(&&open.cases[*case])))?;
        }
        let (notes, unkept) = evaluation.end()?;
        worker.report(Update::Notes(refused.into_iter().chain(notes).chain(unkept).collect()))
    }

    /// Takes the next materials out of those that are left: as many as are computed at a time.
    fn next(&self, left: &mut Vec<usize>, count: usize) -> Vec<usize> {
        let first = self.first.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let mut next: Vec<usize> = first.into_iter().filter(|case| left.contains(case)).collect();
        next.dedup();
        let others: Vec<usize> =
            left.iter().filter(|case| !next.contains(case)).copied().take(count).collect();
        next.extend(others);
        next.truncate(count);
        left.retain(|case| !next.contains(case));
        next
    }
}
