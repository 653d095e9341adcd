//! The output formats of reports.

use svbrdf_core::text::printable;
use svbrdf_evaluate::report::Report;
use svbrdf_files::Error;

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
    pub fn write(self, report: &(impl Report + ?Sized)) -> Result<String, Error> {
        match self {
            Self::Text => Ok(printable(&report.text())),
            Self::Json => report.json(),
            Self::Csv => report.csv(),
        }
    }
}
