//! Many materials: the losses of several methods over a data set, with intervals over materials.
//!
//! A data set is a list of [`Case`]s, one for each material: [`cases_of_folders`] matches folders by name, [`cases_of_table`] reads a table of
//! pairs. [`run`] gives a [`MaterialResult`] for each and keeps the losses in a results folder, so that no run computes them again; a
//! [`DatasetReport`] compares the methods by them.

mod bootstrap;
mod doubts;
mod evaluate;
mod latex;
mod list;
mod mark_summary;
mod metric_summary;
mod names;
mod opened;
mod pick;
mod ranking;
mod reading;
mod record;
mod remark;
mod repetition;
mod report;
mod robust;
mod scenes;
mod summary;
mod verify;
mod witness;

pub use bootstrap::{FEWEST, interval_of_mean, interval_of_mean_within, interval_of_median};
pub use doubts::{DoubtCount, ReadingSummary};
pub use evaluate::{Evaluation, run};
pub use list::{Shard, cases_of_folders, cases_of_table};
pub use metric_summary::{MetricRow, best_by_metric};
pub use opened::{CaseMaterials, materials_of};
pub use pick::{Pick, counted_loss, counted_sample};
pub use reading::DatasetReading;
pub use record::{
    CandidateFile, Case, DatasetSettings, KnownLoss, Mark, MaterialResult, Method, PredictionResult, Source,
};
pub use remark::Remark;
pub use repetition::digests;
pub use robust::robust;
pub use scenes::DatasetScenes;
pub use summary::{DatasetReport, MarkSummary, MethodSummary, MetricSummary};
pub use verify::{TableDifference, command, differences, shell_words, without_decisions};
pub use witness::decided;
