//! Many predictions of one ground truth.

use std::path::PathBuf;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_evaluate::rank::most_scenes;
use svbrdf_evaluate::report::{Compared, MaterialReading, RankReport, Repetition, Report as _, RobustReport};
use svbrdf_evaluate::robust::RobustInput;

use super::args::{DataSetArgs, PageArgs, RankArgs, RankFormat, check_limit};
use crate::cli::args::floor::FloorArgs;
use crate::cli::args::{Given, refuse, wildcards};
use crate::cli::job::floor::floor_of;
use crate::cli::job::{ComparisonJob, Job, NewJob, Opened};
use crate::cli::output::{CommandError, command_line, exit, target, watched};

/// A ranking of the predictions of one ground truth.
#[derive(Debug)]
struct OneJob {
    comparison: ComparisonJob,
    target_error: f64,
    seed: u64,
    repeats: Vec<PathBuf>,
    fail_above: Option<f64>,
    format: RankFormat,
}

pub fn job(mut args: RankArgs, given: &Given) -> NewJob {
    let reason = "a ranking of the predictions of one material has no results folder, no samples, no metrics and no marks, unlike one \
        with --dataset or --pairs (`svbrdf metrics` and `svbrdf diagnose` print them)";
    given.refuse::<DataSetArgs>(reason)?;
    given.refuse::<PageArgs>(reason)?;
    if args.format == RankFormat::Html {
        let problem = "--format html is for data sets; `svbrdf report` writes a page of the predictions of one material";
        return Err(CommandError::usage(problem));
    }
    args.comparison.materials.predictions = wildcards::expanded(&args.comparison.materials.predictions)?;
    args.comparison.materials.expand_steps()?;
    let comparison = ComparisonJob::with_predictions(&args.comparison, given)?;
    let (target_error, seed) = args.accuracy.target_and_seed();
    let RankArgs { floor: FloorArgs { repeats }, fail_above, format, robust, .. } = args;
    if robust {
        given.refuse::<FloorArgs>("the order under other questions has no floor")?;
        refuse(fail_above.is_some(), "fail-above", "the order under other questions has no limit")?;
        return Ok(Box::new(RobustJob { comparison, target_error, seed, format }));
    }
    Ok(Box::new(OneJob { comparison, target_error, seed, repeats, fail_above, format }))
}

/// Prints the ranking; fails where a loss is above a limit, after all are printed.
impl Job for OneJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison: job, target_error: target, seed, repeats, fail_above, format } = *self;
        let opened = job.materials.open::<f32>()?;
        let predictions: Vec<_> = opened.predictions.iter().collect();
        let comparison = Comparison::new(&opened.ground_truth, &predictions, job.convention)?
            .at_most(most_scenes(predictions.len()));
        let request = Request::Accuracy { target, seed };
        let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
        let compared = Compared::new(&opened.ground_truth, &job.convention);
        let mut report = RankReport::new(compared, target, &outcome);
        if opened.storages[0].has_steps() || !repeats.is_empty() {
            let (floor, captures) = floor_of(&repeats, &job, &opened, seed)?;
            report = report.with_floor(&floor, captures);
        }
        report.repetition = Some(Repetition::new(command_line()));
        report.readings = readings(&opened);
        exit::put(&format.write(&report, RankReport::latex)?)?;
        target::warn_of(report.missed(), job.materials.strict)?;
        check_limit(fail_above, outcome.losses.iter().map(|l| (l.prediction.clone(), l.estimate.mean)))
    }
}

/// Whether the order of the predictions survives other questions.
#[derive(Debug)]
struct RobustJob {
    comparison: ComparisonJob,
    target_error: f64,
    seed: u64,
    format: RankFormat,
}

impl Job for RobustJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison: job, target_error, seed, format } = *self;
        let opened = job.materials.open::<f32>()?;
        let predictions = opened.predictions.iter().collect();
        let (ground_truth, convention) = (&opened.ground_truth, job.convention);
        let input = RobustInput { ground_truth, predictions, convention, target_error, seed };
        let report = watched("rendering", |progress| RobustReport::new(&input, progress))?;
        Ok(exit::put(&format.write(&report, RobustReport::latex)?)?)
    }
}

/// How the materials were read.
fn readings(opened: &Opened<f32>) -> Vec<MaterialReading> {
    let materials = std::iter::once(&opened.ground_truth).chain(&opened.predictions);
    let reading = |(material, remarks): (&Material<f32>, &Vec<String>)| MaterialReading {
        material: material.name().to_owned(),
        remarks: remarks.clone(),
    };
    materials.zip(&opened.readings).map(reading).collect()
}
