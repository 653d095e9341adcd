//! `svbrdf strip`: a figure with materials in rows, and maps, renderings and differences in columns.

use std::path::PathBuf;

use svbrdf::error::Error;
use svbrdf::loss::check_same_size;
use svbrdf::material::Material;
use svbrdf::model::scene_file;
use svbrdf::picture::export::PngDestination;
use svbrdf::picture::quantity::Quantity;
use svbrdf::picture::shown::Shown;
use svbrdf::picture::strip::{Column, Strip};

use super::bar::watched;
use super::comparison_args::ComparisonArgs;
use super::materials;
use super::render::{Range, difference_of, stops};
use super::scene_args::OneSceneArgs;
use super::session::SessionSettings;
use super::stop::stoppable;

/// Writes a labelled figure: a row per material, a column per map, rendering or difference
///
/// Every cell has the pixels that `svbrdf render` writes, one per texel. The row of GT has the legends of differences.
#[derive(Debug, clap::Args)]
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
    scene: OneSceneArgs,

    /// Exposure of renderings in stops [default: 0, or as in the session]
    #[arg(long, value_name = "EV", value_parser = stops, allow_hyphen_values = true)]
    exposure: Option<f32>,

    /// The difference with the last colour: a number, or auto for the 99th percentile of the largest in a column
    /// [default: 2 for logarithms, 45 degrees, else 1]
    #[arg(long, value_name = "RANGE")]
    range: Option<Range>,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// Renders and writes the figure.
///
/// # Errors
/// Where the output cannot be written, or a material cannot be read or rendered.
pub fn run(args: &StripArgs) -> Result<(), Error> {
    let destination = PngDestination::new(&args.output)?;
    let saved = SessionSettings::of(&args.comparison.materials)?;
    let columns = columns(args, saved.as_ref())?;
    let materials = materials::open::<f32>(&args.comparison.materials)?.into_all();
    if let [ground_truth, predictions @ ..] = materials.as_slice() {
        predictions.iter().try_for_each(|prediction| check_same_size(ground_truth, prediction))?;
    }
    let exposure_ev = args.exposure.or(saved.map(|saved| saved.exposure_ev)).unwrap_or(0.0);
    let strip = Strip { columns, convention: args.comparison.convention(), exposure_ev };
    let names: Vec<String> = materials.iter().map(|material| material.name().to_owned()).collect();
    let all: Vec<&Material<f32>> = materials.iter().collect();
    let picture = watched("rendering", |progress| strip.picture(&all, &names, progress))?;
    stoppable(|progress| destination.write(&picture, &strip.entries(&names), progress))
}

fn columns(args: &StripArgs, saved: Option<&SessionSettings>) -> Result<Vec<Column>, Error> {
    let scenes = match &args.scenes {
        Some(path) => scene_file::read(path)?,
        None => vec![args.scene.scene(saved.map(|saved| saved.scene))?],
    };
    let mut columns = Vec::new();
    for text in &args.columns {
        let (quantity, difference) = match text.split_once(':') {
            Some((quantity, kind)) => (quantity, Some(kind)),
            None => (text.as_str(), None),
        };
        let quantity: Quantity = quantity.trim().parse()?;
        let difference = match (difference, saved) {
            (Some(""), Some(saved)) if args.range.is_none() => Some(saved.difference(quantity)),
            _ => difference.map(|kind| difference_of(quantity, kind, args.range)).transpose()?,
        };
        let count = if quantity == Quantity::Rendering { scenes.len() } else { 1 };
        let shown = Shown { quantity, difference };
        columns.extend(scenes.iter().take(count).map(|scene| Column { shown, scene: *scene }));
    }
    Ok(columns)
}
