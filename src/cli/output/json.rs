//! Objects as JSON.

use svbrdf_files::Error;

use super::exit;

/// A JSON object with its last line break.
pub fn text(object: &impl serde::Serialize) -> Result<String, Error> {
    let text = serde_json::to_string_pretty(object).map_err(|problem| exit::unwritable(problem.into()))?;
    Ok(text + "\n")
}
