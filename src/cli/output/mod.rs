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
