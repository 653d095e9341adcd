//! Materials that are being read, one after the other, on a worker. Each is taken over as soon as it has been read.
//!
//! Of a folder of training steps each run is a material. A file that cannot be read because it is just being written is waited for.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, SystemTime};

use eframe::egui;

use super::loaded::{Loaded, Reader, loaded};
use super::slot::{Slot, Target};
use super::source::{Origin, Source};
use super::worker::Task;
use crate::error::Error;
use crate::files::read;
use crate::files::stamp::Stamp;
use crate::files::steps::{RunId, TrainingRun, TrainingStep, runs_in};
use crate::progress::Progress;
use crate::samples;

/// A file that was written less than this ago may be incomplete.
const PATIENCE: Duration = Duration::from_secs(5);
/// A file that was written less than this ago is left for later, where there are others.
const YOUNG: Duration = Duration::from_secs(2);
/// Time until a file that may be incomplete is read again.
const AGAIN: Duration = Duration::from_millis(300);

/// Reads one material. A step of a training run that is just being written is waited for, and so is any file where the reader is
/// patient.
pub(super) fn read_patiently(
    source: &Source,
    reader: &mut Reader,
    progress: &Progress,
) -> Result<Loaded, Error> {
    loop {
        match read(source.clone(), reader, progress) {
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Err(_) if progress.is_cancelled() => return Err(Error::Cancelled),
            Err(_) if (reader.patient || source.run.is_some()) && is_being_written(source) => {
                std::thread::sleep(AGAIN)
            }
            result => return result,
        }
    }
}

/// Whether a file of the material was written a moment ago.
fn is_being_written(source: &Source) -> bool {
    let Origin::Path(path) = &source.origin else { return false };
    let of_step = |run: &RunId| {
        let step = newest_first(run).into_iter().find(|step| step.path == *path || run.folder == *path)?;
        Some(step.stamp)
    };
    let stamp = source.run.as_ref().and_then(of_step).or_else(|| Stamp::of(path));
    stamp.is_some_and(|stamp| stamp.is_younger_than(PATIENCE, SystemTime::now()))
}

/// The steps of a run that are there now.
fn newest_first(run: &RunId) -> Vec<TrainingStep> {
    let runs = runs_in(&run.folder).unwrap_or_default();
    let steps = runs.into_iter().find(|found| found.id == *run).map(|found| found.steps);
    steps.unwrap_or_default().into_iter().rev().collect()
}

/// A source for each training run in a folder; `source` itself where it is none.
fn runs_of(source: Source) -> Vec<Source> {
    let Origin::Path(path) = &source.origin else { return vec![source] };
    let runs =
        if source.run.is_none() && path.is_dir() { runs_in(path).unwrap_or_default() } else { Vec::new() };
    if runs.is_empty() {
        return vec![source];
    }
    let one = |run: TrainingRun| Source {
        origin: Origin::Path(run.id.folder.clone()),
        run: Some(run.id),
        ..source.clone()
    };
    runs.into_iter().map(one).collect()
}

/// Reads one material.
fn read(source: Source, reader: &mut Reader, progress: &Progress) -> Result<Loaded, Error> {
    match &source.origin {
        Origin::BuiltIn(number) => {
            let samples = samples::load::<f32>()?;
            let mut all = std::iter::once(samples.ground_truth).chain(samples.predictions);
            let read = all
                .nth(*number)
                .ok_or_else(|| Error::Internal(format!("there is no built-in material {number}")))?;
            reader.size.get_or_insert(read.material.size());
            Ok(loaded(source, read, reader))
        }
        Origin::Path(path) => {
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
    source: Source,
    reader: &mut Reader,
    progress: &Progress,
) -> Result<Loaded, Error> {
    let read = match &source.exactly {
        Some(options) => read::read_as::<f32>(&path, options, progress)?,
        None => read::read::<f32>(&path, &source.asked, progress)?,
    };
    reader.take(&path, Source { origin: Origin::Path(path.clone()), ..source }, read)
}

/// Reads the newest step of a run that can be read. Steps that were written a moment ago come last: the window moves on to them.
fn read_newest(
    run: &RunId,
    source: &Source,
    reader: &mut Reader,
    progress: &Progress,
) -> Result<Loaded, Error> {
    let now = SystemTime::now();
    let (young, old): (Vec<_>, Vec<_>) =
        newest_first(run).into_iter().partition(|step| step.stamp.is_younger_than(YOUNG, now));
    let mut problem = None;
    for step in old.into_iter().chain(young) {
        match read_path(step.path, source.clone(), reader, progress) {
            Err(Error::Cancelled) => return Err(Error::Cancelled),
            Err(error) => problem = problem.or(Some(error)),
            read => return read,
        }
    }
    Err(problem.unwrap_or_else(|| {
        let absent = format!("no {} of {} is there", run.counter, run.name);
        Error::unreadable(&run.folder, io::Error::new(io::ErrorKind::NotFound, absent))
    }))
}

/// A material of a set: one that is in the window and stays, or one to be read.
#[derive(Debug)]
pub(super) enum Item {
    Kept(Slot),
    Read(Source),
}

/// A material that has been read, or why not.
#[derive(Debug)]
pub(super) enum Arrival {
    Kept(Slot),
    Read(Arc<Loaded>),
    Failed(Box<Source>, Error),
}

/// The reading of several materials.
#[derive(Debug)]
pub(super) struct Opening {
    pub id: u64,
    pub target: Target,
    sources: Vec<String>,
    parts: Arc<Vec<Progress>>,
    current: Arc<AtomicUsize>,
    arrivals: Receiver<Arrival>,
    /// How many materials have been taken over.
    pub arrived: usize,
    task: Task<()>,
}

impl Opening {
    /// Starts to read `items` in their order.
    pub(super) fn start(
        ctx: &egui::Context,
        id: u64,
        target: Target,
        items: Vec<Item>,
        mut reader: Reader,
    ) -> Self {
        let name = |item: &Item| match item {
            Item::Kept(_) => String::new(),
            Item::Read(source) => source.name(),
        };
        let sources: Vec<String> = items.iter().map(name).collect();
        let whole = Progress::default();
        let parts = Arc::new(items.iter().map(|_| whole.part()).collect::<Vec<_>>());
        let current = Arc::new(AtomicUsize::new(0));
        let (sender, arrivals) = mpsc::channel();
        let (seen, each, now) = (ctx.clone(), parts.clone(), current.clone());
        let alone = match &target {
            // The ground truth is one material, and so is a material that is read again.
            Target::Everything => 1,
            Target::Predictions => 0,
            Target::Again(_) => items.len(),
        };
        let task = Task::start_with(ctx, whole, move |whole| {
            for (index, item) in items.into_iter().enumerate() {
                now.store(index, Ordering::Relaxed);
                let items = match item {
                    Item::Read(source) if index >= alone => {
                        runs_of(source).into_iter().map(Item::Read).collect()
                    }
                    item => vec![item],
                };
                for item in items {
                    let mut read = None;
                    let arrival = match item {
                        _ if whole.is_cancelled() => return Err(Error::Cancelled),
                        Item::Kept(kept) => Arrival::Kept(kept),
                        Item::Read(source) => match read_patiently(&source, &mut reader, &each[index]) {
                            Ok(loaded) => Arrival::Read(read.insert(Arc::new(loaded)).clone()),
                            Err(error) => Arrival::Failed(Box::new(source), error),
                        },
                    };
                    // Where the window has dropped this reading, the material is not wanted.
                    if sender.send(arrival).is_err() {
                        return Err(Error::Cancelled);
                    }
                    seen.request_repaint();
                    if let (Some(loaded), Some(gpu)) = (read, &reader.gpu) {
                        loaded.complete_upload(gpu);
                        seen.request_repaint();
                    }
                }
            }
            Ok(())
        });
        Self { id, target, sources, parts, current, arrivals, arrived: 0, task }
    }

    /// The materials that have been read since the last call, and how the reading ended.
    pub(super) fn poll(&self, ctx: &egui::Context) -> (Vec<Arrival>, Option<Result<(), Error>>) {
        // What was sent before the end is there after it.
        let ended = self.task.poll(ctx);
        (self.arrivals.try_iter().collect(), ended)
    }

    /// The names of the materials after the first `count`.
    pub(super) fn names_after(&self, count: usize) -> Vec<String> {
        self.sources.iter().skip(count).cloned().collect()
    }

    /// What is being read, for a progress bar.
    pub(super) fn text(&self) -> String {
        let index = self.current.load(Ordering::Relaxed);
        let name = self.sources.get(index).map_or("", String::as_str);
        match self.sources.len() {
            1 => format!("Reading {name}"),
            count => format!("Reading {} of {count}: {name}", index + 1),
        }
    }

    /// Share of the files that has been read, in [0, 1].
    pub(super) fn fraction(&self) -> f32 {
        let index = self.current.load(Ordering::Relaxed);
        let part = self.parts.get(index).map_or(0.0, |part| match part.counts() {
            (_, 0) => 0.0,
            (done, total) => done as f32 / total as f32,
        });
        (index as f32 + part.min(1.0)) / self.sources.len().max(1) as f32
    }

    pub(super) fn cancel(&self) {
        self.task.cancel();
    }
}
