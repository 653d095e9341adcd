//! `svbrdf loss`: the rendering loss (Algorithm 1).

use std::path::PathBuf;
use std::time::Duration;

use svbrdf::error::Error;
use svbrdf::loss::{Comparison, Compute, Precision, Question, Request, Sampling, Texels};
use svbrdf::model::sampler::Sampler;
use svbrdf::model::scene_file;
use svbrdf::report::{LossReport, Report as _};

use super::backend::{self, DeviceChoice};
use super::bar::watched;
use super::comparison_args::ComparisonArgs;
use super::report::ReportFormat;
use super::session::SessionSettings;
use super::{exit, materials, table, target};

/// Prints the rendering loss of predictions against a ground truth
///
/// Ground truth and predictions are rendered in the same sampled scenes (light and view). The loss is the mean over scenes,
/// texels and RGB of |ln(R_gt + epsilon) - ln(R_pred + epsilon)|. The standard error is due to the sampling of scenes and
/// texels; it is unknown with a single scene of a kind. Without options that choose scenes: the loss over all
/// scenes to +-1%, and the loss over the 6 + 3 scenes of the papers; of a session, what its window asked for. A folder of training
/// steps, such as NAME_step000100.png or epoch_12/, stands for all its steps. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct LossArgs {
    /// Number of near-field scenes [default: 6]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    near: Option<usize>,

    /// Number of distant scenes [default: 3]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    distant: Option<usize>,

    /// Seed of the sampled scenes [default: 0, or as in the session]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    seed: Option<u64>,

    /// Sampler of scenes: random, or sobol, which gives less error with as many scenes [default: random]
    #[arg(long, value_name = "random|sobol")]
    sampler: Option<Sampler>,

    /// Compares all texels, or an independent random subset of N texels per scene, which is fast on maps of any size
    /// [default: all]
    #[arg(long, value_name = "all|N", allow_negative_numbers = true, conflicts_with = "scenes")]
    texels: Option<Texels>,

    /// Samples as many scenes as this relative error needs at 95% confidence, such as 1%
    #[arg(long, value_name = "PERCENT", value_parser = percent, allow_hyphen_values = true,
        conflicts_with_all = ["near", "distant", "sampler", "texels", "scenes", "time_budget"])]
    target_error: Option<f64>,

    /// Samples as many scenes as fit into this time, such as 500ms or 2s
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true,
        conflicts_with_all = ["near", "distant", "sampler", "texels", "scenes"])]
    time_budget: Option<Duration>,

    /// Uses the scenes of a JSON file instead of sampled ones, or those of a MaterialGAN capture (render.json)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["near", "distant", "seed", "sampler"])]
    scenes: Option<PathBuf>,

    /// Floating-point precision
    #[arg(long, value_name = "f32|f64", default_value = "f32")]
    precision: Precision,

    /// Device that computes the loss
    #[arg(long, value_enum, default_value_t)]
    backend: DeviceChoice,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Prints the losses to stdout.
///
/// # Errors
/// Where a material or the scenes cannot be read or used; with `--strict` where a target error is not reached, after the
/// losses are printed.
pub fn run(mut args: LossArgs) -> Result<(), Error> {
    let steps = args.comparison.materials.expand_steps()?;
    let args = &args;
    table::check_predictions(&args.comparison.materials)?;
    let question = question(args)?;
    check_backend(args, &question)?;
    let report = match args.precision {
        Precision::F32 => {
            report(args, &question, |comparison, request| backend::run(args.backend, comparison, request))?
        }
        Precision::F64 => report(args, &question, on_cpu::<f64>)?,
    };
    let report = LossReport { paths: paths(args), steps, ..report };
    exit::put(&args.format.write(&report)?)?;
    target::warn_of(report.missed(), args.comparison.materials.reading.both.strict)
}

/// The paths of the ground truth and of the predictions; none of the built-in ones.
fn paths(args: &LossArgs) -> Vec<Option<String>> {
    let all = args.comparison.materials.ground_truth.iter().chain(&args.comparison.materials.predictions);
    all.map(|path| Some(path.display().to_string())).collect()
}

/// The question of the options or of the session, or the default.
fn question(args: &LossArgs) -> Result<Question, Error> {
    if chooses_scenes(args) {
        return request(args).map(Question::from);
    }
    let saved = saved_request(args)?.map(Question::from);
    Ok(saved.unwrap_or_else(|| Question::of_seed(args.seed.unwrap_or(0))))
}

/// The request of the session.
fn saved_request(args: &LossArgs) -> Result<Option<Request>, Error> {
    let saved = SessionSettings::of(&args.comparison.materials)?;
    Ok(saved.and_then(|saved| saved.request(args.seed)))
}

/// Opens the materials in precision `T` and answers the question: few scenes with `run`, many beside them on the CPU.
fn report<T: Compute>(
    args: &LossArgs,
    question: &Question,
    run: impl FnOnce(Comparison<'_, T>, &Request) -> Result<LossReport, Error>,
) -> Result<LossReport, Error> {
    let opened = materials::open::<T>(&args.comparison.materials)?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, args.comparison.convention())?;
    let Question { request, few_scenes: Some(few) } = question else {
        return run(comparison, &question.request);
    };
    let report = on_cpu(comparison.clone(), request)?;
    let few = run(comparison, &Request::Scenes(*few))?;
    Ok(report.beside(few))
}

fn on_cpu<T: Compute>(comparison: Comparison<'_, T>, request: &Request) -> Result<LossReport, Error> {
    let outcome = watched("rendering", |progress| comparison.run(request, progress))?;
    Ok(LossReport::new(&comparison, request, outcome))
}

/// Whether an option says which scenes and texels are compared; a seed does not.
fn chooses_scenes(args: &LossArgs) -> bool {
    let LossArgs { near, distant, sampler, texels, target_error, time_budget, scenes, .. } = args;
    let counts = near.is_some() || distant.is_some() || sampler.is_some() || texels.is_some();
    counts || target_error.is_some() || time_budget.is_some() || scenes.is_some()
}

/// A graphics adapter compares all texels, in f32.
fn check_backend(args: &LossArgs, question: &Question) -> Result<(), Error> {
    let few_scenes = question.few_scenes.map(Request::Scenes);
    let problem = match (args.backend, args.precision, few_scenes.as_ref().unwrap_or(&question.request)) {
        (DeviceChoice::Cpu | DeviceChoice::Auto, ..) => return Ok(()),
        (DeviceChoice::Gpu, Precision::F64, _) => {
            "graphics adapters compute in f32; leave out --backend gpu, or --precision f64"
        }
        (
            DeviceChoice::Gpu,
            _,
            Request::Listed(_) | Request::Scenes(Sampling { texels: Texels::All, .. }),
        ) => {
            return Ok(());
        }
        _ => {
            "graphics adapters compare all texels; leave out --backend gpu, or \
            --texels, --target-error and --time-budget"
        }
    };
    Err(Error::Usage(problem.to_owned()))
}

/// The request that the options make.
fn request(args: &LossArgs) -> Result<Request, Error> {
    let LossArgs { near, distant, sampler, texels, .. } = *args;
    let seed = args.seed.unwrap_or(0);
    let usual = Sampling::default();
    let sampling = Sampling {
        near: near.unwrap_or(usual.near),
        distant: distant.unwrap_or(usual.distant),
        seed,
        sampler: sampler.unwrap_or(usual.sampler),
        texels: texels.unwrap_or(usual.texels),
    };
    Ok(match (args.target_error, args.time_budget, &args.scenes) {
        (Some(target), ..) => Request::Accuracy { target, seed },
        (None, Some(budget), _) => Request::Time { budget, seed },
        (None, None, Some(path)) => Request::Listed(scene_file::read(path)?),
        (None, None, None) => {
            sampling.check()?;
            Request::Scenes(sampling)
        }
    })
}

/// A share such as `1%` or `0.01`.
pub fn percent(text: &str) -> Result<f64, String> {
    let (number, scale) = text.strip_suffix('%').map_or((text, 1.0), |number| (number, 0.01));
    let share = number.trim().parse::<f64>().map(|number| number * scale);
    share
        .ok()
        .filter(|s| *s > 0.0 && *s < 1.0)
        .ok_or("expected more than 0% and less than 100%, as in 1%".to_owned())
}

/// A time such as `500ms`, `2s` or `0.5` (seconds).
fn duration(text: &str) -> Result<Duration, String> {
    let units = [("us", 1e-6), ("ms", 1e-3), ("s", 1.0)];
    let with_unit = units.iter().find_map(|(unit, scale)| Some((text.strip_suffix(unit)?, *scale)));
    let (number, scale) = with_unit.unwrap_or((text, 1.0));
    let seconds = number.trim().parse::<f64>().map(|number| number * scale);
    let time = seconds.ok().filter(|s| *s > 0.0 && *s <= 86_400.0).map(Duration::from_secs_f64);
    time.ok_or(
        "expected a time above 0, at most a day, in us, ms or s (the default), as in 500ms or 2s".to_owned(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_positive_and_have_units() {
        let times = ["100us", "500ms", "2s", "0.5", "1 s"].map(|text| duration(text).unwrap().as_micros());
        assert_eq!(times, [100, 500_000, 2_000_000, 500_000, 1_000_000]);
        for wrong in ["0", "-1s", "2m", "1e9s", "nan", "s", ""] {
            assert!(duration(wrong).is_err_and(|said| said.contains("above 0")), "{wrong}");
        }
    }
}
