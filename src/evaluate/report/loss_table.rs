//! A loss report: its rows, one per prediction, its text, and what it misses.

use super::Report;
use super::heading::scenes_line;
use super::loss::{Difference, FewScenes, LossReport, PredictionLoss};
use super::missed::missed_by_any;
use super::table::{Cell, Field, Reader, Table};
use crate::error::Error;

fn fields<'a>() -> [Field<(&'a LossReport, &'a PredictionLoss)>; 22] {
    [
        ("prediction", "prediction", |(_, result)| result.prediction.as_str().into()),
        ("loss", "loss", |(_, result)| result.loss.into()),
        ("standard_error", "+- std. error", |(_, result)| Cell::or(result.standard_error, "unknown")),
        ("interval95_low interval95_high", "95% interval", |(_, result)| {
            Cell::or(result.interval95, "unknown")
        }),
        ("convention", "", |(report, _)| report.convention.into()),
        ("epsilon", "", |(report, _)| report.epsilon.into()),
        ("width", "", |(report, _)| report.size[0].into()),
        ("height", "", |(report, _)| report.size[1].into()),
        ("near", "", |(report, _)| report.sampled.near.into()),
        ("distant", "", |(report, _)| report.sampled.distant.into()),
        ("seed", "", |(report, _)| report.sampled.seed.into()),
        ("sampler", "", |(report, _)| report.sampled.sampler.map(|sampler| sampler.to_string()).into()),
        ("texels", "", |(report, _)| report.sampled.texels.into()),
        ("precision", "", |(report, _)| report.precision.into()),
        ("target_error", "", |(report, _)| report.target_error.into()),
        ("target_reached", "", |(report, _)| report.target_reached.into()),
        ("path", "", |(_, result)| result.path.clone().into()),
        ("ground_truth", "", |(report, _)| report.ground_truth.as_str().into()),
        ("ground_truth_path", "", |(report, _)| report.ground_truth_path.clone().into()),
        ("interval95_from", "", |(report, _)| report.interval95_from.to_string().into()),
        ("few_scenes_loss", "", |(_, result)| {
            result.few_scenes.as_ref().map(|few| few.few_scenes_loss).into()
        }),
        ("few_scenes_low few_scenes_high", "", |(_, result)| few_scenes(result).into()),
    ]
}

/// The interval of the loss over few scenes.
fn few_scenes(result: &PredictionLoss) -> Option<[f64; 2]> {
    result.few_scenes.as_ref()?.few_scenes_interval95
}

impl LossReport {
    /// The losses over few scenes: a line per prediction.
    fn few_scenes_lines(&self, FewScenes { sampled, .. }: &FewScenes) -> String {
        let line = |result: &PredictionLoss| {
            let few = result.few_scenes.as_ref()?;
            let interval = few
                .few_scenes_interval95
                .map_or("unknown".to_owned(), |[low, high]| format!("{low:.3} to {high:.3}"));
            Some(format!(
                "{} + {} scenes: {:.3} (95% {interval}), {}\n",
                sampled.near, sampled.distant, few.few_scenes_loss, result.prediction
            ))
        };
        format!("\n{}", self.results.iter().filter_map(line).collect::<String>())
    }

    /// Paired differences: variance that the scenes have in common cancels, so the errors of the losses do not add up.
    fn difference_lines(&self) -> String {
        let line = |difference: &Difference| {
            let [mean, error, interval] = difference.estimate().texts();
            let Difference { prediction, to, .. } = difference;
            format!("\n{prediction} - {to}, same scenes: {mean} +- {error}, 95% {interval}")
        };
        let text: String = self.differences.iter().map(line).collect();
        if text.is_empty() { text } else { text + "\n" }
    }
}

impl Report for LossReport {
    fn heading(&self) -> String {
        let Self { convention, epsilon, ground_truth, size, precision, outcome, .. } = self;
        let [width, height] = size;
        format!(
            "rendering loss against {ground_truth}, {width} x {height} texels, {precision}\n\
             convention {convention}, epsilon {epsilon}\n{}",
            scenes_line(outcome.sampling.as_ref(), &outcome.scenes, *size)
        )
    }

    /// The table of the losses, then the difference of each further loss from the first, then a line per prediction for the few
    /// scenes of the papers.
    fn text(&self) -> String {
        let table = self.table(Reader::Person).text();
        let few_scenes = self.few_scenes.as_ref().map(|few| self.few_scenes_lines(few)).unwrap_or_default();
        format!("{}\n{table}{}{few_scenes}", self.heading(), self.difference_lines())
    }

    /// A row per prediction.
    fn table(&self, reader: Reader) -> Table {
        Table::fields(&fields(), self.results.iter().map(|result| (self, result)), reader)
    }

    fn missed(&self) -> Vec<Error> {
        let losses = self.results.iter().map(|result| (result.prediction.as_str(), result.estimate()));
        let missed = |target| missed_by_any(target, losses, self.outcome.scenes.len());
        self.target_error.and_then(missed).into_iter().collect()
    }
}
