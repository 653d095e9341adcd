//! `svbrdf blame`: how much of a loss comes from each map.

use std::path::PathBuf;

use serde::Serialize;
use svbrdf::error::Error;
use svbrdf::loss::Request;
use svbrdf::material::{Map, Material};
use svbrdf::model::convention::Convention;
use svbrdf::model::scene_file;
use svbrdf::report::table::{aligned, scenes_line};
use svbrdf::why::{Attribution, MapShare, attribute};

use super::args::{ComparisonArgs, Given, values};
use super::job::ComparisonJob;
use super::output::{CommandError, exit, table, target, watched};
use super::report::{EstimateEntry, ReportFormat};

/// Prints how much of the rendering loss comes from each map
///
/// Renders all 16 mixtures of the maps of the ground truth and of the prediction in the same scenes on the same texels. The Shapley
/// value of a map is the mean of what it adds to the loss over all orders in which the maps can become wrong; the four
/// values add up to the loss. Beside them stands the loss where only this map is wrong, and where only this map is right. A share
/// below 0%: the error of this map hides errors of others. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct BlameArgs {
    /// Samples as many scenes as this relative error of the loss needs at 95% confidence, at most 49,152
    #[arg(long, value_name = "PERCENT", value_parser = values::percent, allow_hyphen_values = true, default_value = "1%")]
    target_error: f64,

    /// Seed of the sampled scenes
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 0)]
    seed: u64,

    /// Uses the scenes of a JSON file instead of sampled ones, or those of a MaterialGAN capture (render.json)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["target_error", "seed"])]
    scenes: Option<PathBuf>,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the attributions to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used; with `--strict` where the target error is not reached, after the results
/// are printed.
pub fn run(args: &BlameArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let request = match &args.scenes {
        Some(path) => Request::Listed(scene_file::read(path)?),
        None => Request::Accuracy { target: args.target_error, seed: args.seed },
    };
    let opened = job.materials.open::<f32>()?;
    let one = |prediction: &Material<f32>| {
        watched("rendering", |progress| {
            attribute(&opened.ground_truth, prediction, &job.convention, &request, progress)
        })
    };
    let attributions = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let target = args.scenes.is_none().then_some(args.target_error);
    exit::put(&match args.format {
        ReportFormat::Text => {
            let one = |a| text(a, &opened.ground_truth, &job.convention);
            attributions.iter().map(one).collect::<Vec<_>>().join("\n")
        }
        ReportFormat::Json => json(&attributions, &opened.ground_truth, &job.convention, target)?,
        ReportFormat::Csv => csv(&attributions, target)?,
    })?;
    let missed = |a: &Attribution| target::missed(target?, &a.prediction, &a.loss, a.scenes.len());
    target::warn_of(attributions.iter().filter_map(missed), job.materials.strict)
}

/// Whether the loss is known as well as the target error asks for.
fn is_reached(attribution: &Attribution, target: f64) -> bool {
    attribution.loss.relative_error95() <= target
}

fn text(attribution: &Attribution, ground_truth: &Material<f32>, convention: &Convention) -> String {
    let Attribution { prediction, sampling, scenes, loss, maps } = attribution;
    let heading = table::heading(&format!("blame of {prediction}"), ground_truth, convention);
    let mut rows = vec![
        ["map", "share", "of the loss", "+- std. error", "95% interval", "only it wrong", "only it right"]
            .map(str::to_owned)
            .to_vec(),
    ];
    rows.extend(maps.iter().map(|share| {
        let [mean, error, interval] = share.shapley.texts();
        let share_of_loss = percent(share.shapley.mean, loss.mean);
        let [wrong, right] = [share.only_wrong, share.only_right].map(|e| format!("{:.6}", e.mean));
        vec![share.map.name().to_owned(), share_of_loss, mean, error, interval, wrong, right]
    }));
    let [mean, error, interval] = loss.texts();
    rows.push(vec!["all".to_owned(), percent(loss.mean, loss.mean), mean, error, interval]);
    let scenes = scenes_line(sampling.as_ref(), scenes, ground_truth.size());
    let note = attribution.note().map_or(String::new(), |note| format!("\n{note}\n"));
    format!("{heading}{scenes}\n{}{note}", aligned(&rows))
}

fn percent(part: f64, whole: f64) -> String {
    if whole > 0.0 { format!("{:.1}%", 100.0 * part / whole) } else { "-".to_owned() }
}

fn csv(attributions: &[Attribution], target: Option<f64>) -> Result<String, Error> {
    let heading = [
        "prediction",
        "map",
        "shapley",
        "standard_error",
        "interval95_low",
        "interval95_high",
        "only_wrong",
        "only_right",
        "loss",
        "target_error",
        "target_reached",
    ];
    let row = |a: &Attribution, share: &MapShare| {
        let [error, low, high] = table::errors(&share.shapley);
        let numbers = [share.only_wrong.mean, share.only_right.mean, a.loss.mean].map(|x| x.to_string());
        let start = [
            a.prediction.clone(),
            share.map.name().to_owned(),
            share.shapley.mean.to_string(),
            error,
            low,
            high,
        ];
        let error = target.map_or(String::new(), |target| target.to_string());
        let reached = target.map_or(String::new(), |target| is_reached(a, target).to_string());
        start.into_iter().chain(numbers).chain([error, reached]).collect()
    };
    let rows = attributions.iter().flat_map(|a| a.maps.iter().map(move |share| row(a, share)));
    table::csv([heading.map(str::to_owned).to_vec()].into_iter().chain(rows))
}

#[derive(Serialize)]
struct BlameJson<'a> {
    ground_truth: &'a str,
    convention: &'a str,
    epsilon: f64,
    target_error: Option<f64>,
    attributions: Vec<BlameEntry<'a>>,
}

#[derive(Serialize)]
struct BlameEntry<'a> {
    prediction: &'a str,
    scenes: usize,
    seed: Option<u64>,
    target_reached: Option<bool>,
    loss: EstimateEntry,
    maps: Vec<Share>,
}

#[derive(Serialize)]
struct Share {
    map: Map,
    shapley: EstimateEntry,
    only_wrong: EstimateEntry,
    only_right: EstimateEntry,
}

fn json(
    attributions: &[Attribution],
    ground_truth: &Material<f32>,
    convention: &Convention,
    target: Option<f64>,
) -> Result<String, Error> {
    let share = |s: &MapShare| Share {
        map: s.map,
        shapley: s.shapley.into(),
        only_wrong: s.only_wrong.into(),
        only_right: s.only_right.into(),
    };
    let entries = attributions.iter().map(|a| BlameEntry {
        prediction: &a.prediction,
        scenes: a.scenes.len(),
        seed: a.sampling.map(|sampling| sampling.seed),
        target_reached: target.map(|target| is_reached(a, target)),
        loss: a.loss.into(),
        maps: a.maps.iter().map(share).collect(),
    });
    table::json(&BlameJson {
        ground_truth: ground_truth.name(),
        convention: convention.name,
        epsilon: convention.epsilon,
        target_error: target,
        attributions: entries.collect(),
    })
}
