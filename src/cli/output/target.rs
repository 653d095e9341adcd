//! Target errors that are not reached.

use svbrdf_evaluate::Error;

use super::error::CommandError;
use super::exit;

/// Prints a warning for each of `missed`, once the results are printed.
pub fn warn_of(missed: impl IntoIterator<Item = Error>, strict: bool) -> Result<(), CommandError> {
    let mut missed = missed.into_iter();
    let failure = if strict { missed.next() } else { None };
    for warning in missed {
        exit::tell(&format!("warning: {warning}"));
    }
    failure.map_or(Ok(()), |failure| Err(failure.into()))
}
