//! Measurements of specular maps.

use svbrdf_core::statistics::median;

use crate::read::raster::Raster;

/// Median over pixels of the least of red, green and blue: 0.04 in a specular map of dielectrics.
pub(crate) fn specular_median(raster: &Raster) -> f64 {
    let least = |index| raster.rgb(index).into_iter().fold(f64::INFINITY, f64::min);
    let mut values: Vec<f64> = raster.sampled().map(least).collect();
    median(&mut values).unwrap_or_default()
}
