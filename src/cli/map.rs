//! `svbrdf map`: the loss over texels, lights or views.

use std::path::{Path, PathBuf};

use svbrdf_core::error::Error;
use svbrdf_core::loss::Comparison;
use svbrdf_core::model::scene::Endpoint;
use svbrdf_evaluate::report::{MapReport, Report as _};
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, PictureFormat, Provenance, check_place, write_text};

use super::args::scenes::SceneArgs;
use super::args::{ComparisonArgs, Given, modes, values};
use super::job::ComparisonJob;
use super::output::stop::stoppable;
use super::output::{CommandError, exit, watched};

/// Writes the loss over texels, light directions or view directions to a file
///
/// Over texels: the mean log difference of each texel over all scenes, whose mean is the loss. Over lights or views: the loss in
/// distant scenes over the directions that Algorithm 2 samples, seen from above (x to the right, y up), with a standard
/// error. Predictions stand side by side. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  svbrdf map gt.png a.png --over lights -o lights.png")]
pub struct MapArgs {
    /// Output file: .exr for floats, .png for colours from 0 to the largest value, .csv for a table
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// What the map is over
    #[arg(long, value_enum, default_value_t)]
    over: Over,

    /// Direction of the view of a map over lights, or of the light of a map over views
    #[arg(long, value_name = "X,Y,Z", value_parser = values::triple, allow_hyphen_values = true,
        default_value = "0,0,1")]
    fixed: [f64; 3],

    /// Columns and rows of a map over lights or views
    #[arg(long, value_name = "N", value_parser = values::side, default_value = "64")]
    side: u16,

    #[command(flatten)]
    scenes: SceneArgs,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Over {
    /// The texels of the material
    #[default]
    Texels,
    /// The directions of the light, with a fixed view
    Lights,
    /// The directions of the view, with a fixed light
    Views,
}

/// Writes the map, and prints its means and its largest values.
///
/// # Errors
/// Where a material or the scenes cannot be read or used, or the file cannot be written.
pub fn run(args: &MapArgs, given: &Given) -> Result<(), CommandError> {
    let job = ComparisonJob::new(&args.comparison, given)?;
    job.materials.check_predictions()?;
    given.check(match args.over {
        Over::Texels => &modes::MAP_OVER_TEXELS,
        Over::Lights | Over::Views => &modes::MAP_OVER_DIRECTIONS,
    })?;
    let output = Output::new(&args.output)?;
    let opened = job.materials.open::<f32>()?;
    check_output(&args.output)?;
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, job.convention)?.without_pilot();
    let over = |moved| {
        watched("rendering", |progress| {
            MapReport::over_directions(&comparison, moved, args.fixed, usize::from(args.side), progress)
        })
    };
    let map = match args.over {
        Over::Texels => {
            let (_, scenes) = args.scenes.scenes(comparison.convention(), given)?;
            watched("rendering", |progress| MapReport::over_texels(&comparison, &scenes, progress))?
        }
        Over::Lights => over(Endpoint::Light)?,
        Over::Views => over(Endpoint::View)?,
    };
    let largest = map.images.iter().flat_map(|pane| pane.pixels.as_flattened()).copied().fold(0.0, f32::max);
    let sources: Vec<_> =
        [comparison.ground_truth()].into_iter().chain(predictions).map(|m| m.name()).collect();
    let entries = [
        ("svbrdf:shows", format!("{}; the last colour is {largest}", map.shows)),
        ("svbrdf:sources", sources.join(" | ")),
        ("svbrdf:convention", job.convention.name.to_owned()),
        ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
    ];
    stoppable(|progress| match &output {
        Output::Picture(destination) => {
            destination.write_maps(&map.images, largest.max(f32::MIN_POSITIVE), &entries, progress)
        }
        Output::Table(path) => write_text(path, &map.csv()?, progress),
    })?;
    Ok(exit::put_text(&map.text())?)
}

/// Where the map goes.
enum Output<'a> {
    Picture(Destination<PictureFormat>),
    Table(&'a Path),
}

impl<'a> Output<'a> {
    fn new(path: &'a Path) -> Result<Self, Error> {
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv")) {
            check_place(path)?;
            return Ok(Self::Table(path));
        }
        Destination::<PictureFormat>::new(path).map(Self::Picture)
    }
}
