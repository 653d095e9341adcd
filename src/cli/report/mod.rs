//! Losses for programs: one file per format. The text for people is the library's, which the window copies, too.

mod csv;
mod json;

use std::io;

use svbrdf::error::Error;
use svbrdf::loss::Request;
use svbrdf::report::Report;

/// A report, and what the command line knows beside it.
#[derive(Debug)]
pub struct Printed {
    pub report: Report,
    /// What was asked for.
    pub request: Request,
    /// The accuracy that was asked for, where it was not reached.
    pub missed: Option<Error>,
    /// Where the ground truth and the predictions were read from; none for the built-in ones.
    pub paths: Vec<String>,
}

impl Printed {
    /// The accuracy that was asked for, if any, and whether it was reached.
    fn target(&self) -> Option<(f64, bool)> {
        match self.request {
            Request::Accuracy { target, .. } => Some((target, self.missed.is_none())),
            _ => None,
        }
    }

    /// Whether the number of scenes was given, so that a list of them is of a readable length.
    fn lists_scenes(&self) -> bool {
        matches!(self.request, Request::Scenes(_) | Request::Listed(_))
    }

    fn ground_truth_path(&self) -> Option<&str> {
        self.paths.first().map(String::as_str)
    }

    /// The path of each prediction.
    fn prediction_paths(&self) -> impl Iterator<Item = Option<&str>> {
        self.paths.iter().skip(1).map(|path| Some(path.as_str())).chain(std::iter::repeat(None))
    }
}

/// What a report is written in.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
pub enum Format {
    #[default]
    Text,
    Json,
    Csv,
}

impl Format {
    /// The report in this format, complete with its last line break.
    pub fn write(self, printed: &Printed) -> io::Result<String> {
        match self {
            Self::Text => Ok(printed.report.text()),
            Self::Json => json::write(printed),
            Self::Csv => Ok(csv::write(printed)),
        }
    }
}
