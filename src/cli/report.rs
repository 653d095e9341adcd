//! `svbrdf report`: one HTML file with an interactive figure and the findings.

use std::path::PathBuf;

use svbrdf_core::loss::Request;
use svbrdf_core::material::Material;
use svbrdf_core::model::scene::Scene;
use svbrdf_evaluate::report::Report as _;
use svbrdf_files::disk::atomic::write_text;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::session::window::SessionDisplay;
use svbrdf_page::{Findings, MOST_BYTES, PageReport, View, check_destination, exposure};

use super::args::protocol::MaskArgs;
use super::args::scenes::{Accuracy, RenderingArgs, SceneArgs};
use super::args::{ComparisonArgs, Specified};
use super::job::{self, ComparisonJob, Job, NewJob, SessionSettings};
use super::output::{CommandError, command_line, exit, stoppable, warn_of, watched};

/// Writes a page with an interactive figure and the findings, which opens in any browser
///
/// One HTML file without a network: readers move light and view, zoom, and compare values and differences, on a desktop or a phone.
/// Below the figure, without script: losses with intervals, the share of each map, the worst scenes, the assumptions in reading, and the
/// command that makes the file. Maps of the figure are halved until the file has at most 10 MB. Without GT and PRED: the built-in
/// materials.
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

    /// Writes the figure alone, without findings, to be embedded with an <iframe>
    #[arg(long)]
    figure: bool,

    #[command(flatten)]
    accuracy: SceneArgs<Accuracy>,

    #[command(flatten)]
    rendering: RenderingArgs,

    #[command(flatten)]
    mask: MaskArgs,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Debug)]
struct ReportJob {
    comparison: ComparisonJob,
    output: PathBuf,
    scene: Scene,
    /// `None`: fitted to the ground truth.
    exposure_ev: Option<f32>,
    display: SessionDisplay,
    /// Without findings.
    is_figure: bool,
    /// The request of the findings; `None` without predictions.
    request: Option<Request>,
}

impl ReportArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        let Self { output, figure: is_figure, accuracy, rendering, mask, comparison } = self;
        check_destination(&output)?;
        let mut comparison = ComparisonJob::new(&comparison, given)?;
        comparison.materials.is_comparison = true;
        comparison.materials.mask(mask.mask.as_ref());
        let (session, is_alone) = (comparison.session.as_ref(), comparison.materials.predictions() == 0);
        if is_figure {
            given.refuse::<SceneArgs<Accuracy>>("the figure alone has no loss")?;
        }
        if is_alone {
            given.refuse::<SceneArgs<Accuracy>>("there is no prediction, and no loss")?;
        }
        let options = accuracy.options()?;
        let request = || SessionSettings::request(session, &options);
        let request = (!is_alone && !is_figure).then(request).transpose()?;
        let display = session.map(|session| session.display.clone()).unwrap_or_default();
        let scene = rendering.scene.scene(session.map(|session| session.scene))?;
        let exposure_ev = rendering.exposure.or(session.map(|session| session.exposure_ev));
        Ok(Box::new(ReportJob { comparison, output, scene, exposure_ev, display, is_figure, request }))
    }
}

/// Computes the findings and writes the page; with `--strict` fails where the target error is not reached, after the file is written.
impl Job for ReportJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison, output, scene, exposure_ev, display, is_figure, request } = *self;
        let ComparisonJob { convention, materials, .. } = comparison;
        let opened = materials.open::<f32>()?;
        check_output(&output)?;
        let findings = |request| {
            let input = job::input(&opened, &materials, convention, request);
            watched("rendering", |progress| Findings::new(&input, progress))
        };
        let findings = request.map(findings).transpose()?;
        let missed = findings.as_ref().map_or(Vec::new(), |findings| findings.loss.missed());
        let (readings, mask) = (opened.readings.clone(), opened.mask.clone());
        let gray = |one: Material<f32>| match &mask {
            Some(mask) => one.gray_outside(mask),
            None => one,
        };
        let all: Vec<_> = opened.into_all().into_iter().map(gray).collect();
        let exposure_ev = exposure_ev.unwrap_or_else(|| exposure(&all[0], &scene, &convention));
        let all: Vec<&Material<f32>> = all.iter().collect();
        let report = PageReport {
            materials: &all,
            is_masked: mask.is_some(),
            convention,
            view: View { scene, exposure_ev, display },
            findings,
            readings: if is_figure { Vec::new() } else { readings },
            command: (!is_figure).then(command_line),
            max_bytes: MOST_BYTES,
        };
        let page = watched("writing", |progress| report.page(progress))?;
        stoppable(|progress| write_text(&output, &page.html, progress))?;
        if let Some([width, height]) = page.reduced_to {
            exit::tell(&format!(
                "note: the maps of the figure are reduced to {width} x {height} texels; findings are of all texels"
            ));
        }
        warn_of(missed, materials.strict)
    }
}
