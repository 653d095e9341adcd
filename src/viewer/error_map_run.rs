//! The error maps: the log difference of each texel, averaged over the scenes of the loss, on a worker.

use std::sync::Arc;

use super::latest::Latest;
use super::loaded::Loaded;
use super::slot::Slot;
use super::state::ViewState;
use super::work_context::WorkContext;
use super::worker::Task;
use crate::error::Error;
use crate::gpu::{Gpu, Shaded};
use crate::image::{Image, mean_of_channels};
use crate::loss::{Comparison, Request};
use crate::material::Material;
use crate::model::convention::Convention;
use crate::picture::statistics::Distributions;
use crate::progress::Progress;
use crate::why::error_maps;

/// What error maps depend on.
#[derive(Clone, Debug, PartialEq)]
struct ErrorMapKey {
    /// Of the materials, the ground truth first.
    ids: Vec<u64>,
    scenes: Request,
    convention: &'static str,
}

/// The error maps of all predictions.
#[derive(Debug)]
pub(super) struct ErrorMaps {
    /// Of each prediction.
    pub images: Vec<Image<f32>>,
    /// Where there is an adapter.
    shaded: Vec<Arc<Shaded>>,
    pub distributions: Distributions,
}

/// What the legend says of error maps besides their statistics.
#[derive(Clone, Copy, Debug)]
pub(super) struct ErrorMapSummary {
    /// Number of scenes.
    pub scenes: usize,
    /// The share of the texels that is done, while they are rendered.
    pub progress: Option<f32>,
}

/// The error maps of what the panes show.
#[derive(Debug, Default)]
pub(super) struct ErrorMapRun(Latest<ErrorMapKey, Arc<ErrorMaps>>);

impl ErrorMapRun {
    /// Takes over a result, and computes what is wanted now; where none is `shown`, the latest is kept.
    pub(super) fn follow(&mut self, work: &WorkContext<'_>, shown: bool, scenes: Request) -> Option<Error> {
        if !shown || work.slots.len() < 2 {
            self.0.rest();
            return None;
        }
        let wanted = key(work.slots, work.state, scenes);
        self.0.drop_other(&wanted);
        let convention = work.state.convention();
        self.0.follow(work.ctx, Some(wanted), |key| {
            let (scenes, materials, gpu) = (key.scenes.clone(), work.materials(), work.gpu.cloned());
            Task::start(work.ctx, move |progress| {
                maps(&materials, &scenes, &convention, gpu.as_ref(), progress).map(Arc::new)
            })
        })
    }

    /// The error maps of the current materials and scenes, once they are there.
    pub(super) fn get(&self, slots: &[Slot], state: &ViewState, scenes: Request) -> Option<&Arc<ErrorMaps>> {
        let (of, maps) = self.0.get()?;
        (*of == key(slots, state, scenes)).then_some(maps)
    }

    /// The share of the texels that is done, while they are rendered.
    pub(super) fn progress(&self) -> Option<f32> {
        self.0.running().map(Task::fraction)
    }
}

impl ErrorMaps {
    /// The map of slot `slot` on the adapter.
    pub(super) fn shaded(&self, slot: usize) -> Option<&Arc<Shaded>> {
        self.shaded.get(slot.checked_sub(1)?)
    }

    /// The value of the map of slot `slot` at the texel (column, row): the mean over RGB.
    pub(super) fn at(&self, slot: usize, [column, row]: [usize; 2]) -> f64 {
        let image = slot.checked_sub(1).and_then(|index| self.images.get(index));
        image.map_or(f64::NAN, |image| f64::from(mean_of_channels(&image.pixels[row * image.width + column])))
    }
}

fn key(slots: &[Slot], state: &ViewState, scenes: Request) -> ErrorMapKey {
    let ids = slots.iter().map(|slot| slot.id).collect();
    ErrorMapKey { ids, scenes, convention: state.convention().name }
}

fn maps(
    materials: &[Arc<Loaded>],
    scenes: &Request,
    convention: &Convention,
    gpu: Option<&Gpu>,
    progress: &Progress,
) -> Result<ErrorMaps, Error> {
    let materials: Vec<&Material<f32>> = materials.iter().map(|loaded| &loaded.material).collect();
    let comparison = Comparison::new(materials[0], &materials[1..], *convention)?;
    let scenes = scenes.scenes(convention)?.unwrap_or_default();
    let images = error_maps(&comparison, &scenes, progress)?;
    let means = |image: &Image<f32>| image.pixels.iter().map(mean_of_channels).collect();
    let values: Vec<Vec<f32>> = images.iter().map(means).collect();
    let distributions = Distributions::of(&values, false);
    let upload = |gpu: &Gpu| {
        let one = |image| Shaded::of_image(gpu, image).map(Arc::new);
        images.iter().map(one).collect::<Result<Vec<_>, Error>>()
    };
    let shaded = gpu.map(upload).transpose()?.unwrap_or_default();
    Ok(ErrorMaps { images, shaded, distributions })
}
