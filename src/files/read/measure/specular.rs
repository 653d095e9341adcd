//! Measurements of the reflectance of specular maps and of metals.

use svbrdf_core::statistics::median;

use crate::read::options::Albedo;
use crate::read::options::transfer::linear;
use crate::read::raster::Raster;

/// Metals reflect more than this: 0.5 to 0.97.
const DARKEST_METAL: f64 = 0.2;

/// Median over pixels of the least of red, green and blue: 0.04 in a specular map of dielectrics.
pub(crate) fn specular_median(raster: &Raster) -> f64 {
    let least = |index| raster.rgb(index).into_iter().fold(f64::INFINITY, f64::min);
    let mut values: Vec<f64> = raster.sampled().map(least).collect();
    median(&mut values).unwrap_or_default()
}

/// The median of the base colour where `metallic` is 1 everywhere and that is darker than metals reflect: programs fill the channel of
/// metallic with 1, too.
pub(crate) fn dark_metal(metallic: &Raster, colour: &Raster) -> Option<f64> {
    let is_metal = metallic.sampled().all(|index| metallic.channels[0].at(index) > 0.99);
    let space = if colour.is_float() { Albedo::Linear } else { Albedo::Srgb };
    let mean =
        |index| colour.rgb(index).map(|value| linear(value.clamp(0.0, 1.0), space)).iter().sum::<f64>() / 3.0;
    let mut values: Vec<f64> = if is_metal { colour.sampled().map(mean).collect() } else { return None };
    median(&mut values).filter(|median| *median < DARKEST_METAL)
}
