//! Methods over many materials.

use svbrdf_core::error::Error;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{
    self, Case, DatasetReport, DatasetResults, DatasetSettings, MaterialResult, Shard, Source,
};
use svbrdf_evaluate::report::Report as _;

use super::args::{RankArgs, RankFormat, check_limit};
use super::cases::{reading, source};
use super::html;
use crate::cli::args::{Given, modes};
use crate::cli::output::stop::stoppable;
use crate::cli::output::{CommandError, exit, target, watched_on};

pub fn run(args: &RankArgs, given: &Given) -> Result<(), CommandError> {
    given.check(&modes::RANK_DATA_SET)?;
    let source = source(args)?;
    let cases = source.cases()?;
    html::check(args, given, &cases)?;
    let evaluate = |progress: &Progress| evaluate(args, source, cases, progress);
    let writes = args.results.is_some() || args.format == RankFormat::Html;
    if writes { stoppable(evaluate) } else { evaluate(&Progress::default()) }
}

fn evaluate(
    args: &RankArgs,
    source: Source,
    cases: Vec<Case>,
    progress: &Progress,
) -> Result<(), CommandError> {
    let convention = args.comparison.convention.unwrap_or_default();
    let settings = DatasetSettings {
        metrics: args.metrics,
        diagnose: args.diagnose,
        ..DatasetSettings::new(source, convention.name, args.target_error, args.seed.seed, &cases)
    };
    let reading = reading(args, &settings.methods)?;
    let cases = part(args.shard, cases);
    let results = args.results.as_deref();
    let DatasetResults { results, notes } = watched_on(progress, "comparing materials", |progress| {
        dataset::run(&cases, &settings, &reading, results, progress)
    })?;
    notes.iter().for_each(|note| exit::tell(&format!("note: {note}")));
    for (material, prediction, problem) in failures(&results) {
        exit::tell(&format!("note: {material}, {prediction}: {problem}"));
    }
    let report = DatasetReport::new(settings, reading, results, args.pick);
    tell_reading(args, &report);
    match args.format {
        RankFormat::Html => html::write(args, &report, &cases, progress)?,
        format => exit::put(&format.write(&report, DatasetReport::latex)?)?,
    }
    check_any(&report)?;
    target::warn_of(report.missed(), args.comparison.materials.reading.both.strict)?;
    let means = report.methods.into_iter().filter(|summary| summary.materials > 0);
    check_limit(args.fail_above, means.map(|summary| (summary.method, summary.mean)))
}

/// The cases of a shard, which is reported.
fn part(shard: Option<Shard>, cases: Vec<Case>) -> Vec<Case> {
    let Some(shard) = shard else { return cases };
    let all = cases.len();
    let part = shard.part(cases);
    let Shard { number, of } = shard;
    exit::tell(&format!("note: part {number} of {of}: {} of {all} materials", part.len()));
    part
}

/// Reports how the files were read: with `--verbose` every remark; otherwise the doubts, where the format does not print them.
fn tell_reading(args: &RankArgs, report: &DatasetReport) {
    if args.comparison.materials.reading.both.verbose {
        report.remarks().for_each(|(name, remark)| exit::tell(&format!("note: {name}: {}", remark.text)));
    } else if args.format != RankFormat::Text {
        report.conditions().iter().for_each(|condition| exit::tell(&format!("note: {condition}")));
    }
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
        let failed = result.predictions.iter().filter_map(|p| Some((p, p.error.as_ref()?)));
        failed.map(|(p, problem)| (result.material.as_str(), p.method.as_str(), problem.as_str()))
    })
}
