//! `svbrdf strip`: a figure with materials in rows, and maps, renderings and differences in columns.

use std::path::PathBuf;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::Material;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::PngDestination;
use svbrdf_files::export::strip::{Column, Crop, Strip};
use svbrdf_files::scene_file;

use super::args::lights::LightsArgs;
use super::args::scenes::OneSceneArgs;
use super::args::values::{Range, stops};
use super::args::{ComparisonArgs, Given, modes};
use super::job::{ComparisonJob, SessionSettings};
use super::output::stop::stoppable;
use super::output::{CommandError, watched};
use super::render::difference_of;

/// Writes a labelled figure: a row per material, a column per map, rendering or difference
///
/// Every cell has the pixels that `svbrdf render` writes, one per texel, but for the frames of crops. The row of GT has the
/// scale bars of differences.
#[derive(Debug, clap::Args)]
#[command(mut_arg("lights", |arg| arg.conflicts_with_all(["scenes", "view", "light", "distant"]).help(
    "Lights and views of a publication: flash, flash-9 or hemisphere; renderings and their differences have a column for each")))]
#[command(
    after_help = "Example:\n  svbrdf strip gt.png a.png --columns normal,roughness:,rendering -o figure.png"
)]
pub struct StripArgs {
    /// Output file, .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Columns: rendering, normal, diffuse, specular, roughness; with a colon and a kind, or a colon alone, differences:
    /// rendering:log, normal:; of a session, the difference that was chosen in its window
    #[arg(
        long,
        value_name = "COLUMN,...",
        value_delimiter = ',',
        default_value = "normal,diffuse,roughness,specular,rendering,rendering:"
    )]
    columns: Vec<String>,

    /// Scene file; renderings and their differences have a column for each of its scenes
    #[arg(long, value_name = "FILE", conflicts_with_all = ["view", "light", "distant"])]
    scenes: Option<PathBuf>,

    #[command(flatten)]
    lights: LightsArgs,

    #[command(flatten)]
    scene: OneSceneArgs,

    /// Exposure of renderings in stops [default: 0, or as in the session]
    #[arg(long, value_name = "EV", value_parser = stops, allow_hyphen_values = true)]
    exposure: Option<f32>,

    /// The difference with the last colour: a number, or auto for the 99th percentile of the largest in a column
    /// [default: 2 for logarithms, 45 degrees, else 1]
    #[arg(long, value_name = "RANGE")]
    range: Option<Range>,

    /// Rectangle of texels that is framed in every cell and magnified beside it: left, top, width, height; may be given
    /// several times
    #[arg(long = "crop", value_name = "X,Y,W,H")]
    crops: Vec<Crop>,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Renders and writes the figure.
///
/// # Errors
/// Where the output cannot be written, or a material cannot be read or rendered.
pub fn run(args: &StripArgs, given: &Given) -> Result<(), CommandError> {
    let destination = PngDestination::new(&args.output)?;
    let job = ComparisonJob::new(&args.comparison, given)?;
    let session = job.session.as_ref();
    let columns = columns(args, session, given)?;
    check_options(&columns, given)?;
    let exposure_ev = args.exposure.or(session.map(|session| session.exposure_ev)).unwrap_or(0.0);
    let strip = Strip { columns, convention: job.convention, exposure_ev, crops: args.crops.clone() };
    let opened = job.materials.open::<f32>()?;
    check_output(&args.output)?;
    let materials = opened.into_all();
    if let [ground_truth, predictions @ ..] = materials.as_slice() {
        predictions.iter().try_for_each(|prediction| check_same_size(ground_truth, prediction))?;
    }
    let names: Vec<String> = materials.iter().map(|material| material.name().to_owned()).collect();
    let all: Vec<&Material<f32>> = materials.iter().collect();
    let picture = watched("rendering", |progress| strip.picture(&all, &names, progress))?;
    Ok(stoppable(|progress| destination.write(&picture, &strip.entries(&names), progress))?)
}

/// Refuses options that no column uses.
fn check_options(columns: &[Column], given: &Given) -> Result<(), CommandError> {
    if columns.iter().all(|column| column.content.quantity != Quantity::Rendering) {
        given.check(&modes::STRIP_MAPS)?;
    }
    if columns.iter().all(|column| column.content.difference.is_none()) {
        given.check(&modes::STRIP_VALUES)?;
    }
    Ok(())
}

fn columns(
    args: &StripArgs,
    session: Option<&SessionSettings>,
    given: &Given,
) -> Result<Vec<Column>, CommandError> {
    if !args.lights.is_named() {
        given.check(&modes::STRIP_SAMPLED)?;
    }
    let scenes = match (args.lights.scenes(given)?, &args.scenes) {
        (Some(scenes), _) => scenes,
        (None, Some(path)) => scene_file::read(path)?,
        (None, None) => vec![args.scene.scene(session.map(|session| session.scene))?],
    };
    let mut columns = Vec::new();
    for text in &args.columns {
        let (quantity, difference) = match text.split_once(':') {
            Some((quantity, kind)) => (quantity, Some(kind)),
            None => (text.as_str(), None),
        };
        let quantity: Quantity = quantity.trim().parse()?;
        let difference = match (difference, session) {
            (Some(""), Some(session)) if args.range.is_none() => Some(session.difference(quantity)),
            _ => difference.map(|kind| difference_of(quantity, kind, args.range)).transpose()?,
        };
        let count = if quantity == Quantity::Rendering { scenes.len() } else { 1 };
        let content = PictureContent { quantity, difference };
        columns.extend(scenes.iter().take(count).map(|scene| Column { content, scene: *scene }));
    }
    Ok(columns)
}
