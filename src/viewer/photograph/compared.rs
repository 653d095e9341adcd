//! Every material against a photograph, each at its own exposure.

use std::sync::Arc;

use super::keys::RectifiedKey;
use crate::error::Error;
use crate::gpu::{Gpu, Shaded};
use crate::image::Image;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::photograph::{PhotographComparison, Rectified};
use crate::picture::difference::Difference;
use crate::picture::quantity::Quantity;
use crate::picture::statistics::Distributions;
use crate::progress::Progress;
use crate::viewer::loaded::Loaded;
use crate::viewer::slot::Slot;
use crate::viewer::state::ViewState;

/// What the comparisons depend on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ComparedKey {
    pub rectified: RectifiedKey,
    falloff: bool,
    /// Of all materials.
    ids: Vec<u64>,
    scene: Scene,
    convention: &'static str,
    pub kind: Difference,
}

impl ComparedKey {
    /// Whether it is of these materials.
    pub(super) fn is_of(&self, slots: &[Slot]) -> bool {
        self.ids.iter().copied().eq(slots.iter().map(|slot| slot.id))
    }
}

/// The photograph beside every material.
#[derive(Debug)]
pub(crate) struct Photographs {
    /// Of each slot.
    pub comparisons: Vec<PhotographComparison>,
    /// The photograph at the exposure of each slot, where there is an adapter.
    shaded: Vec<Arc<Shaded>>,
    /// Of the chosen difference of each slot.
    pub distributions: Distributions,
}

impl Photographs {
    /// The comparison of slot `slot`.
    pub(crate) fn get(&self, slot: usize) -> Option<&PhotographComparison> {
        self.comparisons.get(slot)
    }

    /// The photograph at the exposure of slot `slot` on the adapter.
    pub(crate) fn shaded(&self, slot: usize) -> Option<&Arc<Shaded>> {
        self.shaded.get(slot)
    }

    /// The photograph at the exposure of slot `slot` at the texel (column, row); NaN where it is clipped.
    pub(crate) fn at(&self, slot: usize, [column, row]: [usize; 2]) -> [f32; 3] {
        let image = self.get(slot).map(|compared| &compared.photograph);
        image.map_or([f32::NAN; 3], |image: &Image<f32>| image.pixels[row * image.width + column])
    }
}

pub(super) fn key(rectified: RectifiedKey, falloff: bool, slots: &[Slot], state: &ViewState) -> ComparedKey {
    ComparedKey {
        rectified,
        falloff,
        ids: slots.iter().map(|slot| slot.id).collect(),
        scene: state.scene,
        convention: state.convention().name,
        kind: state.differences.kind(Quantity::Rendering),
    }
}

pub(super) fn compare(
    key: &ComparedKey,
    rectified: &Rectified,
    materials: &[Arc<Loaded>],
    convention: &Convention,
    gpu: Option<&Gpu>,
    progress: &Progress,
) -> Result<Photographs, Error> {
    let corrected = key.falloff.then(|| rectified.clone().without_falloff(&key.scene));
    let rectified = corrected.as_ref().unwrap_or(rectified);
    let one = |loaded: &Arc<Loaded>| rectified.compare(&loaded.material, &key.scene, convention, progress);
    let comparisons = materials.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let values: Vec<_> = comparisons.iter().map(|compared| compared.differences(key.kind)).collect();
    let distributions = Distributions::of(&values, key.kind.is_signed());
    let upload = |gpu: &Gpu| {
        let one = |compared: &PhotographComparison| Shaded::of_image(gpu, &compared.photograph).map(Arc::new);
        comparisons.iter().map(one).collect::<Result<Vec<_>, _>>()
    };
    let shaded = gpu.map(upload).transpose()?.unwrap_or_default();
    Ok(Photographs { comparisons, shaded, distributions })
}
