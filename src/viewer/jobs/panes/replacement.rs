//! Replacement of the chosen prediction in the panes: the prediction with one map alone wrong, or one map alone right, or with a change
//! that a diagnosis found.

use std::sync::Arc;

use svbrdf_core::material::{Map, Material};
use svbrdf_evaluate::diagnose::Change;

use crate::error::Error;
use crate::jobs::reading::upload::{Uploaded, Uploads};
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::material::read::ReadMaterial;
use crate::model::view::ViewState;

/// What is shown in the place of a prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Replacement {
    /// A mixture with the ground truth.
    Mixture { map: Map, only_right: bool },
    /// The prediction after a change.
    Corrected(Change),
}

/// What a replacement depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ReplacementKey {
    /// Of the ground truth and of the prediction.
    ids: [MaterialId; 2],
    replacement: Replacement,
}

/// The replacement in the panes, and the making of another one.
#[derive(Debug, Default)]
pub struct ReplacementJob {
    job: Latest<ReplacementKey, Made>,
    displayed: Option<(ReplacementKey, LoadedMaterial)>,
}

/// A replacement, and its maps on the adapter.
type Made = (Arc<ReadMaterial>, Option<Arc<Uploaded>>);

impl ReplacementJob {
    /// Takes over a replacement, and makes the one that is wanted now.
    pub fn follow(&mut self, work: &JobContext<'_>, uploads: &mut Uploads) -> Option<Error> {
        let wanted = key(work.materials, work.view);
        let error = self.job.follow(wanted, |key| {
            let pair = [0, work.view.display.prediction + 1].map(|index| work.materials[index].read.clone());
            let (replacement, gpu) = (key.replacement, work.gpu.cloned());
            Job::start(work.waker, move |_| {
                let read = Arc::new(replacement.made(&pair)?);
                let uploaded = gpu.map(|gpu| Arc::new(Uploaded::all(&gpu, read.material())));
                Ok((read, uploaded))
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
            let name = key.replacement.name(prediction.name());
            let material = LoadedMaterial::named(read.clone(), prediction.problem.clone(), name);
            self.displayed = Some((*key, material));
        }
        // Also of a replacement that was not in the panes for a while.
        uploads.add(read.id, uploaded.clone());
        error
    }

    /// `materials`, with the replacement in the place of the prediction that it is made of. While another one of the same
    /// materials is made, the one before it stays.
    pub fn displayed(&self, materials: &[LoadedMaterial], view: &ViewState) -> Vec<LoadedMaterial> {
        let mut displayed = materials.to_vec();
        if let (Some(wanted), Some((of, replacement))) = (key(materials, view), &self.displayed)
            && of.ids == wanted.ids
        {
            displayed[view.display.prediction + 1] = replacement.clone();
        }
        displayed
    }
}

/// The replacement that is wanted.
fn key(materials: &[LoadedMaterial], state: &ViewState) -> Option<ReplacementKey> {
    let [ground_truth, prediction] = [materials.first()?, materials.get(state.display.prediction + 1)?];
    let ids = [ground_truth.id(), prediction.id()];
    let only_right = state.display.only_right;
    let mixture = state.display.isolated.map(|map| Replacement::Mixture { map, only_right });
    let corrected = state.display.corrected.filter(|change| change.fits(prediction.material().size()));
    let replacement = mixture.or(corrected.map(Replacement::Corrected))?;
    Some(ReplacementKey { ids, replacement })
}

impl Replacement {
    /// The replacement made of a ground truth and a prediction.
    fn made(self, [ground_truth, prediction]: &[Arc<ReadMaterial>; 2]) -> Result<ReadMaterial, Error> {
        let (truth, predicted) = (ground_truth.material(), prediction.material());
        let mixed = |base: &Material<f32>, other, map| base.with_maps_of(other, |of| of == map);
        let material = match self {
            Self::Mixture { map, only_right: true } => mixed(predicted, truth, map)?,
            Self::Mixture { map, only_right: false } => mixed(truth, predicted, map)?,
            Self::Corrected(change) => change.applied(predicted, &prediction.storage)?,
        };
        Ok(prediction.with_material(material.renamed(predicted.name())))
    }

    /// The name of the replacement of the prediction `name`.
    fn name(self, name: &str) -> String {
        match self {
            Self::Mixture { map, only_right } => {
                let side = if only_right { "right" } else { "wrong" };
                format!("{name}, only its {} {side}", map.name())
            }
            Self::Corrected(change) => format!("{name}, {change}"),
        }
    }
}
