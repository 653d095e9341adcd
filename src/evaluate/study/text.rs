//! A study as a summary.

use super::choice::Family;
use super::result::{Point, Study};
use svbrdf_core::material::Depth;
use svbrdf_core::text::{percent, time};

/// Target errors of the summary, as shares of the loss.
const TARGETS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];

impl Study {
    /// The cheapest setting for each of a few target errors, with the options of `svbrdf loss` that select it.
    pub fn summary(&self) -> String {
        let rows = TARGETS.map(|target| match self.cheapest(target) {
            Some(p) => [percent(target), time(p.seconds), percent(p.error), p.choice.options()],
            None => [percent(target), "-".to_owned(), "-".to_owned(), "no measured setting".to_owned()],
        });
        let heading = ["target", "time", "error", "svbrdf loss ..."].map(str::to_owned);
        let table: String = std::iter::once(heading)
            .chain(rows)
            .map(|[target, time, error, options]| format!("{target:>6}  {time:>7}  {error:>8}  {options}\n"))
            .collect();
        format!("{}\n{table}\n{}", self.header(), self.footer())
    }

    fn header(&self) -> String {
        let Self { names: [ground_truth, prediction], size: [width, height], threads, reference, .. } = self;
        format!(
            "{prediction} against {ground_truth}, {width} x {height} texels, convention {}, {threads} threads\n\
             loss {:.6} +- {} by {} scenes\n",
            self.convention.name,
            reference.loss,
            percent(reference.error),
            reference.scenes
        )
    }

    fn footer(&self) -> String {
        let mut lines = vec![
            "Errors are root mean squares over seeds; 95% of losses are off by less than about twice that."
                .to_owned(),
        ];
        if self.points.iter().any(|p| p.error < self.least_error()) {
            let least = percent(self.least_error());
            lines.push(format!(
                "Errors below {least} are not significantly different from 0: the reference is not known better."
            ));
        }
        lines.extend(self.variants());
        lines.extend(self.left_out.iter().map(|what| format!("Not measured: {what}")));
        lines.join("\n") + "\n"
    }

    /// The cost and effect of other precisions and depths of maps, at the most scenes that they were run with.
    pub fn variants(&self) -> Vec<String> {
        let line = |family: Family| {
            let of_family = |p: &&Point| p.choice.family() == family && p.choice != p.choice.base();
            let point = self.points.iter().rfind(of_family)?;
            let base = self.points.iter().find(|p| p.choice == point.choice.base())?;
            let time = match point.choice.maps {
                Depth::Float => format!("takes {:.2} times as long and ", point.seconds / base.seconds),
                _ => String::new(),
            };
            Some(format!("{}: {time}changes the loss by {}", family.name(), percent(point.shift.abs())))
        };
        Family::ALL.into_iter().filter_map(line).collect()
    }
}
