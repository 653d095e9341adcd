//! `svbrdf rank`: many predictions of one ground truth, or many materials.

mod args;
pub mod cases;
mod many;
mod one;
mod robust;

pub use args::RankArgs;
use args::RankFormat;

use super::args::Given;
use super::job::NewJob;

impl RankArgs {
    pub fn job(self, given: &Given) -> NewJob {
        match (self.dataset || self.pairs, self.robust) {
            (true, true) if self.output.format() != RankFormat::Html => robust::job(&self, given),
            (true, _) => many::job(self, given),
            (false, _) => one::job(self, given),
        }
    }
}
