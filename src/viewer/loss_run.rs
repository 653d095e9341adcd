//! The loss in the window: computed on a worker, for the materials and parameters of now, and shown as it tightens.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use eframe::egui;

use super::loaded::Loaded;
use super::slots::Slots;
use super::worker::Task;
use crate::loss::{Comparison, Estimate, Loss, Outcome, Request};
use crate::material::Material;
use crate::model::convention::Convention;
use crate::report::Report;

/// What takes less is not announced: it would only flicker.
const SOON: Duration = Duration::from_millis(100);

/// What a loss depends on: the ids of the materials, the ground truth first, and what is asked for.
#[derive(Clone, Debug, PartialEq)]
struct Key {
    ids: Vec<u64>,
    asked: Asked,
}

/// What is asked for, by which convention.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    pub request: Request,
    pub convention: Convention,
}

/// What a run has reached so far.
#[derive(Debug)]
struct Update {
    report: Report,
    differences: Vec<Vec<Estimate>>,
    elapsed: Duration,
}

/// A loss that is being computed. The worker replaces `latest`; the window takes it.
#[derive(Debug)]
struct Running {
    key: Key,
    job: Task<()>,
    latest: Arc<Mutex<Option<Update>>>,
    /// Scenes of the latest update; 0 before the first.
    scenes: usize,
}

impl Running {
    /// Whether its first numbers may come in a moment. It is let to them, even if something else is asked for by now:
    /// else there would be none while a slider moves.
    fn is_young(&self) -> bool {
        self.scenes == 0 && self.job.elapsed() < SOON
    }
}

/// How the run ended whose result is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    NotYet,
    Finished,
    /// By a person, or by an error.
    Cancelled,
}

/// The losses that are shown.
#[derive(Debug)]
pub struct Shown {
    key: Key,
    pub report: Report,
    /// `differences[a][b]`: how much larger the loss of prediction b is than that of a, on the same scenes.
    pub differences: Vec<Vec<Estimate>>,
    /// How long the run took until it had them.
    pub elapsed: Duration,
    pub end: End,
}

impl Shown {
    /// What it was computed for.
    pub fn request(&self) -> &Request {
        &self.key.asked.request
    }

    /// The largest half of a 95% interval, as a share of its loss.
    pub fn relative_error(&self) -> f64 {
        self.report.outcome.relative_error95()
    }
}

/// The loss that is being computed and the one that is shown.
#[derive(Debug, Default)]
pub struct LossRun {
    running: Option<Running>,
    shown: Option<Shown>,
    /// What a person cancelled or what failed, and why it did: not tried again by itself.
    given_up: Option<(Key, Option<String>)>,
    /// Since when something else is asked for than what is shown.
    behind: Option<Instant>,
}

impl LossRun {
    /// The latest losses, and whether they are of what is asked for.
    pub fn shown(&self) -> Option<(&Shown, bool)> {
        self.shown.as_ref().map(|shown| (shown, self.behind.is_none()))
    }

    /// Whether what is shown has been out of date for longer than a person takes for at once.
    pub fn stale(&self) -> bool {
        self.behind.is_some_and(|since| self.running.is_none() || since.elapsed() > SOON)
    }

    /// The losses, if they are complete and hold for `asked` and `slots`.
    pub fn finished(&self, slots: &Slots, asked: &Asked) -> Option<&[Loss]> {
        let shown = self.shown.as_ref()?;
        let holds = shown.end == End::Finished && shown.key == key(slots, asked);
        holds.then_some(shown.report.outcome.losses.as_slice())
    }

    /// How far the running loss is: its share in [0, 1], its time, and whether anything was reached yet.
    /// `None` without one, and for the first moment of one.
    pub fn busy(&self) -> Option<(f32, Duration, bool)> {
        let running = self.running.as_ref()?;
        let elapsed = running.job.elapsed();
        let fraction = match &running.key.asked.request {
            Request::Time { budget, .. } if running.scenes > 0 => {
                elapsed.as_secs_f32() / budget.as_secs_f32()
            }
            Request::Scenes(s) if running.scenes > 0 => running.scenes as f32 / (s.near + s.distant) as f32,
            _ => running.job.fraction(),
        };
        (elapsed > SOON).then_some((fraction.min(1.0), elapsed, running.scenes > 0))
    }

    /// Why what is asked for could not be computed.
    pub fn problem(&self) -> Option<&str> {
        self.given_up.as_ref()?.1.as_deref()
    }

    /// Takes over what the worker has reached.
    pub fn poll(&mut self, ctx: &egui::Context) {
        let Some(running) = self.running.as_mut() else { return };
        // A worker that has ended has left its last update before.
        let ended = running.job.poll(ctx);
        if let Some(update) = running.latest.lock().unwrap_or_else(PoisonError::into_inner).take() {
            let Update { report, differences, elapsed } = update;
            running.scenes = report.outcome.scenes.len();
            self.behind = None;
            self.shown =
                Some(Shown { key: running.key.clone(), report, differences, elapsed, end: End::NotYet });
        }
        let Some(result) = ended else { return };
        // Something else may be asked for by now.
        ctx.request_repaint();
        let Some(running) = self.running.take() else { return };
        match result {
            Ok(()) => self.end_with(&running, End::Finished),
            Err(error) => {
                self.end_with(&running, End::Cancelled);
                self.given_up = Some((running.key, Some(error.to_string())));
            }
        }
    }

    /// Notices whether what is shown is what is asked for. With `auto` it computes what is asked for, unless that is done
    /// or was given up; a run for something else is given up for it.
    pub fn follow(&mut self, ctx: &egui::Context, slots: &Slots, asked: &Asked, auto: bool) {
        if slots.predictions().is_empty() {
            *self = Self::default();
            return;
        }
        let key = key(slots, asked);
        if self.shown.as_ref().is_none_or(|shown| shown.key == key) {
            self.behind = None;
        } else {
            self.behind.get_or_insert_with(Instant::now);
        }
        self.given_up.take_if(|(given_up, _)| *given_up != key);
        if !auto || self.given_up.is_some() {
            return;
        }
        let done = self.finished(slots, asked).is_some();
        match &self.running {
            Some(running) if running.key == key => {}
            _ if done => self.running = None,
            Some(running) if running.is_young() => {}
            _ => self.start(ctx, slots, asked),
        }
    }

    /// Starts the loss of the predictions in `slots`; a running one is given up for it.
    pub fn start(&mut self, ctx: &egui::Context, slots: &Slots, asked: &Asked) {
        self.running = None;
        self.given_up = None;
        if slots.predictions().is_empty() {
            return;
        }
        let key = key(slots, asked);
        let materials: Vec<Arc<Loaded>> = slots.slots.iter().map(|s| s.loaded.clone()).collect();
        let names: Vec<String> = slots.slots.iter().map(|s| s.name().to_owned()).collect();
        let Asked { request, convention } = asked.clone();
        let latest = Arc::new(Mutex::new(None));
        let (left, seen) = (latest.clone(), ctx.clone());
        let job = Task::start(ctx, move |progress| {
            let materials: Vec<&Material<f32>> = materials.iter().map(|l| &l.material).collect();
            let start = Instant::now();
            let comparison = Comparison::new(materials[0], &materials[1..], convention)?;
            let update = |outcome: &Outcome| {
                let elapsed = start.elapsed();
                let report = Report::new(&comparison, outcome.clone()).renamed(&names);
                let update = Update { differences: differences(&report), report, elapsed };
                *left.lock().unwrap_or_else(PoisonError::into_inner) = Some(update);
                seen.request_repaint();
            };
            comparison.stream(&request, progress, update).map(|_| ())
        });
        self.running = Some(Running { key, job, latest, scenes: 0 });
    }

    /// Stops the running loss and does not start it again by itself. What it has reached stays.
    pub fn cancel(&mut self) {
        if let Some(running) = self.running.take() {
            running.job.cancel();
            self.end_with(&running, End::Cancelled);
            self.given_up = Some((running.key, None));
        }
    }

    /// Says how `running` ended, if what is shown is its.
    fn end_with(&mut self, running: &Running, end: End) {
        if let Some(shown) = self.shown.as_mut().filter(|_| running.scenes > 0) {
            shown.end = end;
        }
    }
}

fn key(slots: &Slots, asked: &Asked) -> Key {
    Key { ids: slots.slots.iter().map(|s| s.id).collect(), asked: asked.clone() }
}

/// For each prediction how much larger the losses of all are.
fn differences(report: &Report) -> Vec<Vec<Estimate>> {
    let outcome = &report.outcome;
    let to = |other| outcome.losses.iter().map(|loss| outcome.difference(loss, other)).collect();
    outcome.losses.iter().map(to).collect()
}
