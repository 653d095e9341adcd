//! `svbrdf metrics`: metrics beside the loss.

use svbrdf_core::loss::Request;
use svbrdf_core::material::Material;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_evaluate::metrics::{Metric, RenderedScenes, of_maps, of_renderings};
use svbrdf_evaluate::report::{Compared, MetricsReport};
use svbrdf_files::Error;

use super::args::scenes::SceneArgs;
use super::args::values::stops;
use super::args::{ComparisonArgs, Given, refuse};
use super::job::{ComparisonJob, Job, NewJob};
use super::output::report::ReportFormat;
use super::output::{CommandError, exit, watched};
use super::protocol::{self, ProtocolArgs};

/// Prints metrics of maps and renderings, each with its convention in its name
///
/// Root mean square and mean absolute differences, PSNR and SSIM of the four maps and of renderings, the same of base colour and
/// metallic, angles between normals, and FLIP of renderings. docs/metrics.md defines each. With --protocol: those of a published evaluation, as
/// its released code computes them. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf metrics gt.png a.png b.png --format csv")]
pub struct MetricsArgs {
    #[command(flatten)]
    scenes: SceneArgs,

    #[command(flatten)]
    protocol: ProtocolArgs,

    /// Exposure of renderings in stops, before they are clipped [default: 0]
    #[arg(long, value_name = "EV", value_parser = stops, allow_hyphen_values = true)]
    exposure: Option<f32>,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Debug)]
struct MetricsJob {
    comparison: ComparisonJob,
    metrics: Metrics,
    format: ReportFormat,
}

/// The metrics, with what they take.
#[derive(Debug)]
enum Metrics {
    Ours { request: Request, exposure_ev: f32 },
    OfProtocol(ProtocolArgs),
}

impl MetricsArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let Self { scenes, protocol, exposure, format, comparison: args } = self;
        let comparison = ComparisonJob::with_predictions(&args, given)?;
        let metrics = if protocol.protocol.is_some() {
            let reason = "a protocol has its own scenes, convention and exposure";
            given.refuse::<SceneArgs>(reason)?;
            refuse(args.convention.is_some(), "convention", reason)?;
            refuse(exposure.is_some(), "exposure", reason)?;
            let resizes = args.materials.reading.resize_to.is_some();
            refuse(resizes, "resize-to", "a protocol compares materials as they are")?;
            if comparison.session.is_some() {
                let problem = "a protocol takes the files of materials; name them instead of a session";
                return Err(CommandError::usage(problem));
            }
            Metrics::OfProtocol(protocol)
        } else {
            refuse(protocol.renderings.is_some(), "renderings", "only a --protocol writes renderings")?;
            Metrics::Ours { request: scenes.options()?.listed()?, exposure_ev: exposure.unwrap_or(0.0) }
        };
        Ok(Box::new(MetricsJob { comparison, metrics, format }))
    }
}

/// Prints the metrics to stdout.
impl Job for MetricsJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let ComparisonJob { convention, materials, .. } = &self.comparison;
        let (request, exposure_ev) = match &self.metrics {
            Metrics::Ours { request, exposure_ev } => (request, *exposure_ev),
            Metrics::OfProtocol(protocol) => return protocol::run(protocol, materials, self.format),
        };
        let scenes = request.scenes(convention)?.unwrap_or_default();
        let sampling = request.sampling();
        let rendered = RenderedScenes {
            scenes: &scenes,
            sampler: sampling.map_or(Sampler::Random, |sampling| sampling.sampler),
            convention,
            exposure_ev,
        };
        let opened = materials.open::<f32>()?;
        let truth = &opened.ground_truth;
        let one = |prediction: &Material<f32>| -> Result<(String, Vec<Metric>), Error> {
            let renderings =
                watched("rendering", |progress| of_renderings(truth, prediction, &rendered, progress))?;
            Ok((prediction.name().to_owned(), [of_maps(truth, prediction)?, renderings].concat()))
        };
        let results = opened.predictions.iter().map(one).collect::<Result<Vec<_>, _>>()?;
        let compared = Compared::new(truth, convention);
        let report = MetricsReport::new(&compared, sampling.as_ref(), &rendered, results);
        Ok(exit::put(&self.format.write(&report)?)?)
    }
}
