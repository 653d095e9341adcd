//! Phases of the loss, and the steps between them.

use std::time::Duration;

use svbrdf_core::loss::{Estimate, Request};
use svbrdf_evaluate::report::LossReport;

use crate::jobs::work::job::Job;
use crate::model::material::read::MaterialId;
use crate::model::settings::loss_query::LossQuery;

/// What a loss depends on: the ids of the materials, the ground truth first, and the request.
#[derive(Clone, Debug, PartialEq)]
pub struct LossKey {
    pub ids: Vec<MaterialId>,
    pub query: LossQuery,
}

/// Losses for a key, complete or so far.
#[derive(Debug)]
pub struct KeyedLosses {
    pub key: LossKey,
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
pub struct RunningLoss {
    pub key: LossKey,
    pub job: Job<(), KeyedLosses>,
}

/// Losses that no longer change.
#[derive(Debug)]
pub enum Settled {
    Nothing,
    Finished(KeyedLosses),
    /// Of a run that was cancelled or failed: the losses it had reached.
    Partial(KeyedLosses),
}

impl Settled {
    fn losses(&self) -> Option<&KeyedLosses> {
        match self {
            Self::Nothing => None,
            Self::Finished(losses) | Self::Partial(losses) => Some(losses),
        }
    }
}

/// The phase of the loss in the window.
#[derive(Debug)]
pub enum Phase {
    /// No run; the losses of the last one.
    Settled(Settled),
    /// A run without losses yet; the losses of an earlier one.
    Starting(RunningLoss, Settled),
    /// A run with losses so far.
    Refining(RunningLoss, KeyedLosses),
    /// No run: this key was cancelled, or failed for this reason. It is not computed again by itself.
    Stopped { key: LossKey, problem: Option<String>, settled: Settled },
}

/// What the phase and the wanted losses call for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    Keep,
    /// Cancel the run: the losses of an earlier one are the wanted ones.
    Drop,
    Start,
}

impl Phase {
    /// The next step towards the losses of `wanted`; `is_recent` tells whether a run has begun a moment ago. Such a run is left
    /// to give its first losses: otherwise there are none while a slider moves.
    pub fn step(&self, wanted: &LossKey, is_recent: bool) -> Step {
        let is_finished = |settled: &Settled| matches!(settled, Settled::Finished(l) if l.key == *wanted);
        match self {
            Self::Settled(settled) if is_finished(settled) => Step::Keep,
            Self::Settled(_) => Step::Start,
            Self::Starting(run, _) | Self::Refining(run, _) if run.key == *wanted => Step::Keep,
            Self::Starting(_, settled) if is_finished(settled) => Step::Drop,
            Self::Starting(..) if is_recent => Step::Keep,
            Self::Starting(..) | Self::Refining(..) => Step::Start,
            Self::Stopped { key, .. } if key == wanted => Step::Keep,
            Self::Stopped { settled, .. } if is_finished(settled) => Step::Drop,
            Self::Stopped { .. } => Step::Start,
        }
    }

    /// The run is dropped; its losses are kept.
    pub fn settled(self) -> Settled {
        match self {
            Self::Settled(settled) | Self::Starting(_, settled) | Self::Stopped { settled, .. } => settled,
            Self::Refining(_, losses) => Settled::Partial(losses),
        }
    }

    pub fn losses(&self) -> Option<&KeyedLosses> {
        match self {
            Self::Settled(settled) | Self::Starting(_, settled) | Self::Stopped { settled, .. } => {
                settled.losses()
            }
            Self::Refining(_, losses) => Some(losses),
        }
    }

    pub fn run(&self) -> Option<&RunningLoss> {
        match self {
            Self::Starting(run, _) | Self::Refining(run, _) => Some(run),
            Self::Settled(_) | Self::Stopped { .. } => None,
        }
    }
}

/// The phase after its run has stopped early.
pub fn stopped(phase: Phase, problem: Option<String>) -> Phase {
    match phase.run().map(|run| run.key.clone()) {
        Some(key) => Phase::Stopped { key, problem, settled: phase.settled() },
        None => phase,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::work::waker::Waker;
    use svbrdf_core::loss::{Comparison, Outcome, Sampling};
    use svbrdf_core::material::Material;
    use svbrdf_core::model::brdf::Texel;
    use svbrdf_core::model::convention::Convention;
    use svbrdf_core::progress::Progress;

    /// What is wanted with this seed.
    fn key(seed: u64) -> LossKey {
        let request = Request::Scenes(Sampling { near: 1, distant: 0, seed, ..Sampling::default() });
        LossKey { ids: Vec::new(), query: LossQuery { request, convention: Convention::default() } }
    }

    fn run(seed: u64) -> RunningLoss {
        let job = Job::stream(&Waker::default(), Progress::default(), |_| Ok(()));
        RunningLoss { key: key(seed), job }
    }

    fn losses(seed: u64) -> KeyedLosses {
        let normal = glam::Vec3::Z;
        let texel = Texel::<f32> { normal, diffuse: [0.5; 3], specular: [0.04; 3], roughness: 0.5 };
        let material = Material::uniform("gray", 1, 1, &texel).unwrap();
        let key = key(seed);
        let comparison = Comparison::new(&material, &[&material], key.query.convention).unwrap();
        let mut report = None;
        let update = |outcome: &Outcome| {
            report = Some(LossReport::new(&comparison, &key.query.request, outcome.clone()))
        };
        comparison.stream(&key.query.request, &svbrdf_core::progress::Progress::default(), update).unwrap();
        KeyedLosses { key, report: report.unwrap(), differences: Vec::new(), elapsed: Duration::ZERO }
    }

    /// Every phase for the losses of seed 1, and of an earlier seed where it has some.
    fn phases() -> [(&'static str, Phase); 8] {
        let stopped = |settled| Phase::Stopped { key: key(1), problem: None, settled };
        [
            ("nothing", Phase::Settled(Settled::Nothing)),
            ("finished", Phase::Settled(Settled::Finished(losses(1)))),
            ("partial", Phase::Settled(Settled::Partial(losses(1)))),
            ("starting", Phase::Starting(run(1), Settled::Nothing)),
            ("starting after 2", Phase::Starting(run(1), Settled::Finished(losses(2)))),
            ("refining", Phase::Refining(run(1), losses(1))),
            ("stopped", stopped(Settled::Partial(losses(1)))),
            ("stopped after 2", stopped(Settled::Finished(losses(2)))),
        ]
    }

    #[test]
    fn every_phase_takes_the_step_that_leads_to_the_wanted_losses() {
        use Step::{Drop, Keep, Start};
        // For the losses of seed 1, of seed 2 when the run is is_recent, and of seed 2 later.
        let expected = [
            ("nothing", [Start, Start, Start]),
            ("finished", [Keep, Start, Start]),
            ("partial", [Start, Start, Start]),
            ("starting", [Keep, Keep, Start]),
            ("starting after 2", [Keep, Drop, Drop]),
            ("refining", [Keep, Start, Start]),
            ("stopped", [Keep, Start, Start]),
            ("stopped after 2", [Keep, Drop, Drop]),
        ];
        for ((name, phase), (expected_name, steps)) in phases().into_iter().zip(expected) {
            assert_eq!(name, expected_name);
            let got = [phase.step(&key(1), true), phase.step(&key(2), true), phase.step(&key(2), false)];
            assert_eq!(got, steps, "{name}");
        }
    }

    #[test]
    fn a_run_that_stops_keeps_its_losses_or_the_earlier_ones() {
        let expected = [None, Some(1), Some(1), None, Some(2), Some(1), Some(1), Some(2)];
        for ((name, phase), seed) in phases().into_iter().zip(expected) {
            let was_running = phase.run().is_some();
            let stopped = stopped(phase, Some("why".to_owned()));
            assert_eq!(stopped.losses().map(|losses| losses.key.clone()), seed.map(key), "{name}");
            assert!(stopped.run().is_none(), "{name}");
            let has_problem = matches!(&stopped, Phase::Stopped { problem: Some(_), .. });
            assert_eq!(has_problem, was_running, "{name}");
        }
    }
}
