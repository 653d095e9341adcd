//! Reading of materials: the question that an opening asks, with retries where files are just being written.

use std::sync::Arc;
use std::time::{Duration, SystemTime};

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::progress::Progress;
use svbrdf_files::disk::stamp::Stamp;
use svbrdf_files::read::{Note, Read};
use svbrdf_files::source::{MaterialSource, Place};
use svbrdf_gpu::Gpu;

use super::answers::content::Given;
use super::answers::{Pace, Question, Work};
use crate::error::Error;
use crate::model::material::opening::{Arrival, Item, Opening, Reading};
use crate::model::material::read::ReadMaterial;

/// A file that was written less than this ago may be incomplete.
const INCOMPLETE: Duration = Duration::from_secs(5);
/// Time until a file that may be incomplete is read again.
const RETRY: Duration = Duration::from_millis(300);

/// The materials of an opening, which are told of one by one.
#[derive(Clone, Debug)]
pub struct ReadMaterials {
    pub opening: Opening,
    pub gpu: Given<Option<Gpu>>,
}

impl PartialEq for ReadMaterials {
    fn eq(&self, other: &Self) -> bool {
        self.opening.number == other.opening.number
    }
}

impl Question for ReadMaterials {
    type Answer = Vec<Arrival>;
    const PACE: Pace = Pace::Beside;
    // The model has what is in the window.
    const KEPT: usize = 0;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<Vec<Arrival>, Error> {
        let (mut reading, gpu) = (self.opening.reading.clone(), self.gpu.0.as_ref());
        let mut all = Vec::new();
        work.progress().begin(self.opening.items.len() as u64);
        for item in self.opening.items.iter() {
            all.push(match item {
                Item::Loaded(loaded) => {
                    if reading.size.is_none() {
                        reading.size = Some(loaded.material().size());
                        reading.mask.clone_from(&loaded.read.record.mask);
                    }
                    Arrival::Loaded(loaded.clone())
                }
                Item::Read(source) => match read(&mut reading, source, gpu, &work.progress().part()) {
                    Ok(read) => Arrival::Read(Arc::new(read)),
                    Err(error) => Arrival::Failed(source.clone(), Arc::new(error)),
                },
            });
            work.progress().step()?;
            work.tell(all.clone());
        }
        Ok(all)
    }
}

/// Reads one material and sends it to the adapter; the first one sets the size, where there is none yet. A file that is just being
/// written is tried again where `reading` retries.
///
/// # Errors
/// Those of [`MaterialSource::read`], [`CoreError::Cancelled`], [`Guessed`](svbrdf_files::Error::Guessed) where guesses are errors,
/// [`SizesDiffer`](CoreError::SizesDiffer) where it cannot be resized.
pub fn read(
    reading: &mut Reading,
    source: &MaterialSource,
    gpu: Option<&Gpu>,
    progress: &Progress,
) -> Result<ReadMaterial, Error> {
    loop {
        let read = source.read(progress).map_err(Error::from);
        match read.and_then(|read| by_rules(reading, source, read)) {
            Err(error) if error.is_cancelled() || progress.is_cancelled() => {
                return Err(CoreError::Cancelled.into());
            }
            Err(_) if reading.retries && is_being_written(source) => std::thread::sleep(RETRY),
            result => return result.map(|(source, read)| ReadMaterial::new(source, read, gpu)),
        }
    }
}

/// What was read, by the rules.
fn by_rules(
    reading: &mut Reading,
    source: &MaterialSource,
    mut read: Read<f32>,
) -> Result<(MaterialSource, Read<f32>), Error> {
    let mut source = source.clone();
    let from = read.material.size();
    if reading.size.is_none() {
        let mask = reading.rules.mask.as_ref().map(|mask| mask.of(read.material.name(), &read));
        reading.mask = mask.transpose()?;
    }
    let size = *reading.size.get_or_insert(from);
    if let Place::Path(path) = &source.place {
        if reading.rules.strict {
            read.refuse_guesses(path)?;
        }
        source.fit |= reading.rules.fit;
        if source.fit && from != size {
            read.material = read.material.resized(size)?;
            read.notes.push(Note::Resized { from, to: size });
        }
    }
    // One of another size is refused when it arrives.
    read.mask = reading.mask.clone().filter(|mask| mask.size() == read.material.size());
    if let Some(mask) = &read.mask {
        read.material = read.material.gray_outside(mask);
    }
    Ok((source, read))
}

/// Whether a file of the material was written a moment ago.
fn is_being_written(source: &MaterialSource) -> bool {
    let Place::Path(path) = &source.place else { return false };
    Stamp::of(path).is_some_and(|stamp| stamp.is_younger_than(INCOMPLETE, SystemTime::now()))
}
