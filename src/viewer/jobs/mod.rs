//! Jobs of the window: all background work, by one mechanism.
//!
//! A result belongs to a key: the ids of the materials (a reading of a version of their files), the question, the convention. The
//! latest question wins. Workers wake the window; nothing here knows the window library.

pub mod browse;
pub mod dataset;
pub mod displayed;
pub mod follow;
pub mod loss;
pub mod panes;
pub mod photograph;
pub mod reading;
pub mod report;
pub mod saving;
pub mod why;
pub mod work;

use std::path::PathBuf;

use svbrdf_core::loss::FileScenes;
use svbrdf_files::scene_file;
use svbrdf_gpu::Gpu;

use crate::error::Error;
use crate::model::Model;
use crate::model::material::request::{ReadRequest, Target};

use browse::Browsed;
use dataset::DatasetJobs;
use loss::LossJob;
use loss::scene::SceneLossJob;
use panes::PaneJobs;
use photograph::PhotographJobs;
use reading::opening::Openings;
use reading::read::MaterialReader;
use reading::upload::Uploads;
use reading::watch::FileWatch;
use why::WhyJobs;
use work::job::Job;
use work::order::{OrderJob, OrderKey};
use work::waker::Waker;

/// All background work of the window.
#[derive(Debug, Default)]
pub struct Jobs {
    pub waker: Waker,
    /// `None` where there is no adapter.
    pub gpu: Option<Gpu>,
    pub uploads: Uploads,
    pub openings: Openings,
    pub watch: FileWatch,
    pub loss: LossJob,
    pub scene_loss: SceneLossJob,
    pub order: OrderJob<OrderKey>,
    pub why: WhyJobs,
    pub panes: PaneJobs,
    pub photograph: PhotographJobs,
    pub dataset: DatasetJobs,
    pub browsing: Option<Job<Browsed>>,
    pub saving: Option<Job<PathBuf>>,
    /// The scene file that is being read.
    pub scene_file: Option<Job<FileScenes>>,
}

impl Jobs {
    pub fn new(waker: Waker, gpu: Option<Gpu>) -> Self {
        Self { waker, gpu, ..Self::default() }
    }

    /// Starts to read materials; the number of the opening.
    pub fn read(&mut self, model: &Model, request: ReadRequest) -> u64 {
        // A file that is opened by hand and cannot be read is reported at once.
        let retries = model.settings.watch && matches!(request.target, Target::Again(_));
        let size = model.materials.size_for(&request.target);
        let reader = MaterialReader { rules: model.materials.rules, size, retries };
        self.openings.start(&self.waker, self.gpu.as_ref(), request, reader)
    }

    /// Reads the scenes of a file.
    pub fn read_scenes(&mut self, paths: Vec<PathBuf>) {
        self.scene_file = Some(Job::start(&self.waker, move |_| {
            let read = scene_file::read_one(&paths)?;
            read.ok_or_else(|| Error::internal("there is no scene file"))
        }));
    }
}
