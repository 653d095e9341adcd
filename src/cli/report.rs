//! `svbrdf report`: one HTML file with an interactive figure and the findings.

use std::path::PathBuf;

use svbrdf_core::error::Error;
use svbrdf_core::loss::Request;
use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::report::Report as _;
use svbrdf_files::disk::atomic::write_text;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::session::window::Layout;
use svbrdf_page::{Findings, Page, Repetition, Report, View, check_destination, exposure};

use super::args::scenes::OneSceneArgs;
use super::args::{ComparisonArgs, Given, modes, values};
use super::job::{ComparisonJob, SessionSettings};
use super::output::stop::stoppable;
use super::output::{CommandError, command_line, exit, target, watched};

/// Writes a page with an interactive figure and the findings, which opens in any browser
///
/// One HTML file without a network: readers move light and view, zoom, and compare values and differences, on a desktop or a phone.
/// Below the figure, without script: losses with intervals, the share of each map, the worst scenes, the loss over directions of
/// the light, the assumptions in reading, and the command that makes the file. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf report gt.png a.png b.png -o report.html")]
pub struct ReportArgs {
    /// Output file, .html
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Largest size of the file, such as 10MB or 500kB: the maps of the figure are halved until it fits, or it is refused
    #[arg(long, value_name = "SIZE", value_parser = values::bytes, default_value = "10MB")]
    max_size: usize,

    /// Writes the figure alone, without findings, to be embedded with an <iframe>
    #[arg(long)]
    figure: bool,

    /// Layout that the figure begins with: side-by-side, wipe or single [default: side-by-side, or as in the session]
    #[arg(long, value_name = "LAYOUT")]
    layout: Option<Layout>,

    /// Samples as many scenes as this relative error of the loss needs at 95% confidence [default: 1%, or the scenes of the
    /// session]
    #[arg(help_heading = "Scenes", long, value_name = "PERCENT", value_parser = values::percent, allow_hyphen_values = true)]
    target_error: Option<f64>,

    /// Seed of the sampled scenes [default: 0, or as in the session]
    #[arg(help_heading = "Scenes", long, value_name = "N", value_parser = values::whole::<u64>, allow_negative_numbers = true)]
    seed: Option<u64>,

    #[command(flatten)]
    scene: OneSceneArgs,

    /// Exposure of the figure in stops [default: the brightest 1% of the ground truth just clip, or as in the
    /// session]
    #[arg(long, value_name = "EV", value_parser = values::stops, allow_hyphen_values = true)]
    exposure: Option<f32>,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Computes the findings and writes the page.
///
/// # Errors
/// Where a material cannot be read or compared, the page is larger than asked for, or the file cannot be written; with `--strict` where the target error is not reached,
/// after the file is written.
pub fn run(args: &ReportArgs, given: &Given) -> Result<(), CommandError> {
    check_destination(&args.output)?;
    let job = ComparisonJob::new(&args.comparison, given)?;
    check_options(args, &job, given)?;
    let request = request(args, job.session.as_ref(), given)?;
    let opened = job.materials.open::<f32>()?;
    check_output(&args.output)?;
    let view = view(args, &job, &opened.ground_truth)?;
    let (ground_truth, predictions) = (&opened.ground_truth, opened.predictions.iter().collect::<Vec<_>>());
    let findings =
        |progress: &Progress| Findings::new(ground_truth, &predictions, job.convention, &request, progress);
    let has_findings = !args.figure && !predictions.is_empty();
    let findings = has_findings.then(|| watched("rendering", findings)).transpose()?;
    let missed = findings.as_ref().map_or(Vec::new(), |findings| findings.loss.missed());
    let materials: Vec<&Material<f32>> = std::iter::once(ground_truth).chain(predictions).collect();
    let whole = !args.figure;
    let report = Report {
        materials: &materials,
        convention: job.convention,
        view,
        findings,
        readings: if whole { opened.readings.clone() } else { Vec::new() },
        repetition: whole.then(|| Repetition { command: command_line(), session: None }),
        max_bytes: args.max_size,
    };
    let page = watched("writing", |progress| report.page(progress))?;
    check_size(&page, args.max_size)?;
    stoppable(|progress| write_text(&args.output, &page.html, progress))?;
    tell_reduction(&page, args.max_size);
    target::warn_of(missed, job.materials.strict)
}

/// Refuses the options that the mode does not use.
fn check_options(args: &ReportArgs, job: &ComparisonJob, given: &Given) -> Result<(), CommandError> {
    if args.figure {
        given.check(&modes::REPORT_FIGURE)?;
    }
    if job.materials.predictions() == 0 {
        given.check(&modes::REPORT_ALONE)?;
    }
    Ok(())
}

/// What the figure begins with.
fn view(args: &ReportArgs, job: &ComparisonJob, ground_truth: &Material<f32>) -> Result<View, CommandError> {
    let session = job.session.as_ref();
    let scene = args.scene.scene(session.map(|session| session.scene))?;
    let exposure_ev = args
        .exposure
        .or(session.map(|session| session.exposure_ev))
        .unwrap_or_else(|| exposure(ground_truth, &scene, &job.convention));
    let mut display = session.map(|session| session.display().clone()).unwrap_or_default();
    display.layout = args.layout.unwrap_or(display.layout);
    Ok(View { scene, exposure_ev, display })
}

/// The scenes of the losses: those of the session, unless an accuracy is specified.
fn request(
    args: &ReportArgs,
    session: Option<&SessionSettings>,
    given: &Given,
) -> Result<Request, CommandError> {
    let saved =
        session.filter(|_| args.target_error.is_none()).and_then(|session| session.request(args.seed));
    if let Some(Request::Listed(_)) = saved {
        given.check(&modes::SESSION_SCENES)?;
    }
    let (target, seed) = (args.target_error.unwrap_or(0.01), args.seed.unwrap_or(0));
    Ok(saved.unwrap_or(Request::Accuracy { target, seed }))
}

/// Refuses a page of more than `limit` bytes, which smaller maps do not help.
fn check_size(page: &Page, limit: usize) -> Result<(), Error> {
    let bytes = page.html.len();
    if bytes <= limit { Ok(()) } else { Err(Error::ReportTooLarge { bytes, limit }) }
}

/// Reports what the size of the file, at most `most` bytes, has cost.
fn tell_reduction(page: &Page, most: usize) {
    if let Some([width, height]) = page.reduced_to {
        exit::tell(&format!(
            "note: the maps of the figure are reduced to {width} x {height} texels for --max-size {most}; findings are of all texels"
        ));
    }
}
