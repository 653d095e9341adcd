//! Predictions with changes applied.

use super::change::Change;
use super::shift::{interior, shifted};
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
        for change in changes {
            if let Change::Reading(reading) = change {
                corrected.material = reading.applied(&corrected.material, storage)?;
            }
        }
        for change in changes {
            if let Change::Symmetry(symmetry) = change {
                corrected.material = symmetry.applied(&corrected.material)?;
            }
        }
        for change in changes {
            match *change {
                Change::Shift([right, down]) => {
                    corrected.material = shifted(&corrected.material, [-right, -down])?;
                    corrected.texels = Some(interior(prediction.size(), [-right, -down]));
                }
                Change::Exposure(stops) => corrected.stops = Some(stops),
                Change::Symmetry(_) | Change::Reading(_) => {}
            }
        }
        Ok(corrected)
    }
}
