//! Training runs of the window: which follow their newest step, and which step is being read.

use std::collections::HashSet;

use svbrdf_files::steps::RunId;

/// What the model holds about training runs; their steps on disk are the job's.
#[derive(Debug, Default)]
pub struct TrainingState {
    /// Runs that stay at an earlier step when newer ones come.
    pub pinned: HashSet<RunId>,
    /// Runs that do not open by themselves: they were there from the start, or have been opened.
    pub known: HashSet<RunId>,
    /// The step of a run that is being read.
    pub requested: Option<(RunId, u64)>,
}
