//! The losses of the steps of training runs, each computed once on a worker.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver};

use eframe::egui;

use crate::error::Error;
use crate::files::stamp::Stamp;
use crate::files::steps::{RunId, TrainingRun, TrainingStep};
use crate::loss::{Comparison, Estimate};
use crate::progress::Progress;
use crate::viewer::loaded::{Loaded, Reader, Rules};
use crate::viewer::loss_run::Asked;
use crate::viewer::opening::read_patiently;
use crate::viewer::source::{Origin, Source};
use crate::viewer::worker::Task;

/// The loss of a step, or why there is none.
pub(crate) type StepLoss = Result<Estimate, String>;

/// What all losses depend on.
#[derive(Clone, Debug)]
pub(crate) struct RunLossesKey {
    /// The ground truth.
    pub id: u64,
    pub ground_truth: Arc<Loaded>,
    pub asked: Asked,
    pub rules: Rules,
}

/// A run whose losses are wanted.
#[derive(Debug)]
pub(crate) struct WantedRun<'a> {
    pub run: &'a TrainingRun,
    /// How its steps are read.
    pub source: Source,
}

/// The losses of all steps that have one, and the work on the others.
#[derive(Debug, Default)]
pub(crate) struct RunLosses {
    of: Option<RunLossesKey>,
    runs: HashMap<RunId, KnownLosses>,
    running: Option<(Task<()>, Receiver<Computed>)>,
}

/// A file that has changed is another step.
type StepKey = (PathBuf, Stamp);

/// The loss of a step of a run.
type Computed = (RunId, StepKey, StepLoss);

#[derive(Debug)]
struct KnownLosses {
    source: Source,
    losses: HashMap<StepKey, StepLoss>,
}

/// A step whose loss is to be computed.
#[derive(Debug)]
struct Job {
    run: RunId,
    source: Source,
    key: StepKey,
}

impl RunLosses {
    /// Takes over losses and, where `wanted`, computes the missing ones.
    pub(crate) fn follow(
        &mut self,
        ctx: &egui::Context,
        of: RunLossesKey,
        runs: &[WantedRun<'_>],
        wanted: bool,
    ) {
        let is_same = |now: &RunLossesKey| now.id == of.id && now.asked == of.asked && now.rules == of.rules;
        if !self.of.as_ref().is_some_and(is_same) {
            *self = Self { of: Some(of.clone()), ..Self::default() };
        }
        self.take(ctx);
        let is_wanted =
            |id: &RunId, source: &Source| runs.iter().any(|w| w.run.id == *id && w.source == *source);
        self.runs.retain(|id, known| is_wanted(id, &known.source));
        if !wanted {
            self.running = None;
        } else if self.running.is_none() {
            let jobs = self.missing(runs);
            if !jobs.is_empty() {
                self.running = Some(start(ctx, of, jobs));
            }
        }
    }

    /// The loss of a step, once it is known.
    pub(crate) fn get(&self, run: &RunId, step: &TrainingStep) -> Option<&StepLoss> {
        self.runs.get(run)?.losses.get(&(step.path.clone(), step.stamp))
    }

    /// The share of the missing losses that is done, while they are computed.
    pub(crate) fn busy(&self) -> Option<f32> {
        self.running.as_ref().map(|(task, _)| task.fraction())
    }

    fn take(&mut self, ctx: &egui::Context) {
        let Some((task, results)) = &self.running else { return };
        // What was sent before the end is there after it.
        let ended = task.poll(ctx).is_some();
        for (run, key, loss) in results.try_iter() {
            if let Some(known) = self.runs.get_mut(&run) {
                known.losses.insert(key, loss);
            }
        }
        if ended {
            self.running = None;
        }
    }

    /// The steps without a loss, of each run the newest first.
    fn missing(&mut self, runs: &[WantedRun<'_>]) -> Vec<Job> {
        let mut jobs = Vec::new();
        for WantedRun { run, source } in runs {
            let new = || KnownLosses { source: source.clone(), losses: HashMap::new() };
            let known = self.runs.entry(run.id.clone()).or_insert_with(new);
            for step in run.steps.iter().rev() {
                let key = (step.path.clone(), step.stamp);
                if !known.losses.contains_key(&key) {
                    let source = Source { origin: Origin::Path(step.path.clone()), ..source.clone() };
                    jobs.push(Job { run: run.id.clone(), source, key });
                }
            }
        }
        jobs
    }
}

fn start(ctx: &egui::Context, of: RunLossesKey, jobs: Vec<Job>) -> (Task<()>, Receiver<Computed>) {
    let (sender, results) = mpsc::channel();
    let seen = ctx.clone();
    let task = Task::start(ctx, move |progress| {
        progress.begin(jobs.len() as u64);
        for job in jobs {
            let loss = match loss(&of, &job.source, progress) {
                Err(Error::Cancelled) => return Err(Error::Cancelled),
                loss => loss.map_err(|problem| problem.to_string()),
            };
            if sender.send((job.run, job.key, loss)).is_err() {
                return Err(Error::Cancelled);
            }
            seen.request_repaint();
            progress.step()?;
        }
        Ok(())
    });
    (task, results)
}

fn loss(of: &RunLossesKey, source: &Source, progress: &Progress) -> Result<Estimate, Error> {
    let truth = &of.ground_truth.material;
    let mut reader =
        Reader { gpu: None, rules: of.rules, size: Some(truth.size()), patient: true, drafts: false };
    let prediction = read_patiently(source, &mut reader, &progress.part())?;
    let comparison = Comparison::new(truth, &[&prediction.material], of.asked.convention)?;
    let outcome = comparison.run(&of.asked.request, &progress.part())?;
    outcome.losses.first().map(|loss| loss.estimate).ok_or_else(|| Error::Internal("no loss".to_owned()))
}
