//! Losses of the steps of training runs, each computed once.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use svbrdf_core::loss::{Comparison, Estimate};
use svbrdf_core::progress::Progress;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::steps::{RunId, TrainingRun, TrainingStep};

use crate::error::Error;
use crate::jobs::reading::read::{MaterialReader, read_with_retries};
use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;
use crate::model::material::read::{MaterialId, ReadMaterial, Rules};
use crate::model::settings::loss_query::LossQuery;
use svbrdf_files::source::{MaterialSource, Place};

/// The loss of a step, or why there is none.
pub type StepLoss = Result<Estimate, String>;

/// What all losses depend on.
#[derive(Clone, Debug)]
pub struct RunLossesKey {
    /// The ground truth.
    pub id: MaterialId,
    pub ground_truth: Arc<ReadMaterial>,
    pub query: LossQuery,
    pub rules: Rules,
}

/// A run whose losses are wanted.
#[derive(Debug)]
pub struct WantedRun<'a> {
    pub run: &'a TrainingRun,
    /// How its steps are read.
    pub source: MaterialSource,
}

/// The losses of all steps that have one, and the work on the others.
#[derive(Debug, Default)]
pub struct RunLosses {
    of: Option<RunLossesKey>,
    runs: HashMap<RunId, KnownLosses>,
    running: Option<Job<(), Computed>>,
}

/// A file that has changed is another step.
type StepKey = (PathBuf, Stamp);

/// The loss of a step of a run.
type Computed = (RunId, StepKey, StepLoss);

#[derive(Debug)]
struct KnownLosses {
    source: MaterialSource,
    losses: HashMap<StepKey, StepLoss>,
}

/// A step whose loss is to be computed.
#[derive(Debug)]
struct StepTask {
    run: RunId,
    source: MaterialSource,
    key: StepKey,
}

impl RunLosses {
    /// Takes over losses and, where `wanted`, computes the missing ones.
    pub fn follow(&mut self, waker: &Waker, of: RunLossesKey, runs: &[WantedRun<'_>], wanted: bool) {
        let is_same = |now: &RunLossesKey| now.id == of.id && now.query == of.query && now.rules == of.rules;
        if !self.of.as_ref().is_some_and(is_same) {
            *self = Self { of: Some(of.clone()), ..Self::default() };
        }
        self.take();
        let is_wanted =
            |id: &RunId, source: &MaterialSource| runs.iter().any(|w| w.run.id == *id && w.source == *source);
        self.runs.retain(|id, known| is_wanted(id, &known.source));
        if !wanted {
            self.running = None;
        } else if self.running.is_none() {
            let tasks = self.missing(runs);
            if !tasks.is_empty() {
                self.running = Some(start(waker, of, tasks));
            }
        }
    }

    /// The loss of a step, once it is known.
    pub fn get(&self, run: &RunId, step: &TrainingStep) -> Option<&StepLoss> {
        self.runs.get(run)?.losses.get(&(step.path.clone(), step.stamp))
    }

    /// The share of the missing losses that is done, while they are computed.
    pub fn busy(&self) -> Option<f32> {
        self.running.as_ref().map(Job::fraction)
    }

    fn take(&mut self) {
        let Some(job) = &self.running else { return };
        let ended = job.poll().is_some();
        for (run, key, loss) in job.updates() {
            if let Some(known) = self.runs.get_mut(&run) {
                known.losses.insert(key, loss);
            }
        }
        if ended {
            self.running = None;
        }
    }

    /// The steps without a loss, of each run the newest first.
    fn missing(&mut self, runs: &[WantedRun<'_>]) -> Vec<StepTask> {
        let mut tasks = Vec::new();
        for WantedRun { run, source } in runs {
            let new = || KnownLosses { source: source.clone(), losses: HashMap::new() };
            let known = self.runs.entry(run.id.clone()).or_insert_with(new);
            for step in run.steps.iter().rev() {
                let key = (step.path.clone(), step.stamp);
                if !known.losses.contains_key(&key) {
                    let source = MaterialSource { place: Place::Path(step.path.clone()), ..source.clone() };
                    tasks.push(StepTask { run: run.id.clone(), source, key });
                }
            }
        }
        tasks
    }
}

fn start(waker: &Waker, of: RunLossesKey, tasks: Vec<StepTask>) -> Job<(), Computed> {
    Job::stream(waker, Progress::default(), move |worker| {
        worker.progress.begin(tasks.len() as u64);
        for task in tasks {
            let loss = match loss(&of, &task.source, &worker.progress) {
                Err(error) if error.is_cancelled() => return Err(error),
                loss => loss.map_err(|problem| problem.to_string()),
            };
            worker.report((task.run, task.key, loss))?;
            worker.progress.step()?;
        }
        Ok(())
    })
}

fn loss(of: &RunLossesKey, source: &MaterialSource, progress: &Progress) -> Result<Estimate, Error> {
    let truth = of.ground_truth.material();
    let mut reader = MaterialReader { rules: of.rules, size: Some(truth.size()), retries: true };
    let prediction = read_with_retries(source, &mut reader, &progress.part())?;
    let comparison = Comparison::new(truth, &[prediction.material()], of.query.convention)?;
    let outcome = comparison.run(&of.query.request, &progress.part())?;
    outcome.losses.first().map(|loss| loss.estimate).ok_or_else(|| Error::internal("no loss"))
}
