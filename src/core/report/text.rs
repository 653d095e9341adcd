//! The text form of a report: a table and the paired differences.

use super::Report;
use super::table::{aligned, scenes_line};
use crate::loss::{Estimate, Loss};
use crate::model::scene::Kind;

const HEADINGS: [&str; 4] = ["prediction", "loss", "+- std. error", "95% interval"];

impl Report {
    /// A table of the losses, then the difference of each further loss from the first. Ends with a line break.
    ///
    /// Where the losses over all scenes are known, the table is theirs, and a line per prediction follows for the few scenes.
    pub fn text(&self) -> String {
        match &self.all_scenes {
            Some(known) => {
                let leading =
                    Self { outcome: known.clone(), all_scenes: None, backend: "cpu", ..self.clone() };
                format!("{}\n{}", leading.text(), self.few_scenes())
            }
            None => self.table(),
        }
    }

    /// What few scenes say: one line per prediction.
    pub fn few_scenes(&self) -> String {
        let scenes = format!("{} + {} scenes", self.count(Kind::Near), self.count(Kind::Distant));
        let line = |loss: &Loss| {
            let Estimate { mean, interval95, .. } = loss.estimate;
            let interval =
                interval95.map_or("unknown".to_owned(), |[low, high]| format!("{low:.3} to {high:.3}"));
            format!("{scenes}: {mean:.3} (95% {interval}), {}\n", loss.prediction)
        };
        self.outcome.losses.iter().map(line).collect()
    }

    fn table(&self) -> String {
        let mut rows = vec![HEADINGS.map(str::to_owned).to_vec()];
        rows.extend(self.outcome.losses.iter().map(cells));
        format!("{}\n{}{}", header(self), aligned(&rows), differences(self))
    }
}

/// Paired differences: variance that the scenes have in common cancels, so the errors of the losses do not add up.
fn differences(report: &Report) -> String {
    let lines = report.differences().into_iter().map(|(loss, difference)| {
        let [mean, error, interval] = difference.texts();
        let first = &report.outcome.losses[0].prediction;
        format!("\n{} - {first}, same scenes: {mean} +- {error}, 95% {interval}", loss.prediction)
    });
    let text: String = lines.collect();
    if text.is_empty() { text } else { text + "\n" }
}

fn header(report: &Report) -> String {
    let Report { convention, ground_truth, size: [width, height], precision, backend, .. } = report;
    let scenes = scenes_line(report.outcome.sampling.as_ref(), &report.outcome.scenes, report.size);
    format!(
        "rendering loss against {ground_truth}, {width} x {height} texels, {precision} on the {backend}\n\
         convention {}, epsilon {}\n{scenes}",
        convention.name, convention.epsilon
    )
}

fn cells(loss: &Loss) -> Vec<String> {
    let [mean, error, interval] = loss.estimate.texts();
    vec![loss.prediction.clone(), mean, error, interval]
}
