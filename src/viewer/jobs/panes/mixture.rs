//! Mixture: the chosen prediction with one map alone wrong, or one map alone right, in its place in the panes.

use std::sync::Arc;

use svbrdf_core::error::Error;
use svbrdf_core::material::Map;

use crate::viewer::jobs::reading::upload::{Uploaded, Uploads};
use crate::viewer::jobs::work::context::JobContext;
use crate::viewer::jobs::work::job::Job;
use crate::viewer::jobs::work::latest::Latest;
use crate::viewer::model::material::loaded::LoadedMaterial;
use crate::viewer::model::material::read::MaterialId;
use crate::viewer::model::material::read::ReadMaterial;
use crate::viewer::model::view::state::ViewState;

/// What a mixture depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MixtureKey {
    /// Of the ground truth and of the prediction.
    ids: [MaterialId; 2],
    map: Map,
    only_right: bool,
}

/// The mixture in the panes, and the making of another one.
#[derive(Debug, Default)]
pub struct MixtureJob {
    job: Latest<MixtureKey, Made>,
    displayed: Option<(MixtureKey, LoadedMaterial)>,
}

/// A mixture, and its maps on the adapter.
type Made = (Arc<ReadMaterial>, Option<Arc<Uploaded>>);

impl MixtureJob {
    /// Takes over a mixture, and makes the one that is wanted now.
    pub fn follow(&mut self, work: &JobContext<'_>, uploads: &mut Uploads) -> Option<Error> {
        let wanted = key(work.materials, work.view);
        let error = self.job.follow(wanted, |key| {
            let [ground_truth, prediction] =
                [0, work.view.display.prediction + 1].map(|index| work.materials[index].read.clone());
            let (key, gpu) = (*key, work.gpu.cloned());
            Job::start(work.waker, move |_| {
                let mixture = Arc::new(mixture(&ground_truth, &prediction, key)?);
                let uploaded = gpu.map(|gpu| Arc::new(Uploaded::all(&gpu, &mixture.material)));
                Ok((mixture, uploaded))
            })
        });
        let Some((key, (read, uploaded))) = self.job.get() else {
            self.displayed = None;
            return error;
        };
        if self.displayed.as_ref().is_none_or(|(of, _)| of != key) {
            let Some(prediction) = work.materials.iter().find(|one| one.id() == key.ids[1]) else {
                return error;
            };
            let side = if key.only_right { "right" } else { "wrong" };
            let name = format!("{}, only its {} {side}", prediction.name(), key.map.name());
            let mixture = LoadedMaterial::named(read.clone(), prediction.problem.clone(), name);
            self.displayed = Some((*key, mixture));
        }
        // Also of a mixture that was not in the panes for a while.
        uploads.add(read.id, uploaded.clone());
        error
    }

    /// `materials`, with the mixture in the place of the prediction that it is made of. While another mixture of the same
    /// materials is made, the one before it stays.
    pub fn displayed(&self, materials: &[LoadedMaterial], view: &ViewState) -> Vec<LoadedMaterial> {
        let mut displayed = materials.to_vec();
        if let (Some(wanted), Some((of, mixture))) = (key(materials, view), &self.displayed)
            && of.ids == wanted.ids
        {
            displayed[view.display.prediction + 1] = mixture.clone();
        }
        displayed
    }
}

/// The mixture that is wanted.
fn key(materials: &[LoadedMaterial], state: &ViewState) -> Option<MixtureKey> {
    let [ground_truth, prediction] = [materials.first()?, materials.get(state.display.prediction + 1)?];
    let ids = [ground_truth.id(), prediction.id()];
    state.display.isolated.map(|map| MixtureKey { ids, map, only_right: state.display.only_right })
}

fn mixture(
    ground_truth: &ReadMaterial,
    prediction: &ReadMaterial,
    key: MixtureKey,
) -> Result<ReadMaterial, Error> {
    let [base, other] = match key.only_right {
        true => [prediction, ground_truth],
        false => [ground_truth, prediction],
    };
    let material = base.material.with_maps_of(&other.material, |map| map == key.map)?;
    Ok(prediction.with_material(material.renamed(prediction.material.name())))
}
