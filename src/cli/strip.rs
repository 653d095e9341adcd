//! `svbrdf strip`: a figure with materials in rows, and maps, renderings and differences in columns.

use std::path::PathBuf;

use svbrdf_core::loss::check_same_size;
use svbrdf_core::material::Material;
use svbrdf_core::picture::content::PictureContent;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::Destination;
use svbrdf_files::export::strip::{Column, Crop, Paper, Strip};
use svbrdf_files::session::Session;

use crate::cli::args::protocol::MaskArgs;
use crate::cli::args::scenes::{Lights, ListArgs, RenderingArgs};
use crate::cli::args::values::{self, Range};
use crate::cli::args::{ComparisonArgs, Specified, refuse};
use crate::cli::job::{ComparisonJob, Job, MaterialJob, NewJob, SessionSettings};
use crate::cli::output::{CommandError, stoppable, watched};
use crate::cli::render::difference_of;
use crate::cli::strip_methods::{self, Look};

/// Writes a labelled figure: a row per material, a column per map, rendering or difference
///
/// PDF and SVG have real text at --text-pt and a width of --width-mm; a PNG has the same layout. Every cell of a PNG has the pixels
/// that `svbrdf render` writes, one or a square per texel, but for the frames of crops. The row of GT has the scale bars of differences.
#[derive(Debug, clap::Args)]
#[command(mut_arg("scenes", |arg| arg.conflicts_with_all(["view", "light", "distant"]).help(
    "Scene file; renderings and their differences have a column for each of its scenes")))]
#[command(mut_arg("lights", |arg| arg.conflicts_with_all(["view", "light", "distant"]).help(
    "Lights and views of a publication: flash, flash-9 or hemisphere; renderings and their differences have a column for each")))]
pub struct StripArgs {
    /// Output file, .pdf, .svg or .png
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// GT is a folder of ground truths, and every PRED a folder of the predictions of a method: a row for each material, a column for each
    /// method, all of one of --columns
    #[arg(long, conflicts_with = "pairs", requires = "ground_truth")]
    dataset: bool,

    /// GT is a CSV table of pairs, as of `svbrdf rank`: a row for each material, a column for each method
    #[arg(long, requires = "ground_truth")]
    pairs: bool,

    /// Width of the figure in millimetres [default: 88 for up to three cells in a row, else 180]
    #[arg(long, value_name = "MM", value_parser = values::millimetres)]
    width_mm: Option<f64>,

    /// The most height of a figure of a data set in millimetres: it is made narrower
    #[arg(long, value_name = "MM", value_parser = values::millimetres, conflicts_with = "width_mm", hide_short_help = true)]
    height_mm: Option<f64>,

    /// Size of its text in points
    #[arg(long, value_name = "PT", value_parser = values::points, default_value_t = Paper::default().text_pt)]
    text_pt: f64,

    /// Writes the loss of each prediction of a data set below its cell: those in this folder, to which the others are added
    #[arg(long, value_name = "DIR")]
    results: Option<PathBuf>,

    /// Shows these materials of a data set only, in this order
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    materials: Vec<String>,

    /// Columns: rendering, normal, diffuse, specular, roughness; with a colon and a kind, or a colon alone, differences:
    /// rendering:log, normal:; of a session, the difference that was chosen in its window
    /// [default: normal,diffuse,roughness,specular,rendering,rendering:; of a data set: rendering]
    #[arg(long, value_name = "COLUMN,...", value_delimiter = ',')]
    columns: Vec<String>,

    #[command(flatten)]
    list: ListArgs,

    #[command(flatten)]
    rendering: RenderingArgs,

    /// The difference with the last colour: a number, or auto for the 99th percentile of the largest in a column
    /// [default: 2 for logarithms, 45 degrees, else 1]
    #[arg(long, value_name = "RANGE")]
    range: Option<Range>,

    /// Rectangle of texels that is framed in every cell and magnified beside it: left, top, width, height; may be given
    /// several times. Cells of a data set are averaged to their size, unless there are crops
    #[arg(long = "crop", value_name = "X,Y,W,H")]
    crops: Vec<Crop>,

    #[command(flatten)]
    mask: MaskArgs,

    #[command(flatten)]
    comparison: ComparisonArgs,
}

/// The columns where none are specified, of a data set and of materials.
const OF_DATA_SET: [&str; 1] = ["rendering"];
const OF_MATERIALS: [&str; 6] = ["normal", "diffuse", "roughness", "specular", "rendering", "rendering:"];

#[derive(Debug)]
struct StripJob {
    materials: MaterialJob,
    output: PathBuf,
    destination: Destination,
    strip: Strip,
    saved: Session,
}

impl StripArgs {
    pub fn job(mut self, given: &Specified) -> NewJob {
        let destination = Destination::of_figure(&self.output)?;
        let paper = Paper { width_mm: self.width_mm, text_pt: self.text_pt };
        let is_data_set = self.dataset || self.pairs;
        if self.columns.is_empty() {
            let columns: &[&str] = if is_data_set { &OF_DATA_SET } else { &OF_MATERIALS };
            self.columns = columns.iter().map(|column| (*column).to_owned()).collect();
        }
        if is_data_set {
            let columns = columns(&self, None)?;
            self.refuse_unused(&columns, given)?;
            let height_mm = self.height_mm;
            let look =
                Look { columns, exposure_ev: self.rendering.exposure, crops: self.crops, paper, height_mm };
            return strip_methods::job(
                (&self.comparison, self.mask.mask),
                (self.pairs, &self.materials),
                look,
                self.results,
                self.output,
            );
        }
        refuse(
            self.height_mm.is_some(),
            "height-mm",
            "only a figure of --dataset or --pairs has a given height",
        )?;
        let reason = "losses below cells are those of --dataset or --pairs";
        refuse(self.results.is_some(), "results", reason)?;
        refuse(
            !self.materials.is_empty(),
            "materials",
            "all materials are shown without --dataset or --pairs",
        )?;
        let mut comparison = ComparisonJob::new(&self.comparison, given)?;
        comparison.materials.is_comparison = true;
        comparison.materials.mask(self.mask.mask.as_ref());
        let session = comparison.session.as_ref();
        let columns = columns(&self, session)?;
        self.refuse_unused(&columns, given)?;
        let saved = session.map(|session| session.exposure_ev);
        let exposure_ev = self.rendering.exposure.or(saved).unwrap_or(0.0);
        let crops = self.crops;
        let strip = Strip { columns, convention: comparison.convention, exposure_ev, crops, paper };
        let scene = self.rendering.scene.scene(session.map(|session| session.scene))?;
        let saved = comparison.saved(strip.columns.first().map_or(scene, |column| column.scene), exposure_ev);
        let (materials, output) = (comparison.materials, self.output);
        Ok(Box::new(StripJob { materials, output, destination, strip, saved }))
    }

    /// Refuses what none of the columns uses.
    fn refuse_unused(&self, columns: &[Column], given: &Specified) -> Result<(), CommandError> {
        if columns.iter().all(|column| column.content.quantity != Quantity::Rendering) {
            let reason =
                "maps have no light, no view, no exposure and no convention, and no column is a rendering";
            given.refuse::<RenderingArgs>(reason)?;
            given.refuse::<ListArgs>(reason)?;
            refuse(self.comparison.convention.is_some(), "convention", reason)?;
        }
        let has_difference = columns.iter().any(|column| column.content.difference.is_some());
        refuse(self.range.is_some() && !has_difference, "range", "no column is a difference")
    }
}

/// Renders and writes the figure.
impl Job for StripJob {
    fn run(self: Box<Self>) -> Result<(), CommandError> {
        let Self { materials, output, destination, strip, saved } = *self;
        let opened = materials.open::<f32>()?;
        check_output(&output)?;
        let mask = opened.mask.clone();
        let materials = opened.into_all();
        if let [ground_truth, predictions @ ..] = materials.as_slice() {
            predictions.iter().try_for_each(|prediction| check_same_size(ground_truth, prediction))?;
        }
        let names: Vec<String> = materials.iter().map(|material| material.name().to_owned()).collect();
        let all: Vec<&Material<f32>> = materials.iter().collect();
        let figure = watched("rendering", |progress| strip.figure(&all, &names, mask.as_ref(), progress))?;
        let entries = strip.entries(&names, saved.entry(&output)?);
        Ok(stoppable(|progress| destination.write_figure(&figure, &entries, progress))?)
    }
}

fn columns(args: &StripArgs, session: Option<&SessionSettings>) -> Result<Vec<Column>, CommandError> {
    let reason =
        "a strip has no sampled scenes: use flash, flash-9 or hemisphere, or a file of `svbrdf scenes`";
    refuse(args.list.lights == Some(Lights::Papers), "lights", reason)?;
    let scenes = match args.list.file()? {
        Some(file) => file.scenes,
        None => vec![args.rendering.scene.scene(session.map(|session| session.scene))?],
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
