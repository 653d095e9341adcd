//! Questions whether the order of predictions survives, or that of the methods of a data set.

use std::sync::Arc;

use svbrdf_core::loss::{Comparison, LossSettings};
use svbrdf_core::model::convention::Convention;
use svbrdf_evaluate::dataset::{self, DatasetSettings};
use svbrdf_evaluate::report::Compared;
use svbrdf_evaluate::robust::{RobustReport, answers};

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
    /// Error of the losses, in percent, and seed of their scenes.
    pub target_percent: f64,
    pub seed: u64,
}

impl PredictionOrder {
    /// Of the materials in the window, the ground truth first.
    pub fn of(materials: &[LoadedMaterial], view: &ViewState, loss: &LossSettings) -> Self {
        let named = |one: &LoadedMaterial| (Content::of(one), one.name().to_owned());
        let (convention, target_percent) = (view.convention(), loss.target_percent);
        Self { materials: materials.iter().map(named).collect(), convention, target_percent, seed: loss.seed }
    }
}

impl Question for PredictionOrder {
    type Answer = RobustReport;
    const HAS_MESSAGE: bool = false;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<RobustReport, Error> {
        let read: Vec<_> = self.materials.iter().map(|(one, _)| one.read()).collect::<Result<_, _>>()?;
        let names: Vec<String> = self.materials.iter().map(|(_, name)| name.clone()).collect();
        let [ground_truth, predictions @ ..] = read.as_slice() else {
            return Err(Error::internal("there is no ground truth"));
        };
        let predictions: Vec<_> = predictions.iter().map(|one| one.material()).collect();
        let found = Comparison::new(ground_truth.material(), &predictions, self.convention)
            .map_err(svbrdf_evaluate::Error::from)
            .and_then(|one| answers(&one, (self.target_percent / 100.0, self.seed), work.progress()));
        let compared = Compared::new(ground_truth.material(), &self.convention);
        let compared = Compared { ground_truth: names[0].clone(), ..compared };
        Ok(RobustReport::of_answers(compared, Vec::new(), &names[1..], &found?))
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
