//! Training runs: each is one prediction, in one of its steps.

pub mod losses;
pub mod scan;

use svbrdf_files::steps::{RunId, TrainingRun};

use crate::model::material::loaded::LoadedMaterial;

pub use losses::{RunLosses, RunLossesKey, StepLoss, WantedRun};
pub use scan::{RunNews, RunScan};

/// What is known of the training runs in the window.
#[derive(Debug, Default)]
pub struct TrainingJobs {
    pub scan: RunScan,
    pub losses: RunLosses,
}

/// A training run as the panel shows it.
#[derive(Debug)]
pub struct RunView<'a> {
    /// The index of the prediction among the materials.
    pub index: usize,
    pub run: &'a TrainingRun,
    /// The number of the step in the window, or on its way.
    pub number: u64,
    /// Whether it is on its way.
    pub is_reading: bool,
    /// Of each step, as far as it is known.
    pub losses: Vec<Option<&'a StepLoss>>,
}

impl RunView<'_> {
    /// The index of the step in the window, or the one before it where that is gone.
    pub fn step_index(&self) -> usize {
        self.run.steps.partition_point(|step| step.number <= self.number).saturating_sub(1)
    }
}

impl TrainingJobs {
    /// The runs in the window, in the order of the predictions.
    pub fn views<'a>(
        &'a self,
        materials: &'a [LoadedMaterial],
        requested: Option<&(RunId, u64)>,
    ) -> Vec<RunView<'a>> {
        let view = |(index, of): (usize, &'a LoadedMaterial)| {
            let (id, number) = of.read.step()?;
            let run = self.run(id)?;
            let requested = requested.filter(|(run, _)| run == id);
            let losses = run.steps.iter().map(|step| self.losses.get(id, step)).collect();
            let is_reading = requested.is_some_and(|(_, requested)| *requested != number);
            let number = requested.map_or(number, |(_, number)| *number);
            Some(RunView { index, run, number, is_reading, losses })
        };
        materials.iter().enumerate().skip(1).filter_map(view).collect()
    }

    /// The run, once its folder has been looked at.
    pub fn run(&self, id: &RunId) -> Option<&TrainingRun> {
        self.scan.runs(&id.folder).iter().find(|run| run.id == *id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_files::disk::stamp::Stamp;
    use svbrdf_files::steps::{Counter, TrainingStep};

    #[test]
    fn a_step_that_is_gone_is_counted_as_the_one_before_it() {
        let id = RunId { folder: "x".into(), name: "a".to_owned(), counter: Counter::Step };
        let step = |number| TrainingStep { number, path: "a".into(), stamp: Stamp::default() };
        let run = TrainingRun { id, steps: [100, 200, 300].map(step).into() };
        let index = |number| {
            RunView { index: 1, run: &run, number, is_reading: false, losses: Vec::new() }.step_index()
        };
        assert_eq!([100, 200, 300].map(index), [0, 1, 2]);
        assert_eq!([50, 250, 999].map(index), [0, 1, 2]);
    }
}
