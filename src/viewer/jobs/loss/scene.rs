//! Loss of the current scene alone.

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;

use crate::error::Error;
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::view::ViewState;

/// What the losses depend on.
#[derive(Clone, Debug, PartialEq)]
struct SceneLossKey {
    ids: Vec<MaterialId>,
    scene: Scene,
    convention: Convention,
}

/// The loss of each prediction under the current light and view.
#[derive(Debug, Default)]
pub struct SceneLossJob(Latest<SceneLossKey, Vec<f64>>);

impl SceneLossJob {
    /// Takes over a result, and computes what is needed now; nothing where it is not `is_visible`.
    pub fn follow(&mut self, work: &JobContext<'_>, is_visible: bool) -> Option<Error> {
        let wanted = (is_visible && work.materials.len() > 1).then(|| key(work.materials, work.view));
        let convention = work.view.convention();
        self.0.follow(wanted, |key| {
            let (materials, request) = (work.materials(), Request::Listed(vec![key.scene]));
            Job::start(work.waker, move |progress| {
                let materials: Vec<&Material<f32>> = materials.iter().map(|l| l.material()).collect();
                let comparison = Comparison::new(materials[0], &materials[1..], convention)?;
                let outcome = comparison.run(&request, progress)?;
                Ok(outcome.losses.iter().map(|loss| loss.estimate.mean).collect())
            })
        })
    }

    /// The latest losses of these materials, and whether they are up to date.
    pub fn get(&self, materials: &[LoadedMaterial], state: &ViewState) -> Option<(&[f64], bool)> {
        let (of, losses) = self.0.get()?;
        let now = key(materials, state);
        (of.ids == now.ids).then_some((losses.as_slice(), *of == now))
    }
}

fn key(materials: &[LoadedMaterial], state: &ViewState) -> SceneLossKey {
    let ids = materials.iter().map(LoadedMaterial::id).collect();
    SceneLossKey { ids, scene: state.scene, convention: state.convention() }
}
