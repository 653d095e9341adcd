//! The floor of a ground truth: that of rounding, or that of repeated captures.

use std::path::PathBuf;

use svbrdf_core::loss::Estimate;
use svbrdf_evaluate::diagnose::{floor, floor_of_captures};

use super::ComparisonJob;
use super::materials::Opened;
use crate::cli::output::{CommandError, watched};

/// The loss that the ground truth cannot resolve, and the number of captures that it is the mean loss between; `None`: it is that of
/// rounding.
pub fn floor_of(
    repeats: &[PathBuf],
    job: &ComparisonJob,
    opened: &Opened<f32>,
    seed: u64,
) -> Result<(Estimate, Option<usize>), CommandError> {
    let (truth, convention) = (&opened.ground_truth, &job.convention);
    if repeats.is_empty() {
        let stored = &opened.storages[0];
        let floor = watched("dithering", |progress| floor(truth, stored, convention, seed, progress))?;
        return Ok((floor, None));
    }
    let repeats = job.materials.repeats(repeats, truth)?;
    let floor = watched("comparing captures", |progress| {
        floor_of_captures(truth, &repeats, convention, seed, progress)
    })?;
    Ok((floor, Some(1 + repeats.len())))
}
