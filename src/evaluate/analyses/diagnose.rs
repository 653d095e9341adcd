//! Report of what might explain each loss.

use serde::Serialize;

use crate::diagnose::{self, Finding, Value, diagnose, floor, sentence};
use crate::error::Error;
use crate::report::{
    Analysis, AnalysisInput, Cell, Compared, Field, NoOptions, Reader, Report, Table, floor_line,
};
use svbrdf_core::loss::Estimate;
use svbrdf_core::progress::Progress;

/// The diagnosis of each prediction: docs/diagnose.md describes each line.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DiagnoseReport {
    #[serde(flatten)]
    compared: Compared,
    seed: u64,
    /// The loss that the ground truth cannot resolve.
    floor: Estimate,
    /// One per prediction.
    predictions: Vec<Diagnosis>,
}

/// What might explain the loss of a prediction.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
}

/// The loss under a hypothesis, such as another exposure or another direction of y.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "Finding"))]
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
    /// The report of `diagnoses` beside a `floor`.
    fn new(compared: Compared, seed: u64, floor: Estimate, diagnoses: Vec<diagnose::Diagnosis>) -> Self {
        let predictions = diagnoses.into_iter().map(|one| Diagnosis::new(one, &compared, &floor)).collect();
        Self { compared, seed, floor, predictions }
    }

    fn text_of(diagnosis: &Diagnosis) -> String {
        let [mean, _, interval] = diagnosis.loss.texts();
        format!(
            "{}\n\n{}: loss {mean}, 95% {interval}\n\n{}",
            diagnosis.sentence,
            diagnosis.prediction,
            Table::fields(&fields(), diagnosis.rows(), Reader::Person).text(),
        )
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
        ("loss", "loss", |(_, one)| one.finding.loss.into()),
        ("interval95_low interval95_high", "95% interval", |(_, one)| Cell::or(one.finding.interval95, "-")),
        ("share", "share", |(_, one)| Cell::Share(one.finding.share)),
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
        }
    }
}

/// A number, a list of them in brackets, or a name.
fn cell(value: &Value) -> Cell {
    match value {
        Value::Number(number) => (*number).into(),
        Value::Numbers(numbers) | Value::Placement(numbers) => format!("{numbers:?}").into(),
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
            floor_line(&self.floor)
        )
    }

    fn text(&self) -> String {
        let texts: Vec<String> = self.predictions.iter().map(Self::text_of).collect();
        format!("{}\n{}", self.heading(), texts.join("\n"))
    }

    fn table(&self, reader: Reader) -> Table {
        let rows = self.predictions.iter().flat_map(Diagnosis::rows);
        Table::fields(&fields(), rows, reader)
    }
}

impl Analysis for DiagnoseReport {
    const NAME: &'static str = "diagnose";
    const ANSWERS: &'static str = "whether exposure, alignment or reading explain the loss";
    const ABOUT: &'static str = "Prints what an exposure, a shift, a symmetry or another reading of the files would lower the loss to";
    const DETAILS: &'static str = "Each hypothesis is fitted in the scenes of a pilot and evaluated in 3,072 others. A star marks those \
        that lower the loss significantly, and by at least 10% beside the other marked ones. The last column has the option that corrects \
        the reading. Losses below the floor, which the ground truth cannot resolve, have no mark. docs/diagnose.md describes each line.";
    const EXAMPLE: &'static str = "\
        >>> import svbrdf
        >>> ground_truth, _, _ = svbrdf.built_in()
        >>> maps = {name: getattr(ground_truth, name) for name in (\"diffuse\", \"specular\", \"roughness\")}
        >>> flipped = svbrdf.Material(normal=ground_truth.normal * [1, -1, 1], **maps)
        >>> findings = svbrdf.diagnose(ground_truth, flipped).predictions[0].findings
        >>> [finding.hypothesis for finding in findings if finding.marked]
        ['normal_y']";
    const DOING: &'static str = "diagnosing";
    const SCENES: &'static [&'static str] = &["seed"];
    type Options = NoOptions;

    fn run(input: &AnalysisInput<'_>, _: &NoOptions, progress: &Progress) -> Result<Self, Error> {
        let AnalysisInput { ground_truth, predictions, storages, convention, .. } = input;
        let (of_truth, seed) = (storages[0], input.seed());
        let floor = floor(ground_truth, of_truth, convention, seed, progress)?;
        let one = |(prediction, storage): (&&_, &&_)| {
            let (pair, storages) = ([*ground_truth, *prediction], [of_truth, *storage]);
            Ok(diagnose(pair, storages, convention, floor.mean, seed, progress)?)
        };
        let diagnoses = predictions.iter().zip(&storages[1..]).map(one).collect::<Result<_, Error>>()?;
        Ok(Self::new(input.compared(), seed, floor, diagnoses))
    }
}
