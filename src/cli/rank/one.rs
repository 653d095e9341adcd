//! Many predictions of one ground truth.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_evaluate::rank::most_scenes;
use svbrdf_evaluate::report::{Compared, MaterialReading, RankReport, Repetition, Report as _};

use super::args::{RankArgs, RankFormat, check_limit};
use crate::cli::args::{Given, modes, wildcards};
use crate::cli::job::floor::floor_of;
use crate::cli::job::{ComparisonJob, Opened};
use crate::cli::output::{CommandError, command_line, exit, target, watched};

pub fn run(mut args: RankArgs, given: &Given) -> Result<(), CommandError> {
    given.check(&modes::RANK_PREDICTIONS)?;
    if args.format == RankFormat::Html {
        let problem = "--format html is for data sets; `svbrdf report` writes a page of the predictions of one material";
        return Err(CommandError::usage(problem));
    }
    args.comparison.materials.predictions = wildcards::expanded(&args.comparison.materials.predictions)?;
    args.comparison.materials.expand_steps()?;
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    let opened = job.materials.open::<f32>()?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, job.convention)?
        .at_most(most_scenes(predictions.len()));
    let request = Request::Accuracy { target: args.target_error, seed: args.seed.seed };
    let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
    let compared = Compared::new(&opened.ground_truth, &job.convention);
    let mut report = RankReport::new(compared, args.target_error, &outcome);
    if opened.storages[0].has_steps() || !args.floor.repeats.is_empty() {
        let (floor, captures) = floor_of(&args.floor, &job, &opened, args.seed.seed)?;
        report = report.with_floor(&floor, captures);
    }
    report.repetition = Some(Repetition::new(command_line()));
    report.readings = readings(&opened);
    exit::put(&args.format.write(&report, RankReport::latex)?)?;
    target::warn_of(report.missed(), job.materials.strict)?;
    check_limit(args.fail_above, outcome.losses.iter().map(|l| (l.prediction.clone(), l.estimate.mean)))
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
