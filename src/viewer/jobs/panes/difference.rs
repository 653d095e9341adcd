//! Question about the difference in the panes: its statistics, and the difference itself where it is of neighbourhoods of texels.

use std::sync::Arc;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_gpu::Gpu;

use super::computed_maps::ComputedMaps;
use crate::error::Error;
use crate::jobs::answers::content::{Content, Given, read_all};
use crate::jobs::answers::{Question, Work};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::ReadMaterial;
use crate::model::view::ViewState;

/// The difference of each prediction from the ground truth, the first of the materials.
#[derive(Clone, Debug, PartialEq)]
pub struct Differences {
    materials: Vec<Content>,
    quantity: Quantity,
    kind: Difference,
    /// Of a rendering.
    scene: Option<Scene>,
    /// Where the difference depends on it.
    exposure_ev: Option<f32>,
    convention: Convention,
    /// What else a rendering or a difference is given, though it does not depend on it; and the adapter.
    given: Given<(Scene, f32, Option<Gpu>)>,
}

/// What is computed of a difference.
#[derive(Debug)]
pub enum ComputedDifference {
    /// Shaders compute the difference itself.
    Texels(Distributions),
    Maps(ComputedMaps),
}

impl ComputedDifference {
    pub fn distributions(&self) -> &Distributions {
        match self {
            Self::Texels(distributions) => distributions,
            Self::Maps(maps) => &maps.distributions,
        }
    }

    /// The difference of each prediction; `None` where shaders compute it.
    pub fn maps(&self) -> Option<&ComputedMaps> {
        match self {
            Self::Maps(maps) => Some(maps),
            Self::Texels(_) => None,
        }
    }
}

impl Differences {
    pub fn of(materials: &[LoadedMaterial], view: &ViewState, gpu: Option<&Gpu>) -> Self {
        let (quantity, kind) = (view.display.quantity, view.difference_kind());
        Self {
            materials: Content::all(materials),
            quantity,
            kind,
            scene: (quantity == Quantity::Rendering).then_some(view.scene),
            exposure_ev: (kind == Difference::Flip).then_some(view.exposure_ev),
            convention: view.convention(),
            given: Given((view.scene, view.exposure_ev, gpu.cloned())),
        }
    }

    /// Whether it is of the same materials and difference, perhaps under another scene or exposure.
    pub fn is_like(&self, other: &Self) -> bool {
        (&self.materials, self.quantity, self.kind) == (&other.materials, other.quantity, other.kind)
    }
}

impl Question for Differences {
    type Answer = ComputedDifference;
    const IS_SHORT: bool = true;
    const KEPT: usize = 1;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<ComputedDifference, Error> {
        let Self { quantity, kind, convention, given: Given((scene, exposure_ev, gpu)), .. } = self;
        let params = DifferenceParams { epsilon: convention.epsilon, exposure_ev: *exposure_ev };
        let materials = read_all(&self.materials)?;
        let image = |loaded: &Arc<ReadMaterial>| {
            quantity.image(loaded.material(), scene, convention, work.progress())
        };
        let ground_truth = image(&materials[0])?;
        let predictions = materials[1..].iter().map(image);
        if *kind == Difference::Flip {
            let map =
                |prediction: Result<_, CoreError>| Ok(kind.picture(&ground_truth, &prediction?, params));
            let maps = predictions.map(map).collect::<Result<Vec<_>, CoreError>>()?;
            return Ok(ComputedDifference::Maps(ComputedMaps::new(maps, gpu.as_ref())?));
        }
        let values =
            |prediction: Result<_, CoreError>| Ok(kind.of_images(&ground_truth, &prediction?, params));
        let values = predictions.map(values).collect::<Result<Vec<_>, CoreError>>()?;
        Ok(ComputedDifference::Texels(Distributions::of(&values, kind.is_signed())))
    }
}
