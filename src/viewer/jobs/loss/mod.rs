//! Loss of the predictions: computed for the current materials and settings, and refined until it answers the question.

pub mod phase;
pub mod scene;

use std::time::{Duration, Instant};

use svbrdf_core::loss::{Comparison, Estimate, Outcome, Request};
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::LossReport;

use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;
use crate::model::material::list::MaterialList;
use crate::model::material::loaded::{LoadedMaterial, ids};
use crate::model::settings::loss_query::LossQuery;

pub use phase::KeyedLosses;
use phase::{LossKey, Phase, RunningLoss, Settled, Step, stopped};

/// Progress and staleness are shown after this time: what takes less would only flicker.
const SOON: Duration = Duration::from_millis(100);

/// The loss that is being computed, and the latest one.
#[derive(Debug)]
pub struct LossJob {
    phase: Phase,
    /// The losses that are wanted, and since when.
    wanted: Option<(LossKey, Instant)>,
}

impl Default for LossJob {
    fn default() -> Self {
        Self { phase: Phase::Settled(Settled::Nothing), wanted: None }
    }
}

impl LossJob {
    /// The latest losses.
    pub fn losses(&self) -> Option<&KeyedLosses> {
        self.phase.losses()
    }

    /// Whether the latest losses are those of a run that ended early.
    pub fn is_partial(&self) -> bool {
        matches!(
            &self.phase,
            Phase::Settled(Settled::Partial(_)) | Phase::Stopped { settled: Settled::Partial(_), .. }
        )
    }

    /// Whether the latest losses are complete.
    pub fn is_complete(&self) -> bool {
        matches!(
            &self.phase,
            Phase::Settled(Settled::Finished(_))
                | Phase::Starting(_, Settled::Finished(_))
                | Phase::Stopped { settled: Settled::Finished(_), .. }
        )
    }

    /// Whether other losses than the latest are wanted, for longer than a moment where they are being computed.
    pub fn stale(&self) -> bool {
        let (Some(losses), Some((wanted, since))) = (self.losses(), &self.wanted) else { return false };
        losses.key != *wanted && (self.phase.run().is_none() || since.elapsed() > SOON)
    }

    /// The losses, if they are complete and hold for `query` and `materials`.
    pub fn finished(
        &self,
        materials: &MaterialList,
        query: &LossQuery,
    ) -> Option<&[svbrdf_core::loss::Loss]> {
        let losses =
            self.losses().filter(|losses| self.is_complete() && losses.key == key(materials, query))?;
        Some(losses.report.outcome.losses.as_slice())
    }

    /// Progress of the running loss: its share in [0, 1], its time, and whether it has losses yet. `None` without one, and
    /// for the first moment of one.
    pub fn busy(&self) -> Option<(f32, Duration, bool)> {
        let run = self.phase.run()?;
        let elapsed = run.job.elapsed();
        let scenes = match &self.phase {
            Phase::Refining(_, losses) => losses.report.outcome.scenes.len(),
            _ => 0,
        };
        let fraction = match &run.key.query.request {
            Request::Time { budget, .. } if scenes > 0 => elapsed.as_secs_f32() / budget.as_secs_f32(),
            Request::Scenes(s) if scenes > 0 => scenes as f32 / (s.near + s.distant) as f32,
            _ => run.job.fraction(),
        };
        (elapsed > SOON).then_some((fraction.min(1.0), elapsed, scenes > 0))
    }

    /// Whether losses are being computed.
    pub fn is_running(&self) -> bool {
        self.phase.run().is_some()
    }

    /// Why the wanted losses could not be computed.
    pub fn problem(&self) -> Option<&str> {
        match &self.phase {
            Phase::Stopped { problem, .. } => problem.as_deref(),
            _ => None,
        }
    }

    /// Takes over the results of the worker.
    pub fn poll(&mut self, waker: &Waker) {
        let Some(run) = self.phase.run() else { return };
        // A worker leaves its last losses before it ends.
        let ended = run.job.poll();
        let update = run.job.updates().pop();
        if let Some(losses) = update {
            self.change(|phase| match phase {
                Phase::Starting(run, _) | Phase::Refining(run, _) => Phase::Refining(run, losses),
                settled => settled,
            });
        }
        let Some(result) = ended else { return };
        // Other losses may be wanted by now.
        waker.wake();
        self.change(|phase| match (phase, result) {
            (Phase::Refining(_, losses), Ok(())) => Phase::Settled(Settled::Finished(losses)),
            (phase, Ok(())) => Phase::Settled(phase.settled()),
            (phase, Err(error)) => stopped(phase, Some(error.to_string())),
        });
    }

    /// Takes note of the losses that are wanted. With `auto` it computes them, unless that is done or was stopped; a run for
    /// others is cancelled.
    pub fn follow(&mut self, waker: &Waker, materials: &MaterialList, query: &LossQuery, auto: bool) {
        if materials.predictions().is_empty() {
            *self = Self::default();
            return;
        }
        let key = key(materials, query);
        if self.wanted.as_ref().is_none_or(|(wanted, _)| *wanted != key) {
            self.wanted = Some((key.clone(), Instant::now()));
        }
        if matches!(&self.phase, Phase::Stopped { key: stopped, .. } if *stopped != key) {
            self.change(|phase| Phase::Settled(phase.settled()));
        }
        if !auto {
            return;
        }
        let is_recent = self.phase.run().is_some_and(|run| run.job.elapsed() < SOON);
        match self.phase.step(&key, is_recent) {
            Step::Keep => {}
            Step::Drop => self.change(|phase| Phase::Settled(phase.settled())),
            Step::Start => self.start(waker, materials, query),
        }
    }

    /// Starts the loss of the predictions in `materials`; a running one is cancelled.
    pub fn start(&mut self, waker: &Waker, materials: &MaterialList, query: &LossQuery) {
        let run = (!materials.predictions().is_empty()).then(|| start(waker, materials, query));
        self.change(|phase| match run {
            Some(run) => Phase::Starting(run, phase.settled()),
            None => Phase::Settled(phase.settled()),
        });
    }

    /// Cancels the running loss, which is not started again by itself. The losses it has reached stay.
    pub fn cancel(&mut self) {
        if self.phase.run().is_some() {
            self.change(|phase| stopped(phase, None));
        }
    }

    fn change(&mut self, to: impl FnOnce(Phase) -> Phase) {
        let phase = std::mem::replace(&mut self.phase, Phase::Settled(Settled::Nothing));
        self.phase = to(phase);
    }
}

fn start(waker: &Waker, materials: &MaterialList, query: &LossQuery) -> RunningLoss {
    let key = key(materials, query);
    let named = |s: &LoadedMaterial| s.material().clone().renamed(s.name());
    let materials: Vec<Material<f32>> = materials.all.iter().map(named).collect();
    let LossQuery { request, convention } = query.clone();
    let of = key.clone();
    let job = Job::stream(waker, Progress::default(), move |worker| {
        let materials: Vec<&Material<f32>> = materials.iter().collect();
        let start = Instant::now();
        let comparison = Comparison::new(materials[0], &materials[1..], convention)?;
        let update = |outcome: &Outcome| {
            let elapsed = start.elapsed();
            let report = LossReport::new(&comparison, &request, outcome.clone());
            let losses = KeyedLosses { key: of.clone(), differences: differences(&report), report, elapsed };
            // Where the window has dropped this job, its progress ends the work.
            let _ = worker.replace(losses);
        };
        comparison.stream(&request, &worker.progress, update)?;
        Ok(())
    });
    RunningLoss { key, job }
}

fn key(materials: &MaterialList, query: &LossQuery) -> LossKey {
    LossKey { ids: ids(&materials.all), query: query.clone() }
}

/// For each prediction the differences of all losses from its own.
fn differences(report: &LossReport) -> Vec<Vec<Estimate>> {
    let outcome = &report.outcome;
    let predictions = 0..outcome.losses.len();
    let from = |other| predictions.clone().map(|index| outcome.difference(index, other)).collect();
    predictions.clone().map(from).collect()
}
