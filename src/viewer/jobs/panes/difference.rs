//! Statistics of the difference in the panes.

use std::sync::Arc;

use svbrdf_core::error::Error;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_core::progress::Progress;

use crate::viewer::jobs::work::context::JobContext;
use crate::viewer::jobs::work::job::Job;
use crate::viewer::jobs::work::latest::Latest;
use crate::viewer::model::material::loaded::LoadedMaterial;
use crate::viewer::model::material::read::MaterialId;
use crate::viewer::model::material::read::ReadMaterial;
use crate::viewer::model::view::state::ViewState;

/// What the statistics depend on.
#[derive(Clone, Debug, PartialEq)]
struct DifferenceKey {
    /// Of the materials, the ground truth first.
    ids: Vec<MaterialId>,
    quantity: Quantity,
    kind: Difference,
    /// Of a rendering.
    scene: Option<Scene>,
    convention: &'static str,
}

/// The statistics of the difference in the panes, and the computation of new ones.
#[derive(Debug, Default)]
pub struct DifferenceJob(Latest<DifferenceKey, Distributions>);

impl DifferenceJob {
    /// The distributions for the current materials and difference, perhaps of an earlier scene; one for each prediction.
    pub fn distributions(&self, materials: &[LoadedMaterial], state: &ViewState) -> Option<&Distributions> {
        let (latest, distributions) = self.0.get()?;
        let now = key(materials, state);
        let same = (&latest.ids, latest.quantity, latest.kind) == (&now.ids, now.quantity, now.kind);
        same.then_some(distributions)
    }

    /// Whether the distributions are up to date.
    pub fn is_current(&self, materials: &[LoadedMaterial], state: &ViewState) -> bool {
        self.0.get().is_some_and(|(latest, _)| *latest == key(materials, state))
    }

    /// Takes over a result, and computes what is needed now, where a difference is `is_visible`.
    pub fn follow(&mut self, work: &JobContext<'_>, is_visible: bool) -> Option<Error> {
        let wanted = (is_visible && work.materials.len() > 1).then(|| key(work.materials, work.view));
        self.0.follow(wanted, |_| start(work))
    }
}

fn key(materials: &[LoadedMaterial], state: &ViewState) -> DifferenceKey {
    DifferenceKey {
        ids: materials.iter().map(LoadedMaterial::id).collect(),
        quantity: state.display.quantity,
        kind: state.difference_kind(),
        scene: (state.display.quantity == Quantity::Rendering).then_some(state.scene),
        convention: state.convention().name,
    }
}

fn start(work: &JobContext<'_>) -> Job<Distributions> {
    let (materials, state) = (work.materials(), work.view);
    let (quantity, kind) = (state.display.quantity, state.difference_kind());
    let (scene, convention) = (state.scene, state.convention());
    Job::start(work.waker, move |progress| {
        distributions(&materials, quantity, kind, &scene, &convention, progress)
    })
}

fn distributions(
    materials: &[Arc<ReadMaterial>],
    quantity: Quantity,
    kind: Difference,
    scene: &Scene,
    convention: &Convention,
    progress: &Progress,
) -> Result<Distributions, Error> {
    let image = |loaded: &Arc<ReadMaterial>| quantity.image(&loaded.material, scene, convention, progress);
    let ground_truth = image(&materials[0])?;
    let values = materials[1..]
        .iter()
        .map(|prediction| Ok(kind.of_images(&ground_truth, &image(prediction)?, convention.epsilon)))
        .collect::<Result<Vec<_>, Error>>()?;
    Ok(Distributions::of(&values, kind.is_signed()))
}
