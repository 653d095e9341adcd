//! Renderings against photographs: a rectified photograph on the texels of a material, at the exposure of its renderings.
//!
//! One factor brings photographs to the unit of Algorithm 3. Nothing else is calibrated. [`PhotoReport`] compares materials with all
//! photographs of a [`Capture`](svbrdf_files::photograph::Capture), which may be one.
//!
//! ```
//! use svbrdf_core::model::convention::PRINTED;
//! use svbrdf_core::model::scene::{Kind, Scene};
//! use svbrdf_core::picture::difference::Difference;
//! use svbrdf_core::progress::Progress;
//! use svbrdf_core::render;
//! use svbrdf_evaluate::photograph::compare;
//! use svbrdf_files::samples;
//!
//! // A "photograph" of a known exposure: the rendering of the built-in ground truth, at half the brightness.
//! let (built_in, progress) = (samples::load::<f32>()?, Progress::default());
//! let truth = &built_in.ground_truth.material;
//! let scene = Scene { kind: Kind::Near, view: [0.0, 0.0, 2.4], light: [0.0, 0.0, 2.4] };
//! let mut image = render::render_f32(truth, &scene, &PRINTED, &progress)?;
//! image.pixels.iter_mut().flatten().for_each(|value| *value *= 0.5);
//!
//! let photographs = [(image, scene)];
//! let right = &compare(&photographs, truth, truth.name(), &PRINTED, &progress)?[0];
//! let statistics = right.statistics(Difference::Log).ok_or("nothing is compared")?;
//! assert!((right.factor - 2.0).abs() < 1e-6 && statistics.mean < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod report;

use rayon::prelude::*;

use svbrdf_core::error::Error as CoreError;
use svbrdf_core::image::Image;
use svbrdf_core::material::resize::{self, Filter};
use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::progress::Progress;
use svbrdf_core::render;
use svbrdf_files::read::Photograph;

use crate::error::Error;
pub use report::{PhotoMeasure, PhotoReport, PhotoResult, ReadPhotograph};

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

/// The photograph `name` on `size` = (columns, rows) of texels: the mean radiance of each texel, NaN where a pixel of it is clipped.
///
/// With the scene whose falloff is divided out: Algorithm 3 has no falloff of light with distance. A point light at the height h and the
/// distance d lights the plane with h / d^3, of which Algorithm 3 has the cosine h / d divided out; pixels are multiplied by d^3 / h.
/// A distant light has no falloff.
///
/// # Errors
/// [`CoreError::SizesDiffer`] where the photograph has another shape than the material.
pub fn on_texels(
    photograph: &Photograph,
    name: &str,
    size: [usize; 2],
    falloff: Option<&Scene>,
) -> Result<Image<f32>, Error> {
    let Image { width, height, pixels } = &photograph.image;
    let [columns, rows] = size;
    let ratio = (width * rows) as f64 / (height * columns) as f64;
    if !(0.99..=1.01).contains(&ratio) {
        return Err(CoreError::SizesDiffer {
            first: name.to_owned(),
            first_size: [*width, *height],
            second: "the material".to_owned(),
            second_size: size,
            remedy: "rectify the photograph: the material fills it",
        }
        .into());
    }
    let planes = [0, 1, 2].map(|c| {
        let plane: Vec<_> = pixels.iter().map(|pixel| pixel[c]).collect();
        resize::plane(plane, [*width, *height], size, Filter::Value)
    });
    let grid = Grid { width: columns, height: rows };
    let gain = |index: usize| {
        let Some(scene) = falloff.filter(|scene| scene.kind == Kind::Near) else { return 1.0 };
        let place: glam::DVec3 = grid.position(index % columns, index / columns);
        ((glam::DVec3::from(scene.light) - place).length().powi(3) / scene.light[2]) as f32
    };
    let pixel = |index: usize| planes.each_ref().map(|plane| gain(index) * plane[index]);
    Ok(Image { width: columns, height: rows, pixels: (0..columns * rows).map(pixel).collect() })
}

/// Renders `material`, which is called `name`, in the scene of each photograph, and brings all photographs, which are on its texels, to the
/// exposure of the renderings by one factor. A rendering is a step of `progress`.
///
/// # Errors
/// [`CoreError::UnusableScene`], [`Error::NoExposure`], [`Cancelled`](Error::is_cancelled).
pub fn compare(
    photographs: &[(Image<f32>, Scene)],
    material: &Material<f32>,
    name: &str,
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<PhotographComparison>, Error> {
    let epsilon = convention.epsilon;
    let render = |(_, scene): &(Image<f32>, Scene)| -> Result<_, CoreError> {
        let rendering = render::render_f32(material, scene, convention, &progress.part())?;
        progress.step().map(|()| rendering)
    };
    let renderings = photographs.iter().map(render).collect::<Result<Vec<_>, _>>()?;
    let mut all = Vec::new();
    for ((photograph, _), rendering) in photographs.iter().zip(&renderings) {
        all.append(&mut ratios(photograph, rendering, epsilon));
    }
    let factor = factor(&mut all).ok_or_else(|| {
        let is_clipped = |(image, _): &(Image<f32>, Scene)| image.pixels.iter().all(|rgb| rgb[0].is_nan());
        let problem = match photographs.iter().all(is_clipped) {
            true => "every texel is clipped",
            false => "no part of the material is lit both in a photograph and in its rendering",
        };
        Error::NoExposure { name: name.to_owned(), problem: problem.to_owned() }
    })?;
    let compared = |((photograph, _), rendering): (&(Image<f32>, Scene), _)| {
        // A stored value below 0 is noise: there is no negative radiance.
        let expose = |value: f32| if value.is_nan() { value } else { (value * factor as f32).max(0.0) };
        let pixels = photograph.pixels.iter().map(|pixel| pixel.map(expose)).collect();
        let photograph = Image { pixels, ..*photograph };
        PhotographComparison { factor, photograph, rendering, epsilon }
    };
    Ok(photographs.iter().zip(renderings).map(compared).collect())
}

/// Ratios p / g of a rendering p and a photograph g over texels and channels, each with the weight p / (p + epsilon). Texels that are
/// NaN are left out.
fn ratios(photograph: &Image<f32>, rendering: &Image<f32>, epsilon: f64) -> Vec<[f32; 2]> {
    let samples = photograph.pixels.as_flattened().par_iter().zip(rendering.pixels.as_flattened());
    let ratio = |(&g, &p): (&f32, &f32)| {
        let weight = f64::from(p) / (f64::from(p) + epsilon);
        // A dark photograph of something bright asks for a large factor.
        let ratio = f64::from(p) / f64::from(g.max(0.0));
        (g.is_finite() && weight > 0.0).then_some([ratio as f32, weight as f32])
    };
    samples.filter_map(ratio).collect()
}

/// The factor k that brings photographs to the exposure of renderings: the weighted median of p / g. `None` where nothing is lit in both.
///
/// It minimizes the mean of w |ln (k g) - ln p|, which to first order in the deviations is the mean of the log difference
/// |ln (k g + epsilon) - ln (p + epsilon)|. As a median it is exact where all ratios agree, and highlights that one of the two
/// lacks hardly move it.
fn factor(ratios: &mut [[f32; 2]]) -> Option<f64> {
    ratios.par_sort_by(|[a, _], [b, _]| a.total_cmp(b));
    let half = 0.5 * ratios.iter().map(|[_, weight]| f64::from(*weight)).sum::<f64>();
    let mut sum = 0.0;
    let median = ratios.iter().find(|[_, weight]| {
        sum += f64::from(*weight);
        sum >= half
    });
    median.map(|[ratio, _]| f64::from(*ratio)).filter(|factor| factor.is_finite() && *factor > 0.0)
}

impl PhotographComparison {
    /// The factor in stops: positive where the photograph is darker than the rendering.
    pub fn exposure_ev(&self) -> f64 {
        self.factor.log2()
    }

    /// The number of texels that have a clipped pixel: they are left out of everything.
    pub fn clipped(&self) -> usize {
        self.photograph.pixels.iter().filter(|pixel| pixel[0].is_nan()).count()
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

#[cfg(test)]
mod tests {
    use super::*;

    fn image(values: &[f32]) -> Image<f32> {
        let pixels = values.iter().map(|&value| [value; 3]).collect();
        Image { width: values.len(), height: 1, pixels }
    }

    /// The factor of these photographs and one rendering.
    fn fitted(photographs: &[&[f32]], rendering: &[f32], epsilon: f64) -> Option<f64> {
        let of = |values: &&[f32]| ratios(&image(values), &image(rendering), epsilon);
        factor(&mut photographs.iter().flat_map(of).collect::<Vec<_>>())
    }

    #[test]
    fn one_factor_is_exact_where_ratios_agree_and_ignores_what_is_left_out() {
        let (rendering, nan) = ([0.5, 0.25, 1.0, 0.125, 2.0, 0.0], f32::NAN);
        for highlight in [0.5, 100.0, 0.0] {
            let photograph = [0.125, 0.0625, 0.25, nan, highlight, 0.3];
            assert_eq!(fitted(&[&photograph], &rendering, 0.01), Some(4.0), "{highlight}");
        }
        let [half, eighth] = [2.0, 8.0].map(|k| [0.5 / k, 0.25 / k, 1.0 / k]);
        assert_eq!(fitted(&[&half, &eighth, &half], &[0.5, 0.25, 1.0], 0.01), Some(2.0));
        for (photograph, rendering) in [([0.0; 2], [1.0; 2]), ([1.0; 2], [0.0; 2]), ([nan; 2], [1.0; 2])] {
            assert_eq!(fitted(&[&photograph], &rendering, 0.01), None);
        }
        // Three dark texels against one bright count as little as in the log difference: by number, they would win.
        let dark = |epsilon| fitted(&[&[1e-5, 1e-5, 1e-5, 0.5]], &[1e-4, 1e-4, 1e-4, 1.0], epsilon).unwrap();
        assert!((dark(0.01) - 2.0).abs() < 1e-6 && (dark(1e-9) - 10.0).abs() < 1e-4);
    }
}
