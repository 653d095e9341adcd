//! `svbrdf worst`: the scene with the largest loss.

use serde::Serialize;
use svbrdf::error::Error;
use svbrdf::loss::ALL_SCENES_TARGET;
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::model::scene::Scene;
use svbrdf::report::table::aligned;
use svbrdf::why::{Worst, worst};

use super::args::{ComparisonArgs, Given};
use super::job::ComparisonJob;
use super::output::table::{kind_name, triple};
use super::output::{CommandError, exit, table, target, watched};
use super::report::ReportFormat;

/// Searches for the scene with the largest loss of each prediction
///
/// Samples 6,144 of the scenes that the loss is over, then refines the 16 worst. The search compares up to 1,024 texels; the
/// printed loss is over all. The mean is the loss over all scenes, to +-1% where 49,152 scenes are enough. The JSON is a scene file
/// that `--scenes` takes. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct WorstArgs {
    /// Seed of the scenes that the search starts from
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = 0)]
    seed: u64,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the worst scenes to stdout.
///
/// # Errors
/// Where a material cannot be read or used; with `--strict` where a mean is known less well, after the results are printed.
pub fn run(args: &WorstArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let opened = job.materials.open::<f32>()?;
    let one = |prediction: &Material<f32>| {
        watched("searching", |progress| {
            worst(&opened.ground_truth, prediction, &job.convention, args.seed, progress)
        })
    };
    let found = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    exit::put(&match args.format {
        ReportFormat::Text => text(&found, &opened.ground_truth, &job.convention),
        ReportFormat::Json => json(&found, &opened.ground_truth, &job.convention)?,
        ReportFormat::Csv => csv(&found)?,
    })?;
    let missed = |worst: &Worst| {
        let Worst { prediction, mean, mean_scenes, .. } = worst;
        target::missed(ALL_SCENES_TARGET, &format!("the mean of {prediction}"), mean, *mean_scenes)
    };
    target::warn_of(found.iter().filter_map(missed), job.materials.strict)
}

fn is_reached(worst: &Worst) -> bool {
    worst.mean.relative_error95() <= ALL_SCENES_TARGET
}

fn text(found: &[Worst], ground_truth: &Material<f32>, convention: &Convention) -> String {
    let titles = ["prediction", "worst", "mean", "times the mean", "kind", "view", "light", "evaluations"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(found.iter().map(|worst| {
        let Scene { kind, view, light } = worst.scene;
        vec![
            worst.prediction.clone(),
            format!("{:.6}", worst.loss),
            format!("{:.6}", worst.mean.mean),
            if worst.mean.mean > 0.0 {
                format!("{:.2}", worst.loss / worst.mean.mean)
            } else {
                "-".to_owned()
            },
            kind_name(kind).to_owned(),
            triple(view),
            triple(light),
            worst.evaluations.to_string(),
        ]
    }));
    format!("{}\n{}", table::heading("worst scenes", ground_truth, convention), aligned(&rows))
}

fn csv(found: &[Worst]) -> Result<String, Error> {
    let heading = [
        "prediction",
        "worst",
        "mean",
        "kind",
        "view_x",
        "view_y",
        "view_z",
        "light_x",
        "light_y",
        "light_z",
        "evaluations",
        "target_reached",
    ];
    let row = |worst: &Worst| {
        let Scene { kind, view, light } = worst.scene;
        let start = [
            worst.prediction.clone(),
            worst.loss.to_string(),
            worst.mean.mean.to_string(),
            kind_name(kind).to_owned(),
        ];
        let place = view.into_iter().chain(light).map(|c| c.to_string());
        start
            .into_iter()
            .chain(place)
            .chain([worst.evaluations.to_string(), is_reached(worst).to_string()])
            .collect()
    };
    table::csv([heading.map(str::to_owned).to_vec()].into_iter().chain(found.iter().map(row)))
}

/// A scene file, too: scene k is the worst of prediction k.
#[derive(Serialize)]
struct WorstJson<'a> {
    ground_truth: &'a str,
    convention: &'a str,
    epsilon: f64,
    results: Vec<WorstEntry<'a>>,
    scenes: Vec<Scene>,
}

#[derive(Serialize)]
struct WorstEntry<'a> {
    prediction: &'a str,
    worst: f64,
    /// The loss over all scenes.
    mean: f64,
    interval95: Option<[f64; 2]>,
    /// Of the mean.
    target_error: f64,
    target_reached: bool,
    evaluations: usize,
}

fn json(found: &[Worst], ground_truth: &Material<f32>, convention: &Convention) -> Result<String, Error> {
    let results = found.iter().map(|worst| WorstEntry {
        prediction: &worst.prediction,
        worst: worst.loss,
        mean: worst.mean.mean,
        interval95: worst.mean.interval95,
        target_error: ALL_SCENES_TARGET,
        target_reached: is_reached(worst),
        evaluations: worst.evaluations,
    });
    table::json(&WorstJson {
        ground_truth: ground_truth.name(),
        convention: convention.name,
        epsilon: convention.epsilon,
        results: results.collect(),
        scenes: found.iter().map(|worst| worst.scene).collect(),
    })
}
