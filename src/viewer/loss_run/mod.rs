//! The loss in the window: computed on a worker for the current materials and settings, and refined while it is shown.

mod phase;

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use eframe::egui;

use super::loaded::Loaded;
use super::slots::Slots;
use super::worker::Task;
use crate::loss::{Comparison, Estimate, Outcome, Request};
use crate::material::Material;
use crate::report::Report;

pub(super) use phase::{Asked, Losses};
use phase::{LossKey, Phase, RunningLoss, Settled, Step, stopped};

/// Progress and staleness are shown after this time: what takes less would only flicker.
const SOON: Duration = Duration::from_millis(100);

/// The loss that is being computed and the one that is shown.
#[derive(Debug)]
pub(super) struct LossRun {
    phase: Phase,
    /// The losses that are wanted, and since when.
    wanted: Option<(LossKey, Instant)>,
}

impl Default for LossRun {
    fn default() -> Self {
        Self { phase: Phase::Settled(Settled::Nothing), wanted: None }
    }
}

impl LossRun {
    /// The latest losses.
    pub(super) fn losses(&self) -> Option<&Losses> {
        self.phase.losses()
    }

    /// Whether the latest losses are those of a run that ended early.
    pub(super) fn is_partial(&self) -> bool {
        matches!(
            &self.phase,
            Phase::Settled(Settled::Partial(_)) | Phase::Stopped { settled: Settled::Partial(_), .. }
        )
    }

    /// Whether the latest losses are complete.
    pub(super) fn is_complete(&self) -> bool {
        matches!(
            &self.phase,
            Phase::Settled(Settled::Finished(_))
                | Phase::Starting(_, Settled::Finished(_))
                | Phase::Stopped { settled: Settled::Finished(_), .. }
        )
    }

    /// Whether other losses than the latest are wanted, for longer than a moment where they are being computed.
    pub(super) fn stale(&self) -> bool {
        let (Some(losses), Some((wanted, since))) = (self.losses(), &self.wanted) else { return false };
        losses.key != *wanted && (self.phase.run().is_none() || since.elapsed() > SOON)
    }

    /// The losses, if they are complete and hold for `asked` and `slots`.
    #[cfg(feature = "testing")]
    pub(super) fn finished(&self, slots: &Slots, asked: &Asked) -> Option<&[crate::loss::Loss]> {
        let losses = self.losses().filter(|losses| self.is_complete() && losses.key == key(slots, asked))?;
        Some(losses.report.outcome.losses.as_slice())
    }

    /// Progress of the running loss: its share in [0, 1], its time, and whether it has losses yet. `None` without one, and
    /// for the first moment of one.
    pub(super) fn busy(&self) -> Option<(f32, Duration, bool)> {
        let run = self.phase.run()?;
        let elapsed = run.task.elapsed();
        let scenes = match &self.phase {
            Phase::Refining(_, losses) => losses.report.outcome.scenes.len(),
            _ => 0,
        };
        let fraction = match &run.key.asked.request {
            Request::Time { budget, .. } if scenes > 0 => elapsed.as_secs_f32() / budget.as_secs_f32(),
            Request::Scenes(s) if scenes > 0 => scenes as f32 / (s.near + s.distant) as f32,
            _ => run.task.fraction(),
        };
        (elapsed > SOON).then_some((fraction.min(1.0), elapsed, scenes > 0))
    }

    /// Whether losses are being computed.
    pub(super) fn is_running(&self) -> bool {
        self.phase.run().is_some()
    }

    /// Why the wanted losses could not be computed.
    pub(super) fn problem(&self) -> Option<&str> {
        match &self.phase {
            Phase::Stopped { problem, .. } => problem.as_deref(),
            _ => None,
        }
    }

    /// Takes over the results of the worker.
    pub(super) fn poll(&mut self, ctx: &egui::Context) {
        let Some(run) = self.phase.run() else { return };
        // A worker leaves its last losses before it ends.
        let ended = run.task.poll(ctx);
        let update = run.latest.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(losses) = update {
            self.change(|phase| match phase {
                Phase::Starting(run, _) | Phase::Refining(run, _) => Phase::Refining(run, losses),
                settled => settled,
            });
        }
        let Some(result) = ended else { return };
        // Other losses may be wanted by now.
        ctx.request_repaint();
        self.change(|phase| match (phase, result) {
            (Phase::Refining(_, losses), Ok(())) => Phase::Settled(Settled::Finished(losses)),
            (phase, Ok(())) => Phase::Settled(phase.settled()),
            (phase, Err(error)) => stopped(phase, Some(error.to_string())),
        });
    }

    /// Takes note of the losses that are wanted. With `auto` it computes them, unless that is done or was stopped; a run for
    /// others is cancelled.
    pub(super) fn follow(&mut self, ctx: &egui::Context, slots: &Slots, asked: &Asked, auto: bool) {
        if slots.predictions().is_empty() {
            *self = Self::default();
            return;
        }
        let key = key(slots, asked);
        if self.wanted.as_ref().is_none_or(|(wanted, _)| *wanted != key) {
            self.wanted = Some((key.clone(), Instant::now()));
        }
        if matches!(&self.phase, Phase::Stopped { key: stopped, .. } if *stopped != key) {
            self.change(|phase| Phase::Settled(phase.settled()));
        }
        if !auto {
            return;
        }
        let young = self.phase.run().is_some_and(|run| run.task.elapsed() < SOON);
        match self.phase.step(&key, young) {
            Step::Keep => {}
            Step::Drop => self.change(|phase| Phase::Settled(phase.settled())),
            Step::Start => self.start(ctx, slots, asked),
        }
    }

    /// Starts the loss of the predictions in `slots`; a running one is cancelled.
    pub(super) fn start(&mut self, ctx: &egui::Context, slots: &Slots, asked: &Asked) {
        let run = (!slots.predictions().is_empty()).then(|| start(ctx, slots, asked));
        self.change(|phase| match run {
            Some(run) => Phase::Starting(run, phase.settled()),
            None => Phase::Settled(phase.settled()),
        });
    }

    /// Cancels the running loss, which is not started again by itself. The losses it has reached stay.
    pub(super) fn cancel(&mut self) {
        if self.phase.run().is_some() {
            self.change(|phase| stopped(phase, None));
        }
    }

    fn change(&mut self, to: impl FnOnce(Phase) -> Phase) {
        let phase = std::mem::replace(&mut self.phase, Phase::Settled(Settled::Nothing));
        self.phase = to(phase);
    }
}

fn start(ctx: &egui::Context, slots: &Slots, asked: &Asked) -> RunningLoss {
    let key = key(slots, asked);
    let materials: Vec<Arc<Loaded>> = slots.slots.iter().map(|s| s.loaded.clone()).collect();
    let names: Vec<String> = slots.slots.iter().map(|s| s.name().to_owned()).collect();
    let Asked { request, convention } = asked.clone();
    let latest = Arc::new(Mutex::new(None));
    let (left, seen, of) = (latest.clone(), ctx.clone(), key.clone());
    let task = Task::start(ctx, move |progress| {
        let materials: Vec<&Material<f32>> = materials.iter().map(|l| &l.material).collect();
        let start = Instant::now();
        let comparison = Comparison::new(materials[0], &materials[1..], convention)?;
        let update = |outcome: &Outcome| {
            let elapsed = start.elapsed();
            let report = Report::new(&comparison, outcome.clone()).renamed(&names);
            let losses = Losses { key: of.clone(), differences: differences(&report), report, elapsed };
            *left.lock().unwrap_or_else(PoisonError::into_inner) = Some(losses);
            seen.request_repaint();
        };
        comparison.stream(&request, progress, update).map(|_| ())
    });
    RunningLoss { key, task, latest }
}

fn key(slots: &Slots, asked: &Asked) -> LossKey {
    LossKey { ids: slots.slots.iter().map(|s| s.id).collect(), asked: asked.clone() }
}

/// For each prediction the differences of all losses from its own.
fn differences(report: &Report) -> Vec<Vec<Estimate>> {
    let outcome = &report.outcome;
    let predictions = 0..outcome.losses.len();
    let from = |other| predictions.clone().map(|index| outcome.difference(index, other)).collect();
    predictions.clone().map(from).collect()
}
