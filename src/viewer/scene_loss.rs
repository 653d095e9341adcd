//! The loss of the current scene alone, computed on a worker.

use super::latest::Latest;
use super::slots::{Slot, Slots};
use super::state::ViewState;
use super::work_context::WorkContext;
use super::worker::Task;
use crate::error::Error;
use crate::loss::{Comparison, Request};
use crate::material::Material;
use crate::model::scene::Scene;

/// What the losses depend on.
#[derive(Clone, Debug, PartialEq)]
struct SceneLossKey {
    ids: Vec<u64>,
    scene: Scene,
    convention: &'static str,
}

/// The loss of each prediction under the current light and view.
#[derive(Debug, Default)]
pub(super) struct SceneLossRun(Latest<SceneLossKey, Vec<f64>>);

impl SceneLossRun {
    /// Takes over a result, and computes what is needed now; nothing where it is not `shown`.
    pub(super) fn follow(&mut self, work: &WorkContext<'_>, shown: bool) -> Option<Error> {
        let wanted = (shown && work.slots.len() > 1).then(|| key(work.slots, work.state));
        let convention = work.state.convention();
        self.0.follow(work.ctx, wanted, |key| {
            let (materials, request) = (work.materials(), Request::Listed(vec![key.scene]));
            Task::start(work.ctx, move |progress| {
                let materials: Vec<&Material<f32>> = materials.iter().map(|l| &l.material).collect();
                let comparison = Comparison::new(materials[0], &materials[1..], convention)?;
                let outcome = comparison.run(&request, progress)?;
                Ok(outcome.losses.iter().map(|loss| loss.estimate.mean).collect())
            })
        })
    }

    /// The latest losses of these materials, and whether they are up to date.
    pub(super) fn get(&self, slots: &Slots, state: &ViewState) -> Option<(&[f64], bool)> {
        let (of, losses) = self.0.get()?;
        let now = key(&slots.slots, state);
        (of.ids == now.ids).then_some((losses.as_slice(), *of == now))
    }
}

fn key(slots: &[Slot], state: &ViewState) -> SceneLossKey {
    let ids = slots.iter().map(|slot| slot.id).collect();
    SceneLossKey { ids, scene: state.scene, convention: state.convention().name }
}
