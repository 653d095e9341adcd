//! Analyses of predictions: each a computation and a report, which is text, JSON, CSV and LaTeX at once.
//!
//! | module | content |
//! |---|---|
//! | [`analyses`] | what has a command, a function in Python and a table in the window: declared once |
//! | [`why`] | what a loss comes from: maps, scenes, directions of light, texels; the worst scene |
//! | [`diagnose`] | whether exposure, alignment or reading explain a loss; what the ground truth resolves |
//! | [`metrics`] | differences of maps and renderings, each with its convention in its name |
//! | [`rank`], [`robust`] | many predictions of one ground truth, best first; whether their order survives other questions |
//! | [`protocols`] | what papers and their codes compute, as data |
//! | [`registration`] | which part of a ground truth a prediction is |
//! | [`study`] | speed against accuracy, measured for one pair on one machine |
//! | [`report`] | results with their settings as values, and their tables |
//! | [`photograph`] | renderings against photographs of the real material |
//! | [`blind`] | whether an observer sees the difference of two things |
//! | [`dataset`] | methods over the materials of a data set, with a folder of results |
//! | [`conform`] | whose renderer gave out radiances at known points |
//! | [`schema`] | the JSON Schema of each report |

pub mod analyses;
pub mod blind;
pub mod conform;
pub mod dataset;
pub mod diagnose;
mod error;
#[cfg(feature = "schema")]
mod json_schema;
pub mod metrics;
pub mod photograph;
pub mod protocols;
pub mod rank;
pub mod registration;
pub mod report;
mod results;
pub mod robust;
#[cfg(feature = "schema")]
pub mod schema;
pub mod study;
pub mod why;

pub use error::Error;
pub use results::KeptAnswer;
