//! Comparison of every material with a photograph, each at its own exposure.

use std::sync::Arc;

use svbrdf_core::image::Image;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_core::progress::Progress;
use svbrdf_evaluate::photograph::{PhotographComparison, Rectified};
use svbrdf_gpu::{Gpu, Shaded};

use crate::error::Error;
use crate::jobs::photograph::keys::RectifiedKey;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::material::read::ReadMaterial;
use crate::model::view::state::ViewState;

/// What the comparisons depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedKey {
    pub rectified: RectifiedKey,
    falloff: bool,
    /// Of all materials.
    ids: Vec<MaterialId>,
    scene: Scene,
    convention: Convention,
    pub kind: Difference,
}

impl ComparedKey {
    /// Whether it is of these materials.
    pub fn is_of(&self, materials: &[LoadedMaterial]) -> bool {
        self.ids.iter().copied().eq(materials.iter().map(LoadedMaterial::id))
    }
}

/// The photograph beside every material.
#[derive(Debug)]
pub struct Photographs {
    /// Of each material.
    pub comparisons: Vec<PhotographComparison>,
    /// The photograph at the exposure of each material, where there is an adapter.
    shaded: Vec<Arc<Shaded>>,
    /// Of the chosen difference of each material.
    pub distributions: Distributions,
}

impl Photographs {
    /// The comparison of the material at this index.
    pub fn get(&self, index: usize) -> Option<&PhotographComparison> {
        self.comparisons.get(index)
    }

    /// The photograph at the exposure of the material at this index on the adapter.
    pub fn shaded(&self, index: usize) -> Option<&Arc<Shaded>> {
        self.shaded.get(index)
    }

    /// The photograph at the exposure of the material at this index at the texel (column, row); NaN where it is clipped.
    pub fn at(&self, index: usize, [column, row]: [usize; 2]) -> [f32; 3] {
        let image = self.get(index).map(|compared| &compared.photograph);
        image.map_or([f32::NAN; 3], |image: &Image<f32>| image.pixels[row * image.width + column])
    }
}

pub fn key(
    rectified: RectifiedKey,
    falloff: bool,
    materials: &[LoadedMaterial],
    state: &ViewState,
) -> ComparedKey {
    ComparedKey {
        rectified,
        falloff,
        ids: materials.iter().map(LoadedMaterial::id).collect(),
        scene: state.scene,
        convention: state.convention(),
        kind: state.display.differences.kind(Quantity::Rendering),
    }
}

pub fn compare(
    key: &ComparedKey,
    rectified: &Rectified,
    materials: &[Arc<ReadMaterial>],
    convention: &Convention,
    gpu: Option<&Gpu>,
    progress: &Progress,
) -> Result<Photographs, Error> {
    let corrected = key.falloff.then(|| rectified.clone().without_falloff(&key.scene));
    let rectified = corrected.as_ref().unwrap_or(rectified);
    let one =
        |loaded: &Arc<ReadMaterial>| rectified.compare(loaded.material(), &key.scene, convention, progress);
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
