//! Statistics of the difference in the panes, computed on a worker.

use std::sync::Arc;

use super::latest::Latest;
use super::loaded::Loaded;
use super::slot::Slot;
use super::state::ViewState;
use super::work_context::WorkContext;
use super::worker::Task;
use crate::error::Error;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::picture::difference::Difference;
use crate::picture::quantity::Quantity;
use crate::picture::statistics::Distributions;
use crate::progress::Progress;

/// What the statistics depend on.
#[derive(Clone, Debug, PartialEq)]
struct DifferenceKey {
    /// Of the materials, the ground truth first.
    ids: Vec<u64>,
    quantity: Quantity,
    kind: Difference,
    /// Of a rendering.
    scene: Option<Scene>,
    convention: &'static str,
}

/// The statistics of the difference in the panes, and the computation of new ones.
#[derive(Debug, Default)]
pub(super) struct DifferenceRun(Latest<DifferenceKey, Distributions>);

impl DifferenceRun {
    /// The distributions for the current materials and difference, perhaps of an earlier scene; one for each prediction.
    pub(super) fn distributions(&self, slots: &[Slot], state: &ViewState) -> Option<&Distributions> {
        let (latest, distributions) = self.0.get()?;
        let now = key(slots, state);
        let same = (&latest.ids, latest.quantity, latest.kind) == (&now.ids, now.quantity, now.kind);
        same.then_some(distributions)
    }

    /// Whether the distributions are up to date.
    pub(super) fn is_current(&self, slots: &[Slot], state: &ViewState) -> bool {
        self.0.get().is_some_and(|(latest, _)| *latest == key(slots, state))
    }

    /// Takes over a result, and computes what is needed now, where a difference is `shown`.
    pub(super) fn follow(&mut self, work: &WorkContext<'_>, shown: bool) -> Option<Error> {
        let wanted = (shown && work.slots.len() > 1).then(|| key(work.slots, work.state));
        self.0.follow(work.ctx, wanted, |_| start(work))
    }
}

fn key(slots: &[Slot], state: &ViewState) -> DifferenceKey {
    DifferenceKey {
        ids: slots.iter().map(|slot| slot.id).collect(),
        quantity: state.quantity,
        kind: state.difference_kind(),
        scene: (state.quantity == Quantity::Rendering).then_some(state.scene),
        convention: state.convention().name,
    }
}

fn start(work: &WorkContext<'_>) -> Task<Distributions> {
    let (materials, state) = (work.materials(), work.state);
    let (quantity, kind) = (state.quantity, state.difference_kind());
    let (scene, convention) = (state.scene, state.convention());
    Task::start(work.ctx, move |progress| {
        distributions(&materials, quantity, kind, &scene, &convention, progress)
    })
}

fn distributions(
    materials: &[Arc<Loaded>],
    quantity: Quantity,
    kind: Difference,
    scene: &Scene,
    convention: &Convention,
    progress: &Progress,
) -> Result<Distributions, Error> {
    let image = |loaded: &Arc<Loaded>| quantity.image(&loaded.material, scene, convention, progress);
    let ground_truth = image(&materials[0])?;
    let values = materials[1..]
        .iter()
        .map(|prediction| Ok(kind.of_images(&ground_truth, &image(prediction)?, convention.epsilon)))
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(Distributions::of(&values, kind.is_signed()))
}
