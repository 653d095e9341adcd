//! Methods over many materials.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use svbrdf::dataset::{
    self, Case, DatasetReading, DatasetResults, DatasetSettings, MaterialResult, MethodSummary, Pick,
    PredictionResult, cases_of_folders, cases_of_table, summarize,
};
use svbrdf::error::Error;
use svbrdf::report::distinct_names;
use svbrdf::report::table::aligned;

use super::args::{RankArgs, RankFormat, check_limit};
use super::metric_columns::{self, MetricEntry};
use crate::cli::args::{ComparisonArgs, Given, modes, wildcards};
use crate::cli::output::{CommandError, exit, latex, table, target, watched};

pub fn run(args: &RankArgs, given: &Given) -> Result<(), CommandError> {
    let (settings, results) = if args.merge { merged(args, given)? } else { evaluated(args, given)? };
    for (material, prediction, problem) in failures(&results) {
        exit::tell(&format!("note: {material}, {prediction}: {problem}"));
    }
    let summaries = summarize(&settings.methods, &results, args.pick);
    exit::put(&match args.format {
        RankFormat::Text => {
            let table = text(&settings, &results, &summaries, args.pick);
            table + &metric_columns::text(&summaries, &results, args.pick)
        }
        RankFormat::Json => table::json(&DatasetJson::new(&settings, &results, &summaries, args.pick))?,
        RankFormat::Csv => csv(&results)?,
        RankFormat::Latex => {
            latex_table(&summaries) + &metric_columns::latex(&summaries, &results, args.pick)
        }
    })?;
    target::warn_of(missed(&settings, &results), args.comparison.materials.reading.both.strict)?;
    check_limit(args.fail_above, summaries.into_iter().map(|summary| (summary.method, summary.mean)))
}

/// The results of the journals that stand for GT and PRED.
fn merged(args: &RankArgs, given: &Given) -> Result<(DatasetSettings, Vec<MaterialResult>), CommandError> {
    given.check(&modes::RANK_MERGE)?;
    let paths: Vec<PathBuf> = args.comparison.materials.paths().cloned().collect();
    Ok(dataset::merged(&wildcards::expanded(&paths)?)?)
}

/// The errors of predictions whose loss is not known as well as the target error asks for.
fn missed(settings: &DatasetSettings, results: &[MaterialResult]) -> Vec<Error> {
    let of = |result: &MaterialResult, prediction: &PredictionResult| {
        let known = prediction.result.as_ref().ok()?;
        let name = format!("{}, {}", result.material, prediction.method);
        target::missed(settings.target_error, &name, &known.estimate(), result.scenes)
    };
    let all = results.iter().flat_map(|result| result.predictions.iter().filter_map(|p| of(result, p)));
    all.collect()
}

/// The predictions without a loss: material, method and what is wrong.
fn failures(results: &[MaterialResult]) -> impl Iterator<Item = (&str, &str, &str)> {
    results.iter().flat_map(|result| {
        let failed = result.predictions.iter().filter_map(|p| Some((p, p.result.as_ref().err()?)));
        failed.map(|(p, problem)| (result.material.as_str(), p.method.as_str(), problem.as_str()))
    })
}

fn evaluated(args: &RankArgs, given: &Given) -> Result<(DatasetSettings, Vec<MaterialResult>), CommandError> {
    given.check(&modes::RANK_DATA_SET)?;
    let cases = cases(args)?;
    let ComparisonArgs { convention, materials } = &args.comparison;
    let convention = convention.unwrap_or_default();
    let settings = DatasetSettings::new(convention.name, args.target_error, args.seed, &cases)
        .with_metrics(args.metrics);
    let cases = args.shard.map_or(cases.clone(), |shard| shard.part(cases));
    let reading = DatasetReading {
        ground_truths: materials.reading.of_ground_truth(),
        predictions: materials.reading.of_predictions(),
        strict: materials.reading.both.strict,
    };
    let DatasetResults { results, recomputed } = watched("comparing materials", |progress| {
        dataset::run(&cases, &settings, &reading, args.journal.as_deref(), progress)
    })?;
    recomputed.iter().for_each(|recomputed| exit::tell(&format!("note: {recomputed}")));
    Ok((settings, results))
}

fn cases(args: &RankArgs) -> Result<Vec<Case>, CommandError> {
    let Some(ground_truth) = &args.comparison.materials.ground_truth else {
        return Err(CommandError::usage("give a folder of ground truths, or a table of pairs"));
    };
    if args.pairs {
        return match args.comparison.materials.predictions.as_slice() {
            [] => Ok(cases_of_table(ground_truth)?),
            _ => Err(CommandError::usage("--pairs takes one CSV table, which names the predictions")),
        };
    }
    let folders = wildcards::expanded(&args.comparison.materials.predictions)?;
    if folders.is_empty() {
        return Err(CommandError::Usage(format!(
            "there is no method to compare with {}; give one or more folders",
            ground_truth.display()
        )));
    }
    let named: Vec<(String, &Path)> = folders.iter().map(|path| (name(path), path.as_path())).collect();
    let named: Vec<(&str, &Path)> = named.iter().map(|(name, path)| (name.as_str(), *path)).collect();
    let names = distinct_names(&named);
    let methods: Vec<(String, PathBuf)> = names.into_iter().zip(folders.iter().cloned()).collect();
    Ok(cases_of_folders(ground_truth, &methods)?)
}

fn name(folder: &Path) -> String {
    folder
        .file_name()
        .map_or_else(|| folder.display().to_string(), |name| name.to_string_lossy().into_owned())
}

fn text(
    settings: &DatasetSettings,
    results: &[MaterialResult],
    summaries: &[MethodSummary],
    pick: Pick,
) -> String {
    let titles = [
        "method",
        "materials",
        "failed",
        "mean loss",
        "95% over materials",
        "95% over scenes",
        "median",
        "- best",
        "95% over materials",
    ];
    let range = |interval: Option<[f64; 2]>| {
        interval.map_or_else(|| "unknown".to_owned(), |[low, high]| format!("{low:.6} to {high:.6}"))
    };
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(summaries.iter().map(|summary| {
        let [difference, of_difference] = match &summary.to_best {
            None => [const { String::new() }; 2],
            Some(difference) => [format!("{:.6}", difference.mean), range(difference.interval95_materials)],
        };
        vec![
            summary.method.clone(),
            summary.materials.to_string(),
            summary.failures.to_string(),
            format!("{:.6}", summary.mean),
            range(summary.interval95_materials),
            range(Some(summary.interval95_scenes)),
            format!("{:.6}", summary.median),
            difference,
            of_difference,
        ]
    }));
    let DatasetSettings { convention, target_error, seed, materials, .. } = settings;
    format!(
        "rendering loss over {} of {} materials\nconvention {convention}, +-{}% per loss, seed {seed}, pick {pick}\n\n{}",
        results.len(),
        materials.len(),
        100.0 * target_error,
        aligned(&rows)
    )
}

/// A row for each prediction.
fn csv(results: &[MaterialResult]) -> Result<String, Error> {
    let columns = metric_columns::names(results);
    let heading = [
        "material",
        "method",
        "sample",
        "loss",
        "standard_error",
        "interval95_low",
        "interval95_high",
        "seed",
        "scenes",
        "path",
        "error",
    ];
    let rows = results.iter().flat_map(|result| {
        result.predictions.iter().map(|prediction| {
            let numbers = match &prediction.result {
                Ok(known) => [known.loss, known.standard_error, known.interval95[0], known.interval95[1]]
                    .map(|x| x.to_string()),
                Err(_) => [const { String::new() }; 4],
            };
            let start = [result.material.clone(), prediction.method.clone(), prediction.sample.to_string()];
            let scenes = [result.seed.to_string(), result.scenes.to_string()];
            let problem = prediction.result.as_ref().err().cloned().unwrap_or_default();
            let end = [prediction.path.clone(), problem];
            let metrics = metric_columns::values(&columns, prediction);
            start.into_iter().chain(numbers).chain(scenes).chain(end).chain(metrics).collect()
        })
    });
    let heading = heading.into_iter().chain(columns.iter().copied()).map(str::to_owned).collect();
    table::csv([heading].into_iter().chain(rows))
}

fn latex_table(summaries: &[MethodSummary]) -> String {
    let row = |summary: &MethodSummary| {
        let mean = latex::bold(&format!("{:.4}", summary.mean), summary.ties_with_best());
        let interval = summary
            .interval95_materials
            .map_or("--".to_owned(), |[low, high]| format!("[{low:.4}, {high:.4}]"));
        let method = latex::escaped(&summary.method);
        format!("{method} & {mean} & {interval} & {:.4} & {} \\\\\n", summary.median, summary.materials)
    };
    let rows: String = summaries.iter().map(row).collect();
    latex::table("lrlrr", "Method & Mean loss & 95\\% interval & Median & Materials", &rows)
}

#[derive(Serialize)]
struct DatasetJson<'a> {
    settings: &'a DatasetSettings,
    pick: String,
    /// Best first.
    methods: Vec<MethodEntry<'a>>,
    results: &'a [MaterialResult],
}

#[derive(Serialize)]
struct MethodEntry<'a> {
    method: &'a str,
    materials: usize,
    failures: usize,
    mean: f64,
    median: f64,
    interval95_materials: Option<[f64; 2]>,
    interval95_scenes: [f64; 2],
    to_best: Option<f64>,
    to_best_interval95_materials: Option<[f64; 2]>,
    ties_with_best: bool,
    /// Of the maps, by name.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    metrics: BTreeMap<String, MetricEntry>,
}

impl<'a> DatasetJson<'a> {
    fn new(
        settings: &'a DatasetSettings,
        results: &'a [MaterialResult],
        summaries: &'a [MethodSummary],
        pick: Pick,
    ) -> Self {
        let entry = |summary: &'a MethodSummary| MethodEntry {
            method: &summary.method,
            materials: summary.materials,
            failures: summary.failures,
            mean: summary.mean,
            median: summary.median,
            interval95_materials: summary.interval95_materials,
            interval95_scenes: summary.interval95_scenes,
            to_best: summary.to_best.map(|difference| difference.mean),
            to_best_interval95_materials: summary
                .to_best
                .and_then(|difference| difference.interval95_materials),
            ties_with_best: summary.ties_with_best(),
            metrics: metric_columns::entries(&summary.method, results, pick),
        };
        Self { settings, pick: pick.to_string(), methods: summaries.iter().map(entry).collect(), results }
    }
}
