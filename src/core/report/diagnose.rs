//! Report of what might explain each loss.

use serde::{Serialize, Serializer};

use super::Report;
use super::heading::{Compared, floor_line};
use super::table::{Cell, Table, aligned};
use crate::diagnose::{Diagnosis, Finding, Rung, Seam, Value, sentence};
use crate::loss::Estimate;

const TITLES: [&str; 7] = ["", "hypothesis", "value", "loss", "95% interval", "share", "option"];
const RUNGS: [&str; 4] = ["block", "loss", "roughness, ground truth", "roughness, prediction"];

const COLUMNS: [&str; 13] = [
    "prediction",
    "hypothesis",
    "value",
    "unit",
    "loss",
    "interval95_low",
    "interval95_high",
    "share",
    "share_interval95_low",
    "share_interval95_high",
    "p",
    "marked",
    "remedy",
];

/// Largest rank of a seam that is printed.
const SEAM: f64 = 0.05;

/// The diagnosis of the loss of each prediction.
#[derive(Clone, Debug)]
pub struct DiagnoseReport {
    pub compared: Compared,
    pub seed: u64,
    /// The loss that the ground truth cannot resolve.
    pub floor: Estimate,
    /// The number of captures of the ground truth that the floor is the mean loss between; `None`: it is that of rounding.
    pub captures: Option<usize>,
    /// The seams of the ground truth.
    pub seams: Vec<Seam>,
    /// One per prediction.
    pub diagnoses: Vec<Diagnosis>,
}

impl DiagnoseReport {
    fn text_of(&self, diagnosis: &Diagnosis) -> String {
        let [mean, _, interval] = diagnosis.loss.texts();
        let mut rows = vec![TITLES.map(str::to_owned).to_vec()];
        rows.extend(diagnosis.findings.iter().map(|finding| row(finding, self.names(diagnosis))));
        let mut rungs = vec![RUNGS.map(str::to_owned).to_vec()];
        rungs.extend(diagnosis.ladder.iter().map(|rung: &Rung| {
            let [truth, prediction] = rung.roughness.map(|roughness| format!("{roughness:.4}"));
            vec![format!("{0} x {0}", rung.side), format!("{:.6}", rung.loss), truth, prediction]
        }));
        format!(
            "{}\n\n{}: loss {mean}, 95% {interval}\n\n{}\n{}{}",
            sentence(diagnosis, Some(&self.floor)),
            diagnosis.prediction,
            aligned(&rows),
            aligned(&rungs),
            self.seams_line(diagnosis)
        )
    }

    /// The names of the ground truth and of the prediction.
    fn names<'a>(&'a self, diagnosis: &'a Diagnosis) -> [&'a str; 2] {
        [&self.compared.ground_truth, &diagnosis.prediction]
    }

    fn entry<'a>(&self, diagnosis: &'a Diagnosis) -> DiagnosisEntry<'a> {
        let Diagnosis { prediction, loss, explained, findings, ladder, seams } = diagnosis;
        let names = self.names(diagnosis);
        DiagnosisEntry {
            prediction,
            sentence: sentence(diagnosis, Some(&self.floor)),
            loss: *loss,
            resolvable: loss.mean > self.floor.mean,
            explained: *explained,
            findings: findings.iter().map(|finding| FindingEntry::new(finding, names)).collect(),
            ladder,
            seams,
        }
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

/// A number, a list of them in brackets, or a name.
fn cell(value: &Value) -> Cell {
    match value {
        Value::Number(number) => (*number).into(),
        Value::Numbers(numbers) => format!("{numbers:?}").into(),
        Value::Displacement(displacement) => format!("{displacement:?}").into(),
        Value::Name(name) => (*name).into(),
    }
}

/// A line of the table of the ground truth and the prediction with these names.
fn row(finding: &Finding, names: [&str; 2]) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.6}"));
    let interval =
        finding.interval95.map_or_else(|| "-".to_owned(), |[low, high]| format!("{low:.6} to {high:.6}"));
    let unit = finding.unit.map(|unit| format!(" {unit}")).unwrap_or_default();
    vec![
        if finding.marked { "*" } else { "" }.to_owned(),
        finding.hypothesis.name().to_owned(),
        format!("{}{unit}", finding.value),
        number(finding.loss),
        interval,
        finding.share.map_or_else(|| "-".to_owned(), |share| format!("{:.1}%", 100.0 * share)),
        match finding.marked {
            true => finding.command_option(names).unwrap_or_else(|| "none".to_owned()),
            false => String::new(),
        },
    ]
}

impl Report for DiagnoseReport {
    fn text(&self) -> String {
        let first =
            self.diagnoses.iter().map(|diagnosis| self.text_of(diagnosis)).collect::<Vec<_>>().join("\n");
        format!(
            "{}128 near-field and 64 distant scenes, seed {}, scrambled Sobol\n{}\n{first}",
            self.compared.heading("diagnosis"),
            self.seed,
            floor_line(&self.floor, self.captures)
        )
    }

    fn table(&self) -> Table {
        let row = |diagnosis: &Diagnosis, finding: &Finding| {
            let ends =
                |interval: Option<[f64; 2]>| [0, 1].map(|end| Cell::from(interval.map(|ends| ends[end])));
            let [low, high] = ends(finding.interval95);
            let [share_low, share_high] = ends(finding.share_interval95);
            vec![
                diagnosis.prediction.as_str().into(),
                finding.hypothesis.name().into(),
                cell(&finding.value),
                finding.unit.into(),
                finding.loss.into(),
                low,
                high,
                finding.share.into(),
                share_low,
                share_high,
                finding.p.into(),
                finding.marked.into(),
                finding.statement(self.names(diagnosis)).into(),
            ]
        };
        let all = self.diagnoses.iter();
        Table::new(
            COLUMNS,
            all.flat_map(|diagnosis| diagnosis.findings.iter().map(move |f| row(diagnosis, f))),
        )
    }
}

#[derive(Serialize)]
struct DiagnoseJson<'a> {
    #[serde(flatten)]
    compared: &'a Compared,
    seed: u64,
    floor: Estimate,
    captures: Option<usize>,
    seams: &'a [Seam],
    predictions: Vec<DiagnosisEntry<'a>>,
}

#[derive(Serialize)]
struct DiagnosisEntry<'a> {
    prediction: &'a str,
    sentence: String,
    loss: Estimate,
    /// Whether the loss is above the floor.
    resolvable: bool,
    explained: Option<f64>,
    findings: Vec<FindingEntry<'a>>,
    ladder: &'a [Rung],
    seams: &'a [Seam],
}

impl Serialize for DiagnoseReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        DiagnoseJson {
            compared: &self.compared,
            seed: self.seed,
            floor: self.floor,
            captures: self.captures,
            seams: &self.seams,
            predictions: self.diagnoses.iter().map(|diagnosis| self.entry(diagnosis)).collect(),
        }
        .serialize(serializer)
    }
}

/// A finding, and what `--read` takes to correct the reading: `name:normal-y=down`.
#[derive(Serialize)]
struct FindingEntry<'a> {
    #[serde(flatten)]
    finding: &'a Finding,
    remedy: Option<String>,
}

impl<'a> FindingEntry<'a> {
    fn new(finding: &'a Finding, names: [&str; 2]) -> Self {
        Self { finding, remedy: finding.statement(names) }
    }
}
