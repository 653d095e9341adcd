//! Checks of what a table compares.

use svbrdf::error::Error;
use svbrdf::files::session::Session;

use super::materials;

/// Refuses a ground truth without predictions. A session file has its own.
///
/// # Errors
/// [`Error::Usage`]; those of reading a session.
pub fn check_predictions(materials: &materials::MaterialArgs) -> Result<(), Error> {
    match &materials.ground_truth {
        Some(path) if Session::is_named(path) && Session::read(path)?.materials.len() > 1 => Ok(()),
        Some(path) if materials.predictions.is_empty() => Err(Error::Usage(format!(
            "there is no prediction to compare with {}; give one or more after it",
            path.display()
        ))),
        _ => Ok(()),
    }
}
