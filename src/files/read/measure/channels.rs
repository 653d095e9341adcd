//! Channels of pictures that are named after one gray map, and may hold several.

use crate::read::raster::Raster;

/// Channels of a gray picture differ by no more: compression and rounding.
const NOISE: f64 = 12.0 / 255.0;
/// Share of the texels whose channels must differ by more.
const DIFFERENT: f64 = 0.02;
/// A constant channel varies by no more.
const CONSTANT: f64 = 2.0 / 255.0;

/// The maps in the channels of a picture that is named after a gray map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channels {
    /// The same, but for noise.
    Gray,
    /// Green roughness and blue metallic, as glTF packs them.
    RoughnessMetallic,
    /// Green roughness; red and blue are constant.
    Roughness,
    /// Blue metallic; red and green are constant.
    Metallic,
}

impl Channels {
    /// By the constancy and the differences of the channels.
    pub(crate) fn of(raster: &Raster) -> Self {
        if raster.channels.len() < 3 || !differ(raster) {
            return Self::Gray;
        }
        let [_, green, blue] = [0, 1, 2].map(|channel| is_constant(raster, channel));
        match (green, blue) {
            (false, false) => Self::RoughnessMetallic,
            (false, true) => Self::Roughness,
            (true, false) => Self::Metallic,
            (true, true) => Self::Gray,
        }
    }
}

fn differ(raster: &Raster) -> bool {
    let is_coloured = |index: &usize| {
        let [r, g, b] = raster.rgb(*index);
        r.max(g).max(b) - r.min(g).min(b) > NOISE
    };
    let (count, different) = (raster.sampled().count(), raster.sampled().filter(is_coloured).count());
    different as f64 > DIFFERENT * count as f64
}

/// Whether channel number `channel` is the same everywhere.
pub(crate) fn is_constant(raster: &Raster, channel: usize) -> bool {
    let values = raster.sampled().map(|index| raster.rgb(index)[channel]);
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
    high - low <= CONSTANT
}

/// Whether the picture is the same everywhere.
pub(crate) fn is_flat(raster: &Raster) -> bool {
    (0..3).all(|channel| is_constant(raster, channel))
}
