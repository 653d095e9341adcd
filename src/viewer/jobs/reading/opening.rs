//! Opening: materials that are read one after the other. Each is taken over as soon as it has been read.

use std::sync::Arc;

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
                uploads.extend(uploaded);
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
        let gpu = gpu.cloned();
        let job = Job::stream(waker, Progress::default(), move |worker| {
            read_all(items, reader, gpu.as_ref(), worker)
        });
        Self { number, target, names, loaded, arrived: 0, job }
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
        let name = self.names.get(self.arrived).map_or("", String::as_str);
        match self.names.len() {
            1 => format!("Reading {name}"),
            count => format!("Reading {} of {count}: {name}", self.arrived + 1),
        }
    }

    /// Share of the materials that have been read, in [0, 1].
    pub fn fraction(&self) -> f32 {
        self.arrived as f32 / self.names.len().max(1) as f32
    }
}

/// Reads the items one after the other.
fn read_all(
    items: Vec<Item>,
    mut reader: MaterialReader,
    gpu: Option<&Gpu>,
    worker: &Worker<Uploading>,
) -> Result<(), Error> {
    for item in items {
        worker.report(match item {
            Item::Loaded(loaded) => (Arrival::Loaded(loaded), None),
            Item::Read(source) => match read_with_retries(&source, &mut reader, &worker.progress.part()) {
                Ok(read) => {
                    let uploaded = gpu.map(|gpu| (read.id, Arc::new(Uploaded::new(gpu, read.material()))));
                    (Arrival::Read(Arc::new(read)), uploaded)
                }
                Err(error) => (Arrival::Failed(source, error), None),
            },
        })?;
    }
    Ok(())
}
