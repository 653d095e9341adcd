//! `svbrdf rank`: many predictions of one ground truth, or many materials.

mod args;
pub mod cases;
mod many;
mod one;

pub use args::{RankArgs, RankFormat};
pub use many::written;

use super::args::Specified;
use super::job::NewJob;

impl RankArgs {
    pub fn job(self, given: &Specified) -> NewJob {
        if self.dataset || self.pairs { many::job(self, given) } else { one::job(self, given) }
    }
}
