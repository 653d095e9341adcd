//! Predictions with changes applied.

use super::change::Change;
use super::shift::interior;
use super::storage::Storage;
use crate::error::Error;
use crate::material::Material;

/// A prediction with changes applied.
#[derive(Clone, Debug)]
pub(super) struct Corrected {
    pub(super) material: Material<f32>,
    /// The texels that did not leave the map; `None`: all.
    pub(super) texels: Option<Vec<usize>>,
    /// Factors on its radiance, in stops; `None`: 1.
    pub(super) stops: Option<[f64; 3]>,
}

impl Corrected {
    /// Applies readings, then symmetries, then shifts; exposures apply to renderings.
    pub(super) fn new(
        prediction: &Material<f32>,
        changes: &[Change],
        storage: &Storage,
    ) -> Result<Self, Error> {
        let mut corrected = Self { material: prediction.clone(), texels: None, stops: None };
        let mut changes = changes.to_vec();
        changes.sort_by_key(|change| match change {
            Change::Reading(_) => 0,
            Change::Symmetry(_) => 1,
            Change::Shift(_) => 2,
            Change::Exposure(_) => 3,
        });
        for change in changes {
            match change {
                Change::Exposure(stops) => corrected.stops = Some(stops),
                Change::Shift(by) => corrected.texels = Some(interior(prediction.size(), by.map(|by| -by))),
                Change::Symmetry(_) | Change::Reading(_) => {}
            }
            corrected.material = change.applied(&corrected.material, storage)?;
        }
        Ok(corrected)
    }
}
