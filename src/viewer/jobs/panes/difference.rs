//! Statistics of the difference in the panes, and the difference itself where it is of neighbourhoods of texels.

use std::sync::Arc;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;

use super::computed_maps::ComputedMaps;
use crate::error::Error;
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::model::material::loaded::{LoadedMaterial, ids};
use crate::model::material::read::{MaterialId, ReadMaterial};
use crate::model::view::ViewState;

/// What the statistics depend on.
#[derive(Clone, Debug, PartialEq)]
struct DifferenceKey {
    /// Of the materials, the ground truth first.
    ids: Vec<MaterialId>,
    quantity: Quantity,
    kind: Difference,
    /// Of a rendering.
    scene: Option<Scene>,
    /// Where the difference depends on it.
    exposure_ev: Option<f32>,
    convention: Convention,
}

/// What is computed of a difference.
#[derive(Debug)]
enum ComputedDifference {
    /// Shaders compute the difference itself.
    Texels(Distributions),
    Maps(Arc<ComputedMaps>),
}

impl ComputedDifference {
    fn distributions(&self) -> &Distributions {
        match self {
            Self::Texels(distributions) => distributions,
            Self::Maps(maps) => &maps.distributions,
        }
    }
}

/// The statistics of the difference in the panes, and the computation of new ones.
#[derive(Debug, Default)]
pub struct DifferenceJob(Latest<DifferenceKey, ComputedDifference>);

impl DifferenceJob {
    /// The distributions for the current materials and difference, perhaps of an earlier scene; one for each prediction.
    pub fn distributions(&self, materials: &[LoadedMaterial], state: &ViewState) -> Option<&Distributions> {
        self.latest(materials, state).map(ComputedDifference::distributions)
    }

    /// The difference of each prediction, perhaps of an earlier scene or exposure; `None` where shaders compute it.
    pub fn maps(&self, materials: &[LoadedMaterial], state: &ViewState) -> Option<&Arc<ComputedMaps>> {
        match self.latest(materials, state)? {
            ComputedDifference::Maps(maps) => Some(maps),
            ComputedDifference::Texels(_) => None,
        }
    }

    fn latest(&self, materials: &[LoadedMaterial], state: &ViewState) -> Option<&ComputedDifference> {
        let (latest, compared) = self.0.get()?;
        let now = key(materials, state);
        let same = (&latest.ids, latest.quantity, latest.kind) == (&now.ids, now.quantity, now.kind);
        same.then_some(compared)
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
    let kind = state.difference_kind();
    DifferenceKey {
        ids: ids(materials),
        quantity: state.display.quantity,
        kind,
        scene: (state.display.quantity == Quantity::Rendering).then_some(state.scene),
        exposure_ev: (kind == Difference::Flip).then_some(state.exposure_ev),
        convention: state.convention(),
    }
}

fn start(work: &JobContext<'_>) -> Job<ComputedDifference> {
    let (materials, gpu, state) = (work.materials(), work.gpu.cloned(), work.view);
    let (quantity, kind) = (state.display.quantity, state.difference_kind());
    let (scene, convention) = (state.scene, state.convention());
    let params = DifferenceParams { epsilon: convention.epsilon, exposure_ev: state.exposure_ev };
    Job::start(work.waker, move |progress| {
        let image =
            |loaded: &Arc<ReadMaterial>| quantity.image(loaded.material(), &scene, &convention, progress);
        let ground_truth = image(&materials[0])?;
        let predictions = materials[1..].iter().map(image);
        if kind == Difference::Flip {
            let map =
                |prediction: Result<_, CoreError>| Ok(kind.picture(&ground_truth, &prediction?, params));
            let maps = predictions.map(map).collect::<Result<Vec<_>, CoreError>>()?;
            return Ok(ComputedDifference::Maps(Arc::new(ComputedMaps::new(maps, gpu.as_ref())?)));
        }
        let values =
            |prediction: Result<_, CoreError>| Ok(kind.of_images(&ground_truth, &prediction?, params));
        let values = predictions.map(values).collect::<Result<Vec<_>, CoreError>>()?;
        Ok(ComputedDifference::Texels(Distributions::of(&values, kind.is_signed())))
    })
}
