//! Many predictions of one ground truth.

use svbrdf::error::Error;
use svbrdf::loss::{Comparison, Request};
use svbrdf::rank::most_scenes;
use svbrdf::report::{Compared, RankReport, Report as _};

use super::args::{RankArgs, check_limit};
use crate::cli::bar::watched;
use crate::cli::{exit, materials, table, target, wildcards};

pub fn run(mut args: RankArgs) -> Result<(), Error> {
    if args.metrics {
        return Err(Error::Usage(
            "--metrics adds the metrics of a data set; `svbrdf metrics` prints those of predictions of one material"
                .to_owned(),
        ));
    }
    if args.journal.is_some() {
        return Err(Error::Usage(
            "--journal keeps the results of a data set; add --dataset or --pairs".to_owned(),
        ));
    }
    args.comparison.materials.predictions = wildcards::expanded(&args.comparison.materials.predictions)?;
    args.comparison.materials.expand_steps()?;
    table::check_predictions(&args.comparison.materials)?;
    let opened = materials::open::<f32>(&args.comparison.materials)?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, args.comparison.convention())?
        .at_most(most_scenes(predictions.len()));
    let request = Request::Accuracy { target: args.target_error, seed: args.seed };
    let outcome = watched("rendering", |progress| comparison.run(&request, progress))?;
    let compared = Compared::new(&opened.ground_truth, &args.comparison.convention());
    let report = RankReport::new(compared, args.target_error, outcome);
    exit::put(&args.format.write(&report, RankReport::latex)?)?;
    target::warn_of(report.missed(), args.comparison.materials.reading.both.strict)?;
    check_limit(
        args.fail_above,
        report.outcome.losses.iter().map(|l| (l.prediction.clone(), l.estimate.mean)),
    )
}
