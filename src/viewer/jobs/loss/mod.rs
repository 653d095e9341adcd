//! Loss of the predictions: computed for the current materials and settings, and refined until it answers the question.

pub mod scene;

use std::time::{Duration, Instant};

use svbrdf_core::loss::{Comparison, Estimate, Loss, Outcome, Request};
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::LossReport;

use crate::jobs::work::job::Job;
use crate::jobs::work::waker::Waker;
use crate::model::material::list::MaterialList;
use crate::model::material::loaded::{LoadedMaterial, ids};
use crate::model::material::read::MaterialId;
use crate::model::settings::LossQuery;

/// Progress and staleness are shown after this time: what takes less would only flicker.
const SOON: Duration = Duration::from_millis(100);

/// What a loss depends on: the ids of the materials, the ground truth first, and the request.
#[derive(Clone, Debug, PartialEq)]
struct LossKey {
    ids: Vec<MaterialId>,
    query: LossQuery,
}

/// Losses for a key, complete or so far.
#[derive(Debug)]
pub struct KeyedLosses {
    key: LossKey,
    pub report: LossReport,
    /// `differences[a][b]`: the loss of prediction b minus that of a, on the same scenes.
    pub differences: Vec<Vec<Estimate>>,
    /// The time it took to compute them.
    pub elapsed: Duration,
}

impl KeyedLosses {
    /// The request they answer.
    pub fn request(&self) -> &Request {
        &self.key.query.request
    }

    /// The largest half of a 95% interval, relative to its loss.
    pub fn relative_error(&self) -> f64 {
        self.report.outcome.relative_error95()
    }
}

/// A loss that is being computed. Each of its updates stands for those before it.
#[derive(Debug)]
struct RunningLoss {
    key: LossKey,
    job: Job<(), KeyedLosses>,
    /// Whether the latest losses are of this run.
    has_losses: bool,
}

/// The loss that is being computed, and the latest one.
#[derive(Debug, Default)]
pub struct LossJob {
    running: Option<RunningLoss>,
    latest: Option<KeyedLosses>,
    /// Whether the latest losses are all that was asked for.
    is_complete: bool,
    /// What was cancelled, or failed for this reason. It is not computed again by itself.
    stopped: Option<(LossKey, Option<String>)>,
    /// The losses that are wanted, and since when.
    wanted: Option<(LossKey, Instant)>,
}

/// What is to be done towards the wanted losses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    Keep,
    /// Cancel the run: the losses of an earlier one are the wanted ones.
    Drop,
    Start,
}

impl LossJob {
    /// The latest losses.
    pub fn losses(&self) -> Option<&KeyedLosses> {
        self.latest.as_ref()
    }

    /// Whether the latest losses are those of a run that ended early.
    pub fn is_partial(&self) -> bool {
        self.running.is_none() && self.latest.is_some() && !self.is_complete
    }

    /// Whether the latest losses are complete.
    pub fn is_complete(&self) -> bool {
        self.is_complete
    }

    /// Whether other losses than the latest are wanted, for longer than a moment where they are being computed.
    pub fn stale(&self) -> bool {
        let (Some(losses), Some((wanted, since))) = (self.losses(), &self.wanted) else { return false };
        losses.key != *wanted && (self.running.is_none() || since.elapsed() > SOON)
    }

    /// The losses, if they are complete and hold for `query` and `materials`.
    pub fn finished(&self, materials: &MaterialList, query: &LossQuery) -> Option<&[Loss]> {
        let losses = self.losses().filter(|_| self.has_finished(&key(materials, query)))?;
        Some(losses.report.outcome.losses.as_slice())
    }

    fn has_finished(&self, key: &LossKey) -> bool {
        self.is_complete && self.latest.as_ref().is_some_and(|losses| losses.key == *key)
    }

    /// Progress of the running loss: its share in [0, 1], its time, and whether it has losses yet. `None` without one, and
    /// for the first moment of one.
    pub fn busy(&self) -> Option<(f32, Duration, bool)> {
        let run = self.running.as_ref()?;
        let elapsed = run.job.elapsed();
        let of_run = self.latest.as_ref().filter(|_| run.has_losses);
        let scenes = of_run.map_or(0, |losses| losses.report.outcome.scenes.len());
        let fraction = match &run.key.query.request {
            Request::Time { budget, .. } if scenes > 0 => elapsed.as_secs_f32() / budget.as_secs_f32(),
            Request::Scenes(s) if scenes > 0 => scenes as f32 / (s.near + s.distant) as f32,
            _ => run.job.fraction(),
        };
        (elapsed > SOON).then_some((fraction.min(1.0), elapsed, scenes > 0))
    }

    /// Whether losses are being computed.
    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Why the wanted losses could not be computed.
    pub fn problem(&self) -> Option<&str> {
        self.stopped.as_ref().and_then(|(_, problem)| problem.as_deref())
    }

    /// Takes over the results of the worker.
    pub fn poll(&mut self, waker: &Waker) {
        let Some(run) = &mut self.running else { return };
        // A worker leaves its last losses before it ends.
        let ended = run.job.poll();
        if let Some(losses) = run.job.updates().pop() {
            run.has_losses = true;
            (self.latest, self.is_complete) = (Some(losses), false);
        }
        let Some(result) = ended else { return };
        // Other losses may be wanted by now.
        waker.wake();
        match result {
            Ok(()) => self.is_complete |= run.has_losses,
            Err(error) => self.stopped = Some((run.key.clone(), Some(error.to_string()))),
        }
        self.running = None;
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
        self.stopped.take_if(|(stopped, _)| *stopped != key);
        let is_recent = self.running.as_ref().is_some_and(|run| run.job.elapsed() < SOON);
        match self.step(&key, is_recent) {
            _ if !auto => {}
            Step::Keep => {}
            Step::Drop => self.running = None,
            Step::Start => self.start(waker, materials, query),
        }
    }

    /// The next step towards the losses of `wanted`; `is_recent` tells whether a run has begun a moment ago. Such a run is left
    /// to give its first losses: otherwise there are none while a slider moves.
    fn step(&self, wanted: &LossKey, is_recent: bool) -> Step {
        match &self.running {
            Some(run) if run.key == *wanted => Step::Keep,
            Some(run) if !run.has_losses && self.has_finished(wanted) => Step::Drop,
            Some(run) if !run.has_losses && is_recent => Step::Keep,
            None if self.stopped.is_some() || self.has_finished(wanted) => Step::Keep,
            _ => Step::Start,
        }
    }

    /// Starts the loss of the predictions in `materials`; a running one is cancelled.
    pub fn start(&mut self, waker: &Waker, materials: &MaterialList, query: &LossQuery) {
        self.stopped = None;
        self.running = (!materials.predictions().is_empty()).then(|| start(waker, materials, query));
    }

    /// Cancels the running loss, which is not started again by itself. The losses it has reached stay.
    pub fn cancel(&mut self) {
        if let Some(run) = self.running.take() {
            self.stopped = Some((run.key.clone(), None));
        }
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
    RunningLoss { key, job, has_losses: false }
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

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use svbrdf_core::loss::Sampling;
    use svbrdf_core::model::brdf::Texel;
    use svbrdf_core::model::convention::Convention;

    /// What is wanted with this seed.
    fn key(seed: u64) -> LossKey {
        let request = Request::Scenes(Sampling { near: 1, distant: 0, seed, ..Sampling::default() });
        LossKey { ids: Vec::new(), query: LossQuery { request, convention: Convention::default() } }
    }

    fn losses(seed: u64) -> KeyedLosses {
        let texel = Texel::<f32> { normal: Vec3::Z, diffuse: [0.5; 3], specular: [0.04; 3], roughness: 0.5 };
        let material = Material::uniform("gray", 1, 1, &texel).unwrap();
        let LossQuery { request, convention } = key(seed).query;
        let comparison = Comparison::new(&material, &[&material], convention).unwrap();
        let outcome = comparison.run(&request, &Progress::default()).unwrap();
        let report = LossReport::new(&comparison, &request, outcome);
        KeyedLosses { key: key(seed), report, differences: Vec::new(), elapsed: Duration::ZERO }
    }

    /// A job with losses of a seed, which are complete or not, and a run of seed 1, which has losses or not.
    fn job(latest: Option<(u64, bool)>, run: Option<bool>) -> LossJob {
        let job = || Job::stream(&Waker::default(), Progress::default(), |_| Ok(()));
        let running = run.map(|has_losses| RunningLoss { key: key(1), job: job(), has_losses });
        let (latest, is_complete) = latest.map(|(seed, complete)| (losses(seed), complete)).unzip();
        LossJob { running, latest, is_complete: is_complete.unwrap_or(false), ..LossJob::default() }
    }

    #[test]
    fn every_state_takes_the_step_that_leads_to_the_wanted_losses() {
        use Step::{Drop, Keep, Start};
        // For the losses of seed 1, of seed 2 where the run has just begun, and of seed 2 later.
        for (name, latest, run, expected) in [
            ("nothing", None, None, [Start, Start, Start]),
            ("finished", Some((1, true)), None, [Keep, Start, Start]),
            ("ended early", Some((1, false)), None, [Start, Start, Start]),
            ("starting", None, Some(false), [Keep, Keep, Start]),
            ("starting after 2", Some((2, true)), Some(false), [Keep, Drop, Drop]),
            ("refining", Some((1, false)), Some(true), [Keep, Start, Start]),
        ] {
            let mut job = job(latest, run);
            let steps = [job.step(&key(1), true), job.step(&key(2), true), job.step(&key(2), false)];
            assert_eq!(steps, expected, "{name}");
            // Cancelled, it keeps its losses and is not started again.
            let was_running = job.is_running();
            job.cancel();
            assert_eq!(
                job.losses().map(|losses| losses.key.clone()),
                latest.map(|(seed, _)| key(seed)),
                "{name}"
            );
            assert!(!job.is_running() && (!was_running || job.step(&key(1), false) == Keep), "{name}");
        }
    }
}
