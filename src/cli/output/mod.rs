//! Everything that a command prints: results, tables, notes, progress, errors and the exit code.

pub mod advice;
pub mod bar;
pub mod error;
pub mod exit;
pub mod json;
pub mod report;
pub mod stop;
pub mod target;

pub use bar::{watched, watched_on};
pub use error::CommandError;

use svbrdf_core::text::quoted;

/// The command line of this process, quoted for a shell.
pub fn command_line() -> String {
    let arguments = std::env::args_os().skip(1).map(|argument| quoted(&argument.to_string_lossy()));
    std::iter::once("svbrdf".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
}
