//! Pairs with changes applied.

use rayon::prelude::*;

use super::pair::{Pair, SampledPair};
use super::samples::Samples;
use super::shift::Interior;
use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_files::changes::Change;
use svbrdf_files::changes::Reading;

/// A prediction with changes applied, and its ground truth where that is changed.
#[derive(Clone, Debug)]
pub(super) struct Corrected {
    pub(super) material: Material<f32>,
    /// `None`: the ground truth as it was read.
    pub(super) ground_truth: Option<Material<f32>>,
    /// The texels that did not leave the map; `None`: all.
    pub(super) interior: Option<Interior>,
    /// The changes of both, which are all but exposures.
    pub(super) changes: Vec<Change>,
    /// Factors on its radiance, in stops; `None`: 1.
    pub(super) stops: Option<[f64; 3]>,
}

impl Corrected {
    /// Applies readings, then symmetries, then shifts, to all texels of `pair` or to `samples` of it; exposures apply to renderings.
    pub(super) fn new(
        pair: &Pair<'_>,
        samples: Option<&SampledPair>,
        changes: &[Change],
    ) -> Result<Self, Error> {
        let size = pair.prediction.size();
        let mut changes = changes.to_vec();
        changes.sort_by_key(order);
        let moves = changes.iter().any(|change| matches!(change, Change::Symmetry(_) | Change::Shift(_)));
        let before = |texel: usize| changes.iter().rev().fold(texel, |texel, one| one.before(texel, size));
        let material = match samples {
            _ if !moves => samples.map_or(pair.prediction, |samples| &samples.prediction).clone(),
            Some(SampledPair { samples: Samples { texels, .. }, .. }) => {
                let before: Vec<_> = texels.par_iter().map(|&texel| before(texel)).collect();
                pair.prediction.gathered(&before, [texels.len(), 1])
            }
            None => {
                let before: Vec<_> = (0..size[0] * size[1]).into_par_iter().map(before).collect();
                pair.prediction.gathered(&before, size)
            }
        };
        let mut corrected =
            Self { material, ground_truth: None, interior: None, changes: Vec::new(), stops: None };
        for change in changes {
            match change {
                Change::Exposure(stops) => {
                    corrected.stops = Some(stops);
                    continue;
                }
                Change::GroundTruth(reading) => {
                    let truth = samples.map_or(pair.ground_truth, |samples| &samples.ground_truth);
                    corrected.ground_truth = Some(reading.applied(truth, pair.storages[0])?);
                }
                Change::Shift(by) => corrected.interior = Some(Interior::new(size, by.map(|by| -by))),
                Change::Symmetry(_) | Change::Reading(_) => {}
            }
            corrected.material = change.of_values(&corrected.material, pair.storages[1])?;
            corrected.changes.push(change);
        }
        Ok(corrected)
    }
}

/// Diffuse is scaled by specular as that is decoded.
fn order(change: &Change) -> usize {
    match change {
        Change::Reading(Reading::Unscaled | Reading::Scaled) => 1,
        Change::Reading(_) | Change::GroundTruth(_) => 0,
        Change::Symmetry(_) => 2,
        Change::Shift(_) => 3,
        Change::Exposure(_) => 4,
    }
}
