//! Work on other threads: questions with their answers, the watch over files, and work that ends in an edit of the model.
//!
//! Workers wake the window; nothing here knows the window library.

pub mod answers;
pub mod reading;
pub mod watch;
pub mod work;

use std::collections::HashMap;

use svbrdf_gpu::Gpu;

use crate::model::Model;
use crate::model::material::opening::{Arrival, Opening};

use answers::content::Given;
use answers::{Answer, Answers};
use reading::ReadMaterials;
use watch::FileWatch;
use work::{Job, Waker};

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
    pub watch: FileWatch,
    /// Work that ends in an edit of the model, one of a kind at a time.
    pub edits: HashMap<&'static str, Job<Edit>>,
}

impl Jobs {
    pub fn new(waker: Waker, gpu: Option<Gpu>) -> Self {
        Self { answers: Answers::new(waker.clone()), waker, gpu, ..Self::default() }
    }

    /// Asks for the materials of an opening: those that have arrived since the last time, and whether it goes on.
    pub fn read(&self, opening: &Opening) -> (Vec<Arrival>, bool) {
        let question = ReadMaterials { opening: opening.clone(), gpu: Given(self.gpu.clone()) };
        let (all, goes_on) = match self.answers.get(&question) {
            Answer::Ready(all) => (Some(all), false),
            Answer::Partial(all, ..) => (Some(all), true),
            Answer::Running(..) => (None, true),
            Answer::Stopped(_) | Answer::Failed(_) => (None, false),
        };
        (all.iter().flat_map(|all| all.iter().skip(opening.arrived)).cloned().collect(), goes_on)
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
