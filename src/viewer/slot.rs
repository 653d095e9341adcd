//! A place among the materials in the window.

use std::sync::Arc;

use super::loaded::Loaded;
use super::message::SizeMismatch;
use crate::report::distinct_names;

/// A material in the window. Its id is never used again: it is the key of everything derived from the material.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    pub id: u64,
    pub loaded: Arc<Loaded>,
    /// Why it is not what its files hold now: they are gone, or could not be read again.
    pub problem: Option<String>,
    /// Its name, unique among the slots.
    name: String,
}

impl Slot {
    pub(super) fn new(id: u64, loaded: Arc<Loaded>) -> Self {
        let name = loaded.material.name().to_owned();
        Self { id, loaded, problem: None, name }
    }

    /// A material made of others, with this name.
    pub(super) fn named(id: u64, loaded: Arc<Loaded>, problem: Option<String>, name: String) -> Self {
        Self { id, loaded, problem, name }
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }
}

/// Where materials go once they have been read.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Target {
    /// The first replaces the ground truth, the others the predictions.
    Everything,
    /// All are added as predictions.
    Predictions,
    /// The one replaces the slot of this id, which stays where it is.
    Again(u64),
}

/// Gives every slot a unique name.
pub(super) fn rename(slots: &mut [Slot]) {
    let named: Vec<_> = slots.iter().map(|s| (s.loaded.material.name(), s.loaded.path())).collect();
    let names = distinct_names(&named);
    slots.iter_mut().zip(names).for_each(|(slot, name)| slot.name = name);
}

/// The two sizes, where `prediction` has another size than the ground truth.
pub(super) fn mismatch(ground_truth: &Slot, prediction: &Loaded) -> Option<SizeMismatch> {
    let [gt, material] = [&ground_truth.loaded.material, &prediction.material];
    (gt.size() != material.size()).then(|| SizeMismatch {
        prediction: material.name().to_owned(),
        prediction_size: material.size(),
        ground_truth: gt.name().to_owned(),
        ground_truth_size: gt.size(),
        source: prediction.source(),
    })
}
