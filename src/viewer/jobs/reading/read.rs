//! Reading of one material, with retries where its files are just being written.

use std::time::{Duration, SystemTime};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::read::{Note, Read};
use svbrdf_files::source::{MaterialSource, Place};
use svbrdf_gpu::Gpu;

use crate::error::Error;
use crate::model::material::read::{ReadMaterial, Rules};

/// A file that was written less than this ago may be incomplete.
const INCOMPLETE: Duration = Duration::from_secs(5);
/// Time until a file that may be incomplete is read again.
const RETRY: Duration = Duration::from_millis(300);

/// How materials are read one after the other.
#[derive(Clone, Debug)]
pub struct MaterialReader {
    pub rules: Rules,
    /// The size of the ground truth, once it is known.
    pub size: Option<[usize; 2]>,
    /// Whether a file that cannot be read is tried again, where it was written a moment ago.
    pub retries: bool,
    /// Where materials are sent to.
    pub gpu: Option<Gpu>,
}

impl MaterialReader {
    /// Reads one material; the first one sets the size, where there is none yet. A file that is just being written is tried again
    /// where the reader retries.
    ///
    /// # Errors
    /// Those of [`MaterialSource::read`], [`CoreError::Cancelled`], [`Guessed`](svbrdf_files::Error::Guessed) where guesses are errors,
    /// [`SizesDiffer`](CoreError::SizesDiffer) where it cannot be resized.
    pub fn read(&mut self, source: &MaterialSource, progress: &Progress) -> Result<ReadMaterial, Error> {
        loop {
            match source.read(progress).map_err(Error::from).and_then(|read| self.take(source, read)) {
                Err(error) if error.is_cancelled() || progress.is_cancelled() => {
                    return Err(CoreError::Cancelled.into());
                }
                Err(_) if self.retries && is_being_written(source) => std::thread::sleep(RETRY),
                result => return result,
            }
        }
    }

    /// Takes in what was read, by the rules.
    fn take(&mut self, source: &MaterialSource, mut read: Read<f32>) -> Result<ReadMaterial, Error> {
        let mut source = source.clone();
        let from = read.material.size();
        let size = *self.size.get_or_insert(from);
        if let Place::Path(path) = &source.place {
            if self.rules.strict {
                read.refuse_guesses(path)?;
            }
            source.fit |= self.rules.fit;
            if source.fit && from != size {
                read.material = read.material.resized(size)?;
                read.notes.push(Note::Resized { from, to: size });
            }
        }
        Ok(ReadMaterial::new(source, read, self.gpu.as_ref()))
    }
}

/// Whether a file of the material was written a moment ago.
fn is_being_written(source: &MaterialSource) -> bool {
    let Place::Path(path) = &source.place else { return false };
    Stamp::of(path).is_some_and(|stamp| stamp.is_younger_than(INCOMPLETE, SystemTime::now()))
}
