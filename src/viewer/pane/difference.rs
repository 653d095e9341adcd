//! Questions about the difference in the panes: its statistics, and the difference itself where no shader computes it, as FLIP and the
//! error map.

use std::sync::Arc;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::{Image, mean_of_channels};
use svbrdf_core::loss::{Comparison, Request};
use svbrdf_core::material::{Mask, Material};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Distributions;
use svbrdf_evaluate::why::error_maps;
use svbrdf_gpu::{Gpu, Shaded};

use crate::error::Error;
use crate::jobs::Shown;
use crate::jobs::answers::content::{Content, Given, mask_of, read_all};
use crate::jobs::answers::{Answered, Pace, Question, Work};
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::ReadMaterial;

/// What is computed of a difference: of each prediction.
#[derive(Debug)]
pub struct ComputedDifference {
    pub distributions: Distributions,
    /// Where no shader computes it: the difference, the mean of which over RGB counts.
    pub images: Vec<Image<f32>>,
    /// The same on the adapter, where there is one.
    shaded: Vec<Arc<Shaded>>,
}

impl ComputedDifference {
    /// # Errors
    /// [`CoreError::Gpu`].
    fn of_images(
        mut images: Vec<Image<f32>>,
        mask: Option<&Mask>,
        gpu: Option<&Gpu>,
    ) -> Result<Self, CoreError> {
        let means = |image: &Image<f32>| kept(image.pixels.iter().map(mean_of_channels), mask);
        let values: Vec<Vec<f32>> = images.iter().map(means).collect();
        let distributions = Distributions::of(&values, false);
        // Gray in a pane.
        for image in &mut images {
            let texels = image.pixels.iter_mut().zip(mask.map_or(&[][..], Mask::kept));
            texels.filter(|(_, kept)| !**kept).for_each(|(texel, _)| *texel = [f32::NAN; 3]);
        }
        Ok(Self { distributions, shaded: uploaded(&images, gpu)?, images })
    }

    /// The difference of the material at this index on the adapter.
    pub fn shaded(&self, index: usize) -> Option<&Arc<Shaded>> {
        self.shaded.get(index.checked_sub(1)?)
    }

    /// The difference of the material at this index at the texel (column, row).
    pub fn at(&self, index: usize, [column, row]: [usize; 2]) -> f64 {
        let image = index.checked_sub(1).and_then(|index| self.images.get(index));
        image.map_or(f64::NAN, |image| f64::from(mean_of_channels(&image.pixels[row * image.width + column])))
    }
}

/// The values of the texels that are compared.
fn kept(values: impl Iterator<Item = f32>, mask: Option<&Mask>) -> Vec<f32> {
    match mask {
        Some(mask) => values.zip(mask.kept()).filter(|(_, kept)| **kept).map(|(value, _)| value).collect(),
        None => values.collect(),
    }
}

/// Images on the adapter, where there is one.
///
/// # Errors
/// [`CoreError::Gpu`].
fn uploaded(images: &[Image<f32>], gpu: Option<&Gpu>) -> Result<Vec<Arc<Shaded>>, CoreError> {
    let Some(gpu) = gpu else { return Ok(Vec::new()) };
    images.iter().map(|image| Shaded::of_image(gpu, image).map(Arc::new)).collect()
}

/// The difference of the predictions among `materials` that the panes display, and whether it is of the present scene and exposure.
pub fn displayed(
    shown: Shown<'_>,
    materials: &[LoadedMaterial],
) -> Option<(Arc<Answered<ComputedDifference>>, bool)> {
    let (answers, view) = (&shown.jobs.answers, &shown.model.view);
    if !view.display.difference || materials.len() < 2 {
        return None;
    }
    match view.is_error_map() {
        true => Some((answers.get(&ErrorMaps::of(shown, materials)).ready()?, true)),
        false => answers.drawn(&ComputeDifferences::of(shown, materials)),
    }
}

/// The difference of each prediction from the ground truth, the first of the materials.
#[derive(Clone, Debug, PartialEq)]
struct ComputeDifferences {
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

impl ComputeDifferences {
    fn of(shown: Shown<'_>, materials: &[LoadedMaterial]) -> Self {
        let view = &shown.model.view;
        let (quantity, kind) = (view.display.quantity, view.difference_kind());
        Self {
            materials: Content::all(materials),
            quantity,
            kind,
            scene: (quantity == Quantity::Rendering).then_some(view.scene),
            exposure_ev: (kind == Difference::Flip).then_some(view.exposure_ev),
            convention: view.convention(),
            given: Given((view.scene, view.exposure_ev, shown.jobs.gpu.clone())),
        }
    }
}

impl Question for ComputeDifferences {
    type Answer = ComputedDifference;
    const PACE: Pace = Pace::AtOnce;
    const KEPT: usize = 1;

    fn is_like(&self, earlier: &Self) -> bool {
        (&self.materials, self.quantity, self.kind) == (&earlier.materials, earlier.quantity, earlier.kind)
    }

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
            return Ok(ComputedDifference::of_images(maps, mask_of(&materials)?, gpu.as_ref())?);
        }
        let mask = mask_of(&materials)?;
        let values = |prediction: Result<_, CoreError>| {
            Ok(kept(kind.of_images(&ground_truth, &prediction?, params).into_iter(), mask))
        };
        let values = predictions.map(values).collect::<Result<Vec<_>, CoreError>>()?;
        let distributions = Distributions::of(&values, kind.is_signed());
        Ok(ComputedDifference { distributions, images: Vec::new(), shaded: Vec::new() })
    }
}

/// The error map of each prediction: the log difference of each texel, averaged over the scenes of the loss. The ground truth is the first
/// of the materials.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMaps {
    materials: Vec<Content>,
    scenes: Request,
    convention: Convention,
    gpu: Given<Option<Gpu>>,
}

impl ErrorMaps {
    pub fn of(shown: Shown<'_>, materials: &[LoadedMaterial]) -> Self {
        Self {
            materials: Content::all(materials),
            scenes: shown.model.settings.loss.listed_scenes(),
            convention: shown.model.view.convention(),
            gpu: Given(shown.jobs.gpu.clone()),
        }
    }
}

impl Question for ErrorMaps {
    type Answer = ComputedDifference;
    const KEPT: usize = 1;

    fn answer(&self, work: &Work<'_, Self::Answer>) -> Result<ComputedDifference, Error> {
        let read = read_all(&self.materials)?;
        let materials: Vec<&Material<f32>> = read.iter().map(|loaded| loaded.material()).collect();
        let comparison = Comparison::new(materials[0], &materials[1..], self.convention)?;
        let scenes = self.scenes.scenes(&self.convention)?.unwrap_or_default();
        let images = error_maps(&comparison, &scenes, work.progress())?;
        Ok(ComputedDifference::of_images(images, mask_of(&read)?, self.gpu.0.as_ref())?)
    }
}
