//! Questions whether the order of predictions survives, or that of the methods of a data set.

use std::sync::Arc;

use svbrdf_core::loss::{Comparison, LossSettings, Request};
use svbrdf_core::model::convention::Convention;
use svbrdf_evaluate::dataset::{self, DatasetSettings};
use svbrdf_evaluate::robust::RobustReport;

use super::answers::content::Content;
use super::answers::{Question, Work};
use super::work::priority;
use crate::error::Error;
use crate::model::dataset::OpenDataset;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::view::ViewState;

/// Whether the order of the predictions survives. The ground truth is the first of the materials, each with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictionOrder {
    pub materials: Vec<(Content, String)>,
    pub convention: Convention,
    /// The losses.
    pub request: Request,
}

impl PredictionOrder {
    /// Of the materials in the window, the ground truth first.
    pub fn of(materials: &[LoadedMaterial], view: &ViewState, loss: &LossSettings) -> Self {
        let named = |one: &LoadedMaterial| (Content::of(one), one.name().to_owned());
        let request = Request::Accuracy { target: loss.target_percent / 100.0, seed: loss.seed };
        Self { materials: materials.iter().map(named).collect(), convention: view.convention(), request }
    }
}

impl Question for PredictionOrder {
    type Answer = RobustReport;
    const HAS_MESSAGE: bool = false;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<RobustReport, Error> {
        let named =
            |(one, name): &(Content, String)| Ok(one.read()?.material().clone().renamed(name.clone()));
        let materials = self.materials.iter().map(named).collect::<Result<Vec<_>, Error>>()?;
        let [ground_truth, predictions @ ..] = materials.as_slice() else {
            return Err(Error::internal("there is no ground truth"));
        };
        let predictions: Vec<_> = predictions.iter().collect();
        let comparison = Comparison::new(ground_truth, &predictions, self.convention)?;
        Ok(RobustReport::new(&comparison, &self.request, work.progress())?)
    }
}

/// Whether the order of the methods survives, as `svbrdf rank --dataset --robust` asks.
#[derive(Clone, Debug)]
pub struct MethodOrder {
    pub open: Arc<OpenDataset>,
    /// In the convention of the window.
    pub settings: DatasetSettings,
    /// How often a material was read again.
    pub read_again: u64,
}

impl PartialEq for MethodOrder {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.open, &other.open)
            && self.settings.convention == other.settings.convention
            && self.read_again == other.read_again
    }
}

impl Question for MethodOrder {
    type Answer = RobustReport;
    const HAS_MESSAGE: bool = false;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<RobustReport, Error> {
        // Threads of its own, as for the losses.
        let pool = priority::background_pool().map_err(|error| Error::internal(error.to_string()))?;
        let (cases, reading, progress) = (&self.open.cases, &self.open.reading, work.progress());
        pool.install(|| Ok(dataset::robust(cases, &self.settings, reading, |_| (), progress)?))
    }
}
