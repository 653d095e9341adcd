//! The text form of a report: a table and the paired differences.

use super::Report;
use crate::loss::{Estimate, Loss, Texels};
use crate::model::sampler::Sampler;
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
        let mut rows = vec![HEADINGS.map(str::to_owned)];
        rows.extend(self.outcome.losses.iter().map(cells));
        let widths: [usize; 4] =
            std::array::from_fn(|c| rows.iter().map(|row| row[c].chars().count()).max().unwrap_or(0));
        let lines: String = rows.iter().map(|row| line(row, widths)).collect();
        format!("{}\n{lines}{}", header(self), differences(self))
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
    let (near, distant) = (report.count(Kind::Near), report.count(Kind::Distant));
    let origin = report.seed().map_or(" from a file".to_owned(), |seed| format!(", seed {seed}"));
    let sampler = match report.sampler() {
        Some(Sampler::Sobol) => ", scrambled Sobol",
        _ => "",
    };
    let texels = match report.texels() {
        Texels::All => String::new(),
        Texels::Sampled(1) => ", 1 random texel per scene".to_owned(),
        Texels::Sampled(count) => format!(", {count} random texels per scene"),
    };
    format!(
        "rendering loss against {ground_truth}, {width} x {height} texels, {precision} on the {backend}\n\
         convention {}, epsilon {}\n\
         {near} near-field and {distant} distant scenes{origin}{sampler}{texels}\n",
        convention.name, convention.epsilon
    )
}

fn cells(loss: &Loss) -> [String; 4] {
    let [mean, error, interval] = loss.estimate.texts();
    [loss.prediction.clone(), mean, error, interval]
}

fn line([name, loss, error, interval]: &[String; 4], [a, b, c, d]: [usize; 4]) -> String {
    format!("{name:<a$}  {loss:>b$}  {error:>c$}  {interval:>d$}\n")
}
