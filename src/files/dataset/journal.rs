//! Results in a file, while they come: the first line has the settings, every other line a material, as JSON.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::record::{Case, MaterialResult, RunSettings};
use crate::error::Error;
use crate::files::atomic::write_text;
use crate::progress::Progress;

/// A file to which results are added.
#[derive(Debug)]
pub(super) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

impl Journal {
    /// Opens the journal at `path`, which may be there already, and the results that it holds.
    ///
    /// A last line that was cut off, as when the program was ended, is dropped.
    ///
    /// # Errors
    /// [`Error::Unreadable`], [`Error::Unwritable`]; [`Error::BadJournal`] where the file is of other settings, or is no journal.
    pub(super) fn open(path: &Path, settings: &RunSettings) -> Result<(Self, Vec<MaterialResult>), Error> {
        let results = if path.exists() {
            let (found, results) = read(path)?;
            if found != *settings {
                return Err(bad(path, "it is of other settings, materials or methods".to_owned()));
            }
            results
        } else {
            Vec::new()
        };
        write(path, settings, &results)?;
        let file = OpenOptions::new().append(true).open(path).map_err(|source| unwritable(path, source))?;
        Ok((Self { path: path.to_owned(), file: Mutex::new(file) }, results))
    }

    /// Adds a result.
    ///
    /// # Errors
    /// [`Error::Unwritable`].
    pub(super) fn add(&self, result: &MaterialResult) -> Result<(), Error> {
        let line = line(&self.path, result)?;
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.write_all(line.as_bytes()).map_err(|source| unwritable(&self.path, source))
    }
}

/// Writes the whole journal: its bytes depend on `results` alone, which are in order.
///
/// # Errors
/// [`Error::Unwritable`].
pub(super) fn write(path: &Path, settings: &RunSettings, results: &[MaterialResult]) -> Result<(), Error> {
    let mut text = line(path, settings)?;
    for result in results {
        text += &line(path, result)?;
    }
    write_text(path, &text, &Progress::default())
}

/// The results of several journals of one data set, in order.
///
/// # Errors
/// [`Error::Unreadable`]; [`Error::BadJournal`] where they are of different settings, or results are missing or not the same.
pub fn merged(paths: &[PathBuf]) -> Result<(RunSettings, Vec<MaterialResult>), Error> {
    let mut common: Option<RunSettings> = None;
    let mut all: BTreeMap<usize, MaterialResult> = BTreeMap::new();
    let Some(last) = paths.last() else { return Err(bad(Path::new(""), "there is no journal".to_owned())) };
    for path in paths {
        let (settings, results) = read(path)?;
        if common.as_ref().is_some_and(|common| *common != settings) {
            return Err(bad(path, "it is of other settings, materials or methods than the first".to_owned()));
        }
        common = Some(settings);
        for result in results {
            let name = result.material.clone();
            if all.insert(result.index, result.clone()).is_some_and(|before| before != result) {
                return Err(bad(path, format!("its result of {name} differs from that of another journal")));
            }
        }
    }
    let settings = common.ok_or_else(|| bad(last, "it is empty".to_owned()))?;
    let missing = (0..settings.materials.len()).filter(|index| !all.contains_key(index)).count();
    if missing > 0 {
        let count = settings.materials.len();
        return Err(bad(last, format!("{missing} of {count} materials are in none of the journals")));
    }
    Ok((settings, all.into_values().collect()))
}

/// The tasks whose results are not there yet.
pub(super) fn remaining(tasks: &[Case], results: &[MaterialResult]) -> Vec<Case> {
    let is_done = |task: &&Case| results.iter().any(|result| result.index == task.index);
    tasks.iter().filter(|task| !is_done(task)).cloned().collect()
}

fn read(path: &Path) -> Result<(RunSettings, Vec<MaterialResult>), Error> {
    let text = std::fs::read_to_string(path).map_err(|source| Error::unreadable(path, source))?;
    let complete = text.rfind('\n').map_or("", |end| &text[..end]);
    let mut lines = complete.lines();
    let is_not =
        |problem: serde_json::Error| bad(path, format!("it is no journal of a data set ({problem})"));
    let settings = serde_json::from_str(lines.next().unwrap_or_default()).map_err(is_not)?;
    let mut results: Vec<MaterialResult> =
        lines.map(serde_json::from_str).collect::<Result<_, _>>().map_err(is_not)?;
    results.sort_by_key(|result| result.index);
    results.dedup_by_key(|result| result.index);
    Ok((settings, results))
}

fn line(path: &Path, value: &impl serde::Serialize) -> Result<String, Error> {
    let text = serde_json::to_string(value).map_err(|problem| unwritable(path, problem.into()))?;
    Ok(text + "\n")
}

fn bad(path: &Path, problem: String) -> Error {
    Error::BadJournal { path: path.to_owned(), problem }
}

fn unwritable(path: &Path, source: std::io::Error) -> Error {
    Error::Unwritable {
        path: path.to_owned(),
        source,
        remedy: "check that its folder is writable and the disk not full",
    }
}
