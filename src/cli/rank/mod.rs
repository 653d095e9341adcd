//! `svbrdf rank`: many predictions of one ground truth, or many materials.

mod args;
mod many;
mod one;

use svbrdf::error::Error;

pub use args::RankArgs;

/// Prints the ranking to stdout.
///
/// # Errors
/// Where a material cannot be read or used, other than in a data set; where a loss is above `--fail-above`, after all are printed.
pub fn run(args: RankArgs) -> Result<(), Error> {
    if args.dataset || args.pairs || args.merge { many::run(&args) } else { one::run(args) }
}
