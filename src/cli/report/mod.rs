//! The output formats of losses. The library makes the text form, which the window copies, too.

mod csv;
mod json;
mod printed;

use std::io;

pub use json::EstimateEntry;
pub use printed::Printed;

/// The output format of a report.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
pub enum ReportFormat {
    #[default]
    Text,
    Json,
    Csv,
}

impl ReportFormat {
    /// The report in this format, complete with its last line break.
    pub fn write(self, printed: &Printed) -> io::Result<String> {
        match self {
            Self::Text => Ok(printed.report.text()),
            Self::Json => json::write(printed),
            Self::Csv => csv::write(printed),
        }
    }
}
