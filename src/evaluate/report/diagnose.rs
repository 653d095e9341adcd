//! Report of what might explain each loss.

use schemars::JsonSchema;
use serde::Serialize;

use super::Report;
use super::heading::{Compared, floor_line};
use super::table::{Cell, Field, Reader, Table};
use crate::diagnose::{self, Finding, Rung, Seam, Value, sentence};
use svbrdf_core::loss::Estimate;

/// Largest rank of a seam that is printed.
const SEAM: f64 = 0.05;

/// The diagnosis of each prediction: docs/diagnose.md describes each line.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct DiagnoseReport {
    #[serde(flatten)]
    compared: Compared,
    seed: u64,
    /// The loss that the ground truth cannot resolve.
    floor: Estimate,
    /// The number of captures of the ground truth that the floor is the mean loss between; `None`: it is that of rounding.
    captures: Option<usize>,
    /// The seams of the ground truth.
    seams: Vec<Seam>,
    /// One per prediction.
    predictions: Vec<Diagnosis>,
}

/// What might explain the loss of a prediction.
#[derive(Clone, Debug, Serialize, JsonSchema)]
struct Diagnosis {
    prediction: String,
    /// The finding in words.
    sentence: String,
    loss: Estimate,
    /// Whether the loss is above the floor.
    resolvable: bool,
    /// The part of the loss that disappears under all marked findings together; `None` without marks.
    explained: Option<f64>,
    findings: Vec<ReportedFinding>,
    /// The loss between averages over larger and larger blocks.
    ladder: Vec<Rung>,
    /// Those of the prediction.
    seams: Vec<Seam>,
}

/// The loss under a hypothesis, such as another exposure or another direction of y.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[schemars(rename = "Finding")]
struct ReportedFinding {
    #[serde(flatten)]
    finding: Finding,
    /// What `--read` takes to correct the reading: `name:normal-y=down`.
    remedy: Option<String>,
    /// The same as an option of the command line.
    #[serde(skip)]
    option: Option<String>,
}

impl DiagnoseReport {
    /// The report of `diagnoses` beside a `floor`, which is the mean loss between this many captures, or that of rounding.
    pub fn new(
        compared: Compared,
        seed: u64,
        (floor, captures): (Estimate, Option<usize>),
        seams: Vec<Seam>,
        diagnoses: Vec<diagnose::Diagnosis>,
    ) -> Self {
        let predictions = diagnoses.into_iter().map(|one| Diagnosis::new(one, &compared, &floor)).collect();
        Self { compared, seed, floor, captures, seams, predictions }
    }

    fn text_of(&self, diagnosis: &Diagnosis) -> String {
        let [mean, _, interval] = diagnosis.loss.texts();
        let rungs: [Field<Rung>; 4] = [
            ("", "block", |rung| format!("{0} x {0}", rung.side).into()),
            ("", "loss", |rung| rung.loss.into()),
            ("", "roughness, ground truth", |rung| Cell::Digits(4, rung.roughness[0])),
            ("", "roughness, prediction", |rung| Cell::Digits(4, rung.roughness[1])),
        ];
        format!(
            "{}\n\n{}: loss {mean}, 95% {interval}\n\n{}\n{}{}",
            diagnosis.sentence,
            diagnosis.prediction,
            Table::fields(&fields(), diagnosis.rows(), Reader::Person).text(),
            Table::fields(&rungs, &diagnosis.ladder, Reader::Person).text(),
            self.seams_line(diagnosis)
        )
    }

    /// The visible seams, where there are any.
    fn seams_line(&self, diagnosis: &Diagnosis) -> String {
        let visible = |seams: &[Seam]| {
            let name = |seam: &Seam| format!("{} {} (rank {:.3})", seam.map.name(), seam.across, seam.rank);
            seams.iter().filter(|seam| seam.rank <= SEAM).map(name).collect::<Vec<_>>().join(", ")
        };
        let line = |name: &str, seams: String| {
            if seams.is_empty() { seams } else { format!("seams of {name} if it is repeated: {seams}\n") }
        };
        let truth = line(&self.compared.ground_truth, visible(&self.seams));
        let prediction = line(&diagnosis.prediction, visible(&diagnosis.seams));
        if truth.is_empty() && prediction.is_empty() {
            String::new()
        } else {
            format!("\n{truth}{prediction}")
        }
    }
}

/// The columns of findings, each with its prediction.
fn fields<'a>() -> [Field<(&'a str, &'a ReportedFinding)>; 14] {
    [
        ("prediction", "", |(prediction, _)| (*prediction).into()),
        ("", " ", |(_, one)| if one.finding.marked { "*" } else { "" }.into()),
        ("hypothesis", "hypothesis", |(_, one)| one.finding.hypothesis.name().into()),
        ("", "value", |(_, ReportedFinding { finding: Finding { value, unit, .. }, .. })| match unit {
            Some(unit) => format!("{value} {unit}").into(),
            None => value.to_string().into(),
        }),
        ("value", "", |(_, one)| cell(&one.finding.value)),
        ("unit", "", |(_, one)| one.finding.unit.into()),
        ("loss", "loss", |(_, one)| Cell::or(one.finding.loss, "-")),
        ("interval95_low interval95_high", "95% interval", |(_, one)| Cell::or(one.finding.interval95, "-")),
        ("share", "share", |(_, one)| one.finding.share.map_or(Cell::Missing("-"), Cell::Share)),
        ("share_interval95_low share_interval95_high", "", |(_, one)| one.finding.share_interval95.into()),
        ("p", "", |(_, one)| one.finding.p.into()),
        ("marked", "", |(_, one)| one.finding.marked.into()),
        ("remedy", "", |(_, one)| one.remedy.clone().into()),
        ("", "option", |(_, one)| match one.finding.marked {
            true => Cell::or(one.option.clone(), "none"),
            false => Cell::Missing(""),
        }),
    ]
}

impl Diagnosis {
    fn rows(&self) -> impl Iterator<Item = (&str, &ReportedFinding)> {
        self.findings.iter().map(|finding| (self.prediction.as_str(), finding))
    }

    fn new(found: diagnose::Diagnosis, compared: &Compared, floor: &Estimate) -> Self {
        let names = [compared.ground_truth.as_str(), &found.prediction];
        let finding = |finding: &Finding| ReportedFinding {
            remedy: finding.statement(names),
            option: finding.command_option(names),
            finding: finding.clone(),
        };
        Self {
            sentence: sentence(&found, Some(floor)),
            resolvable: found.loss.mean > floor.mean,
            findings: found.findings.iter().map(finding).collect(),
            prediction: found.prediction,
            loss: found.loss,
            explained: found.explained,
            ladder: found.ladder,
            seams: found.seams,
        }
    }
}

/// A number, a list of them in brackets, or a name.
fn cell(value: &Value) -> Cell {
    match value {
        Value::Number(number) => (*number).into(),
        Value::Numbers(numbers) => format!("{numbers:?}").into(),
        Value::Displacement(displacement) => format!("{displacement:?}").into(),
        Value::Name(name) => (*name).into(),
    }
}

impl Report for DiagnoseReport {
    fn heading(&self) -> String {
        let [near, distant] = diagnose::SCENES;
        format!(
            "{}{near} near-field and {distant} distant scenes, seed {}, scrambled Sobol\n{}",
            self.compared.heading("diagnosis"),
            self.seed,
            floor_line(&self.floor, self.captures)
        )
    }

    /// With ladder and seams below the table of each prediction.
    fn text(&self) -> String {
        let texts: Vec<String> = self.predictions.iter().map(|diagnosis| self.text_of(diagnosis)).collect();
        format!("{}\n{}", self.heading(), texts.join("\n"))
    }

    fn table(&self, reader: Reader) -> Table {
        let rows = self.predictions.iter().flat_map(Diagnosis::rows);
        Table::fields(&fields(), rows, reader)
    }
}
