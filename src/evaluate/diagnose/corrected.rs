//! Pairs with changes applied.

use rayon::prelude::*;

use super::alignment::Interior;
use super::samples::{Pair, SampledPair};
use svbrdf_core::error::Error;
use svbrdf_core::material::Material;
use svbrdf_files::changes::{Change, Placement, Reading, interpolated};

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
        let material = moved(pair, samples, &changes)?;
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
                Change::Shift(by) => corrected.interior = Some(Interior::new(size, Placement::moved(by))),
                Change::Placement(placement) => corrected.interior = Some(Interior::new(size, placement)),
                _ => {}
            }
            corrected.material = change.of_values(&corrected.material, pair.storages[1])?;
            corrected.changes.push(change);
        }
        Ok(corrected)
    }
}

/// The prediction, or the samples of it, with their texels where `changes` move them.
fn moved(pair: &Pair<'_>, samples: Option<&SampledPair>, changes: &[Change]) -> Result<Material<f32>, Error> {
    let size = pair.prediction.size();
    let placement = changes.iter().find_map(|change| match change {
        Change::Placement(placement) => Some(*placement),
        _ => None,
    });
    let moves = changes.iter().any(|change| matches!(change, Change::Symmetry(_) | Change::Shift(_)));
    if !moves && placement.is_none() {
        return Ok(samples.map_or(pair.prediction, |samples| &samples.prediction).clone());
    }
    let before = |texel: usize| changes.iter().rev().fold(texel, |texel, one| one.before(texel, size));
    let of = |samples: &SampledPair| (samples.samples.texels.clone(), [samples.samples.texels.len(), 1]);
    let (texels, shape) = samples.map_or_else(|| ((0..size[0] * size[1]).collect::<Vec<_>>(), size), of);
    let Some(placement) = placement else {
        let before: Vec<_> = texels.par_iter().map(|&texel| before(texel)).collect();
        return Ok(pair.prediction.gathered(&before, shape));
    };
    let taps = |&texel: &usize| placement.taps(texel, size).map(|(tap, weight)| (before(tap), weight));
    interpolated(pair.prediction, &texels.par_iter().map(taps).collect::<Vec<_>>(), shape)
}

/// Diffuse is scaled by specular as that is decoded.
fn order(change: &Change) -> usize {
    match change {
        Change::Reading(Reading::Unscaled | Reading::Scaled) => 1,
        Change::Reading(_) | Change::GroundTruth(_) => 0,
        Change::DiffuseFactor(_) | Change::SpecularFactor(_) => 2,
        Change::Symmetry(_) => 3,
        Change::Shift(_) | Change::Placement(_) => 4,
        Change::Exposure(_) => 5,
    }
}
