//! The text of a loss report: a table, the paired differences, and the losses over few scenes.

use super::heading::scenes_line;
use super::loss::{LossReport, count};
use super::table::aligned;
use crate::loss::{Estimate, Loss, Outcome};
use crate::model::scene::Kind;

const HEADINGS: [&str; 4] = ["prediction", "loss", "+- std. error", "95% interval"];

impl LossReport {
    /// The table of the losses, then the difference of each further loss from the first, then a line per prediction for the few
    /// scenes of the papers. Ends with a line break.
    pub fn text(&self) -> String {
        let few_scenes = self.few_scenes.as_ref().map(|few| format!("\n{}", few_scenes(&few.outcome)));
        format!("{}{}", table(self), few_scenes.unwrap_or_default())
    }
}

/// The losses over few scenes: a line per prediction.
fn few_scenes(outcome: &Outcome) -> String {
    let scenes = format!("{} + {} scenes", count(outcome, Kind::Near), count(outcome, Kind::Distant));
    let line = |loss: &Loss| {
        let Estimate { mean, interval95, .. } = loss.estimate;
        let interval =
            interval95.map_or("unknown".to_owned(), |[low, high]| format!("{low:.3} to {high:.3}"));
        format!("{scenes}: {mean:.3} (95% {interval}), {}\n", loss.prediction)
    };
    outcome.losses.iter().map(line).collect()
}

fn table(report: &LossReport) -> String {
    let cells = |loss: &Loss| {
        let [mean, error, interval] = loss.estimate.texts();
        vec![loss.prediction.clone(), mean, error, interval]
    };
    let mut rows = vec![HEADINGS.map(str::to_owned).to_vec()];
    rows.extend(report.outcome.losses.iter().map(cells));
    format!("{}\n{}{}", header(report), aligned(&rows), differences(report))
}

/// Paired differences: variance that the scenes have in common cancels, so the errors of the losses do not add up.
fn differences(report: &LossReport) -> String {
    let lines = report.differences().into_iter().map(|(loss, difference)| {
        let [mean, error, interval] = difference.texts();
        let first = &report.outcome.losses[0].prediction;
        format!("\n{} - {first}, same scenes: {mean} +- {error}, 95% {interval}", loss.prediction)
    });
    let text: String = lines.collect();
    if text.is_empty() { text } else { text + "\n" }
}

fn header(report: &LossReport) -> String {
    let LossReport { convention, ground_truth, size: [width, height], precision, backend, .. } = report;
    format!(
        "rendering loss against {ground_truth}, {width} x {height} texels, {precision} on the {backend}\n\
         convention {}, epsilon {}\n{}",
        convention.name,
        convention.epsilon,
        scenes_line(report.outcome.sampling.as_ref(), &report.outcome.scenes, report.size)
    )
}
