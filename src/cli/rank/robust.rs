//! Ranking of methods over many materials under other questions.

use svbrdf_core::progress::Progress;
use svbrdf_evaluate::dataset::{self, Case, DatasetReading, DatasetSettings};
use svbrdf_evaluate::report::RobustReport;

use super::args::{DataSetArgs, OutputArgs, PageArgs, RankArgs, refuse_scenes};
use super::cases::{reading, source};
use crate::cli::args::{Given, refuse};
use crate::cli::job::{Job, NewJob};
use crate::cli::output::{CommandError, exit, watched_on};

/// The questions about a data set.
#[derive(Debug)]
struct RobustJob {
    settings: DatasetSettings,
    reading: DatasetReading,
    cases: Vec<Case>,
    output: OutputArgs,
}

pub fn job(args: &RankArgs, given: &Given) -> NewJob {
    let reason = "the order under other questions has no results folder, no samples, no metrics, no marks, no limit and no remarks";
    given.refuse::<DataSetArgs>(reason)?;
    given.refuse::<PageArgs>(reason)?;
    refuse(args.comparison.materials.reading.both.verbose, "verbose", reason)?;
    refuse(args.fail_above.is_some(), "fail-above", reason)?;
    refuse_scenes(given)?;
    args.output.check(args.comparison.materials.paths())?;
    let of_files = "materials of a data set are not resized";
    refuse(args.comparison.materials.reading.resize_to.is_some(), "resize-to", of_files)?;
    let source = source(&args.comparison.materials, args.pairs)?;
    let cases = source.cases()?;
    let convention = args.comparison.convention.clone().unwrap_or_default();
    let (target_error, seed) = args.scenes.target_and_seed();
    let settings = DatasetSettings::new(source, convention, target_error, seed, &cases);
    let reading = reading(&args.comparison.materials.reading, &settings.methods)?;
    Ok(Box::new(RobustJob { settings, reading, cases, output: args.output.clone() }))
}

impl Job for RobustJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { settings, reading, cases, output } = *self;
        let report = asked(&cases, &settings, &reading, &Progress::default())?;
        Ok(output.put(&report, RobustReport::latex)?)
    }
}

/// The answers about a data set; materials that are left out are reported.
pub fn asked(
    cases: &[Case],
    settings: &DatasetSettings,
    reading: &DatasetReading,
    progress: &Progress,
) -> Result<RobustReport, CommandError> {
    let answers = watched_on(progress, "asking about the order", |progress| {
        dataset::robust(cases, settings, reading, progress)
    })?;
    for (material, problem) in &answers.failures {
        exit::tell(&format!("note: {material} is left out: {problem}"));
    }
    Ok(answers.report(settings)?)
}
