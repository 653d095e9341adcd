//! The rows of a loss report: one per prediction.

use super::loss::LossReport;
use super::table::{Cell, Table};
use crate::loss::{Loss, Texels};
use crate::model::scene::Kind;

const COLUMNS: [&str; 26] = [
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
    "few_scenes_loss",
    "few_scenes_low",
    "few_scenes_high",
    "step",
];

pub(super) fn table(report: &LossReport) -> Table {
    let common = common(report);
    let row = |(index, loss): (usize, &Loss)| {
        let [error, low, high] = Cell::errors(&loss.estimate);
        let start = [loss.prediction.as_str().into(), loss.estimate.mean.into(), error, low, high];
        let end = [
            report.prediction_path(index).into(),
            report.ground_truth.as_str().into(),
            report.ground_truth_path().into(),
            report.outcome.interval_source().to_string().into(),
        ];
        let few_scenes = few_scenes(report.few_scenes_loss(index));
        let step = [report.step(index).into()];
        start.into_iter().chain(common.clone()).chain(end).chain(few_scenes).chain(step).collect()
    };
    Table::new(COLUMNS, report.outcome.losses.iter().enumerate().map(row))
}

/// The cells that are the same in every row.
fn common(report: &LossReport) -> [Cell; 13] {
    let [width, height] = report.size;
    [
        report.convention.name.into(),
        report.convention.epsilon.into(),
        width.into(),
        height.into(),
        report.count(Kind::Near).into(),
        report.count(Kind::Distant).into(),
        report.seed().into(),
        report.sampler().map(|sampler| sampler.to_string()).into(),
        match report.texels() {
            Texels::Sampled(count) => count.into(),
            Texels::All => "all".into(),
        },
        report.precision.into(),
        report.backend.into(),
        report.target_error.into(),
        report.target_reached().into(),
    ]
}

/// The loss over few scenes and its interval, empty where there is none.
fn few_scenes(loss: Option<&Loss>) -> [Cell; 3] {
    let interval = loss.and_then(|loss| loss.estimate.interval95);
    [loss.map(|loss| loss.estimate.mean), interval.map(|i| i[0]), interval.map(|i| i[1])].map(Cell::from)
}
