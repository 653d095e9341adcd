//! The floor of a ground truth: the loss that rounding leaves.

use svbrdf_core::loss::Estimate;
use svbrdf_evaluate::diagnose::floor;

use super::ComparisonJob;
use super::materials::Opened;
use crate::cli::output::{CommandError, watched};

/// The loss that the ground truth cannot resolve.
pub fn floor_of(job: &ComparisonJob, opened: &Opened<f32>, seed: u64) -> Result<Estimate, CommandError> {
    let (truth, stored) = (&opened.ground_truth, &opened.storages[0]);
    Ok(watched("dithering", |progress| floor(truth, stored, &job.convention, seed, progress))?)
}
