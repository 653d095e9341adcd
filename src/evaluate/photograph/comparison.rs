//! The rendering of a material against a photograph.

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::Image;
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_core::render;

use super::exposure::Ratios;
use super::rectified::Rectified;
use crate::error::Error;

/// A rendering and the photograph at its exposure.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotographComparison {
    /// What the photograph was multiplied by.
    pub factor: f64,
    /// The photograph on the texels of the material, multiplied by the factor; NaN where it is clipped.
    pub photograph: Image<f32>,
    pub rendering: Image<f32>,
    epsilon: f64,
}

impl Rectified {
    /// Renders `material`, which has the size of the photograph's texels, and brings the photograph to its exposure.
    ///
    /// # Errors
    /// [`CoreError::SizesDiffer`], [`CoreError::UnusableScene`], [`Error::NoExposure`], [`Cancelled`](Error::is_cancelled).
    pub fn compare(
        &self,
        material: &Material<f32>,
        scene: &Scene,
        convention: &Convention,
        progress: &Progress,
    ) -> Result<PhotographComparison, Error> {
        let rendering = self.rendering(material, scene, convention, progress)?;
        let factor = self.ratios(&rendering, convention.epsilon).factor();
        let factor = factor.ok_or_else(|| no_exposure(material.name(), std::slice::from_ref(self)))?;
        Ok(self.at(factor, rendering, convention.epsilon))
    }

    /// Renders `material`, which has the size of the photograph's texels.
    ///
    /// # Errors
    /// [`CoreError::SizesDiffer`], [`CoreError::UnusableScene`], [`Cancelled`](Error::is_cancelled).
    pub(super) fn rendering(
        &self,
        material: &Material<f32>,
        scene: &Scene,
        convention: &Convention,
        progress: &Progress,
    ) -> Result<Image<f32>, CoreError> {
        let size = [self.image.width, self.image.height];
        if material.size() != size {
            return Err(CoreError::SizesDiffer {
                first: "the rectified photograph".to_owned(),
                first_size: size,
                second: material.name().to_owned(),
                second_size: material.size(),
                remedy: "rectify the photograph to the size of the material",
            });
        }
        render::render_f32(material, scene, convention, progress)
    }

    /// The ratios of `rendering` and the photograph.
    pub(super) fn ratios(&self, rendering: &Image<f32>, epsilon: f64) -> Ratios {
        Ratios::of(&self.image, rendering, epsilon)
    }

    /// The photograph, multiplied by `factor`, and `rendering`.
    pub(super) fn at(&self, factor: f64, rendering: Image<f32>, epsilon: f64) -> PhotographComparison {
        // A stored value below 0 is noise: there is no negative radiance.
        let expose = |value: f32| if value.is_nan() { value } else { (value * factor as f32).max(0.0) };
        let pixels = self.image.pixels.iter().map(|pixel| pixel.map(expose)).collect();
        let photograph = Image { width: self.image.width, height: self.image.height, pixels };
        PhotographComparison { factor, photograph, rendering, epsilon }
    }
}

/// The error of photographs that have no factor for the material `name`.
pub(super) fn no_exposure(name: &str, photographs: &[Rectified]) -> Error {
    let problem = match photographs.iter().all(|one| one.clipped() == one.image.pixels.len()) {
        true => "every texel is clipped",
        false => "no part of the material is lit both in a photograph and in its rendering",
    };
    Error::NoExposure { name: name.to_owned(), problem: problem.to_owned() }
}

impl PhotographComparison {
    /// The factor in stops: positive where the photograph is darker than the rendering.
    pub fn exposure_ev(&self) -> f64 {
        self.factor.log2()
    }

    /// Both are compared at the exposure of the rendering.
    fn params(&self) -> DifferenceParams {
        DifferenceParams { epsilon: self.epsilon, exposure_ev: 0.0 }
    }

    /// The difference of the rendering from the photograph, of each channel; NaN where the photograph is clipped.
    pub fn difference(&self, kind: Difference) -> Image<f32> {
        kind.picture(&self.photograph, &self.rendering, self.params())
    }

    /// The difference of each texel, the mean over RGB; NaN where the photograph is clipped.
    pub fn differences(&self, kind: Difference) -> Vec<f32> {
        kind.of_images(&self.photograph, &self.rendering, self.params())
    }

    /// The statistics of the difference over the texels that are not clipped; `None` where there is none.
    pub fn statistics(&self, kind: Difference) -> Option<Statistics> {
        Statistics::of(&self.differences(kind))
    }
}
