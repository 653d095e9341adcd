//! Pairs with changes applied.

use super::pair::Pair;
use super::shift::interior;
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
    pub(super) texels: Option<Vec<usize>>,
    /// The changes of both, which are all but exposures.
    pub(super) changes: Vec<Change>,
    /// Factors on its radiance, in stops; `None`: 1.
    pub(super) stops: Option<[f64; 3]>,
}

impl Corrected {
    /// Applies readings, then symmetries, then shifts; exposures apply to renderings.
    pub(super) fn new(pair: &Pair<'_>, changes: &[Change]) -> Result<Self, Error> {
        let material = pair.prediction.clone();
        let mut corrected =
            Self { material, ground_truth: None, texels: None, changes: Vec::new(), stops: None };
        let mut changes = changes.to_vec();
        changes.sort_by_key(order);
        for change in changes {
            match change {
                Change::Exposure(stops) => {
                    corrected.stops = Some(stops);
                    continue;
                }
                Change::GroundTruth(reading) => {
                    corrected.ground_truth = Some(reading.applied(pair.ground_truth, pair.storages[0])?);
                }
                Change::Shift(by) => {
                    corrected.texels = Some(interior(pair.prediction.size(), by.map(|by| -by)));
                }
                Change::Symmetry(_) | Change::Reading(_) => {}
            }
            corrected.material = change.applied(&corrected.material, pair.storages[1])?;
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
