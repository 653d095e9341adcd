//! `svbrdf report`: one HTML file with an interactive figure and the findings.

use std::path::PathBuf;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::scene::Scene;
use svbrdf_evaluate::report::Report as _;
use svbrdf_evaluate::robust::RobustReport;
use svbrdf_files::disk::atomic::write_text;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::session::window::{Layout, SessionDisplay};
use svbrdf_page::{Findings, Page, Repetition, Report, View, check_destination, exposure};

use super::args::scenes::{Accuracy, RenderingArgs, SceneArgs};
use super::args::{ComparisonArgs, Specified, refuse, values};
use super::job::{ComparisonJob, Job, NewJob, SessionSettings};
use super::output::{CommandError, command_line, exit, stoppable, warn_of, watched};

/// Writes a page with an interactive figure and the findings, which opens in any browser
///
/// One HTML file without a network: readers move light and view, zoom, and compare values and differences, on a desktop or a phone.
/// Below the figure, without script: losses with intervals, the share of each map, the worst scenes, the loss over directions of
/// the light, the assumptions in reading, and the command that makes the file. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(mut_arg("target_error", |arg| arg.help(
    "Samples as many scenes as this relative error of the loss needs at 95% confidence [default: 1%, or the scenes of the session]")))]
#[command(mut_arg("seed", |arg| arg.help("Seed of the sampled scenes [default: 0, or as in the session]")))]
#[command(mut_arg("exposure", |arg| arg.help(
    "Exposure of the figure in stops [default: the brightest 1% of the ground truth just clip, or as in the session]")))]
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

    /// Adds whether the order of the predictions survives other conventions, epsilons and scenes, as `svbrdf rank --robust` tells
    #[arg(long, conflicts_with = "figure")]
    robust: bool,

    /// Layout that the figure begins with: side-by-side, wipe or single [default: side-by-side, or as in the session]
    #[arg(long, value_name = "LAYOUT")]
    layout: Option<Layout>,

    #[command(flatten)]
    accuracy: SceneArgs<Accuracy>,

    #[command(flatten)]
    rendering: RenderingArgs,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Debug)]
struct ReportJob {
    comparison: ComparisonJob,
    output: PathBuf,
    max_size: usize,
    scene: Scene,
    /// `None`: fitted to the ground truth.
    exposure_ev: Option<f32>,
    display: SessionDisplay,
    /// `None`: the figure alone.
    whole: Option<WholePage>,
}

/// What a page has beside its figure.
#[derive(Debug)]
struct WholePage {
    /// The request of the findings; `None` without predictions.
    request: Option<Request>,
    /// The error of the losses and the seed of the questions about the order, where they are asked.
    robust: Option<(f64, u64)>,
}

impl ReportArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        let Self { output, max_size, figure, robust, layout, accuracy, rendering, comparison } = self;
        check_destination(&output)?;
        let comparison = ComparisonJob::new(&comparison, given)?;
        let (session, is_alone) = (comparison.session.as_ref(), comparison.materials.predictions() == 0);
        if figure {
            given.refuse::<SceneArgs<Accuracy>>("the figure alone has no loss")?;
        }
        if is_alone {
            let reason = "there is no prediction, and no loss";
            given.refuse::<SceneArgs<Accuracy>>(reason)?;
            refuse(layout.is_some(), "layout", reason)?;
            refuse(robust, "robust", reason)?;
        }
        let options = accuracy.options()?;
        let question = || SessionSettings::question(session, &options);
        let request = (!is_alone && !figure).then(question).transpose()?.map(|question| question.request);
        let mut display = session.map(|session| session.display().clone()).unwrap_or_default();
        display.layout = layout.unwrap_or(display.layout);
        let scene = rendering.scene.scene(session.map(|session| session.scene))?;
        let exposure_ev = rendering.exposure.or(session.map(|session| session.exposure_ev));
        let robust = robust.then(|| options.accuracy());
        let whole = (!figure).then_some(WholePage { request, robust });
        Ok(Box::new(ReportJob { comparison, output, max_size, scene, exposure_ev, display, whole }))
    }
}

/// Computes the findings and writes the page; with `--strict` fails where the target error is not reached, after the file is written.
impl Job for ReportJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison, output, max_size, scene, exposure_ev, display, whole } = *self;
        let ComparisonJob { convention, materials, .. } = comparison;
        let opened = materials.open::<f32>()?;
        check_output(&output)?;
        let ground_truth = &opened.ground_truth;
        let exposure_ev = exposure_ev.unwrap_or_else(|| exposure(ground_truth, &scene, &convention));
        let predictions: Vec<_> = opened.predictions.iter().collect();
        let robust = whole.as_ref().and_then(|page| page.robust);
        let findings = |request: &Request| -> Result<Findings, CommandError> {
            let found =
                watched("rendering", |p| Findings::new(ground_truth, &predictions, convention, request, p))?;
            let comparison = Comparison::new(ground_truth, &predictions, convention)?;
            let ask = |accuracy| watched("rendering", |p| RobustReport::new(&comparison, accuracy, p));
            Ok(Findings { robust: robust.map(ask).transpose()?, ..found })
        };
        let request = whole.as_ref().and_then(|page| page.request.as_ref());
        let findings = request.map(findings).transpose()?;
        let missed = findings.as_ref().map_or(Vec::new(), |findings| findings.loss.missed());
        let all: Vec<&Material<f32>> = std::iter::once(ground_truth).chain(predictions).collect();
        let report = Report {
            materials: &all,
            convention,
            view: View { scene, exposure_ev, display },
            findings,
            readings: whole.as_ref().map_or(Vec::new(), |_| opened.readings.clone()),
            repetition: whole.map(|_| Repetition { command: command_line(), session: None }),
            max_bytes: max_size,
        };
        let page = watched("writing", |progress| report.page(progress))?;
        check_size(&page, max_size)?;
        stoppable(|progress| write_text(&output, &page.html, progress))?;
        tell_reduction(&page, max_size);
        warn_of(missed, materials.strict)
    }
}

/// Refuses a page of more than `limit` bytes, which smaller maps do not help.
fn check_size(page: &Page, limit: usize) -> Result<(), CommandError> {
    let bytes = page.html.len();
    if bytes <= limit { Ok(()) } else { Err(CommandError::ReportTooLarge { bytes, limit }) }
}

/// Reports what the size of the file, at most `most` bytes, has cost.
fn tell_reduction(page: &Page, most: usize) {
    if let Some([width, height]) = page.reduced_to {
        exit::tell(&format!(
            "note: the maps of the figure are reduced to {width} x {height} texels for --max-size {most}; findings are of all texels"
        ));
    }
}
