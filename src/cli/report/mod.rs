//! Losses for programs: one file per format. The text for people is the library's, which the window copies, too.

mod csv;
mod json;

use std::io;

use svbrdf::report::Report;

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
    pub fn write(self, report: &Report) -> io::Result<String> {
        match self {
            Self::Text => Ok(report.text()),
            Self::Json => json::write(report),
            Self::Csv => Ok(csv::write(report)),
        }
    }
}
