//! Methods over many materials.

use std::path::{Path, PathBuf};

use svbrdf::dataset::{
    self, Case, DatasetReport, MaterialResult, RunSettings, Side, tasks_of_folders, tasks_of_table,
};
use svbrdf::error::Error;
use svbrdf::files::read;
use svbrdf::material::Material;
use svbrdf::progress::Progress;
use svbrdf::report::Report as _;

use super::args::{RankArgs, check_limit};
use crate::cli::bar::watched;
use crate::cli::{exit, target, wildcards};

pub fn run(args: &RankArgs) -> Result<(), Error> {
    let (settings, results) =
        if args.merge { dataset::merged(&wildcards::expanded(&paths(args))?)? } else { evaluated(args)? };
    for (material, prediction, problem) in failures(&results) {
        exit::tell(&format!("note: {material}, {prediction}: {problem}"));
    }
    let report = DatasetReport::new(settings, results, args.pick);
    exit::put(&args.format.write(&report, DatasetReport::latex)?)?;
    target::warn_of(report.missed(), args.comparison.materials.reading.both.strict)?;
    check_limit(args.fail_above, report.methods.into_iter().map(|summary| (summary.method, summary.mean)))
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
