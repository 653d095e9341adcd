//! A run over a data set, which a journal lets continue.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use super::evaluate::{Side, evaluate};
use super::journal::{self, Journal};
use super::record::{Case, MaterialResult, RunSettings};
use crate::error::Error;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::progress::Progress;

/// The results of `tasks` in order, computed in parallel.
///
/// All predictions of a material are compared in the same scenes, as many as the target error of every one needs. What cannot be
/// read or compared is a result, too: it says why. A material is one step of `progress`. The results do not depend on the
/// number of threads, nor on which other materials there are.
///
/// What the file `journal` holds is not computed again. New results are added to it as they come, and in the end it holds
/// all of them in order. It is created where there is none.
///
/// # Errors
/// [`Error::Cancelled`]; [`Error::Unreadable`] and [`Error::Unwritable`] of the journal; [`Error::BadJournal`] where it is
/// of other settings, or is no journal.
pub fn run(
    tasks: &[Case],
    settings: &RunSettings,
    convention: &Convention,
    read: impl Fn(&Path, Side) -> Result<Material<f32>, Error> + Sync,
    journal: Option<&Path>,
    progress: &Progress,
) -> Result<Vec<MaterialResult>, Error> {
    let (file, known) = match journal {
        Some(path) => Journal::open(path, settings).map(|(file, known)| (Some(file), known))?,
        None => (None, Vec::new()),
    };
    let remaining = journal::remaining(tasks, &known);
    let results = Mutex::new(known);
    let done = |result: &MaterialResult| {
        results.lock().unwrap_or_else(PoisonError::into_inner).push(result.clone());
        file.as_ref().map_or(Ok(()), |file| file.add(result))
    };
    evaluate(&remaining, settings, convention, read, progress, done)?;
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|result| result.index);
    if let Some(path) = journal {
        journal::write(path, settings, &results)?;
    }
    Ok(results)
}
