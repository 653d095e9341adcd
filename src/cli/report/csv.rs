//! One table for spreadsheets (RFC 4180, with a heading); an unknown value is an empty cell.

use std::io;

use svbrdf::loss::Loss;
use svbrdf::model::scene::Kind;

use super::printed::Printed;

const HEADING: [&str; 21] = [
    "prediction",
    "loss",
    "standard_error",
    "interval95_low",
    "interval95_high",
    "convention",
    "epsilon",
    "width",
    "height",
    "near",
    "distant",
    "seed",
    "sampler",
    "texels",
    "precision",
    "backend",
    "target_error",
    "target_reached",
    "path",
    "ground_truth",
    "ground_truth_path",
];

pub(super) fn write(printed: &Printed) -> io::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(HEADING)?;
    let common = common(printed);
    for (loss, path) in printed.report.outcome.losses.iter().zip(printed.prediction_paths()) {
        let ground_truth = [&*printed.report.ground_truth, printed.ground_truth_path().unwrap_or_default()];
        let names = [path.unwrap_or_default()].into_iter().chain(ground_truth);
        let cells = cells(loss).into_iter().chain(common.clone());
        writer.write_record(cells.chain(names.map(str::to_owned)))?;
    }
    let bytes = writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// The cells that are the same in every row.
fn common(printed: &Printed) -> [String; 13] {
    let report = &printed.report;
    let [width, height] = report.size;
    [
        report.convention.name.to_owned(),
        report.convention.epsilon.to_string(),
        width.to_string(),
        height.to_string(),
        report.count(Kind::Near).to_string(),
        report.count(Kind::Distant).to_string(),
        or_empty(report.seed()),
        or_empty(report.sampler()),
        report.texels().to_string(),
        report.precision.to_owned(),
        report.backend.to_owned(),
        or_empty(printed.target().map(|(error, _)| error)),
        or_empty(printed.target().map(|(_, reached)| reached)),
    ]
}

fn or_empty(value: Option<impl ToString>) -> String {
    value.map_or(String::new(), |value| value.to_string())
}

/// The prediction and its loss.
fn cells(loss: &Loss) -> [String; 5] {
    let estimate = &loss.estimate;
    let (low, high) = (estimate.interval95.map(|i| i[0]), estimate.interval95.map(|i| i[1]));
    let [mean, error, low, high] = [Some(estimate.mean), estimate.standard_error, low, high].map(or_empty);
    [loss.prediction.clone(), mean, error, low, high]
}
