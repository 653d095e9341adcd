//! A run over a data set, which a journal lets continue.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use svbrdf_core::error::Error;
use svbrdf_core::progress::Progress;

use super::evaluate::{Evaluated, evaluate};
use super::journal::{Head, Journal, Recomputed, remaining};
use super::record::{Case, DatasetReading, DatasetSettings, MaterialResult};

/// The results of a run over a data set.
#[derive(Clone, Debug, PartialEq)]
pub struct DatasetResults {
    /// Of every case, in order.
    pub results: Vec<MaterialResult>,
    /// The results of the journal that were computed again.
    pub recomputed: Vec<Recomputed>,
}

/// The results of `cases` in order, computed in parallel.
///
/// Each prediction is compared in the first scenes of its material, as many as its target error needs. A material that cannot be read
/// or compared has a result, too, with the reason. A material is one step of `progress`. The results do not depend on the number of
/// threads, nor on which other materials and predictions there are.
///
/// A result in the file `journal` is not computed again, unless a file that it was computed from has changed. New results are added to
/// it as they come, and in the end it holds all of them in order. It is created where there is none.
///
/// # Errors
/// [`Error::Cancelled`], [`Error::UnknownName`] for an unknown convention; [`Error::Unreadable`] and [`Error::Unwritable`] of the
/// journal; [`Error::BadJournal`] where it is of other settings, of another version of this program, or is no journal.
pub fn run(
    cases: &[Case],
    settings: &DatasetSettings,
    reading: &DatasetReading,
    journal: Option<&Path>,
    progress: &Progress,
) -> Result<DatasetResults, Error> {
    let Some(path) = journal else {
        let results = Mutex::new(Vec::new());
        evaluate(cases, settings, reading, progress, |evaluated| {
            lock(&results).push(evaluated.result);
            Ok(())
        })?;
        return Ok(DatasetResults { results: sorted(results), recomputed: Vec::new() });
    };
    let (journal, known, recomputed) = Journal::open(path, Head::new(settings, reading), cases)?;
    let remaining = remaining(cases, &known);
    let lines = Mutex::new(known);
    evaluate(&remaining, settings, reading, progress, |evaluated: Evaluated| {
        let line = journal.add(evaluated)?;
        lock(&lines).push(line);
        Ok(())
    })?;
    let mut lines = lines.into_inner().unwrap_or_else(PoisonError::into_inner);
    lines.sort_by_key(|line| line.result.index);
    journal.finish(&lines)?;
    Ok(DatasetResults { results: lines.into_iter().map(|line| line.result).collect(), recomputed })
}

fn lock<T>(shared: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

fn sorted(results: Mutex<Vec<MaterialResult>>) -> Vec<MaterialResult> {
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|result| result.index);
    results
}
