//! `svbrdf rank`: many predictions of one ground truth, or many materials.

mod args;
mod cases;
mod html;
mod many;
mod one;

use super::args::Given;
use super::output::CommandError;
pub use args::RankArgs;

/// Prints the ranking to stdout.
///
/// # Errors
/// Where a material cannot be read or used, other than in a data set; where a loss is above `--fail-above`, after all are printed.
pub fn run(args: RankArgs, given: &Given) -> Result<(), CommandError> {
    if args.dataset || args.pairs { many::run(&args, given) } else { one::run(args, given) }
}
