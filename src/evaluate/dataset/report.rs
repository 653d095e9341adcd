//! The losses of methods over a data set as text, CSV and LaTeX.

use crate::report::{Cell, Report, Table, aligned, bold, escaped, latex, missed};
use svbrdf_core::error::Error;
use svbrdf_core::text::line;

use super::doubts::ReadingSummary;
use super::mark_report;
use super::metric_report;
use super::pick::counted;
use super::ranking::{DatasetReport, MethodSummary};
use super::record::{DatasetSettings, Mark, MaterialResult, PredictionResult};
use super::remark::Remark;
use super::repetition;
use svbrdf_files::disk::atomic::SOFTWARE;

const TITLES: [&str; 9] = [
    "method",
    "materials",
    "failed",
    "mean loss",
    "95% over materials",
    "95% over scenes",
    "median",
    "- best",
    "95% over materials",
];

const COLUMNS: [&str; 14] = [
    "material",
    "method",
    "sample",
    "loss",
    "standard_error",
    "interval95_low",
    "interval95_high",
    "seed",
    "scenes",
    "path",
    "error",
    "compared",
    "doubts",
    "ground_truth_doubts",
];

/// The columns of diagnoses.
const MARKS: [&str; 3] = ["floor", "resolvable", "marked"];

impl DatasetReport {
    /// The command that makes these results again.
    pub fn command(&self) -> String {
        repetition::command(&self.settings, &self.reading, self.pick)
    }

    /// The doubts in reading the ground truths, and the predictions of each method: lines, none where nothing is in doubt.
    pub fn doubts(&self) -> Vec<String> {
        let mut methods = ReadingSummary::by_method(&self.results);
        let of_method =
            |summary: &MethodSummary| methods.remove(summary.method.as_str())?.line(&summary.method);
        let truths = ReadingSummary::of_ground_truths(&self.results).line("ground truths");
        truths.into_iter().chain(self.ranking.methods.iter().filter_map(of_method)).collect()
    }

    /// The materials that the means are over, and how they were read: lines.
    pub fn conditions(&self) -> Vec<String> {
        self.ranking.over(self.results.len()).into_iter().chain(self.doubts()).collect()
    }

    /// Every remark on the reading of a material, with its name and, for a prediction, its method.
    pub fn remarks(&self) -> impl Iterator<Item = (String, &Remark)> {
        self.results.iter().flat_map(|result| {
            let truth =
                result.reading.iter().map(|remark| (format!("{}, ground truth", result.material), remark));
            let of =
                move |prediction: &'_ PredictionResult| format!("{}, {}", result.material, prediction.method);
            let predictions = result.predictions.iter();
            truth.chain(
                predictions.flat_map(move |one| one.reading.iter().map(move |remark| (of(one), remark))),
            )
        })
    }

    /// Tables for a paper: the best methods in bold, and the same of the metrics. What the numbers depend on is a comment above.
    pub fn latex(&self) -> String {
        let row = |summary: &MethodSummary| {
            let number = |value: f64| if value.is_nan() { "--".to_owned() } else { format!("{value:.4}") };
            let mean = bold(&number(summary.mean), summary.ties_with_best());
            let interval = summary
                .interval95_materials
                .map_or("--".to_owned(), |[low, high]| format!("[{low:.4}, {high:.4}]"));
            let method = escaped(&summary.method);
            format!(
                "{method} & {mean} & {interval} & {} & {} \\\\\n",
                number(summary.median),
                summary.count()
            )
        };
        let (compared, lacking): (Vec<_>, Vec<_>) =
            self.ranking.methods.iter().partition(|summary| summary.is_compared);
        let mut rows: String = compared.into_iter().map(row).collect();
        if !lacking.is_empty() {
            rows += "\\midrule\n";
            rows.extend(lacking.into_iter().map(row));
        }
        let comments = self.conditions().into_iter().chain([self.repetition()]);
        let comments: String = comments.map(|comment| format!("% {}\n", line(&comment))).collect();
        let losses = latex("lrlrr", "Method & Mean loss & 95\\% interval & Median & Materials", &rows);
        comments + &losses + &metric_report::latex_table(self)
    }

    /// How to repeat the ranking: a line.
    fn repetition(&self) -> String {
        format!("repeat with {SOFTWARE}: {}", self.command())
    }

    fn losses(&self) -> String {
        let number = |value: f64| if value.is_nan() { "none".to_owned() } else { format!("{value:.6}") };
        let range = |interval: Option<[f64; 2]>| {
            interval
                .filter(|[low, _]| !low.is_nan())
                .map_or_else(|| "-".to_owned(), |[low, high]| format!("{low:.6} to {high:.6}"))
        };
        let mut rows = vec![TITLES.map(str::to_owned).to_vec()];
        rows.extend(self.ranking.methods.iter().map(|summary| {
            let [difference, of_difference] = match &summary.to_best {
                None => [const { String::new() }; 2],
                Some(difference) => [number(difference.mean), range(difference.interval95_materials)],
            };
            vec![
                summary.method.clone(),
                summary.count(),
                summary.failures.to_string(),
                number(summary.mean),
                range(summary.interval95_materials),
                range(Some(summary.interval95_scenes)),
                number(summary.median),
                difference,
                of_difference,
            ]
        }));
        aligned(&rows)
    }

    /// Whether the loss of a prediction is a part of a mean that is compared.
    fn is_compared(&self, result: &MaterialResult, prediction: &PredictionResult) -> bool {
        let is_of = |summary: &&MethodSummary| summary.method == prediction.method;
        let method = self.ranking.methods.iter().find(is_of);
        let counts =
            counted(result, &prediction.method, self.pick).iter().any(|one| one.sample == prediction.sample);
        counts
            && self.ranking.common.contains(&result.index)
            && method.is_some_and(|summary| summary.is_compared)
    }
}

impl Report for DatasetReport {
    fn text(&self) -> String {
        let DatasetSettings { convention, target_error, seed, materials, .. } = &self.settings;
        let lines = |lines: Vec<String>| lines.into_iter().map(|line| line + "\n").collect::<String>();
        format!(
            "rendering loss over {} of {} materials\nconvention {convention}, +-{}% per loss, seed {seed}, pick {}\n\n{}\n{}{}{}\n{}\n",
            self.results.len(),
            materials.len(),
            100.0 * target_error,
            self.pick,
            self.losses(),
            lines(self.conditions()),
            mark_report::text(self),
            metric_report::text(self),
            self.repetition(),
        )
    }

    /// A row for each prediction.
    fn table(&self) -> Table {
        let metrics = metric_report::names(&self.results);
        let doubts = |reading: &[Remark]| reading.iter().filter(|remark| remark.doubt.is_some()).count();
        let row = |result: &MaterialResult, prediction: &PredictionResult| {
            let start = [
                result.material.as_str().into(),
                prediction.method.as_str().into(),
                prediction.sample.into(),
            ];
            let known = prediction.result.as_ref().ok();
            let numbers = match known {
                Some(known) => [known.loss, known.standard_error, known.interval95[0], known.interval95[1]]
                    .map(Cell::from),
                None => [const { Cell::Empty }; 4],
            };
            let end = [
                result.seed.into(),
                known.map(|known| known.scenes).into(),
                prediction.path.as_str().into(),
                prediction.result.as_ref().err().cloned().into(),
                self.is_compared(result, prediction).into(),
                doubts(&prediction.reading).into(),
                doubts(&result.reading).into(),
            ];
            let metrics = metrics.iter().map(|name| prediction.metrics.get(*name).copied().into());
            let marks = self.settings.diagnose.then(|| marks(result, prediction));
            start
                .into_iter()
                .chain(numbers)
                .chain(end)
                .chain(marks.into_iter().flatten())
                .chain(metrics)
                .collect()
        };
        let of_marks = if self.settings.diagnose { &MARKS[..] } else { &[] };
        let rows = self
            .results
            .iter()
            .flat_map(|result| result.predictions.iter().map(move |prediction| (result, prediction)));
        Table::new(
            COLUMNS.into_iter().chain(of_marks.iter().copied()).chain(metrics.iter().copied()),
            rows.map(|(result, prediction)| row(result, prediction)),
        )
    }

    fn missed(&self) -> Vec<Error> {
        let of = |result: &MaterialResult, prediction: &PredictionResult| {
            let known = prediction.result.as_ref().ok()?;
            let name = format!("{}, {}", result.material, prediction.method);
            missed(self.settings.target_error, &name, &known.estimate(), known.scenes)
        };
        let all = self.results.iter();
        all.flat_map(|result| result.predictions.iter().filter_map(|p| of(result, p))).collect()
    }
}

/// The cells of [`MARKS`]: the marks are names of hypotheses, the largest share first.
fn marks(result: &MaterialResult, prediction: &PredictionResult) -> [Cell; MARKS.len()] {
    let loss = prediction.result.as_ref().ok().map(|known| known.loss);
    let resolvable = result.floor.zip(loss).map(|(floor, loss)| loss > floor);
    let names =
        |marks: &Vec<Mark>| marks.iter().map(|mark| mark.hypothesis.as_str()).collect::<Vec<_>>().join(" ");
    [result.floor.into(), resolvable.into(), prediction.marks.as_ref().map(names).into()]
}
