//! Methods over many materials.

use std::path::PathBuf;

use svbrdf_core::error::Error;
use svbrdf_core::report::Report as _;
use svbrdf_files::dataset::{self, DatasetReport, DatasetResults, DatasetSettings, MaterialResult};

use super::args::{RankArgs, RankFormat, check_limit};
use super::cases::{cases, reading};
use super::html;
use crate::cli::args::{Given, NamedPath, modes, wildcards};
use crate::cli::output::{CommandError, exit, target, watched};

pub fn run(args: &RankArgs, given: &Given) -> Result<(), CommandError> {
    html::check(args, given)?;
    let (settings, results) = if args.merge { merged(args, given)? } else { evaluated(args, given)? };
    for (material, prediction, problem) in failures(&results) {
        exit::tell(&format!("note: {material}, {prediction}: {problem}"));
    }
    let report = DatasetReport::new(settings, results, args.pick);
    match args.format {
        RankFormat::Html => html::write(args, &report)?,
        format => exit::put(&format.write(&report, DatasetReport::latex)?)?,
    }
    check_any(&report)?;
    target::warn_of(report.missed(), args.comparison.materials.reading.both.strict)?;
    check_limit(args.fail_above, report.methods.into_iter().map(|summary| (summary.method, summary.mean)))
}

/// The results of the journals that stand for GT and PRED.
fn merged(args: &RankArgs, given: &Given) -> Result<(DatasetSettings, Vec<MaterialResult>), CommandError> {
    given.check(&modes::RANK_MERGE)?;
    let paths: Vec<NamedPath> = args.comparison.materials.paths().cloned().map(NamedPath::from).collect();
    let paths: Vec<PathBuf> = wildcards::expanded(&paths)?.into_iter().map(|given| given.path).collect();
    Ok(dataset::merged(&paths)?)
}

/// The error of a data set without any loss.
fn check_any(report: &DatasetReport) -> Result<(), Error> {
    if report.methods.iter().any(|summary| summary.materials > 0) {
        return Ok(());
    }
    let failed = failures(&report.results).count();
    match failures(&report.results).next() {
        Some((material, method, problem)) => Err(Error::NothingRanked {
            failed,
            name: format!("{material}, {method}"),
            problem: problem.to_owned(),
        }),
        None => Ok(()),
    }
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
    let convention = args.comparison.convention.unwrap_or_default();
    let settings = DatasetSettings::new(convention.name, args.target_error, args.seed.seed, &cases)
        .with_metrics(args.metrics)
        .with_diagnoses(args.diagnose);
    let cases = args.shard.map_or(cases.clone(), |shard| shard.part(cases));
    let reading = reading(args)?;
    let DatasetResults { results, recomputed } = watched("comparing materials", |progress| {
        dataset::run(&cases, &settings, &reading, args.journal.as_deref(), progress)
    })?;
    recomputed.iter().for_each(|recomputed| exit::tell(&format!("note: {recomputed}")));
    Ok((settings, results))
}
