//! Opening: materials that are read one after the other. Each is taken over as soon as it has been read.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use svbrdf_core::progress::Progress;
use svbrdf_gpu::Gpu;

use super::read::{MaterialReader, read_with_retries};
use super::upload::{Uploaded, Uploads};
use crate::error::Error;
use crate::jobs::work::job::{Job, Worker};
use crate::jobs::work::waker::Waker;
use crate::model::material::read::MaterialId;
use crate::model::material::read::label;
use crate::model::material::request::{Arrival, ArrivalPlace, Item, ReadRequest, Target};
use svbrdf_files::source::MaterialSource;

/// The openings that are going on.
#[derive(Debug, Default)]
pub struct Openings {
    all: Vec<Opening>,
    latest: u64,
}

/// The reading of several materials.
#[derive(Debug)]
pub struct Opening {
    number: u64,
    target: Target,
    names: Vec<String>,
    parts: Arc<Vec<Progress>>,
    current: Arc<AtomicUsize>,
    /// The materials of it that are loaded already.
    loaded: Vec<MaterialId>,
    /// How many materials have been taken over.
    arrived: usize,
    job: Job<(), Uploading>,
}

/// A material that has been read or not, and its maps on the adapter, where they are new.
type Uploading = (Arrival, Option<(MaterialId, Arc<Uploaded>)>);

impl Openings {
    /// Starts to read materials; the number of the opening. One for everything cancels all others, and one that reads a material
    /// again cancels the others of this material.
    pub fn start(
        &mut self,
        waker: &Waker,
        gpu: Option<&Gpu>,
        request: ReadRequest,
        reader: MaterialReader,
    ) -> u64 {
        match &request.target {
            Target::Everything => self.all.clear(),
            Target::Predictions => {}
            Target::Again(_) => self.all.retain(|one| one.target != request.target),
        }
        self.latest += 1;
        self.all.push(Opening::start(waker, gpu, self.latest, request, reader));
        self.latest
    }

    /// Takes over the materials that have been read since the last call; `place` returns whether those after one are wanted. The
    /// errors of openings that have failed.
    pub fn take(
        &mut self,
        uploads: &mut Uploads,
        mut place: impl FnMut(&ArrivalPlace, Arrival) -> bool,
    ) -> Vec<Error> {
        let mut errors = Vec::new();
        for mut opening in std::mem::take(&mut self.all) {
            let ended = opening.job.poll();
            let are_wanted = opening.job.updates().into_iter().all(|(arrival, uploaded)| {
                if let Some((id, uploaded)) = uploaded {
                    uploads.add(id, Some(uploaded));
                }
                let at = opening.place();
                opening.arrived += 1;
                place(&at, arrival)
            });
            match ended {
                None if are_wanted => self.all.push(opening),
                Some(Err(error)) if !error.is_cancelled() => errors.push(error),
                _ => {}
            }
        }
        errors
    }

    pub fn iter(&self) -> impl Iterator<Item = &Opening> {
        self.all.iter()
    }

    /// Cancels the opening of this number; what it has read stays.
    pub fn cancel(&self, number: u64) {
        self.all.iter().filter(|one| one.number == number).for_each(|one| one.job.cancel());
    }

    /// Whether a material is on its way back into the window.
    pub fn hold(&self, id: MaterialId) -> bool {
        self.all.iter().any(|one| one.loaded.contains(&id))
    }

    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Whether materials are being read that are not in the window yet.
    pub fn expect_more(&self) -> bool {
        self.all.iter().any(|one| !matches!(one.target, Target::Again(_)))
    }

    /// Whether the opening of this number is going on and none of its materials is there yet.
    pub fn is_waiting(&self, number: u64) -> bool {
        self.all.iter().any(|one| one.number == number && one.arrived == 0)
    }
}

impl Opening {
    fn start(
        waker: &Waker,
        gpu: Option<&Gpu>,
        number: u64,
        ReadRequest { items, target }: ReadRequest,
        reader: MaterialReader,
    ) -> Self {
        let name = |item: &Item| match item {
            Item::Loaded(_) => String::new(),
            Item::Read(source) => label(source),
        };
        let names: Vec<String> = items.iter().map(name).collect();
        let id = |item: &Item| match item {
            Item::Loaded(loaded) => Some(loaded.id()),
            Item::Read(_) => None,
        };
        let loaded = items.iter().filter_map(id).collect();
        let whole = Progress::default();
        let parts = Arc::new(items.iter().map(|_| whole.part()).collect::<Vec<_>>());
        let current = Arc::new(AtomicUsize::new(0));
        let work = OpeningWork { gpu: gpu.cloned(), parts: parts.clone(), current: current.clone() };
        let job = Job::stream(waker, whole, move |worker| work.run(items, reader, worker));
        Self { number, target, names, parts, current, loaded, arrived: 0, job }
    }

    /// Where its next material belongs.
    fn place(&self) -> ArrivalPlace {
        ArrivalPlace {
            opening: self.number,
            target: self.target.clone(),
            is_first: self.arrived == 0,
            others: self.names.iter().skip(1).cloned().collect(),
        }
    }

    pub fn number(&self) -> u64 {
        self.number
    }

    /// What is being read, for a progress bar.
    pub fn text(&self) -> String {
        let index = self.current.load(Ordering::Relaxed);
        let name = self.names.get(index).map_or("", String::as_str);
        match self.names.len() {
            1 => format!("Reading {name}"),
            count => format!("Reading {} of {count}: {name}", index + 1),
        }
    }

    /// Share of the files that has been read, in [0, 1].
    pub fn fraction(&self) -> f32 {
        let index = self.current.load(Ordering::Relaxed);
        let part = self.parts.get(index).map_or(0.0, |part| match part.counts() {
            (_, 0) => 0.0,
            (done, total) => done as f32 / total as f32,
        });
        (index as f32 + part.min(1.0)) / self.names.len().max(1) as f32
    }
}

/// What the worker of an opening works with.
struct OpeningWork {
    gpu: Option<Gpu>,
    /// The progress of each item.
    parts: Arc<Vec<Progress>>,
    current: Arc<AtomicUsize>,
}

impl OpeningWork {
    /// Reads the items one after the other.
    fn run(
        &self,
        items: Vec<Item>,
        mut reader: MaterialReader,
        worker: &Worker<Uploading>,
    ) -> Result<(), Error> {
        for (index, item) in items.into_iter().enumerate() {
            self.current.store(index, Ordering::Relaxed);
            match item {
                Item::Loaded(loaded) => worker.report((Arrival::Loaded(loaded), None))?,
                Item::Read(source) => worker.report(self.read(*source, index, &mut reader))?,
            }
        }
        Ok(())
    }

    fn read(&self, source: MaterialSource, index: usize, reader: &mut MaterialReader) -> Uploading {
        match read_with_retries(&source, reader, &self.parts[index]) {
            Ok(read) => {
                let uploaded = self.gpu.as_ref().map(|gpu| Arc::new(Uploaded::new(gpu, read.material())));
                let id = read.id;
                (Arrival::Read(Arc::new(read)), uploaded.map(|uploaded| (id, uploaded)))
            }
            Err(error) => (Arrival::Failed(Box::new(source), error), None),
        }
    }
}
