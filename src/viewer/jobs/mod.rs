//! Work on other threads: questions with their answers, materials that are read, and work that ends in an edit of the model.
//!
//! Workers wake the window; nothing here knows the window library.

pub mod answers;
pub mod reading;
pub mod work;

use std::collections::HashMap;

use svbrdf_gpu::Gpu;

use crate::model::Model;
use crate::model::material::request::{ReadRequest, Target};

use answers::Answers;
use reading::opening::Openings;
use reading::read::MaterialReader;
use reading::watch::FileWatch;
use work::job::Job;
use work::waker::Waker;

/// An edit of the model.
pub type Edit = Box<dyn FnOnce(&mut Model) + Send>;

/// The kind of edits that follow a file that is written.
pub const SAVING: &str = "saving";

/// All background work of the window.
#[derive(Debug, Default)]
pub struct Jobs {
    pub waker: Waker,
    pub answers: Answers,
    /// `None` where there is no adapter.
    pub gpu: Option<Gpu>,
    pub openings: Openings,
    pub watch: FileWatch,
    /// Work that ends in an edit of the model, one of a kind at a time.
    pub edits: HashMap<&'static str, Job<Edit>>,
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
        let reader = MaterialReader { rules: model.materials.rules, size, retries, gpu: self.gpu.clone() };
        self.openings.start(&self.waker, request, reader)
    }

    /// Takes over the edits whose work has ended.
    pub fn take_edits(&mut self, model: &mut Model) {
        self.edits.retain(|_, job| {
            match job.poll() {
                None => return true,
                Some(Ok(edit)) => edit(model),
                Some(Err(error)) => model.not_opened(error),
            }
            false
        });
    }
}

/// What a panel draws, and what it asks.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    pub model: &'a Model,
    pub jobs: &'a Jobs,
}
