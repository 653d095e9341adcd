//! Losses of a data set: those of the results folder at once, the others in the background, what is in sight first.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use rayon::prelude::*;

use svbrdf_evaluate::dataset::{
    DatasetSettings, Evaluation, MaterialResult, Pick, PredictionResult, counted_loss,
};
use svbrdf_files::convention::ChosenConvention;

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::Given;
use crate::jobs::answers::{Answer, Answered, Pace, Question, Work};
use crate::jobs::work::threads;
use crate::model::dataset::list::CaseLosses;
use crate::model::dataset::{InSight, OpenDataset};

/// Of several predictions of a material, the first is the one that counts and that the window shows.
pub const PICK: Pick = Pick::Fixed;
/// Results of the folder that are told at a time.
const AT_A_TIME: usize = 100;

/// The losses as far as they are known.
#[derive(Clone, Debug, Default)]
pub struct DatasetLosses {
    /// How often each material was read again before.
    versions: Arc<Vec<u64>>,
    /// Of each material, its result, and the losses of the list.
    all: Vec<Option<Arc<(MaterialResult, CaseLosses)>>>,
    /// The largest loss that is known.
    pub largest: f64,
    /// What a user should know about the results folder.
    pub notes: Vec<String>,
}

impl DatasetLosses {
    /// The losses of a material, once they are known.
    pub fn row(&self, case: usize) -> Option<&CaseLosses> {
        self.all.get(case)?.as_deref().map(|(_, losses)| losses)
    }

    /// The number of materials whose losses are known.
    pub fn count(&self) -> usize {
        self.results().count()
    }

    /// The causes that the diagnosis of a prediction found, the largest share first.
    pub fn causes(&self, case: usize, method: &str) -> impl Iterator<Item = &str> {
        let all = self.result(case).into_iter().flat_map(|result| &result.predictions);
        let marks = all.filter(move |one| one.method == method).flat_map(|one| one.marks.iter().flatten());
        marks.map(|mark| mark.hypothesis.as_str())
    }

    /// The cause that explains most of the loss of any prediction of a material.
    pub fn cause(&self, case: usize) -> Option<String> {
        let marks = self.result(case)?.predictions.iter().flat_map(|one| one.marks.iter().flatten());
        let most = marks.max_by(|a, b| a.share.total_cmp(&b.share))?;
        Some(format!("{} {:.0}%", most.hypothesis, 100.0 * most.share))
    }

    fn result(&self, case: usize) -> Option<&MaterialResult> {
        self.all.get(case)?.as_deref().map(|(result, _)| result)
    }

    pub fn results(&self) -> impl Iterator<Item = &MaterialResult> {
        self.all.iter().flatten().map(|one| &one.0)
    }

    /// Those of materials of these versions that were known `before`.
    fn of_versions(versions: &Arc<Vec<u64>>, before: Option<&Self>) -> Self {
        let mut known =
            Self { versions: versions.clone(), all: vec![None; versions.len()], ..Self::default() };
        for (case, one) in before.into_iter().flat_map(|before| before.all.iter().enumerate()) {
            if before.is_some_and(|before| before.versions.get(case) == versions.get(case)) {
                one.iter().for_each(|one| known.add(one.clone()));
            }
        }
        known
    }

    fn add(&mut self, one: Arc<(MaterialResult, CaseLosses)>) {
        let losses = one.1.by_method.iter().flatten().map(|known| known.loss);
        self.largest = losses.fold(self.largest, f64::max);
        if let Some(place) = self.all.get_mut(one.0.index) {
            *place = Some(one);
        }
    }
}

/// The losses of a data set.
#[derive(Clone, Debug)]
struct EvaluateDataset {
    open: Arc<OpenDataset>,
    convention: ChosenConvention,
    versions: Arc<Vec<u64>>,
    /// What is computed first, and the losses that are known already.
    given: Given<(InSight, Option<Arc<Answered<DatasetLosses>>>)>,
}

impl PartialEq for EvaluateDataset {
    fn eq(&self, other: &Self) -> bool {
        self.is_like(other) && self.versions == other.versions
    }
}

/// The losses of the data set that is open, as far as they are known.
pub fn ask(shown: Shown<'_>) -> Arc<Answered<DatasetLosses>> {
    let (model, answers) = (shown.model, &shown.jobs.answers);
    let found = model.dataset.open.as_ref().and_then(|open| {
        let (convention, versions) = (model.view.convention.clone(), model.dataset.versions.clone());
        let given = Given((model.dataset.in_sight.clone(), None));
        let mut question = EvaluateDataset { open: open.clone(), convention, versions, given };
        question.given.0.1 = answers.latest(&question);
        match answers.get(&question) {
            Answer::Ready(found) | Answer::Partial(found, ..) => Some(found),
            _ => None,
        }
    });
    found.unwrap_or_else(|| Arc::new(Answered { answer: DatasetLosses::default(), elapsed: Duration::ZERO }))
}

/// The settings of the losses, in the convention of the window.
pub fn settings(open: &OpenDataset, convention: &ChosenConvention) -> DatasetSettings {
    DatasetSettings { convention: convention.clone(), ..open.settings.clone() }
}

impl Question for EvaluateDataset {
    type Answer = DatasetLosses;
    const PACE: Pace = Pace::Beside;
    const KEPT: usize = 0;

    fn is_like(&self, earlier: &Self) -> bool {
        Arc::ptr_eq(&self.open, &earlier.open) && self.convention == earlier.convention
    }

    /// Tells of the losses on the way.
    fn answer(&self, work: &Work<'_, DatasetLosses>) -> Result<DatasetLosses, Error> {
        let (open, Given((in_sight, known))) = (&self.open, &self.given);
        let mut found =
            DatasetLosses::of_versions(&self.versions, known.as_deref().map(|known| &known.answer));
        work.tell(found.clone());
        let settings = settings(open, &self.convention);
        let evaluation = |results| Evaluation::new(&settings, &open.reading, results, work.progress());
        let opened = evaluation(open.results.as_deref());
        found.notes = opened.as_ref().err().map(ToString::to_string).into_iter().collect();
        let evaluation = opened.or_else(|_| evaluation(None))?;
        let missing: Vec<usize> = (0..open.cases.len()).filter(|case| found.all[*case].is_none()).collect();
        let mut left = Vec::new();
        for cases in missing.chunks(AT_A_TIME) {
            for case in cases {
                match evaluation.known(&open.cases[*case]) {
                    Some(result) => found.add(self.row(result)),
                    None => left.push(*case),
                }
            }
            work.tell(found.clone());
        }
        // Threads of its own: in those of the window, a flip would wait for the end of a loss.
        let pool = threads::background_pool().map_err(|error| Error::internal(error.to_string()))?;
        let found = Mutex::new(found);
        while !left.is_empty() {
            let next = next(&in_sight.get(), &mut left, pool.current_num_threads());
            let compute = |case: &usize| {
                let row = self.row(evaluation.material(&open.cases[*case])?);
                let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
                found.add(row);
                work.tell(found.clone());
                Ok::<(), Error>(())
            };
            pool.install(|| next.par_iter().try_for_each(compute))?;
        }
        let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        let (notes, unkept) = evaluation.end()?;
        found.notes.extend(notes.into_iter().chain(unkept));
        Ok(found)
    }
}

impl EvaluateDataset {
    fn row(&self, result: MaterialResult) -> Arc<(MaterialResult, CaseLosses)> {
        let methods = self.open.methods().iter();
        let by_method: Vec<_> = methods.map(|method| counted_loss(&result, method, PICK)).collect();
        let failed = |one: &PredictionResult| Some((one.method.clone(), one.error.clone()?));
        let problems = result.predictions.iter().filter_map(failed).collect();
        let mut losses = by_method.iter().flatten().map(|known| known.loss);
        let is_below_floor = losses.any(|loss| result.is_below_floor(Some(loss)));
        Arc::new((result, CaseLosses { by_method, problems, is_below_floor }))
    }
}

/// Takes the next materials out of those that are left, the `first` ones first: as many as are computed at a time.
fn next(first: &[usize], left: &mut Vec<usize>, count: usize) -> Vec<usize> {
    let mut next: Vec<usize> = first.iter().copied().filter(|case| left.contains(case)).collect();
    next.dedup();
    let others: Vec<usize> = left.iter().filter(|case| !next.contains(case)).copied().take(count).collect();
    next.extend(others);
    next.truncate(count);
    left.retain(|case| !next.contains(case));
    next
}
