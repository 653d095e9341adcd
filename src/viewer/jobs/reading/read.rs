//! Reading of one material, with retries where its files are just being written.

use std::time::{Duration, SystemTime};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_files::disk::stamp::Stamp;

use crate::error::Error;
use crate::model::material::read::{ReadMaterial, Rules};
use svbrdf_files::source::{MaterialSource, Place};

/// A file that was written less than this ago may be incomplete.
const INCOMPLETE: Duration = Duration::from_secs(5);
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

/// Reads one material. A file that is just being written is tried again where the reader retries.
///
/// # Errors
/// Those of [`MaterialSource::read`], and [`CoreError::Cancelled`].
pub fn read_with_retries(
    source: &MaterialSource,
    reader: &mut MaterialReader,
    progress: &Progress,
) -> Result<ReadMaterial, Error> {
    loop {
        match read(source, reader, progress) {
            Err(error) if error.is_cancelled() || progress.is_cancelled() => {
                return Err(CoreError::Cancelled.into());
            }
            Err(_) if reader.retries && is_being_written(source) => std::thread::sleep(RETRY),
            result => return result,
        }
    }
}

/// Whether a file of the material was written a moment ago.
fn is_being_written(source: &MaterialSource) -> bool {
    let Place::Path(path) = &source.place else { return false };
    Stamp::of(path).is_some_and(|stamp| stamp.is_younger_than(INCOMPLETE, SystemTime::now()))
}

fn read(
    source: &MaterialSource,
    reader: &mut MaterialReader,
    progress: &Progress,
) -> Result<ReadMaterial, Error> {
    let read = source.read(progress)?;
    match &source.place {
        Place::BuiltIn(_) => {
            reader.size.get_or_insert(read.material.size());
            Ok(ReadMaterial::new(source.clone(), read))
        }
        Place::Path(path) => reader.rules.take(path, source.clone(), read, &mut reader.size),
    }
}
