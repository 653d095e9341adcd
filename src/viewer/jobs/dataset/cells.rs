//! Small materials of a data set, for the contact sheet.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use svbrdf_core::material::Material;
use svbrdf_core::progress::Progress;
use svbrdf_files::read::Read;

use crate::error::Error;
use crate::jobs::work::job::{Job, Worker};
use crate::jobs::work::waker::Waker;
use crate::model::dataset::OpenDataset;

/// The most small materials beside those in sight.
const MOST_BESIDE: usize = 64;
/// Longest sides of small materials, in texels.
const SIDES: [usize; 4] = [48, 96, 192, 384];

/// A material of a data set: in column 0 the ground truth, from column 1 on the prediction of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cell {
    pub case: usize,
    pub column: usize,
}

/// A small material, or why there is none.
pub type Reduced = Result<Arc<Material<f32>>, String>;

/// The small materials.
#[derive(Debug, Default)]
pub struct CellJobs {
    side: usize,
    reduced: HashMap<Cell, Reduced>,
    /// Counts the changes.
    pub generation: u64,
    wanted: Arc<Mutex<Vec<Cell>>>,
    job: Option<Job<(), ReadCell>>,
}

/// A material that was read.
type ReadCell = (Cell, Reduced);

impl CellJobs {
    pub fn get(&self, cell: Cell) -> Option<&Reduced> {
        self.reduced.get(&cell)
    }

    /// Reads a material again: its files have changed.
    pub fn forget(&mut self, case: usize) {
        self.reduced.retain(|cell, _| cell.case != case);
        self.generation += 1;
    }

    /// Takes over what has been read, and reads what is missing of the cells in sight, which are drawn with this longest side in
    /// pixels.
    pub(super) fn follow(
        &mut self,
        waker: &Waker,
        open: &Arc<OpenDataset>,
        cells: &[Cell],
        pixels: usize,
    ) -> Option<Error> {
        let side = SIDES.into_iter().find(|side| *side >= pixels).unwrap_or(SIDES[SIDES.len() - 1]);
        if !cells.is_empty() && side != self.side {
            self.reduced.clear();
            (self.side, self.job) = (side, None);
        }
        let error = self.take();
        if self.reduced.len() > cells.len() + MOST_BESIDE {
            self.reduced.retain(|cell, _| cells.contains(cell));
        }
        let missing: Vec<Cell> =
            cells.iter().filter(|cell| !self.reduced.contains_key(cell)).copied().collect();
        let is_missing = !missing.is_empty();
        *self.wanted.lock().unwrap_or_else(PoisonError::into_inner) = missing;
        if self.job.is_none() && is_missing && error.is_none() {
            let (open, wanted) = (open.clone(), self.wanted.clone());
            self.job = Some(Job::stream(waker, Progress::default(), move |worker| {
                run(&open, &wanted, side, worker)
            }));
        }
        error
    }

    fn take(&mut self) -> Option<Error> {
        let job = self.job.as_ref()?;
        let ended = job.poll();
        for (cell, reduced) in job.updates() {
            self.reduced.insert(cell, reduced);
            self.generation += 1;
        }
        let error = ended?.err();
        self.job = None;
        error.filter(|error| !error.is_cancelled())
    }
}

/// Reads what is wanted, until nothing is.
fn run(
    open: &OpenDataset,
    wanted: &Mutex<Vec<Cell>>,
    side: usize,
    worker: &Worker<ReadCell>,
) -> Result<(), Error> {
    let mut done: Vec<Cell> = Vec::new();
    loop {
        let next = {
            let wanted = wanted.lock().unwrap_or_else(PoisonError::into_inner);
            wanted.iter().find(|cell| !done.contains(cell)).copied()
        };
        let Some(cell) = next else { return Ok(()) };
        let reduced = read(open, cell, side, &worker.progress);
        done.push(cell);
        worker.report((cell, reduced))?;
    }
}

fn read(open: &OpenDataset, cell: Cell, side: usize, progress: &Progress) -> Reduced {
    let source = open.source(cell.case, cell.column)?;
    let read: Read<f32> = source.read(&progress.part()).map_err(|error| error.to_string())?;
    let size = read.material.size();
    let longest = size[0].max(size[1]);
    let small = size.map(|length| if longest > side { (length * side / longest).max(1) } else { length });
    read.material.resized(small).map(Arc::new).map_err(|error| error.to_string())
}
