//! Everything that a command prints: results, tables, notes, progress, errors and the exit code.

pub mod advice;
pub mod bar;
pub mod error;
pub mod exit;
pub mod foreign;

pub use bar::{watched, watched_on};
pub use error::CommandError;

use std::process;

use svbrdf_core::progress::Progress;
use svbrdf_core::text::{printable, quoted};
use svbrdf_evaluate::report::{Report, Views};
use svbrdf_files::disk::signals;

/// The commit that the program is built from, in release builds.
pub const COMMIT: Option<&str> = option_env!("SVBRDF_COMMIT");

/// The command line of this process, quoted for a shell.
pub fn command_line() -> String {
    let arguments = std::env::args_os().skip(1).map(quoted);
    std::iter::once("svbrdf".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}

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
    pub fn write(self, report: &(impl Report + ?Sized)) -> Result<String, svbrdf_files::Error> {
        match self {
            Self::Text => Ok(printable(&report.text())),
            Self::Json => report.json(),
            Self::Csv => report.csv(),
        }
    }

    /// The views of a report in this format.
    pub fn of(self, views: Views) -> String {
        match self {
            Self::Text => printable(&views.text),
            Self::Json => views.json,
            Self::Csv => views.csv,
        }
    }
}

/// Prints a warning for each target error that is missed, once the results are printed; with `strict` the first is an error.
pub fn warn_of(missed: Vec<String>, strict: bool) -> Result<(), CommandError> {
    let mut missed = missed.into_iter();
    let failure = if strict { missed.next() } else { None };
    for warning in missed {
        exit::tell(&format!("warning: {warning}"));
    }
    failure.map_or(Ok(()), |failure| Err(CommandError::Failed(failure)))
}

/// Runs work that leaves temporary files when killed. Ctrl+C and the other signals that end a program cancel it, so that it
/// removes them; a second signal ends the program at once. Before this work there is nothing to remove, and signals have their default effect.
pub fn stoppable<R>(work: impl FnOnce(&Progress) -> R) -> R {
    let progress = Progress::default();
    let part = progress.part();
    signals::on_end(move || {
        if part.is_cancelled() {
            process::exit(exit::INTERRUPTED.into());
        }
        part.cancel();
    });
    work(&progress)
}
