//! Normals with slopes that a file scales.

use rayon::prelude::*;

use crate::read::raster::{Raster, Samples};
use crate::read::stored::StoredMap;

/// Normals stored as (n + 1) / 2 with x and y times `scale`, of length 1 again, stored likewise as floats.
pub(super) fn scaled(source: StoredMap, scale: f64) -> StoredMap {
    if scale == 1.0 || source.raster.channels.len() < 3 {
        return source;
    }
    let raster = &source.raster;
    let texel = |index: usize| {
        let [x, y, z] = raster.rgb(index).map(|c| 2.0 * c - 1.0);
        let n = [scale * x, scale * y, z];
        let length = n.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        n.map(|x| (0.5 * x / length + 0.5) as f32)
    };
    let texels: Vec<[f32; 3]> = (0..raster.width * raster.height).into_par_iter().map(texel).collect();
    let channels = Samples::interleaved(texels.into_flattened(), 3);
    StoredMap { raster: Raster { channels, alpha: None, ..raster.without_samples() }, ..source }
}
