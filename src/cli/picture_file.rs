//! The file of an analysis whose results are pictures: numbers, colours, or a table.

use std::path::PathBuf;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::{Image, mean_of_channels};
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_evaluate::report::Report;
use svbrdf_files::Error;
use svbrdf_files::disk::inputs::check_output;
use svbrdf_files::export::{Destination, Provenance, check_place, write_text};

use super::args::values::Range;
use super::args::{offered, refuse};
use super::output::{CommandError, stoppable};

/// The file, and its colours.
#[derive(Debug, clap::Args)]
pub struct PictureArgs {
    /// Output file: .exr for floats, .png for colours, .csv for a table
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// The loss with the last colour of a .png: a number, or auto for the 99th percentile of the largest map [default: auto]
    #[arg(long, value_name = "LOSS|auto", allow_negative_numbers = true)]
    #[arg(value_parser = offered(str::parse::<Range>, ["auto"]), hide_possible_values = true)]
    range: Option<Range>,
}

/// The file that pictures are written to.
#[derive(Debug)]
pub struct PictureFile {
    path: PathBuf,
    range: Option<Range>,
    /// `None`: a table.
    picture: Option<Destination>,
}

impl PictureFile {
    pub fn new(args: PictureArgs) -> Result<Self, CommandError> {
        let PictureArgs { output: path, range } = args;
        let is_table = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        let picture = match is_table {
            true => check_place(&path).map(|()| None)?,
            false => Some(Destination::of_picture(&path).map_err(or_table)?),
        };
        let file = Self { path, range, picture };
        refuse(range.is_some() && !file.is_png(), "range", "only the colours of a .png have a range")?;
        Ok(file)
    }

    fn is_png(&self) -> bool {
        self.picture.as_ref().is_some_and(|picture| picture.is("png"))
    }

    /// Checks that it replaces no file that was read.
    pub fn check(&self) -> Result<(), Error> {
        check_output(&self.path)
    }

    /// Writes the pictures of a report of materials of these names. Returns a line about their colours.
    pub fn write(
        &self,
        report: &dyn Report,
        names: &[&str],
        convention: &'static str,
    ) -> Result<String, CommandError> {
        let (images, shows) = report.pictures().unwrap_or_default();
        let last = last_colour(images, self.range);
        let entries = [
            ("svbrdf:shows", format!("{shows}; the last colour is {last}")),
            ("svbrdf:sources", names.join(" | ")),
            ("svbrdf:convention", convention.to_owned()),
            ("svbrdf:version", Provenance::SOFTWARE.to_owned()),
        ];
        stoppable(|progress| match &self.picture {
            Some(picture) => picture.write_maps(images, last as f32, &entries, progress),
            None => write_text(&self.path, &report.csv()?, progress),
        })?;
        Ok(match self.is_png() {
            true => format!("\ncolours from 0 to {last:.6}; larger losses have the last colour, too\n"),
            false => String::new(),
        })
    }
}

/// The loss with the last colour.
fn last_colour(images: &[Image<f32>], range: Option<Range>) -> f64 {
    if let Some(Range::Last(last)) = range {
        return last;
    }
    let losses = |pane: &Image<f32>| pane.pixels.iter().map(mean_of_channels).collect();
    Distributions::of(&images.iter().map(losses).collect::<Vec<_>>(), false).auto_range
}

/// The error of another extension, which names that of a table, too.
fn or_table(problem: Error) -> Error {
    match problem {
        Error::Core(CoreError::UnknownName { what, found, known }) => {
            CoreError::unknown_name(what, found, known + ", .csv (a table)").into()
        }
        other => other,
    }
}
