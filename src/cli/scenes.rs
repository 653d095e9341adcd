//! `svbrdf scenes`: the scenes with the largest losses.

use svbrdf::error::Error;
use svbrdf::loss::{Comparison, Outcome};
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::model::scene::Scene;
use svbrdf::report::table::{aligned, scenes_line};
use svbrdf::why::{Distribution, RankedScene, SceneReport, worst_first};

use super::args::scenes::SceneArgs;
use super::args::{ComparisonArgs, Given};
use super::job::ComparisonJob;
use super::output::table::{kind_name, triple};
use super::output::{CommandError, exit, table, watched};
use super::report::ReportFormat;

/// Prints the scenes with the largest losses, worst first
///
/// Scenes are sorted by the mean of the losses of all predictions in them, over all texels. The JSON is a scene file that
/// `--scenes` takes. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct ScenesArgs {
    /// Number of scenes that are printed
    #[arg(long, value_name = "N", default_value_t = 10)]
    top: usize,

    #[command(flatten)]
    scenes: SceneArgs,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the scenes to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used.
pub fn run(args: &ScenesArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let request = args.scenes.request()?;
    let opened = job.materials.open::<f32>()?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, job.convention)?.without_pilot();
    let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
    let mut ranked = worst_first(&outcome);
    ranked.truncate(args.top);
    Ok(exit::put(&match args.format {
        ReportFormat::Text => text(&outcome, &ranked, &opened.ground_truth, &job.convention),
        ReportFormat::Json => {
            let name = opened.ground_truth.name();
            table::json(&SceneReport::new(name, &job.convention, &outcome, &ranked))?
        }
        ReportFormat::Csv => csv(&outcome, &ranked)?,
    })?)
}

fn text(
    outcome: &Outcome,
    ranked: &[RankedScene],
    ground_truth: &Material<f32>,
    convention: &Convention,
) -> String {
    let heading = table::heading("losses of scenes", ground_truth, convention);
    let scenes = scenes_line(outcome.sampling.as_ref(), &outcome.scenes, ground_truth.size());
    let distributions: String = outcome
        .losses
        .iter()
        .filter_map(|loss| Some(line(&loss.prediction, &Distribution::of(&loss.per_scene)?)))
        .collect();
    let names = outcome.losses.iter().map(|loss| loss.prediction.clone());
    let titles = ["scene", "kind", "view", "light"].map(str::to_owned);
    let mut rows = vec![titles.into_iter().chain(names).collect::<Vec<_>>()];
    rows.extend(ranked.iter().map(|ranked| {
        let Scene { kind, view, light } = ranked.scene;
        let start = [ranked.index.to_string(), kind_name(kind).to_owned(), triple(view), triple(light)];
        start.into_iter().chain(ranked.losses.iter().map(|loss| format!("{loss:.6}"))).collect()
    }));
    format!("{heading}{scenes}\n{distributions}\n{}", aligned(&rows))
}

fn line(prediction: &str, d: &Distribution) -> String {
    let Distribution { least, median, percentile95, largest, worst_tenth } = d;
    format!(
        "{prediction}: from {least:.3} to {largest:.3}, median {median:.3}, 95th percentile {percentile95:.3}; \
         the worst tenth of the scenes adds {:.0}% of the loss\n",
        100.0 * worst_tenth
    )
}

fn csv(outcome: &Outcome, ranked: &[RankedScene]) -> Result<String, Error> {
    let fixed = ["scene", "kind", "view_x", "view_y", "view_z", "light_x", "light_y", "light_z"];
    let names = outcome.losses.iter().map(|loss| loss.prediction.clone());
    let heading: Vec<String> = fixed.map(str::to_owned).into_iter().chain(names).collect();
    let row = |ranked: &RankedScene| {
        let Scene { kind, view, light } = ranked.scene;
        let numbers = view.iter().chain(&light).chain(&ranked.losses).map(ToString::to_string);
        [ranked.index.to_string(), kind_name(kind).to_owned()].into_iter().chain(numbers).collect()
    };
    table::csv([heading].into_iter().chain(ranked.iter().map(row)))
}
