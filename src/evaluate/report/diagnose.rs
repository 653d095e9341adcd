//! Report of what might explain each loss.

use schemars::JsonSchema;
use serde::Serialize;

use super::Report;
use super::heading::{Compared, floor_line};
use super::table::{Cell, Column, Table, aligned_columns};
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
        let rungs: [Column<'_, &Rung, String>; 4] = [
            ("block", |rung| format!("{0} x {0}", rung.side)),
            ("loss", |rung| format!("{:.6}", rung.loss)),
            ("roughness, ground truth", |rung| format!("{:.4}", rung.roughness[0])),
            ("roughness, prediction", |rung| format!("{:.4}", rung.roughness[1])),
        ];
        format!(
            "{}\n\n{}: loss {mean}, 95% {interval}\n\n{}\n{}{}",
            diagnosis.sentence,
            diagnosis.prediction,
            aligned_columns(&columns(), &diagnosis.findings),
            aligned_columns(&rungs, &diagnosis.ladder),
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

/// The columns of the findings for people.
fn columns<'a>() -> [Column<'static, &'a ReportedFinding, String>; 7] {
    [
        ("", |one| if one.finding.marked { "*" } else { "" }.to_owned()),
        ("hypothesis", |one| one.finding.hypothesis.name().to_owned()),
        ("value", |ReportedFinding { finding: Finding { value, unit, .. }, .. }| match unit {
            Some(unit) => format!("{value} {unit}"),
            None => value.to_string(),
        }),
        ("loss", |one| known(one.finding.loss, |loss| format!("{loss:.6}"))),
        ("95% interval", |one| known(one.finding.interval95, |[low, high]| format!("{low:.6} to {high:.6}"))),
        ("share", |one| known(one.finding.share, |share| format!("{:.1}%", 100.0 * share))),
        ("option", |one| match one.finding.marked {
            true => one.option.clone().unwrap_or_else(|| "none".to_owned()),
            false => String::new(),
        }),
    ]
}

fn known<T>(value: Option<T>, text: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "-".to_owned(), text)
}

impl Diagnosis {
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
    fn text(&self) -> String {
        let texts: Vec<String> = self.predictions.iter().map(|diagnosis| self.text_of(diagnosis)).collect();
        let [near, distant] = diagnose::SCENES;
        format!(
            "{}{near} near-field and {distant} distant scenes, seed {}, scrambled Sobol\n{}\n{}",
            self.compared.heading("diagnosis"),
            self.seed,
            floor_line(&self.floor, self.captures),
            texts.join("\n")
        )
    }

    fn table(&self) -> Table {
        let columns: [Column<'_, (&str, &ReportedFinding)>; 13] = [
            ("prediction", |(prediction, _)| (*prediction).into()),
            ("hypothesis", |(_, one)| one.finding.hypothesis.name().into()),
            ("value", |(_, one)| cell(&one.finding.value)),
            ("unit", |(_, one)| one.finding.unit.into()),
            ("loss", |(_, one)| one.finding.loss.into()),
            ("interval95_low", |(_, one)| Cell::low(one.finding.interval95)),
            ("interval95_high", |(_, one)| Cell::high(one.finding.interval95)),
            ("share", |(_, one)| one.finding.share.into()),
            ("share_interval95_low", |(_, one)| Cell::low(one.finding.share_interval95)),
            ("share_interval95_high", |(_, one)| Cell::high(one.finding.share_interval95)),
            ("p", |(_, one)| one.finding.p.into()),
            ("marked", |(_, one)| one.finding.marked.into()),
            ("remedy", |(_, one)| one.remedy.clone().into()),
        ];
        let all = self.predictions.iter();
        let rows = all.flat_map(|one| one.findings.iter().map(|finding| (one.prediction.as_str(), finding)));
        Table::of(&columns, rows)
    }
}
