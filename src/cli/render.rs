//! `svbrdf render`: renders materials (Algorithm 3) to a file.

use std::path::PathBuf;

use svbrdf_core::error::Error;
use svbrdf_core::image::Image;
use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent, Pictures};
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, PictureFormat, Provenance};

use super::args::scenes::OneSceneArgs;
use super::args::values::{Range, stops};
use super::args::{ComparisonArgs, Given, modes};
use super::job::{ComparisonJob, SessionSettings, check_heights};
use super::output::stop::stoppable;
use super::output::{CommandError, watched};

/// Renders one material, or several side by side, to a file; or their maps, or differences
///
/// The material spans x in [-1, 1] in the plane z = 0; y points up, z towards the viewer. Without GT and PRED: the built-in
/// materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf render gt.png a.png --light 0.4,0.5,1.2 -o pair.png")]
pub struct RenderArgs {
    /// Output file: .exr for linear floats, .png for exposed, sRGB-encoded 8 bits
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    #[command(flatten)]
    scene: OneSceneArgs,

    /// Exposure of renderings in a PNG, in stops; an EXR keeps the radiance, and differences have none [default: 0, or that
    /// of the session]
    #[arg(long, value_name = "EV", value_parser = stops, allow_hyphen_values = true)]
    exposure: Option<f32>,

    /// What is written: rendering, normal, diffuse, specular or roughness [default: rendering; of a session what its window
    /// showed, value or difference]
    #[arg(long, value_name = "QUANTITY")]
    show: Option<Quantity>,

    /// Writes the difference of each prediction from GT, in a PNG as colours: log, signed-log, absolute, signed or relative;
    /// of normals angle [default: log, of normals angle, of other maps absolute]
    #[arg(long, value_name = "KIND", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    difference: Option<String>,

    /// The difference with the last colour: a number, or auto for the 99th percentile of the largest [default: 2 for
    /// logarithms, 45 degrees, else 1]
    #[arg(long, value_name = "RANGE", requires = "difference")]
    range: Option<Range>,

    /// Renders on the graphics adapter instead of the CPU
    #[arg(long)]
    gpu: bool,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// A picture to write: the arguments, resolved.
struct RenderJob {
    comparison: ComparisonJob,
    destination: Destination<PictureFormat>,
    scene: Scene,
    content: PictureContent,
    exposure_ev: f32,
    on_adapter: bool,
}

/// Renders and writes the file.
///
/// # Errors
/// Where the output cannot be written, or a material cannot be read or rendered.
pub fn run(args: &RenderArgs, given: &Given) -> Result<(), CommandError> {
    let job = RenderJob::new(args, given)?;
    let opened = job.comparison.materials.open::<f32>()?;
    check_output(&args.output)?;
    let materials = opened.into_all();
    if let ([ground_truth, predictions @ ..], Some(_)) = (materials.as_slice(), job.content.difference) {
        predictions.iter().try_for_each(|prediction| check_same_size(ground_truth, prediction))?;
    }
    check_heights(&materials)?;
    let (values, renderer) = job.values(&materials)?;
    let RenderJob { comparison: ComparisonJob { convention, .. }, destination, scene, exposure_ev, .. } = job;
    let Pictures { images, content } = job.content.of_values(values, &convention, exposure_ev);
    let sources = materials.iter().map(|m| m.name().to_owned()).collect();
    let provenance = Provenance { content, scene, convention, exposure_ev, sources, renderer };
    Ok(stoppable(|progress| destination.write(&images, &provenance, progress))?)
}

impl RenderJob {
    fn new(args: &RenderArgs, given: &Given) -> Result<Self, CommandError> {
        let destination = Destination::new(&args.output)?;
        let comparison = ComparisonJob::new(&args.comparison, given)?;
        let session = comparison.session.as_ref();
        let scene = args.scene.scene(session.map(|session| session.scene))?;
        let content = content(args, session)?;
        if content.quantity != Quantity::Rendering {
            given.check(&modes::RENDER_MAPS)?;
        }
        if content.difference.is_some() && comparison.materials.predictions() == 0 {
            let problem = "--difference compares predictions with a ground truth; give both";
            return Err(CommandError::usage(problem));
        }
        check_difference(&content, destination.format(), given)?;
        let exposure_ev = args.exposure.or(session.map(|session| session.exposure_ev)).unwrap_or(0.0);
        Ok(Self { comparison, destination, scene, content, exposure_ev, on_adapter: args.gpu })
    }

    /// The renderings or maps, and the name of the device that rendered them.
    fn values(&self, materials: &[Material<f32>]) -> Result<(Vec<Image<f32>>, String), Error> {
        let Self { comparison: ComparisonJob { convention, .. }, scene, content, .. } = self;
        if self.on_adapter {
            return rendered_on_adapter(materials, scene, convention);
        }
        let one = |material| {
            watched("rendering", |progress| content.quantity.image(material, scene, convention, progress))
        };
        let images = materials.iter().map(one).collect::<Result<_, _>>()?;
        Ok((images, "CPU, f32".to_owned()))
    }
}

/// Refuses the options that a difference does not use.
fn check_difference(
    content: &PictureContent,
    format: PictureFormat,
    given: &Given,
) -> Result<(), CommandError> {
    let Some(difference) = content.difference else { return Ok(()) };
    if difference.kind != Difference::Flip {
        given.check(&modes::RENDER_DIFFERENCE)?;
    }
    match format {
        PictureFormat::Exr => given.check(&modes::RENDER_NUMBERS),
        PictureFormat::Png => Ok(()),
    }
}

/// The quantity and difference that are written: those of the session, unless an option specifies others.
fn content(args: &RenderArgs, session: Option<&SessionSettings>) -> Result<PictureContent, CommandError> {
    if let (Some(session), None, None) = (session, args.show, &args.difference) {
        return Ok(session.content());
    }
    let quantity = args.show.unwrap_or_default();
    let difference = args.difference.as_ref().map(|kind| difference_of(quantity, kind, args.range));
    Ok(PictureContent { quantity, difference: difference.transpose()? })
}

/// The difference of this name, or the default one of `quantity`.
///
/// # Errors
/// [`Error::UnknownName`], [`CommandError::Usage`] where the quantity has no such difference.
pub fn difference_of(
    quantity: Quantity,
    name: &str,
    range: Option<Range>,
) -> Result<ColouredDifference, CommandError> {
    let all = Difference::all(quantity);
    let kind = if name.is_empty() { all[0] } else { name.parse()? };
    if !all.contains(&kind) {
        let known = all.iter().map(|kind| kind.key()).collect::<Vec<_>>().join(", ");
        let (quantity, found) = (quantity.name(), kind.key());
        return Err(CommandError::Usage(format!(
            "expected a difference of {quantity}, {known}; found {found}"
        )));
    }
    let range = match range {
        Some(Range::Auto) => None,
        Some(Range::Last(range)) => Some(range),
        None => Some(kind.default_range()),
    };
    Ok(ColouredDifference { kind, range })
}

#[cfg(feature = "gpu")]
fn rendered_on_adapter(
    materials: &[Material<f32>],
    scene: &Scene,
    convention: &Convention,
) -> Result<(Vec<Image<f32>>, String), Error> {
    let gpu = svbrdf_gpu::Gpu::headless()?;
    let renderer = gpu.report.to_string();
    super::output::exit::tell(&format!("note: {renderer}"));
    let one = |material| gpu.render(material, scene, convention);
    Ok((materials.iter().map(one).collect::<Result<_, _>>()?, renderer))
}

#[cfg(not(feature = "gpu"))]
fn rendered_on_adapter(
    _: &[Material<f32>],
    _: &Scene,
    _: &Convention,
) -> Result<(Vec<Image<f32>>, String), Error> {
    Err(Error::NoAdapter {
        problem: "this program was built without GPU support".to_owned(),
        remedy: "leave out --gpu, or build with the feature `gpu`",
    })
}
