//! One table for spreadsheets (RFC 4180, with a heading); an unknown value is an empty cell.

use std::io;

use svbrdf::loss::Loss;
use svbrdf::model::scene::Kind;

use super::printed::Printed;

const HEADING: [&str; 26] = [
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
    "interval95_from",
    "all_scenes_loss",
    "all_scenes_low",
    "all_scenes_high",
    "step",
];

pub(super) fn write(printed: &Printed) -> io::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(HEADING)?;
    let common = common(printed);
    let outcome = &printed.report.outcome;
    for (index, (loss, path)) in outcome.losses.iter().zip(printed.prediction_paths()).enumerate() {
        let ground_truth = [&*printed.report.ground_truth, printed.ground_truth_path().unwrap_or_default()];
        let names = [path.unwrap_or_default()].into_iter().chain(ground_truth);
        let cells = cells(loss).into_iter().chain(common.clone());
        let source = [outcome.interval_source().to_string()];
        let added =
            source.into_iter().chain(all_scenes(printed, index)).chain([or_empty(printed.step(index))]);
        writer.write_record(cells.chain(names.map(str::to_owned)).chain(added))?;
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

/// The loss of a prediction over all scenes and its interval, empty where options choose scenes.
fn all_scenes(printed: &Printed, index: usize) -> [String; 3] {
    let known = printed.report.all_scenes.as_ref().map(|known| known.losses[index].estimate);
    let interval = known.and_then(|estimate| estimate.interval95);
    [known.map(|e| e.mean), interval.map(|i| i[0]), interval.map(|i| i[1])].map(or_empty)
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
