//! A loss report: its rows, one per prediction, and what it misses.

use super::Report;
use super::loss::{LossReport, PredictionLoss};
use super::missed::missed_by_any;
use super::table::{Cell, Column, Table};
use svbrdf_core::error::Error;

fn table(report: &LossReport) -> Table {
    let columns: [Column<'_, (&LossReport, &PredictionLoss)>; 26] = [
        ("prediction", |(_, result)| result.prediction.as_str().into()),
        ("loss", |(_, result)| result.loss.into()),
        ("standard_error", |(_, result)| result.standard_error.into()),
        ("interval95_low", |(_, result)| Cell::low(result.interval95)),
        ("interval95_high", |(_, result)| Cell::high(result.interval95)),
        ("convention", |(report, _)| report.convention.into()),
        ("epsilon", |(report, _)| report.epsilon.into()),
        ("width", |(report, _)| report.size[0].into()),
        ("height", |(report, _)| report.size[1].into()),
        ("near", |(report, _)| report.sampled.near.into()),
        ("distant", |(report, _)| report.sampled.distant.into()),
        ("seed", |(report, _)| report.sampled.seed.into()),
        ("sampler", |(report, _)| report.sampled.sampler.map(|sampler| sampler.to_string()).into()),
        ("texels", |(report, _)| report.sampled.texels.into()),
        ("precision", |(report, _)| report.precision.into()),
        ("backend", |(report, _)| report.backend.into()),
        ("target_error", |(report, _)| report.target_error.into()),
        ("target_reached", |(report, _)| report.target_reached.into()),
        ("path", |(_, result)| result.path.clone().into()),
        ("ground_truth", |(report, _)| report.ground_truth.as_str().into()),
        ("ground_truth_path", |(report, _)| report.ground_truth_path.clone().into()),
        ("interval95_from", |(report, _)| report.interval95_from.to_string().into()),
        ("few_scenes_loss", |(_, result)| result.few_scenes.as_ref().map(|few| few.few_scenes_loss).into()),
        ("few_scenes_low", |(_, result)| Cell::low(few_scenes(result))),
        ("few_scenes_high", |(_, result)| Cell::high(few_scenes(result))),
        ("step", |(_, result)| result.step.into()),
    ];
    Table::of(&columns, report.results.iter().map(|result| (report, result)))
}

/// The interval of the loss over few scenes.
fn few_scenes(result: &PredictionLoss) -> Option<[f64; 2]> {
    result.few_scenes.as_ref()?.few_scenes_interval95
}

impl Report for LossReport {
    fn text(&self) -> String {
        self.text()
    }

    fn table(&self) -> Table {
        table(self)
    }

    fn missed(&self) -> Vec<Error> {
        let losses = self.results.iter().map(|result| (result.prediction.as_str(), result.estimate()));
        let missed = |target| missed_by_any(target, losses, self.outcome.scenes.len());
        self.target_error.and_then(missed).into_iter().collect()
    }
}
