//! Pairs of the ground truth and a prediction, which the questions of the tab *Why* are about.

use std::sync::Arc;

use svbrdf_core::loss::Comparison;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_evaluate::Error;
use svbrdf_evaluate::diagnose::Storage;

use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::material::read::ReadMaterial;
use crate::model::view::ViewState;

/// Identity of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairKey {
    /// Of the ground truth and of the prediction.
    ids: [MaterialId; 2],
    convention: Convention,
}

/// Identity of a ground truth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundTruthKey {
    id: MaterialId,
    convention: Convention,
}

/// A ground truth and a prediction, for a worker.
#[derive(Clone, Debug)]
pub struct ComparedPair {
    pub key: PairKey,
    materials: [Arc<ReadMaterial>; 2],
    pub convention: Convention,
}

impl ComparedPair {
    /// The pair of the chosen prediction, if there is one.
    pub fn of(materials: &[LoadedMaterial], view: &ViewState) -> Option<Self> {
        Self::new(materials, view.display.prediction, view.convention())
    }

    /// The pairs of all predictions.
    pub fn all(materials: &[LoadedMaterial], view: &ViewState) -> Vec<Self> {
        let convention = view.convention();
        (0..materials.len()).map_while(|prediction| Self::new(materials, prediction, convention)).collect()
    }

    fn new(materials: &[LoadedMaterial], prediction: usize, convention: Convention) -> Option<Self> {
        let pair = [materials.first()?, materials.get(prediction + 1)?];
        let key = PairKey { ids: pair.map(LoadedMaterial::id), convention };
        Some(Self { key, materials: pair.map(|one| one.read.clone()), convention })
    }

    pub fn ground_truth(&self) -> &Material<f32> {
        self.materials[0].material()
    }

    pub fn prediction(&self) -> &Material<f32> {
        self.materials[1].material()
    }

    pub fn ground_truth_key(&self) -> GroundTruthKey {
        GroundTruthKey { id: self.key.ids[0], convention: self.key.convention }
    }

    pub fn ground_truth_storage(&self) -> &Storage {
        &self.materials[0].storage
    }

    pub fn prediction_storage(&self) -> &Storage {
        &self.materials[1].storage
    }

    /// The comparison of the two, without a pilot.
    ///
    /// # Errors
    /// [`SizesDiffer`](svbrdf_core::error::Error::SizesDiffer).
    pub fn comparison(&self) -> Result<Comparison<'_, f32>, Error> {
        comparison(std::slice::from_ref(self))
    }
}

/// The comparison of the predictions of pairs with one ground truth, without a pilot.
///
/// # Errors
/// [`Error::NoPrediction`], [`SizesDiffer`](svbrdf_core::error::Error::SizesDiffer).
pub fn comparison(pairs: &[ComparedPair]) -> Result<Comparison<'_, f32>, Error> {
    let first = pairs.first().ok_or(Error::NoPrediction)?;
    let predictions: Vec<_> = pairs.iter().map(ComparedPair::prediction).collect();
    Ok(Comparison::new(first.ground_truth(), &predictions, first.convention)?.without_pilot())
}
