//! The text of a loss report: a table, the paired differences, and the losses over few scenes.

use super::heading::scenes_line;
use super::loss::{Difference, FewScenes, LossReport, PredictionLoss};
use super::table::Reader;

impl LossReport {
    /// The table of the losses, then the difference of each further loss from the first, then a line per prediction for the few
    /// scenes of the papers. Ends with a line break.
    pub fn text(&self) -> String {
        let table = self.table_for(Reader::Person).text();
        let few_scenes = self.few_scenes.as_ref().map(|few| self.few_scenes_lines(few)).unwrap_or_default();
        format!("{}\n{table}{}{few_scenes}", self.header(), self.difference_lines())
    }

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

    fn header(&self) -> String {
        let Self { convention, epsilon, ground_truth, size, precision, backend, outcome, .. } = self;
        let [width, height] = size;
        format!(
            "rendering loss against {ground_truth}, {width} x {height} texels, {precision} on the {backend}\n\
             convention {convention}, epsilon {epsilon}\n{}",
            scenes_line(outcome.sampling.as_ref(), &outcome.scenes, *size)
        )
    }
}
