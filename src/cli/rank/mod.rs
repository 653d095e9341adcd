//! `svbrdf rank`: many predictions of one ground truth, or many materials.

mod args;
pub mod cases;
mod many;
mod one;

pub use args::{RankArgs, RankFormat};
pub use many::written;

use super::args::Specified;
use super::job::NewJob;
use super::output::CommandError;

impl RankArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        if let Some(word) = self.word_of_metrics() {
            let problem = format!("there is no {word}; words of metrics are given as --metrics={word}");
            return Err(CommandError::usage(problem));
        }
        if self.dataset || self.pairs { many::job(self, given) } else { one::job(self, given) }
    }
}
