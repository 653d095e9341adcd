//! Many predictions of one ground truth.

use serde::Serialize;
use svbrdf::error::Error;
use svbrdf::loss::{Comparison, Outcome, Request};
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::rank::{Ranked, most_scenes, places};
use svbrdf::report::table::{aligned, scenes_line};

use super::args::{RankArgs, RankFormat, check_limit};
use crate::cli::args::{Given, modes, wildcards};
use crate::cli::job::ComparisonJob;
use crate::cli::output::{CommandError, exit, latex, table, target, watched};
use crate::cli::report::EstimateEntry;

pub fn run(mut args: RankArgs, given: &Given) -> Result<(), CommandError> {
    given.check(&modes::RANK_PREDICTIONS)?;
    args.comparison.materials.predictions = wildcards::expanded(&args.comparison.materials.predictions)?;
    args.comparison.materials.expand_steps()?;
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let opened = job.materials.open::<f32>()?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, job.convention)?
        .at_most(most_scenes(predictions.len()));
    let request = Request::Accuracy { target: args.target_error, seed: args.seed };
    let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
    let places = places(&outcome);
    exit::put(&match args.format {
        RankFormat::Text => text(&outcome, &places, &opened.ground_truth, &job.convention),
        RankFormat::Json => {
            json(&outcome, &places, &opened.ground_truth, &job.convention, args.target_error)?
        }
        RankFormat::Csv => csv(&outcome, &places, args.target_error)?,
        RankFormat::Latex => latex_table(&outcome, &places),
    })?;
    let missed = target::missed_by_any(args.target_error, &outcome);
    target::warn_of(missed, job.materials.strict)?;
    check_limit(args.fail_above, outcome.losses.iter().map(|l| (l.prediction.clone(), l.estimate.mean)))
}

fn text(
    outcome: &Outcome,
    places: &[Ranked],
    ground_truth: &Material<f32>,
    convention: &Convention,
) -> String {
    let titles = ["prediction", "loss", "95% interval", "- best", "95% interval", "group"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(places.iter().map(|place| {
        let loss = &outcome.losses[place.index];
        let [mean, _, interval] = loss.estimate.texts();
        let [difference, _, of_difference] =
            place.to_best.map_or_else(|| [const { String::new() }; 3], |estimate| estimate.texts());
        vec![loss.prediction.clone(), mean, interval, difference, of_difference, place.group.to_string()]
    }));
    let heading = table::heading("rendering loss", ground_truth, convention);
    let scenes = scenes_line(outcome.sampling.as_ref(), &outcome.scenes, ground_truth.size());
    format!("{heading}{scenes}\n{}", aligned(&rows))
}

fn csv(outcome: &Outcome, places: &[Ranked], target: f64) -> Result<String, Error> {
    let heading = [
        "place",
        "prediction",
        "loss",
        "standard_error",
        "interval95_low",
        "interval95_high",
        "to_best",
        "to_best_low",
        "to_best_high",
        "group",
        "target_reached",
    ];
    let row = |(number, place): (usize, &Ranked)| {
        let loss = &outcome.losses[place.index];
        let [error, low, high] = table::errors(&loss.estimate);
        let difference = place.to_best.map_or(String::new(), |estimate| estimate.mean.to_string());
        let [_, to_low, to_high] =
            place.to_best.as_ref().map_or_else(|| [const { String::new() }; 3], table::errors);
        let start = [(number + 1).to_string(), loss.prediction.clone(), loss.estimate.mean.to_string()];
        let reached = loss.estimate.relative_error95() <= target;
        let rest =
            [error, low, high, difference, to_low, to_high, place.group.to_string(), reached.to_string()];
        start.into_iter().chain(rest).collect()
    };
    table::csv([heading.map(str::to_owned).to_vec()].into_iter().chain(places.iter().enumerate().map(row)))
}

fn latex_table(outcome: &Outcome, places: &[Ranked]) -> String {
    let row = |place: &Ranked| {
        let loss = &outcome.losses[place.index];
        let [low, high] = loss.estimate.interval95.unwrap_or([f64::NAN; 2]);
        let mean = latex::bold(&format!("{:.4}", loss.estimate.mean), place.group == 1);
        format!("{} & {mean} & [{low:.4}, {high:.4}] \\\\\n", latex::escaped(&loss.prediction))
    };
    let rows: String = places.iter().map(row).collect();
    latex::table("lrl", "Prediction & Loss & 95\\% interval", &rows)
}

#[derive(Serialize)]
struct RankingJson<'a> {
    ground_truth: &'a str,
    convention: &'a str,
    epsilon: f64,
    scenes: usize,
    seed: Option<u64>,
    target_error: f64,
    /// By every prediction.
    target_reached: bool,
    /// Best first.
    ranking: Vec<RankingEntry<'a>>,
}

#[derive(Serialize)]
struct RankingEntry<'a> {
    prediction: &'a str,
    loss: EstimateEntry,
    /// The loss - the loss of the best prediction, over the same scenes.
    to_best: Option<EstimateEntry>,
    group: usize,
}

fn json(
    outcome: &Outcome,
    places: &[Ranked],
    ground_truth: &Material<f32>,
    convention: &Convention,
    target: f64,
) -> Result<String, Error> {
    let entry = |place: &Ranked| RankingEntry {
        prediction: &outcome.losses[place.index].prediction,
        loss: outcome.losses[place.index].estimate.into(),
        to_best: place.to_best.map(EstimateEntry::from),
        group: place.group,
    };
    table::json(&RankingJson {
        ground_truth: ground_truth.name(),
        convention: convention.name,
        epsilon: convention.epsilon,
        scenes: outcome.scenes.len(),
        seed: outcome.sampling.map(|sampling| sampling.seed),
        target_error: target,
        target_reached: outcome.relative_error95() <= target,
        ranking: places.iter().map(entry).collect(),
    })
}
