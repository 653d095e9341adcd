//! Results as text, CSV and JSON, and the lines above a table.

use std::io;

use svbrdf::error::Error;
use svbrdf::loss::Estimate;
use svbrdf::material::Material;
use svbrdf::model::convention::Convention;
use svbrdf::model::scene::Kind;

use super::exit;

/// A CSV table with a heading (RFC 4180).
///
/// # Errors
/// [`Error::Unwritable`], which a table in memory does not give.
pub fn csv(rows: impl IntoIterator<Item = Vec<String>>) -> Result<String, Error> {
    let written = || -> io::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        rows.into_iter().try_for_each(|row| writer.write_record(row))?;
        let bytes = writer.into_inner().map_err(csv::IntoInnerError::into_error)?;
        String::from_utf8(bytes).map_err(io::Error::other)
    };
    written().map_err(exit::unwritable)
}

/// A JSON object with its last line break.
///
/// # Errors
/// [`Error::Unwritable`], which an object in memory does not give.
pub fn json(object: &impl serde::Serialize) -> Result<String, Error> {
    let text = serde_json::to_string_pretty(object).map_err(|problem| exit::unwritable(problem.into()))?;
    Ok(text + "\n")
}

/// The lines above a table: its subject, the ground truth and the convention.
pub fn heading(subject: &str, ground_truth: &Material<f32>, convention: &Convention) -> String {
    let ([width, height], name) = (ground_truth.size(), ground_truth.name());
    format!(
        "{subject} against {name}, {width} x {height} texels\nconvention {}, epsilon {}\n",
        convention.name, convention.epsilon
    )
}

/// Standard error, and the ends of the interval; empty where they are unknown.
pub fn errors(estimate: &Estimate) -> [String; 3] {
    let [low, high] = [0, 1].map(|end| estimate.interval95.map(|interval| interval[end]));
    [estimate.standard_error, low, high].map(|value| value.map_or(String::new(), |value| value.to_string()))
}

pub fn kind_name(kind: Kind) -> &'static str {
    match kind {
        Kind::Near => "near",
        Kind::Distant => "distant",
    }
}

/// A position or direction as people read it.
pub fn triple([x, y, z]: [f64; 3]) -> String {
    format!("({x:.3}, {y:.3}, {z:.3})")
}
