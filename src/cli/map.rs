//! `svbrdf map`: the loss over texels, lights or views.

use std::path::{Path, PathBuf};

use svbrdf::error::Error;
use svbrdf::image::{Image, mean_of_channels};
use svbrdf::loss::Comparison;
use svbrdf::picture::export::{Destination, PictureFormat, Provenance, check_place, write_text};
use svbrdf::report::table::aligned;
use svbrdf::why::{self, Hemisphere, Moved};

use super::args::scenes::SceneArgs;
use super::args::{ComparisonArgs, Given, modes, values};
use super::job::ComparisonJob;
use super::output::stop::stoppable;
use super::output::table::triple;
use super::output::{CommandError, exit, table, watched};

/// Writes the loss over texels, light directions or view directions to a file
///
/// Over texels: the mean log difference of each texel over all scenes, whose mean is the loss. Over lights or views: the loss in
/// distant scenes over the directions that Algorithm 2 samples, seen from above (x to the right, y up), with a standard
/// error. Predictions stand side by side. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
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
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), default_value = "64")]
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
    let predictions: Vec<_> = opened.predictions.iter().collect();
    let comparison = Comparison::new(&opened.ground_truth, &predictions, job.convention)?.without_pilot();
    let map = match args.over {
        Over::Texels => over_texels(args, &comparison)?,
        Over::Lights => over_directions(args, &comparison, Moved::Light)?,
        Over::Views => over_directions(args, &comparison, Moved::View)?,
    };
    let largest = map.panes.iter().flat_map(|pane| pane.pixels.as_flattened()).copied().fold(0.0, f32::max);
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
            destination.write_maps(&map.panes, largest.max(f32::MIN_POSITIVE), &entries, progress)
        }
        Output::Table(path) => write_text(path, &map.table()?, progress),
    })?;
    let heading = table::heading(&map.shows, &opened.ground_truth, &job.convention);
    Ok(exit::put(&format!("{heading}\n{}", map.summary))?)
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

/// A map of every prediction.
struct LossMap {
    /// The meaning of the numbers.
    shows: String,
    panes: Vec<Image<f32>>,
    summary: String,
    heading: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl LossMap {
    fn table(&self) -> Result<String, Error> {
        table::csv([self.heading.clone()].into_iter().chain(self.rows.iter().cloned()))
    }
}

fn over_texels(args: &MapArgs, comparison: &Comparison<'_, f32>) -> Result<LossMap, Error> {
    let (_, scenes) = args.scenes.scenes(comparison.convention())?;
    let panes = watched("rendering", |progress| why::error_maps(comparison, &scenes, progress))?;
    let names: Vec<_> = comparison.predictions().iter().map(|prediction| prediction.name()).collect();
    let mut summary = vec![["prediction", "mean", "largest", "column", "row"].map(str::to_owned).to_vec()];
    let mut rows = Vec::new();
    for (name, pane) in names.iter().zip(&panes) {
        let all = pane.pixels.iter().map(mean_of_channels).enumerate();
        let (at, largest) = all.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
        let place = [at % pane.width, at / pane.width].map(|i| i.to_string());
        let numbers = [format!("{:.6}", why::mean(pane)), format!("{largest:.6}")];
        summary.push([(*name).to_owned()].into_iter().chain(numbers).chain(place).collect());
        rows.extend(pane.pixels.iter().enumerate().map(|(at, pixel)| {
            let place = [at % pane.width, at / pane.width].map(|i| i.to_string());
            [(*name).to_owned()].into_iter().chain(place).chain(pixel.map(|c| c.to_string())).collect()
        }));
    }
    let count = scenes.len();
    Ok(LossMap {
        shows: format!("mean log difference of each texel over {count} scenes"),
        panes,
        summary: aligned(&summary),
        heading: ["prediction", "column", "row", "red", "green", "blue"].map(str::to_owned).to_vec(),
        rows,
    })
}

fn over_directions(args: &MapArgs, comparison: &Comparison<'_, f32>, moved: Moved) -> Result<LossMap, Error> {
    let side = usize::from(args.side);
    let map = watched("rendering", |progress| {
        why::hemisphere(comparison, moved, args.fixed, side, progress, |_| ())
    })?;
    let (what, other) = if moved == Moved::Light { ("light", "view") } else { ("view", "light") };
    let titles = ["prediction", "mean", "largest", "+- std. error", what].map(str::to_owned);
    let mut summary = vec![titles.to_vec()];
    for (p, prediction) in comparison.predictions().iter().enumerate() {
        let Some((direction, loss)) = map.worst(p) else { continue };
        let numbers = [map.mean(p), loss, map.standard_error(p)].map(|x| format!("{x:.6}"));
        let start = [prediction.name().to_owned()].into_iter();
        summary.push(start.chain(numbers).chain([triple(direction)]).collect());
    }
    let pane = |losses: &Vec<f64>| Image {
        width: side,
        height: side,
        pixels: losses.iter().map(|&loss| [loss as f32; 3]).collect(),
    };
    Ok(LossMap {
        shows: format!("loss over distant {what} directions, {other} {}", triple(args.fixed)),
        panes: map.losses.iter().map(pane).collect(),
        summary: aligned(&summary),
        heading: ["prediction", "x", "y", "z", "loss", "standard_error"].map(str::to_owned).to_vec(),
        rows: rows(comparison, &map),
    })
}

fn rows(comparison: &Comparison<'_, f32>, map: &Hemisphere) -> Vec<Vec<String>> {
    let of = |(p, prediction): (usize, &&svbrdf::material::Material<f32>)| {
        let name = prediction.name().to_owned();
        let cell = move |i: usize| {
            let numbers = map.directions[i]?.into_iter().chain([map.losses[p][i], map.standard_errors[p][i]]);
            Some([name.clone()].into_iter().chain(numbers.map(|x| x.to_string())).collect())
        };
        (0..map.directions.len()).filter_map(cell).collect::<Vec<_>>()
    };
    comparison.predictions().iter().enumerate().flat_map(of).collect()
}
