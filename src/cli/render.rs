//! `svbrdf render`: renders materials (Algorithm 3) to a file.

use std::path::PathBuf;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::Material;
use svbrdf_core::picture::content::{ColouredDifference, PictureContent, Pictures};
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::progress::Progress;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, Provenance};
use svbrdf_files::session::Session;
use svbrdf_files::session::window::SessionDisplay;

use super::args::scenes::RenderingArgs;
use super::args::values::Range;
use super::args::{ComparisonArgs, Specified, offered, refuse};
use super::job::{ComparisonJob, Job, NewJob, SessionSettings, check_heights};
use super::output::{CommandError, stoppable, watched};

/// Renders one material, or several side by side, to a file; or their maps, or differences
///
/// The material spans x in [-1, 1] in the plane z = 0; y points up, z towards the viewer. Without GT and PRED: the built-in
/// materials.
#[derive(Debug, clap::Args)]
#[command(mut_arg("exposure", |arg| arg.help(
    "Exposure of renderings in a PNG, in stops; an EXR keeps the radiance, and differences have none [default: 0, or that of the session]")))]
pub struct RenderArgs {
    /// Output file: .exr for linear floats, .png for exposed, sRGB-encoded 8 bits
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    #[command(flatten)]
    rendering: RenderingArgs,

    /// What is written: rendering, normal, diffuse, specular or roughness [default: rendering; of a session what its window
    /// showed, value or difference]
    #[arg(long, value_name = "QUANTITY")]
    #[arg(value_parser = offered(str::parse::<Quantity>, Quantity::ALL.map(Quantity::name)), hide_possible_values = true)]
    show: Option<Quantity>,

    /// Writes the difference of each prediction from GT, in a PNG as colours: log, signed-log, absolute, signed or relative;
    /// of normals angle [default: log, of normals angle, of other maps absolute]
    #[arg(long, value_name = "KIND", num_args = 0..=1, require_equals = true, default_missing_value = "")]
    difference: Option<String>,

    /// The difference with the last colour: a number, or auto for the 99th percentile of the largest [default: 2 for
    /// logarithms, 45 degrees, else 1]
    #[arg(long, value_name = "RANGE", requires = "difference")]
    range: Option<Range>,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// A picture to write.
#[derive(Debug)]
struct RenderJob {
    comparison: ComparisonJob,
    output: PathBuf,
    destination: Destination,
    content: PictureContent,
    /// With the scene and the exposure.
    saved: Session,
}

impl RenderArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        let destination = Destination::of_picture(&self.output)?;
        let comparison = ComparisonJob::new(&self.comparison, given)?;
        let session = comparison.session.as_ref();
        let content = content(&self, session)?;
        if content.quantity != Quantity::Rendering {
            let reason = "a map has no light, no view, no exposure and no convention, and is not rendered";
            self.refuse_of_renderings(given, reason)?;
        }
        if content.difference.is_some() && comparison.materials.predictions() == 0 {
            let problem = "--difference compares predictions with a ground truth; give both";
            return Err(CommandError::usage(problem));
        }
        let Self { output, rendering: RenderingArgs { scene, exposure }, range, .. } = self;
        if let Some(difference) = content.difference {
            let (is_exposed, is_exr) = (difference.kind == Difference::Flip, destination.is("exr"));
            let reason = "only --difference=flip compares exposed renderings";
            refuse(exposure.is_some() && !is_exposed, "exposure", reason)?;
            let reason = "an EXR holds differences as numbers, without colours";
            refuse(range.is_some() && is_exr, "range", reason)?;
        }
        let scene = scene.scene(session.map(|session| session.scene))?;
        let exposure_ev = exposure.or(session.map(|session| session.exposure_ev)).unwrap_or(0.0);
        let mut saved = comparison.saved(scene, exposure_ev);
        let mut display = SessionDisplay { quantity: content.quantity, ..Default::default() };
        if let Some(ColouredDifference { kind, range }) = content.difference {
            display.difference = true;
            display.differences.choose(content.quantity, kind);
            display.differences.set_range(content.quantity, range);
        }
        saved.window.display = Some(display);
        Ok(Box::new(RenderJob { comparison, output, destination, content, saved }))
    }

    /// Refuses the options that maps do not use.
    fn refuse_of_renderings(&self, given: &Specified, reason: &str) -> Result<(), CommandError> {
        given.refuse::<RenderingArgs>(reason)?;
        refuse(self.comparison.convention.is_some(), "convention", reason)
    }
}

/// Renders and writes the file.
impl Job for RenderJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let opened = self.comparison.materials.open::<f32>()?;
        check_output(&self.output)?;
        let mask = opened.mask.clone();
        let gray = |one: Material<f32>| mask.iter().fold(one, Material::gray_outside);
        let materials: Vec<_> = opened.into_all().into_iter().map(gray).collect();
        if let ([ground_truth, predictions @ ..], Some(_)) = (materials.as_slice(), self.content.difference) {
            predictions.iter().try_for_each(|prediction| check_same_size(ground_truth, prediction))?;
        }
        check_heights(&materials)?;
        let Self {
            comparison: ComparisonJob { convention, .. }, destination, content, saved: session, ..
        } = *self;
        let one = |material| {
            let image =
                |progress: &Progress| content.quantity.image(material, &session.scene, &convention, progress);
            watched("rendering", image)
        };
        let values = materials.iter().map(one).collect::<Result<_, _>>()?;
        let Pictures { images, content } = content.of_values(values, &convention, session.exposure);
        let sources = materials.iter().map(|m| m.name().to_owned()).collect();
        let renderer = "CPU, f32".to_owned();
        let provenance = Provenance { content, convention, sources, renderer, session };
        Ok(stoppable(|progress| destination.write_picture(&images, &provenance, None, progress))?)
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
