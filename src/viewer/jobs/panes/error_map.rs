//! Error maps: the log difference of each texel, averaged over the scenes of the loss.

use std::sync::Arc;

use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::why::error_maps;
use svbrdf_gpu::Gpu;

use super::computed_maps::ComputedMaps;
use crate::error::Error;
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::model::material::loaded::{LoadedMaterial, ids};
use crate::model::material::read::{MaterialId, ReadMaterial};
use crate::model::view::ViewState;

/// What error maps depend on.
#[derive(Clone, Debug, PartialEq)]
struct ErrorMapKey {
    /// Of the materials, the ground truth first.
    ids: Vec<MaterialId>,
    scenes: Request,
    convention: Convention,
}

/// What the legend reports of error maps besides their statistics.
#[derive(Clone, Copy, Debug)]
pub struct ErrorMapSummary {
    /// Number of scenes.
    pub scenes: usize,
    /// The share of the texels that is done, while they are rendered.
    pub progress: Option<f32>,
}

/// The error maps of what the panes show.
#[derive(Debug, Default)]
pub struct ErrorMapJob(Latest<ErrorMapKey, Arc<ComputedMaps>>);

impl ErrorMapJob {
    /// Takes over a result, and computes what is wanted now; where none is `is_visible`, the latest is kept.
    pub fn follow(&mut self, work: &JobContext<'_>, is_visible: bool, scenes: Request) -> Option<Error> {
        if !is_visible || work.materials.len() < 2 {
            self.0.pause();
            return None;
        }
        let wanted = key(work.materials, work.view, scenes);
        let convention = work.view.convention();
        self.0.follow_only(wanted, |key| {
            let (scenes, materials, gpu) = (key.scenes.clone(), work.materials(), work.gpu.cloned());
            Job::start(work.waker, move |progress| {
                maps(&materials, &scenes, &convention, gpu.as_ref(), progress).map(Arc::new)
            })
        })
    }

    /// The error maps of the current materials and scenes, once they are there.
    pub fn get(
        &self,
        materials: &[LoadedMaterial],
        state: &ViewState,
        scenes: Request,
    ) -> Option<&Arc<ComputedMaps>> {
        let (of, maps) = self.0.get()?;
        (*of == key(materials, state, scenes)).then_some(maps)
    }

    /// The share of the texels that is done, while they are rendered.
    pub fn progress(&self) -> Option<f32> {
        self.0.running().map(Job::fraction)
    }
}

fn key(materials: &[LoadedMaterial], state: &ViewState, scenes: Request) -> ErrorMapKey {
    let ids = ids(materials);
    ErrorMapKey { ids, scenes, convention: state.convention() }
}

fn maps(
    materials: &[Arc<ReadMaterial>],
    scenes: &Request,
    convention: &Convention,
    gpu: Option<&Gpu>,
    progress: &Progress,
) -> Result<ComputedMaps, Error> {
    let materials: Vec<&Material<f32>> = materials.iter().map(|loaded| loaded.material()).collect();
    let comparison = Comparison::new(materials[0], &materials[1..], *convention)?;
    let scenes = scenes.scenes(convention)?.unwrap_or_default();
    let images = error_maps(&comparison, &scenes, progress)?;
    Ok(ComputedMaps::new(images, gpu)?)
}
