//! `svbrdf map`: the loss over texels, lights or views.

use std::path::{Path, PathBuf};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::{Image, mean_of_channels};
use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::model::scene::Endpoint;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_evaluate::report::{MapReport, Report as _};
use svbrdf_files::Error;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, PictureFormat, Provenance, check_place, write_text};

use super::args::scenes::SceneArgs;
use super::args::values::{self, Range};
use super::args::{ComparisonArgs, Given, offered, refuse};
use super::job::{ComparisonJob, Job, NewJob};
use super::output::{CommandError, exit, stoppable, watched};

/// Writes the loss over texels, light directions or view directions to a file
///
/// Over texels: the mean log difference of each texel over all scenes, whose mean is the loss. Over lights or views: the loss in
/// distant scenes over the directions that Algorithm 2 samples, seen from above (x to the right, y up), with a standard
/// error. Predictions stand side by side. Without GT and PRED: the built-in materials.
#[derive(Debug, clap::Args)]
pub struct MapArgs {
    /// Output file: .exr for floats, .png for colours, .csv for a table
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// What the map is over
    #[arg(long, value_enum, default_value_t)]
    over: Over,

    /// The loss with the last colour of a .png: a number, or auto for the 99th percentile of the largest map [default: auto]
    #[arg(long, value_name = "LOSS|auto", allow_negative_numbers = true)]
    #[arg(value_parser = offered(str::parse::<Range>, ["auto"]), hide_possible_values = true)]
    range: Option<Range>,

    #[command(flatten)]
    directions: DirectionArgs,

    #[command(flatten)]
    scenes: SceneArgs,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// The directions of a map over lights or views.
#[derive(Debug, clap::Args)]
struct DirectionArgs {
    /// Direction of the view of a map over lights, or of the light of a map over views
    #[arg(long, value_name = "X,Y,Z", value_parser = values::triple, allow_hyphen_values = true,
        default_value = "0,0,1")]
    fixed: [f64; 3],

    /// Columns and rows of a map over lights or views
    #[arg(long, value_name = "N", value_parser = values::side, default_value = "64")]
    side: u16,
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

#[derive(Debug)]
struct MapJob {
    comparison: ComparisonJob,
    axes: Axes,
    range: Option<Range>,
    output: Output,
    path: PathBuf,
}

/// What the map is over, with what it takes.
#[derive(Debug)]
enum Axes {
    Texels(Request),
    Directions { moved: Endpoint, fixed: [f64; 3], side: usize },
}

impl MapArgs {
    pub fn job(self, given: &Given) -> NewJob {
        let comparison = ComparisonJob::with_predictions(&self.comparison, given)?;
        let axes = match self.over {
            Over::Texels => {
                let reason = "a map over texels has no fixed direction and the size of its material";
                given.refuse::<DirectionArgs>(reason)?;
                Axes::Texels(self.scenes.options()?.listed()?)
            }
            Over::Lights => self.directions.axes(Endpoint::Light, given)?,
            Over::Views => self.directions.axes(Endpoint::View, given)?,
        };
        let output = Output::new(&self.output)?;
        let is_png = matches!(&output, Output::Picture(picture) if picture.format() == PictureFormat::Png);
        refuse(self.range.is_some() && !is_png, "range", "only the colours of a .png have a range")?;
        Ok(Box::new(MapJob { comparison, axes, range: self.range, output, path: self.output }))
    }
}

impl DirectionArgs {
    fn axes(&self, moved: Endpoint, given: &Given) -> Result<Axes, CommandError> {
        given.refuse::<SceneArgs>("a map over directions samples no scenes")?;
        Ok(Axes::Directions { moved, fixed: self.fixed, side: usize::from(self.side) })
    }
}

/// Writes the map, and prints its means and its largest values.
impl Job for MapJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { comparison: ComparisonJob { convention, materials, .. }, axes, range, output, path } =
            *self;
        let opened = materials.open::<f32>()?;
        check_output(&path)?;
        let predictions: Vec<_> = opened.predictions.iter().collect();
        let comparison = Comparison::new(&opened.ground_truth, &predictions, convention)?.without_pilot();
        let map = watched("rendering", |progress| match axes {
            Axes::Texels(request) => {
                let scenes = request.scenes(&convention)?.unwrap_or_default();
                MapReport::over_texels(&comparison, &scenes, progress)
            }
            Axes::Directions { moved, fixed, side } => {
                MapReport::over_directions(&comparison, moved, fixed, side, progress)
            }
        })?;
        let last = last_colour(&map, range);
        let sources: Vec<_> =
            [comparison.ground_truth()].into_iter().chain(predictions).map(|m| m.name()).collect();
        let entries = [
            ("svbrdf:shows", format!("{}; the last colour is {last}", map.shows)),
            ("svbrdf:sources", sources.join(" | ")),
            ("svbrdf:convention", convention.name.to_owned()),
            ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
        ];
        stoppable(|progress| match &output {
            Output::Picture(destination) => {
                destination.write_maps(&map.images, last as f32, &entries, progress)
            }
            Output::Table => write_text(&path, &map.csv()?, progress),
        })?;
        let colours = match &output {
            Output::Picture(picture) if picture.format() == PictureFormat::Png => {
                format!("\ncolours from 0 to {last:.6}; larger losses have the last colour, too\n")
            }
            _ => String::new(),
        };
        Ok(exit::put_text(&(map.text() + &colours))?)
    }
}

/// The loss with the last colour.
fn last_colour(map: &MapReport, range: Option<Range>) -> f64 {
    if let Some(Range::Last(last)) = range {
        return last;
    }
    let losses = |pane: &Image<f32>| pane.pixels.iter().map(mean_of_channels).collect();
    Distributions::of(&map.images.iter().map(losses).collect::<Vec<_>>(), false).auto_range
}

/// The format of the map.
#[derive(Debug)]
enum Output {
    Picture(Destination<PictureFormat>),
    Table,
}

impl Output {
    fn new(path: &Path) -> Result<Self, Error> {
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv")) {
            check_place(path)?;
            return Ok(Self::Table);
        }
        Destination::<PictureFormat>::new(path).map(Self::Picture).map_err(|problem| match problem {
            Error::Core(CoreError::UnknownName { what, found, known }) => {
                CoreError::unknown_name(what, found, known + ", .csv (a table)").into()
            }
            other => other,
        })
    }
}
