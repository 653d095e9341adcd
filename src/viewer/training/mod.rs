//! The training runs in the window: each is one prediction, in the step that is shown.
//!
//! While files are watched, the window shows the newest step of a run unless the person has gone back, and opens runs that come into
//! being in a folder of runs.

mod losses;
mod scan;

use std::collections::HashSet;

use super::slot::Slot;
use crate::files::steps::{RunId, TrainingRun};

pub(super) use losses::{RunLosses, RunLossesKey, StepLoss, WantedRun};
pub(super) use scan::{RunNews, RunScan};

/// What is known of the training runs in the window.
#[derive(Debug, Default)]
pub(super) struct Training {
    pub scan: RunScan,
    pub losses: RunLosses,
    /// Runs that stay at an earlier step, when newer ones come.
    pub held: HashSet<RunId>,
    /// Runs that do not open by themselves: they were there from the start, or have been opened.
    pub passed: HashSet<RunId>,
    /// The step that is being read, of a run.
    pub wanted: Option<(RunId, u64)>,
}

/// A training run as the panel shows it.
#[derive(Debug)]
pub(super) struct RunView<'a> {
    /// The place of the prediction among the materials.
    pub slot: usize,
    pub run: &'a TrainingRun,
    /// The number of the step that is shown, or on its way.
    pub shown: u64,
    /// Whether it is on its way.
    pub is_reading: bool,
    /// Of each step, as far as it is known.
    pub losses: Vec<Option<&'a StepLoss>>,
}

impl RunView<'_> {
    /// The index of the step that is shown, or the one before it where that is gone.
    pub(super) fn index(&self) -> usize {
        self.run.steps.partition_point(|step| step.number <= self.shown).saturating_sub(1)
    }
}

impl Training {
    /// The runs in the window, in the order of the predictions.
    pub(super) fn views<'a>(&'a self, slots: &'a [Slot]) -> Vec<RunView<'a>> {
        let view = |(slot, of): (usize, &'a Slot)| {
            let (id, number) = of.loaded.step()?;
            let run = self.run(id)?;
            let wanted = self.wanted.as_ref().filter(|(wanted, _)| wanted == id);
            let losses = run.steps.iter().map(|step| self.losses.get(id, step)).collect();
            let is_reading = wanted.is_some_and(|(_, wanted)| *wanted != number);
            let shown = wanted.map_or(number, |(_, number)| *number);
            Some(RunView { slot, run, shown, is_reading, losses })
        };
        slots.iter().enumerate().skip(1).filter_map(view).collect()
    }

    /// The run, once its folder has been looked at.
    pub(super) fn run(&self, id: &RunId) -> Option<&TrainingRun> {
        self.scan.runs(&id.folder).iter().find(|run| run.id == *id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::stamp::Stamp;
    use crate::files::steps::{Counter, TrainingStep};

    #[test]
    fn the_step_before_one_that_is_gone_is_shown() {
        let id = RunId { folder: "x".into(), name: "a".to_owned(), counter: Counter::Step };
        let step = |number| TrainingStep { number, path: "a".into(), stamp: Stamp::default() };
        let run = TrainingRun { id, steps: [100, 200, 300].map(step).into() };
        let index =
            |shown| RunView { slot: 1, run: &run, shown, is_reading: false, losses: Vec::new() }.index();
        assert_eq!([100, 200, 300].map(index), [0, 1, 2]);
        assert_eq!([50, 250, 999].map(index), [0, 1, 2]);
    }
}
