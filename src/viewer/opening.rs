//! Materials that are being read, one after the other, on a worker. Each is taken over as soon as it has been read.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver};

use eframe::egui;

use super::loaded::{Loaded, Reader, loaded};
use super::slot::{Slot, Target};
use super::source::{Origin, Source};
use super::worker::Task;
use crate::error::Error;
use crate::files::read;
use crate::progress::Progress;
use crate::samples;

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
            Ok(loaded(source, read, reader.gpu.as_ref()))
        }
        Origin::Path(path) => {
            let read = match &source.exactly {
                Some(options) => read::read_as::<f32>(path, options, progress)?,
                None => read::read::<f32>(path, &source.asked, progress)?,
            };
            let path = path.clone();
            reader.take(&path, source, read)
        }
    }
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
    Read(Box<Loaded>),
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
        let task = Task::start_with(ctx, whole, move |whole| {
            for (index, item) in items.into_iter().enumerate() {
                now.store(index, Ordering::Relaxed);
                let arrival = match item {
                    _ if whole.is_cancelled() => return Err(Error::Cancelled),
                    Item::Kept(kept) => Arrival::Kept(kept),
                    Item::Read(source) => match read(source.clone(), &mut reader, &each[index]) {
                        Ok(loaded) => Arrival::Read(Box::new(loaded)),
                        Err(error) => Arrival::Failed(Box::new(source), error),
                    },
                };
                // Where the window has dropped this reading, the material is not wanted.
                if sender.send(arrival).is_err() {
                    return Err(Error::Cancelled);
                }
                seen.request_repaint();
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
