//! Many predictions of one ground truth.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::analyses::{MaterialReading, RankReport};
use svbrdf_evaluate::report::{Analysis as _, NoOptions, Repetition, Report as _};
use svbrdf_evaluate::robust::RobustReport;

use super::args::{DataSetArgs, OutputArgs, RankArgs, RankFormat, check_limit, refuse_scenes};
use crate::cli::args::{Specified, refuse};
use crate::cli::job::{self, ComparisonJob, Job, NewJob, OpenedMaterials, SessionSettings};
use crate::cli::output::{COMMIT, CommandError, command_line, warn_of, watched};

/// A ranking of the predictions of one ground truth.
#[derive(Debug)]
struct OneJob {
    comparison: ComparisonJob,
    request: Request,
    /// Whether the order under other questions is asked for instead.
    robust: bool,
    fail_above: Option<f64>,
    output: OutputArgs,
}

pub fn job(args: RankArgs, given: &Specified) -> NewJob {
    let reason = "only a data set (--dataset, --pairs) has kept results, parts, samples, metrics and marks here; `svbrdf metrics` and \
        `svbrdf diagnose` print those of one material";
    given.refuse::<DataSetArgs>(reason)?;
    refuse(args.figures.is_some(), "figures", reason)?;
    if args.output.format() == RankFormat::Html {
        let problem = "--format html is for data sets; `svbrdf report` writes a page of the predictions of one material";
        return Err(CommandError::usage(problem));
    }
    args.output.check(args.comparison.materials.paths())?;
    let mut comparison = ComparisonJob::with_predictions(&args.comparison, given)?;
    comparison.materials.mask(args.mask.mask.as_ref());
    if args.robust {
        comparison.materials.refuse_mask("the order under other questions is over all texels")?;
    }
    let RankArgs { scenes, fail_above, output, robust, .. } = args;
    if robust {
        refuse(fail_above.is_some(), "fail-above", "the order under other questions has no limit")?;
        refuse_scenes(given)?;
    }
    // The order under other questions is asked about materials alone.
    let session = comparison.session.as_ref().filter(|_| !robust);
    let request = SessionSettings::request(session, &scenes.options()?)?;
    Ok(Box::new(OneJob { comparison, request, robust, fail_above, output }))
}

/// Prints the ranking; fails where a loss is above a limit, after all are printed.
impl Job for OneJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison, request, robust, fail_above, output } = *self;
        let ComparisonJob { convention, materials, .. } = comparison;
        let opened = materials.open::<f32>()?;
        let input = job::input(&opened, &materials, convention, request);
        if robust {
            let comparison = Comparison::new(input.ground_truth, &input.predictions, convention)?;
            let ask = |progress: &Progress| RobustReport::new(&comparison, &input.request, progress);
            let report = watched("rendering", ask)?;
            return Ok(output.put(&report, RobustReport::latex)?);
        }
        let mut report =
            watched(RankReport::DOING, |progress| RankReport::run(&input, &NoOptions {}, progress))?;
        report.repetition = Some(Repetition::new(command_line()).at(COMMIT));
        report.readings = readings(&opened);
        output.put(&report, RankReport::latex)?;
        warn_of(report.missed(), materials.strict)?;
        report.ranking.sort_by_key(|place| place.index);
        check_limit(fail_above, report.ranking.into_iter().map(|place| (place.prediction, place.loss.mean)))
    }
}

/// How the materials were read.
fn readings(opened: &OpenedMaterials<f32>) -> Vec<MaterialReading> {
    let materials = std::iter::once(&opened.ground_truth).chain(&opened.predictions);
    let reading = |(material, remarks): (&Material<f32>, &Vec<String>)| MaterialReading {
        material: material.name().to_owned(),
        remarks: remarks.clone(),
    };
    materials.zip(&opened.readings).map(reading).collect()
}
