//! The chosen prediction with one map alone wrong, or one map alone right, in its place in the panes.

use std::sync::Arc;

use eframe::egui;

use super::latest::Latest;
use super::loaded::Loaded;
use super::slots::{Slot, Slots};
use super::state::ViewState;
use super::worker::Task;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::material::Map;

/// What a mixture depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MixtureKey {
    /// Of the ground truth and of the prediction.
    ids: [u64; 2],
    map: Map,
    only_right: bool,
}

/// The mixture that is shown, and the making of another one.
#[derive(Debug, Default)]
pub(super) struct MixtureRun {
    run: Latest<MixtureKey, Arc<Loaded>>,
    shown: Option<(MixtureKey, Slot)>,
}

impl MixtureRun {
    /// Takes over a mixture, and makes the one that is wanted now.
    pub(super) fn follow(
        &mut self,
        ctx: &egui::Context,
        gpu: Option<&Gpu>,
        slots: &mut Slots,
        state: &ViewState,
    ) -> Option<Error> {
        let wanted = key(&slots.slots, state);
        let error = self.run.follow(ctx, wanted, |key| {
            let [ground_truth, prediction] =
                [0, state.prediction + 1].map(|index| slots.slots[index].loaded.clone());
            let (key, gpu) = (*key, gpu.cloned());
            Task::start(ctx, move |_| mixture(&ground_truth, &prediction, key, gpu.as_ref()).map(Arc::new))
        });
        match self.run.get() {
            None => self.shown = None,
            Some((key, _)) if self.shown.as_ref().is_some_and(|(of, _)| of == key) => {}
            Some((key, loaded)) => {
                let id = slots.new_id();
                let Some(prediction) = slots.slots.iter().find(|slot| slot.id == key.ids[1]) else {
                    return error;
                };
                let side = if key.only_right { "right" } else { "wrong" };
                let name = format!("{}, only its {} {side}", prediction.name(), key.map.name());
                let slot = Slot::named(id, loaded.clone(), prediction.problem.clone(), name);
                self.shown = Some((*key, slot));
            }
        }
        error
    }

    /// `slots`, with the mixture in the place of the prediction that it is made of. While another mixture of the same
    /// materials is made, the one before it stays.
    pub(super) fn seen(&self, slots: &[Slot], state: &ViewState) -> Vec<Slot> {
        let mut seen = slots.to_vec();
        if let (Some(wanted), Some((of, slot))) = (key(slots, state), &self.shown)
            && of.ids == wanted.ids
        {
            seen[state.prediction + 1] = slot.clone();
        }
        seen
    }
}

/// The mixture that is wanted.
fn key(slots: &[Slot], state: &ViewState) -> Option<MixtureKey> {
    let [ground_truth, prediction] = [slots.first()?, slots.get(state.prediction + 1)?];
    let ids = [ground_truth.id, prediction.id];
    state.isolated.map(|map| MixtureKey { ids, map, only_right: state.only_right })
}

fn mixture(
    ground_truth: &Loaded,
    prediction: &Loaded,
    key: MixtureKey,
    gpu: Option<&Gpu>,
) -> Result<Loaded, Error> {
    let [base, other] = match key.only_right {
        true => [prediction, ground_truth],
        false => [ground_truth, prediction],
    };
    let material = base.material.with_maps_of(&other.material, |map| map == key.map)?;
    Ok(prediction.with_material(material.renamed(prediction.material.name()), gpu))
}
