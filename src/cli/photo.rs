//! `svbrdf photo`: renderings against a photograph, or against several of one material.

use std::path::PathBuf;

use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_evaluate::photograph::PhotoReport;
use svbrdf_evaluate::report::position;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, Provenance};
use svbrdf_files::photograph::{Capture, SessionPhotograph};
use svbrdf_files::read::Albedo;

use super::args::scenes::OneSceneArgs;
use super::args::{ComparisonArgs, Specified, offered, refuse};
use super::job::{ComparisonJob, Job, NewJob, check_heights};
use super::output::exit::{put, tell};
use super::output::{CommandError, ReportFormat, stoppable, watched};

/// Compares renderings of materials with a rectified photograph, or with several
///
/// Each material is rendered under the light and the view of each photograph (Algorithm 3). One factor brings the photographs to the
/// exposure of the renderings, and is printed: the median of rendering / photograph. Then the log difference, RMSE and SSIM are printed,
/// the material with the smallest log difference first. Clipped pixels are left out. Nothing else is aligned or calibrated.
/// docs/photographs.md describes the files that list several photographs with their lights and views.
#[derive(Debug, clap::Args)]
#[command(override_usage = "svbrdf photo <PHOTO> <MATERIAL>... [OPTIONS]")]
#[command(mut_arg("ground_truth", |arg| arg.value_name("MATERIAL").required(true).help(
    "Material: a packed or layered image, a folder, a name prefix, or a session file of the window")))]
#[command(mut_arg("predictions", |arg| arg.value_name("MATERIAL").help("More materials")))]
#[command(mut_arg("view", |arg| arg.help("Position of the camera, or its direction with --distant [default: as in the session]")))]
#[command(mut_arg("light", |arg| arg.help("Position of the light, or its direction with --distant [default: as in the session]")))]
pub struct PhotoArgs {
    /// Photograph that the material fills; or a folder with capture.json or MaterialGAN's render.json, or such a file
    #[arg(value_name = "PHOTO")]
    photo: PathBuf,

    #[command(flatten)]
    scene: OneSceneArgs,

    /// Transfer curve of the photograph [default: linear for floats and PNG files that declare it, srgb for other integers]
    #[arg(long, value_name = "linear|srgb|gamma2.2")]
    #[arg(value_parser = offered(str::parse::<Albedo>, ["linear", "srgb", "gamma2.2"]), hide_possible_values = true)]
    transfer: Option<Albedo>,

    /// Divides out the falloff of a point light, which Algorithm 3 does not model: for a flash or lamp near the material
    #[arg(long)]
    falloff: bool,

    /// Writes the log difference of each material from a single photograph: .exr for numbers, .png for colours
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Output format
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Photographs and materials to compare.
#[derive(Debug)]
struct PhotoJob {
    capture: Capture,
    comparison: ComparisonJob,
    output: Option<PathBuf>,
    format: ReportFormat,
}

impl PhotoArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        let comparison = ComparisonJob::new(&self.comparison, given)?;
        comparison.materials.refuse_mask("photographs are compared over all texels")?;
        let Self { photo: path, scene, transfer, falloff, output, format, .. } = self;
        let capture = if Capture::is_named(&path) {
            let reason = "the list of the photographs has their lights and views, and how they are read";
            given.refuse::<OneSceneArgs>(reason)?;
            refuse(falloff, "falloff", reason)?;
            refuse(transfer.is_some(), "transfer", reason)?;
            Capture::read(&path)?
        } else {
            let saved = comparison.session.as_ref().map(|session| session.scene);
            if saved.is_none() && !scene.is_specified() {
                return Err(CommandError::usage(
                    "light and view of the photograph are missing; give --view X,Y,Z and --light X,Y,Z",
                ));
            }
            Capture::of_one(SessionPhotograph { path, transfer, falloff }, scene.scene(saved)?)
        };
        if capture.photographs.len() > 1 {
            refuse(output.is_some(), "output", "only differences from a single photograph are written")?;
        }
        Ok(Box::new(PhotoJob { capture, comparison, output, format }))
    }
}

impl Job for PhotoJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { capture, comparison, output, format } = *self;
        let destination = output.as_deref().map(Destination::of_picture).transpose()?;
        let materials = comparison.materials.open::<f32>()?.into_all();
        output.as_deref().map_or(Ok(()), check_output)?;
        if destination.is_some() {
            check_heights(&materials)?;
        }
        let named = materials.iter().map(|material| (material.name(), material));
        let report = watched("comparing", |progress| {
            PhotoReport::new(&capture, named, &comparison.convention, progress)
        })?;
        report.notes.iter().for_each(|note| tell(&format!("note: {note}")));
        if let Some(destination) = destination {
            let compared: Vec<_> = report.results.iter().filter_map(|one| one.compared.as_ref()).collect();
            let values: Vec<_> = compared.iter().map(|one| one.differences(Difference::Log)).collect();
            let panes: Vec<_> = compared.iter().map(|one| one.difference(Difference::Log)).collect();
            // The 99th percentile of the material where it is largest.
            let last = Distributions::of(&values, false).auto_range;
            let entries = entries(&report, last);
            stoppable(|progress| destination.write_maps(&panes, last as f32, &entries, progress))?;
        }
        Ok(put(&format.write(&report)?)?)
    }
}

/// What a picture of the differences says of itself.
fn entries(report: &PhotoReport, last: f64) -> [(&'static str, String); 7] {
    let PhotoReport { path, results, scenes, convention, .. } = report;
    let kind = Difference::Log;
    let shows = format!(
        "{} from the photograph g, {} of renderings p; NaN or gray where the photograph is clipped; {last} the last colour",
        kind.name(),
        kind.unit()
    );
    let scenes = scenes
        .iter()
        .map(|one| format!("{}, view {}, light {}", one.kind, position(one.view), position(one.light)));
    let joined = |texts: Vec<String>| texts.join(" | ");
    [
        ("svbrdf:shows", shows),
        ("svbrdf:photograph", path.clone()),
        ("svbrdf:factors", joined(results.iter().map(|one| one.factor.to_string()).collect())),
        ("svbrdf:sources", joined(results.iter().map(|one| one.material.clone()).collect())),
        ("svbrdf:convention", (*convention).to_owned()),
        ("svbrdf:scene", scenes.collect()),
        ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
    ]
}
