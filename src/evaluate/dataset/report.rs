//! The losses of methods over a data set: JSON, text, CSV and LaTeX.

use std::collections::BTreeMap;
use std::path::Path;

use crate::report::{Cell, Field, Reader, Repetition, Report, Table, missed};

use super::bootstrap::FEWEST;
use super::doubts::ReadingSummary;
use super::mark_summary::{marks_table, summarize_marks};
use super::metric_summary::{metric_names, metrics_table, summarize_metrics};
use super::pick::{Pick, counted};
use super::ranking::ranked;
use super::reading::DatasetReading;
use super::record::{DatasetSettings, MaterialResult, Method, PredictionResult, Source};
use super::remark::Remark;
use super::repetition;
use super::summary::{DatasetReport, FEW, MethodSummary};

/// The columns of the methods.
const METHODS: [Field<MethodSummary>; 9] = [
    ("", "method", |summary| summary.method.as_str().into()),
    ("", "materials", |summary| summary.count().into()),
    ("", "failed", |summary| summary.failures.into()),
    ("", "mean loss", |summary| Cell::or(known(summary.mean), "none")),
    ("", "95% over materials", |summary| Cell::or(summary.interval95_materials, FEW)),
    ("", "95% over scenes", |summary| Cell::or(known(summary.mean).map(|_| summary.interval95_scenes), "-")),
    ("", "median", |summary| Cell::or(known(summary.median), "none")),
    ("", "- best", |summary| summary.to_best.into()),
    ("", "95% over materials", |summary| {
        summary.to_best_interval95_materials.map_or_else(|| summary.signs().into(), Cell::from)
    }),
];

/// A number, unless it is that of a method without any loss.
fn known(number: f64) -> Option<f64> {
    Some(number).filter(|number| !number.is_nan())
}

/// A prediction with its material.
type Row<'a> = (&'a DatasetReport, &'a MaterialResult, &'a PredictionResult);

/// The columns of predictions; the last ones are those of diagnoses.
fn predictions<'a>() -> [Field<Row<'a>>; 16] {
    [
        ("material", "", |(_, result, _)| result.material.as_str().into()),
        ("method", "", |(.., one)| one.method.as_str().into()),
        ("sample", "", |(.., one)| one.sample.into()),
        ("loss", "", |(.., one)| one.known.map(|known| known.loss).into()),
        ("standard_error", "", |(.., one)| one.known.map(|known| known.standard_error).into()),
        ("interval95_low interval95_high", "", |(.., one)| one.known.map(|known| known.interval95).into()),
        ("seed", "", |(_, result, _)| result.seed.into()),
        ("scenes", "", |(.., one)| one.known.map(|known| known.scenes).into()),
        ("path", "", |(.., one)| one.path.as_str().into()),
        ("error", "", |(.., one)| one.error.clone().into()),
        ("compared", "", |(report, result, one)| report.is_compared(result, one).into()),
        ("doubts", "", |(.., one)| doubts(&one.reading)),
        ("ground_truth_doubts", "", |(_, result, _)| doubts(&result.reading)),
        ("floor", "", |(_, result, _)| result.floor.into()),
        ("resolvable", "", |(_, result, one)| {
            result.floor.zip(one.known).map(|(floor, known)| known.loss > floor).into()
        }),
        ("marked", "", |(.., one)| one.marked().into()),
    ]
}

/// The number of those columns.
const OF_DIAGNOSES: usize = 3;

fn doubts(reading: &[Remark]) -> Cell {
    reading.iter().filter(|remark| remark.doubt.is_some()).count().into()
}

impl DatasetReport {
    /// The report of `results`; of several predictions of a material, `pick` says which counts.
    pub fn new(
        settings: DatasetSettings,
        reading: DatasetReading,
        results: Vec<MaterialResult>,
        pick: Pick,
    ) -> Self {
        let (methods, common) = ranked(&settings.methods, &results, pick, settings.common);
        let is_common = |result: &&MaterialResult| common.contains(&result.index);
        let report = Self {
            repetition: Repetition::new(repetition::command(&settings, &reading, pick)),
            files: BTreeMap::new(),
            compared_materials: results.iter().filter(is_common).map(|one| one.material.clone()).collect(),
            ground_truths: ReadingSummary::of_ground_truths(&results),
            methods: Vec::new(),
            settings,
            reading,
            pick,
            results,
            common,
        };
        let mut readings = ReadingSummary::by_method(&report.results);
        let best = methods.first().filter(|best| best.compared).map(|best| best.method.clone());
        let whole = |summary: MethodSummary| MethodSummary {
            reading: readings.remove(summary.method.as_str()),
            metrics: summarize_metrics(&report, &summary),
            marks: summarize_marks(&report, &summary.method, best.as_deref()),
            ..summary
        };
        let methods = methods.into_iter().map(whole).collect();
        let mut report = Self { methods, ..report };
        // A results folder has all metrics.
        let has = |name: &str| report.settings.metrics.as_ref().is_some_and(|metrics| metrics.has(name));
        for prediction in report.results.iter_mut().flat_map(|result| &mut result.predictions) {
            prediction.metrics.retain(|name, _| has(name));
        }
        report
    }

    /// The best method, where methods are compared.
    pub fn best(&self) -> Option<&MethodSummary> {
        self.methods.first().filter(|summary| summary.compared)
    }

    /// The materials that the means are over, and how they were read: lines.
    pub fn conditions(&self) -> Vec<String> {
        let said = self.infinite().chain(self.matched()).chain(self.reading.decisions.iter().cloned());
        self.over().into_iter().chain(said).chain(self.doubts()).collect()
    }

    /// The methods with materials that are in no mean of a PSNR: lines.
    fn infinite(&self) -> impl Iterator<Item = String> {
        self.methods.iter().filter_map(|summary| {
            let most =
                summary.metrics.values().map(|metric| metric.infinite).max().filter(|most| *most > 0)?;
            let materials =
                if most == 1 { "1 material".to_owned() } else { format!("up to {most} materials") };
            Some(format!(
                "{}: {materials} with equal maps, whose infinite PSNR is in no mean",
                summary.method
            ))
        })
    }

    /// The materials that the means are over, and the methods that lack some: lines below a table.
    fn over(&self) -> Vec<String> {
        let compared = self.methods.iter().filter(|summary| summary.compared).count();
        let (common, all) = (self.common.len(), self.results.len());
        let materials = if common == all { format!("{all}") } else { format!("{common} of {all}") };
        let mut lines = vec![match compared {
            0 => "no material has a loss of every method: nothing is compared".to_owned(),
            1 => format!("means over the {materials} materials"),
            _ => format!("means over the {materials} materials that all {compared} compared methods have"),
        }];
        let lacking = self.methods.iter().filter(|summary| compared > 0 && !summary.compared);
        lines.extend(lacking.map(|summary| {
            let count = summary.count();
            format!(
                "{} has {count} materials: not compared, its mean is over other materials",
                summary.method
            )
        }));
        if self.methods.iter().all(|summary| summary.interval95_materials.is_none()) {
            lines.push(format!("intervals over materials need {FEWEST} materials"));
        }
        lines
    }

    /// The methods whose predictions have other names than their materials: lines.
    fn matched(&self) -> impl Iterator<Item = String> {
        let Source::Folders { methods, .. } = &self.settings.source else { return Vec::new().into_iter() };
        let line = |method: &Method| {
            let is_pattern = method.path.to_string_lossy().contains("{}");
            let mut named =
                self.predictions().filter(|(_, one)| one.method == method.name && one.sample == 0);
            let other = |(result, one): &(&MaterialResult, &PredictionResult)| {
                let name =
                    Path::new(&one.path).file_stem().unwrap_or_default().to_string_lossy().into_owned();
                !result.material.ends_with(&name) && !name.starts_with(&result.material)
            };
            let (result, one) = named.find(other).filter(|_| !is_pattern)?;
            Some(format!(
                "{}: names are matched one to one, such as {} of {}",
                method.name, one.path, result.material
            ))
        };
        methods.iter().filter_map(line).collect::<Vec<_>>().into_iter()
    }

    /// The doubts in reading the ground truths, and the predictions of each method: lines, none where nothing is in doubt.
    pub fn doubts(&self) -> Vec<String> {
        let of = |summary: &MethodSummary| summary.reading.as_ref()?.line(&summary.method);
        let methods = self.methods.iter().filter_map(of);
        self.ground_truths.line("ground truths").into_iter().chain(methods).collect()
    }

    /// Every remark on the reading of a material, with its name and, for a prediction, its method.
    pub fn remarks(&self) -> impl Iterator<Item = (String, &Remark)> {
        self.results.iter().flat_map(|result| {
            let predictions = result.predictions.iter().map(|one| (one.method.as_str(), &one.reading));
            let all = [("ground truth", &result.reading)].into_iter().chain(predictions);
            all.flat_map(|(of, reading)| {
                let name = format!("{}, {of}", result.material);
                reading.iter().map(move |remark| (name.clone(), remark))
            })
        })
    }

    /// Every prediction with its material.
    pub(super) fn predictions(&self) -> impl Iterator<Item = (&MaterialResult, &PredictionResult)> {
        self.results.iter().flat_map(|result| result.predictions.iter().map(move |one| (result, one)))
    }

    /// Whether the loss of a prediction is a part of a mean that is compared.
    pub(super) fn is_compared(&self, result: &MaterialResult, prediction: &PredictionResult) -> bool {
        let is_of = |summary: &&MethodSummary| summary.method == prediction.method;
        let method = self.methods.iter().find(is_of);
        let counts =
            counted(result, &prediction.method, self.pick).iter().any(|one| one.sample == prediction.sample);
        counts && self.common.contains(&result.index) && method.is_some_and(|summary| summary.compared)
    }
}

impl Report for DatasetReport {
    fn heading(&self) -> String {
        let DatasetSettings { convention, materials, .. } = &self.settings;
        // Those that means are over, where any are compared.
        let over = if self.common.is_empty() { self.results.len() } else { self.common.len() };
        let protocol = self.settings.protocol.as_ref();
        let protocol = protocol.map_or(String::new(), |protocol| format!("protocol {protocol}\n"));
        format!(
            "rendering loss over {} of {} materials\n{protocol}convention {convention}, {}, pick {}\n",
            over,
            materials.len(),
            self.settings.scenes.description(self.settings.seed),
            self.pick,
        )
    }

    /// With the conditions, marks, metrics and the command that repeats it below the table.
    fn text(&self) -> String {
        let table = |table: Option<Table>| table.map_or(String::new(), |table| format!("\n{}", table.text()));
        let lines = |lines: Vec<String>| lines.into_iter().map(|line| line + "\n").collect::<String>();
        format!(
            "{}\n{}\n{}{}{}\n{}\n",
            self.heading(),
            self.table(Reader::Person).text(),
            lines(self.conditions()),
            table(marks_table(self)),
            table(metrics_table(self)),
            self.repetition,
        )
    }

    /// For programs a row for each prediction; for people one for each method.
    fn table(&self, reader: Reader) -> Table {
        if reader == Reader::Person {
            return Table::fields(&METHODS, &self.methods, reader);
        }
        let fields = predictions();
        let count = fields.len() - if self.settings.diagnose { 0 } else { OF_DIAGNOSES };
        let rows = self.predictions().map(|(result, prediction)| (self, result, prediction));
        let mut table = Table::fields(&fields[..count], rows, reader);
        if !self.files.is_empty() {
            let digest = |whose: String| Cell::from(self.files.get(&whose).cloned());
            let truth =
                |(result, _): (&MaterialResult, _)| digest(format!("ground truth, {}", result.material));
            table.push("ground_truth_sha256".to_owned(), self.predictions().map(truth));
            let one = |(result, one): (&MaterialResult, &PredictionResult)| {
                let sample = if one.sample > 0 { format!(" {}", one.sample) } else { String::new() };
                digest(format!("{}{sample}, {}", one.method, result.material))
            };
            table.push("sha256".to_owned(), self.predictions().map(one));
            let command = |_| self.repetition.command.as_str().into();
            table.push("repeat_with".to_owned(), self.predictions().map(command));
        }
        for name in metric_names(&self.results) {
            let value = |(_, one): (_, &PredictionResult)| one.metrics.get(name).copied().into();
            table.push(name.to_owned(), self.predictions().map(value));
        }
        table
    }

    fn missed(&self) -> Vec<String> {
        let of = |(result, prediction): (&MaterialResult, &PredictionResult)| {
            let known = prediction.known?;
            let name = format!("{}, {}", result.material, prediction.method);
            missed(self.settings.scenes.target()?, &name, &known.estimate(), known.scenes)
        };
        self.predictions().filter_map(of).collect()
    }
}
