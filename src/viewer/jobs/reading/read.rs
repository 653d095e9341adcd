//! Reading of one material, with retries where its files are just being written.

use std::io;
use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_files::Error as FilesError;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::steps::{RunId, TrainingRun, TrainingStep, runs_in};

use crate::error::Error;
use crate::model::material::read::{ReadMaterial, Rules};
use svbrdf_files::source::{MaterialSource, Place};

/// A file that was written less than this ago may be incomplete.
const INCOMPLETE: Duration = Duration::from_secs(5);
/// A file that was written less than this ago is left for later, where there are others.
const RECENT: Duration = Duration::from_secs(2);
/// Time until a file that may be incomplete is read again.
const RETRY: Duration = Duration::from_millis(300);

/// How materials are read one after the other.
#[derive(Clone, Copy, Debug)]
pub struct MaterialReader {
    pub rules: Rules,
    /// The size of the ground truth, once it is known.
    pub size: Option<[usize; 2]>,
    /// Whether a file that cannot be read is tried again, where it was written a moment ago.
    pub retries: bool,
}

/// Reads one material. A step of a training run that is just being written is tried again, and so is any file where the reader
/// retries.
///
/// # Errors
/// Those of [`MaterialSource::read`], and [`CoreError::Cancelled`].
pub fn read_with_retries(
    source: &MaterialSource,
    reader: &mut MaterialReader,
    progress: &Progress,
) -> Result<ReadMaterial, Error> {
    loop {
        match read(source.clone(), reader, progress) {
            Err(error) if error.is_cancelled() || progress.is_cancelled() => {
                return Err(CoreError::Cancelled.into());
            }
            Err(_) if (reader.retries || source.run.is_some()) && is_being_written(source) => {
                std::thread::sleep(RETRY)
            }
            result => return result,
        }
    }
}

/// Whether a file of the material was written a moment ago.
fn is_being_written(source: &MaterialSource) -> bool {
    let Place::Path(path) = &source.place else { return false };
    let of_step = |run: &RunId| {
        let step = newest_first(run).into_iter().find(|step| step.path == *path || run.folder == *path)?;
        Some(step.stamp)
    };
    let stamp = source.run.as_ref().and_then(of_step).or_else(|| Stamp::of(path));
    stamp.is_some_and(|stamp| stamp.is_younger_than(INCOMPLETE, SystemTime::now()))
}

/// The steps of a run that are there now, the newest first.
fn newest_first(run: &RunId) -> Vec<TrainingStep> {
    let runs = runs_in(&run.folder).unwrap_or_default();
    let steps = runs.into_iter().find(|found| found.id == *run).map(|found| found.steps);
    steps.unwrap_or_default().into_iter().rev().collect()
}

/// A source for each training run in a folder; `source` itself where it is none.
pub fn runs_of(source: MaterialSource) -> Vec<MaterialSource> {
    let Place::Path(path) = &source.place else { return vec![source] };
    let runs =
        if source.run.is_none() && path.is_dir() { runs_in(path).unwrap_or_default() } else { Vec::new() };
    if runs.is_empty() {
        return vec![source];
    }
    let one = |run: TrainingRun| MaterialSource {
        place: Place::Path(run.id.folder.clone()),
        run: Some(run.id),
        ..source.clone()
    };
    runs.into_iter().map(one).collect()
}

/// Reads one material.
fn read(
    source: MaterialSource,
    reader: &mut MaterialReader,
    progress: &Progress,
) -> Result<ReadMaterial, Error> {
    match &source.place {
        Place::BuiltIn(_) => {
            let read = source.read(progress)?;
            reader.size.get_or_insert(read.material.size());
            Ok(ReadMaterial::new(source, read))
        }
        Place::Path(path) => {
            let path = path.clone();
            match source.run.as_ref().filter(|run| run.folder == path) {
                Some(run) => read_newest(run, &source, reader, progress),
                None => read_path(path, source, reader, progress),
            }
        }
    }
}

fn read_path(
    path: PathBuf,
    source: MaterialSource,
    reader: &mut MaterialReader,
    progress: &Progress,
) -> Result<ReadMaterial, Error> {
    let source = MaterialSource { place: Place::Path(path.clone()), ..source };
    let read = source.read(progress)?;
    reader.rules.take(&path, source, read, &mut reader.size)
}

/// Reads the newest step of a run that can be read. Steps that were written a moment ago come last: the window moves on to them.
fn read_newest(
    run: &RunId,
    source: &MaterialSource,
    reader: &mut MaterialReader,
    progress: &Progress,
) -> Result<ReadMaterial, Error> {
    let now = SystemTime::now();
    let (recent, old): (Vec<_>, Vec<_>) =
        newest_first(run).into_iter().partition(|step| step.stamp.is_younger_than(RECENT, now));
    let mut problem = None;
    for step in old.into_iter().chain(recent) {
        match read_path(step.path, source.clone(), reader, progress) {
            Err(error) if error.is_cancelled() => return Err(error),
            Err(error) => problem = problem.or(Some(error)),
            read => return read,
        }
    }
    Err(problem.unwrap_or_else(|| {
        let absent = format!("no {} of {} is there", run.counter, run.name);
        FilesError::unreadable(&run.folder, io::Error::new(io::ErrorKind::NotFound, absent)).into()
    }))
}
