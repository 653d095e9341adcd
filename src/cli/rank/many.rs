//! Methods over many materials.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;
use svbrdf::dataset::{
    self, Case, MaterialResult, MethodSummary, Pick, PredictionResult, RunSettings, Side, summarize,
    tasks_of_folders, tasks_of_table,
};
use svbrdf::error::Error;
use svbrdf::files::read;
use svbrdf::material::Material;
use svbrdf::progress::Progress;

use super::args::{RankArgs, RankFormat, check_limit};
use super::metric_columns::{self, MetricEntry};
use crate::cli::bar::watched;
use crate::cli::{exit, table, target, wildcards};

pub fn run(args: &RankArgs) -> Result<(), Error> {
    let (settings, results) =
        if args.merge { dataset::merged(&wildcards::expanded(&paths(args))?)? } else { evaluated(args)? };
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
        RankFormat::Latex => latex(&summaries) + &metric_columns::latex(&summaries, &results, args.pick),
    })?;
    target::warn_of(missed(&settings, &results), args.comparison.materials.reading.both.strict)?;
    check_limit(args.fail_above, summaries.into_iter().map(|summary| (summary.method, summary.mean)))
}

/// The errors of predictions whose loss is not known as well as the target error asks for.
fn missed(settings: &RunSettings, results: &[MaterialResult]) -> Vec<Error> {
    let of = |result: &MaterialResult, prediction: &PredictionResult| {
        let known = prediction.result.as_ref().ok()?;
        let name = format!("{}, {}", result.material, prediction.method);
        target::missed(settings.target_error, &name, &known.estimate(), result.scenes)
    };
    let all = results.iter().flat_map(|result| result.predictions.iter().filter_map(|p| of(result, p)));
    all.collect()
}

/// What stands for GT and PRED.
fn paths(args: &RankArgs) -> Vec<PathBuf> {
    args.comparison
        .materials
        .ground_truth
        .iter()
        .chain(&args.comparison.materials.predictions)
        .cloned()
        .collect()
}

/// The predictions without a loss: material, method and what is wrong.
fn failures(results: &[MaterialResult]) -> impl Iterator<Item = (&str, &str, &str)> {
    results.iter().flat_map(|result| {
        let failed = result.predictions.iter().filter_map(|p| Some((p, p.result.as_ref().err()?)));
        failed.map(|(p, problem)| (result.material.as_str(), p.method.as_str(), problem.as_str()))
    })
}

fn evaluated(args: &RankArgs) -> Result<(RunSettings, Vec<MaterialResult>), Error> {
    if args.comparison.materials.reading.resize_to.is_some() {
        let problem = "materials of a data set are not resized; convert them first, or leave out --resize-to";
        return Err(Error::Usage(problem.to_owned()));
    }
    let tasks = tasks(args)?;
    let settings = RunSettings::new(args.comparison.convention().name, args.target_error, args.seed, &tasks)
        .with_metrics(args.metrics);
    let tasks = args.shard.map_or(tasks.clone(), |shard| shard.part(tasks));
    let options = [
        args.comparison.materials.reading.of_ground_truth(),
        args.comparison.materials.reading.of_predictions(),
    ];
    let strict = args.comparison.materials.reading.both.strict;
    let open = |path: &Path, side: Side| -> Result<Material<f32>, Error> {
        let options = &options[usize::from(side == Side::Prediction)];
        let read = read::read(path, options, &Progress::default())?;
        if strict {
            read.refuse_guesses(path)?;
        }
        Ok(read.material)
    };
    let results = watched("comparing materials", |progress| {
        let convention = args.comparison.convention();
        dataset::run(&tasks, &settings, &convention, open, args.journal.as_deref(), progress)
    })?;
    Ok((settings, results))
}

fn tasks(args: &RankArgs) -> Result<Vec<Case>, Error> {
    let Some(ground_truth) = &args.comparison.materials.ground_truth else {
        return Err(Error::Usage("give a folder of ground truths, or a table of pairs".to_owned()));
    };
    if args.pairs {
        return match args.comparison.materials.predictions.as_slice() {
            [] => tasks_of_table(ground_truth),
            _ => Err(Error::Usage("--pairs takes one CSV table, which names the predictions".to_owned())),
        };
    }
    let folders = wildcards::expanded(&args.comparison.materials.predictions)?;
    if folders.is_empty() {
        let problem = format!(
            "there is no method to compare with {}; give one or more folders",
            ground_truth.display()
        );
        return Err(Error::Usage(problem));
    }
    let named: Vec<(String, &Path)> = folders.iter().map(|path| (name(path), path.as_path())).collect();
    let named: Vec<(&str, &Path)> = named.iter().map(|(name, path)| (name.as_str(), *path)).collect();
    let names = svbrdf::report::distinct_names(&named);
    let methods: Vec<(String, PathBuf)> = names.into_iter().zip(folders.iter().cloned()).collect();
    tasks_of_folders(ground_truth, &methods)
}

fn name(folder: &Path) -> String {
    folder
        .file_name()
        .map_or_else(|| folder.display().to_string(), |name| name.to_string_lossy().into_owned())
}

fn text(
    settings: &RunSettings,
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
    let RunSettings { convention, target_error, seed, materials, .. } = settings;
    format!(
        "rendering loss over {} of {} materials\nconvention {convention}, +-{}% per loss, seed {seed}, pick {pick}\n\n{}",
        results.len(),
        materials.len(),
        100.0 * target_error,
        table::aligned(&rows)
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

fn latex(summaries: &[MethodSummary]) -> String {
    let row = |summary: &MethodSummary| {
        let mean = table::bold(&format!("{:.4}", summary.mean), summary.ties_with_best());
        let interval = summary
            .interval95_materials
            .map_or("--".to_owned(), |[low, high]| format!("[{low:.4}, {high:.4}]"));
        let method = table::escaped(&summary.method);
        format!("{method} & {mean} & {interval} & {:.4} & {} \\\\\n", summary.median, summary.materials)
    };
    let rows: String = summaries.iter().map(row).collect();
    table::latex("lrlrr", "Method & Mean loss & 95\\% interval & Median & Materials", &rows)
}

#[derive(Serialize)]
struct DatasetJson<'a> {
    settings: &'a RunSettings,
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
        settings: &'a RunSettings,
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
