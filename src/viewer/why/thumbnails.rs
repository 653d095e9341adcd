//! Thumbnails: small pictures of the log difference in the worst scenes, all in one picture.

use eframe::egui::{Color32, ColorImage};

use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::colour_map::difference_to_display;
use svbrdf_core::picture::difference::{Difference, DifferenceParams};
use svbrdf_core::progress::Progress;
use svbrdf_core::render;
use svbrdf_core::statistics::quantile;

use crate::error::Error;
use crate::widgets::paint::Atlas;

/// Side of a thumbnail, in pixels.
pub const SIDE: usize = 48;
/// Scenes that have a thumbnail.
pub const MOST: usize = 96;
/// Texels along a side from which on every n-th texel is rendered.
const LARGE: usize = 512;
/// The share of all pixels that have less than the last colour.
const RANGE: f64 = 0.99;

/// Thumbnails of the worst scenes.
#[derive(Debug)]
pub struct Thumbnails {
    pub atlas: Atlas,
    /// The log difference that has the last colour, the same in all.
    pub range: f64,
    /// Of each scene, row by row: the means of the log differences under a pixel.
    pub pixels: Vec<Vec<f32>>,
}

/// Renders the thumbnails of `scenes`, one step of `progress` each. The ground truth is the first of the materials.
///
/// # Errors
/// [`Cancelled`](Error::is_cancelled).
pub fn make(
    [ground_truth, prediction]: [&Material<f32>; 2],
    convention: &Convention,
    scenes: &[Scene],
    progress: &Progress,
) -> Result<Thumbnails, Error> {
    let materials = [reduced(ground_truth), reduced(prediction)];
    progress.begin(scenes.len() as u64);
    let mut pixels = Vec::new();
    for scene in scenes {
        let differences = log_differences(&materials, scene, convention, progress)?;
        pixels.push(averaged(&differences, materials[0].size()));
        progress.step()?;
    }
    let mut all: Vec<f32> = pixels.iter().flatten().copied().collect();
    let range = quantile(&mut all, RANGE).filter(|range| *range > 0.0).unwrap_or(1.0) as f32;
    let colour = |value: &f32| {
        let [r, g, b] = difference_to_display(*value, range, false);
        Color32::from_rgb(r, g, b)
    };
    let picture = |values: &Vec<f32>| ColorImage::new([SIDE; 2], values.iter().map(colour).collect());
    let atlas = Atlas::new(&pixels.iter().map(picture).collect::<Vec<_>>());
    Ok(Thumbnails { atlas, range: f64::from(range), pixels })
}

/// The mean over RGB of the log difference of every texel.
fn log_differences(
    materials: &[Material<f32>; 2],
    scene: &Scene,
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<f32>, Error> {
    let render = |material| render::render_f32(material, scene, convention, &progress.part());
    let [ground_truth, prediction] = [render(&materials[0])?, render(&materials[1])?];
    let params = DifferenceParams { epsilon: convention.epsilon, exposure_ev: 0.0 };
    Ok(Difference::Log.of_images(&ground_truth, &prediction, params))
}

/// Every n-th texel of a large material along both sides, so that fewer than [`LARGE`] are left; a smaller material itself.
fn reduced(material: &Material<f32>) -> Material<f32> {
    let [width, height] = material.size();
    let stride = width.max(height).div_ceil(LARGE);
    let row = |y: usize| (0..width).step_by(stride).map(move |x| y * width + x);
    let texels: Vec<usize> = (0..height).step_by(stride).flat_map(row).collect();
    material.gathered(&texels, [width, height].map(|side| side.div_ceil(stride)))
}

/// The means of `values` under each of the pixels of a thumbnail, which is as wide as high.
fn averaged(values: &[f32], [width, height]: [usize; 2]) -> Vec<f32> {
    let span = |index: usize, side: usize| {
        let first = index * side / SIDE;
        first..((index + 1) * side / SIDE).max(first + 1)
    };
    let pixel = |at: usize| {
        let (columns, rows) = (span(at % SIDE, width), span(at / SIDE, height));
        let count = (columns.len() * rows.len()) as f32;
        rows.map(|row| values[row * width..][columns.clone()].iter().sum::<f32>()).sum::<f32>() / count
    };
    (0..SIDE * SIDE).map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use svbrdf_files::samples;

    #[test]
    fn a_thumbnail_has_the_mean_of_the_texels_and_every_texel_counts_once() {
        // Sides that are multiples of a thumbnail's, and sides below it.
        let values: Vec<f32> = (0..96 * 144).map(|i| (i * 37 % 101) as f32).collect();
        let pixels = averaged(&values, [96, 144]);
        let mean = |values: &[f32]| values.iter().map(|v| f64::from(*v)).sum::<f64>() / values.len() as f64;
        assert!((mean(&pixels) - mean(&values)).abs() < 1e-4);
        assert!((mean(&pixels[1..]) - mean(&values)).abs() > 1e-4, "a planted fault");
        assert_eq!(averaged(&[2.0, 4.0], [2, 1])[..2], [2.0, 2.0]);
        assert_eq!(averaged(&[2.0, 4.0], [2, 1])[SIDE - 1], 4.0);
    }

    #[test]
    fn large_materials_are_reduced_and_small_ones_are_not() {
        let material = samples::load::<f32>().unwrap().ground_truth.material;
        assert_eq!(reduced(&material), material);
        let large = material.clone().resized([1300, 700]).unwrap();
        let small = reduced(&large);
        assert_eq!(small.size(), [434, 234]);
        assert_eq!(small.planes().roughness[434 + 2], large.planes().roughness[3 * 1300 + 6]);
    }
}
