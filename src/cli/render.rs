//! `svbrdf render`: renders materials (Algorithm 3) to a file.

use std::path::PathBuf;
use std::str::FromStr;

use svbrdf::error::Error;
use svbrdf::image::Image;
use svbrdf::loss::check_same_size;
use svbrdf::material::Material;
use svbrdf::model::scene::Scene;
use svbrdf::picture::difference::Difference;
use svbrdf::picture::export::{Destination, Provenance};
use svbrdf::picture::quantity::Quantity;
use svbrdf::picture::shown::{Shown, ShownDifference, ShownPictures};

use super::bar::watched;
use super::comparison_args::ComparisonArgs;
use super::materials;
use super::scene_args::OneSceneArgs;
use super::session::SessionSettings;
use super::stop::stoppable;

/// Renders one material, or several side by side, to a file; or their maps, or differences
///
/// The material spans x in [-1, 1] in the plane z = 0; y points up, z towards the viewer. Without GT and PRED: the built-in
/// materials.
#[derive(Debug, clap::Args)]
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

/// Renders and writes the file.
///
/// # Errors
/// Where the output cannot be written, or a material cannot be read or rendered.
pub fn run(args: &RenderArgs) -> Result<(), Error> {
    let destination = Destination::new(&args.output)?;
    let saved = SessionSettings::of(&args.comparison.materials)?;
    let scene = args.scene.scene(saved.as_ref().map(|saved| saved.scene))?;
    let shown = shown(args, saved.as_ref())?;
    let materials = materials::open::<f32>(&args.comparison.materials)?.into_all();
    match materials.as_slice() {
        [_] if shown.difference.is_some() => {
            let problem = "--difference compares predictions with a ground truth; give both";
            return Err(Error::Usage(problem.to_owned()));
        }
        [ground_truth, predictions @ ..] if shown.difference.is_some() => {
            predictions.iter().try_for_each(|prediction| check_same_size(ground_truth, prediction))?;
        }
        _ => {}
    }
    check_heights(&materials)?;
    let (values, renderer) = values(args, shown.quantity, &materials, &scene)?;
    let ShownPictures { images, shown } = shown.of_values(values, &args.comparison.convention());
    let exposure_ev = args.exposure.or(saved.map(|saved| saved.exposure_ev)).unwrap_or(0.0);
    let provenance = Provenance {
        shown,
        scene,
        convention: args.comparison.convention(),
        exposure_ev,
        sources: materials.iter().map(|m| m.name().to_owned()).collect(),
        renderer,
    };
    stoppable(|progress| destination.write(&images, &provenance, progress))
}

/// What is written: what the session shows, unless an option says otherwise.
fn shown(args: &RenderArgs, saved: Option<&SessionSettings>) -> Result<Shown, Error> {
    if let (Some(saved), None, None) = (saved, args.show, &args.difference) {
        return Ok(saved.shown());
    }
    let quantity = args.show.unwrap_or_default();
    let difference = args.difference.as_ref().map(|kind| difference_of(quantity, kind, args.range));
    Ok(Shown { quantity, difference: difference.transpose()? })
}

/// The difference of this name, or the default one of `quantity`.
///
/// # Errors
/// [`Error::UnknownName`], [`Error::Usage`] where the quantity has no such difference.
pub fn difference_of(quantity: Quantity, name: &str, range: Option<Range>) -> Result<ShownDifference, Error> {
    let all = Difference::all(quantity);
    let kind = if name.is_empty() { all[0] } else { name.parse()? };
    if !all.contains(&kind) {
        let known = all.iter().map(|kind| kind.key()).collect::<Vec<_>>().join(", ");
        let (quantity, found) = (quantity.name(), kind.key());
        return Err(Error::Usage(format!("expected a difference of {quantity}, {known}; found {found}")));
    }
    let range = match range {
        Some(Range::Auto) => None,
        Some(Range::Last(range)) => Some(range),
        None => Some(kind.default_range()),
    };
    Ok(ShownDifference { kind, range })
}

/// The difference that has the last colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    Auto,
    Last(f64),
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match (text, text.parse()) {
            ("auto", _) => Ok(Self::Auto),
            (_, Ok(range)) if range > 0.0 && f64::is_finite(range) => Ok(Self::Last(range)),
            _ => Err("expected auto or a number above 0".to_owned()),
        }
    }
}

/// Materials stand side by side only where they are equally high.
///
/// # Errors
/// [`Error::SizesDiffer`].
pub fn check_heights(materials: &[Material<f32>]) -> Result<(), Error> {
    let different = |pair: &&[Material<f32>]| pair[0].height() != pair[1].height();
    let Some(pair) = materials.windows(2).find(different) else { return Ok(()) };
    Err(Error::SizesDiffer {
        first: pair[0].name().to_owned(),
        first_size: pair[0].size(),
        second: pair[1].name().to_owned(),
        second_size: pair[1].size(),
        remedy: "only equally high materials can stand side by side; render them one by one",
    })
}

/// The renderings or maps, and the name of the device that rendered them.
fn values(
    args: &RenderArgs,
    quantity: Quantity,
    materials: &[Material<f32>],
    scene: &Scene,
) -> Result<(Vec<Image<f32>>, String), Error> {
    if args.gpu && quantity == Quantity::Rendering {
        return panes_of_gpu(args, materials, scene);
    }
    let one = |material| {
        watched("rendering", |progress| {
            quantity.image(material, scene, &args.comparison.convention(), progress)
        })
    };
    let panes = materials.iter().map(one).collect::<Result<_, _>>()?;
    Ok((panes, "CPU, f32".to_owned()))
}

#[cfg(feature = "gpu")]
fn panes_of_gpu(
    args: &RenderArgs,
    materials: &[Material<f32>],
    scene: &Scene,
) -> Result<(Vec<Image<f32>>, String), Error> {
    let gpu = svbrdf::gpu::Gpu::headless()?;
    let renderer = gpu.report.to_string();
    super::exit::tell(&format!("note: {renderer}"));
    let one = |material| gpu.render(material, scene, &args.comparison.convention());
    Ok((materials.iter().map(one).collect::<Result<_, _>>()?, renderer))
}

#[cfg(not(feature = "gpu"))]
fn panes_of_gpu(_: &RenderArgs, _: &[Material<f32>], _: &Scene) -> Result<(Vec<Image<f32>>, String), Error> {
    Err(Error::NoAdapter {
        problem: "this program was built without GPU support".to_owned(),
        remedy: "leave out --gpu, or build with the feature `gpu`",
    })
}

pub fn stops(text: &str) -> Result<f32, String> {
    let finite = text.parse().ok().filter(|stops: &f32| stops.is_finite());
    finite.ok_or_else(|| format!("expected a number of stops like -1.5, found `{text}`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_are_finite() {
        assert_eq!(stops("-1.5"), Ok(-1.5));
        assert!(["nan", "inf", "", "x"].iter().all(|wrong| stops(wrong).is_err()));
    }
}
