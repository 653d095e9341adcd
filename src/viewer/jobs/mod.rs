//! Jobs of the window: all background work, by one mechanism.
//!
//! An answer belongs to its question, which names materials by a reading of a version of their files. Workers wake the window; nothing
//! here knows the window library.

pub mod answers;
pub mod browse;
pub mod dataset;
pub mod displayed;
pub mod follow;
pub mod loss;
pub mod order;
pub mod panes;
pub mod reading;
pub mod saving;
pub mod why;
pub mod work;

use std::collections::HashMap;
use std::fmt;
use std::path::PathBuf;

use svbrdf_gpu::Gpu;

use crate::model::Model;
use crate::model::material::request::{ReadRequest, Target};

use answers::Answers;
use dataset::DatasetJobs;
use loss::DrawnLosses;
use panes::Panes;
use reading::opening::Openings;
use reading::read::MaterialReader;
use reading::upload::Uploads;
use reading::watch::FileWatch;
use work::job::Job;
use work::waker::Waker;

/// An edit of the model.
pub struct Edit(pub Box<dyn FnOnce(&mut Model) + Send>);

impl Edit {
    pub fn new(edit: impl FnOnce(&mut Model) + Send + 'static) -> Self {
        Self(Box::new(edit))
    }
}

impl fmt::Debug for Edit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Edit")
    }
}

/// All background work of the window.
#[derive(Debug, Default)]
pub struct Jobs {
    pub waker: Waker,
    pub answers: Answers,
    /// `None` where there is no adapter.
    pub gpu: Option<Gpu>,
    pub uploads: Uploads,
    pub openings: Openings,
    pub watch: FileWatch,
    pub loss: DrawnLosses,
    pub panes: Panes,
    pub dataset: DatasetJobs,
    /// Work that ends in an edit of the model, one of a kind at a time.
    pub edits: HashMap<&'static str, Job<Edit>>,
    pub saving: Option<Job<PathBuf>>,
}

impl Jobs {
    pub fn new(waker: Waker, gpu: Option<Gpu>) -> Self {
        Self { answers: Answers::new(waker.clone()), waker, gpu, ..Self::default() }
    }

    /// Starts to read materials; the number of the opening.
    pub fn read(&mut self, model: &Model, request: ReadRequest) -> u64 {
        // A file that is opened by hand and cannot be read is reported at once.
        let retries = model.settings.watch && matches!(request.target, Target::Again(_));
        let size = model.materials.size_for(&request.target);
        let reader = MaterialReader { rules: model.materials.rules, size, retries };
        self.openings.start(&self.waker, self.gpu.as_ref(), request, reader)
    }
}
