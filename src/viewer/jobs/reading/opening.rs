//! Opening: materials that are read one after the other. Each is taken over as soon as it has been read.

use std::sync::Arc;

use super::read::MaterialReader;
use crate::error::Error;
use crate::jobs::work::job::{Job, Worker};
use crate::jobs::work::waker::Waker;
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
    /// The place of its next material.
    next: ArrivalPlace,
    job: Job<(), Arrival>,
}

impl Openings {
    /// Starts to read materials; the number of the opening. One for everything cancels all others, and one that reads a material
    /// again cancels the others of this material.
    pub fn start(&mut self, waker: &Waker, request: ReadRequest, reader: MaterialReader) -> u64 {
        match &request.target {
            Target::Everything => self.all.clear(),
            Target::Predictions => {}
            Target::Again(_) => self.all.retain(|one| one.next.target != request.target),
        }
        self.latest += 1;
        self.all.push(Opening::start(waker, self.latest, request, reader));
        self.latest
    }

    /// Takes over the materials that have been read since the last call; `place` returns whether those after one are wanted. The
    /// errors of openings that have failed.
    pub fn take(&mut self, mut place: impl FnMut(&ArrivalPlace, Arrival) -> bool) -> Vec<Error> {
        let mut errors = Vec::new();
        for mut opening in std::mem::take(&mut self.all) {
            let ended = opening.job.poll();
            let are_wanted = opening.job.updates().into_iter().all(|arrival| {
                let is_wanted = place(&opening.next, arrival);
                opening.next.arrived += 1;
                is_wanted
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

    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Whether materials are being read that are not in the window yet.
    pub fn expect_more(&self) -> bool {
        self.all.iter().any(|one| !matches!(one.next.target, Target::Again(_)))
    }

    /// Whether the opening of this number is going on and none of its materials is there yet.
    pub fn is_waiting(&self, number: u64) -> bool {
        self.all.iter().any(|one| one.next.opening == number && one.next.arrived == 0)
    }
}

impl Opening {
    fn start(
        waker: &Waker,
        opening: u64,
        ReadRequest { items, target }: ReadRequest,
        reader: MaterialReader,
    ) -> Self {
        let name = |item: &Item| match item {
            Item::Loaded(_) => String::new(),
            Item::Read(source) => label(source),
        };
        let names: Vec<String> = items.iter().map(name).collect();
        let job = Job::stream(waker, move |worker| read_all(items, reader, worker));
        Self { next: ArrivalPlace { opening, target, names, arrived: 0 }, job }
    }

    /// Cancels it; what it has read stays.
    pub fn cancel(&self) {
        self.job.cancel();
    }

    /// What is being read, for a progress bar.
    pub fn text(&self) -> String {
        let ArrivalPlace { names, arrived, .. } = &self.next;
        let name = names.get(*arrived).map_or("", String::as_str);
        match names.len() {
            1 => format!("Reading {name}"),
            count => format!("Reading {} of {count}: {name}", arrived + 1),
        }
    }

    /// Share of the materials that have been read, in [0, 1].
    pub fn fraction(&self) -> f32 {
        self.next.arrived as f32 / self.next.names.len().max(1) as f32
    }
}

/// Reads the items one after the other.
fn read_all(items: Vec<Item>, mut reader: MaterialReader, worker: &Worker<Arrival>) -> Result<(), Error> {
    for item in items {
        worker.report(match item {
            Item::Loaded(loaded) => Arrival::Loaded(loaded),
            Item::Read(source) => match reader.read(&source, &worker.progress.part()) {
                Ok(read) => Arrival::Read(Arc::new(read)),
                Err(error) => Arrival::Failed(source, error),
            },
        })?;
    }
    Ok(())
}
