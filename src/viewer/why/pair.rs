//! The ground truth and the chosen prediction: what the questions of the tab are about.

use std::sync::Arc;

use crate::error::Error;
use crate::loss::Comparison;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::viewer::loaded::Loaded;
use crate::viewer::slot::Slot;
use crate::viewer::state::ViewState;

/// What identifies a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PairKey {
    /// Of the ground truth and of the prediction.
    ids: [u64; 2],
    convention: &'static str,
}

/// A ground truth and a prediction, for a worker.
#[derive(Clone, Debug)]
pub(crate) struct ComparedPair {
    pub key: PairKey,
    materials: [Arc<Loaded>; 2],
    pub convention: Convention,
}

impl ComparedPair {
    /// The pair of the chosen prediction, if there is one.
    pub(crate) fn of(slots: &[Slot], state: &ViewState) -> Option<Self> {
        let slots = [slots.first()?, slots.get(state.prediction + 1)?];
        let convention = state.convention();
        let key = PairKey { ids: slots.map(|slot| slot.id), convention: convention.name };
        Some(Self { key, materials: slots.map(|slot| slot.loaded.clone()), convention })
    }

    pub(crate) fn ground_truth(&self) -> &Material<f32> {
        &self.materials[0].material
    }

    pub(crate) fn prediction(&self) -> &Material<f32> {
        &self.materials[1].material
    }

    /// The comparison of the two, without a pilot.
    ///
    /// # Errors
    /// [`Error::SizesDiffer`].
    pub(crate) fn comparison(&self) -> Result<Comparison<'_, f32>, Error> {
        Ok(Comparison::new(self.ground_truth(), &[self.prediction()], self.convention)?.without_pilot())
    }
}
