//! The inputs of the kernel that do not depend on the scenes.

use std::ops::Range;

use glam::DVec3;

use super::rows::TexelRows;
use crate::loss::comparison::Comparison;
use crate::material::Material;
use crate::model::convention::Convention;
use crate::render::simd::TEXELS_PER_BLOCK;
use crate::render::simd::shade::ShadingParams;
use crate::render::simd::tile::{GridAxes, TexelSpan};

/// Materials, texels and convention of a loss.
pub(super) struct LossInputs<'a> {
    pub(super) ground_truth: &'a Material<f32>,
    pub(super) predictions: &'a [&'a Material<f32>],
    pub(super) convention: &'a Convention,
    pub(super) params: ShadingParams,
    pub(super) axes: GridAxes,
    /// The largest distance of a texel from the middle.
    pub(super) reach: f64,
    /// Where on the grid each texel is; `None`: in its order.
    pub(super) places: Option<&'a [usize]>,
    /// The texels that are compared; `None`: all.
    pub(super) listed: Option<&'a [usize]>,
    /// The ground truth and the predictions, texel by texel, where that is faster for the listed texels.
    pub(super) rows: Option<&'a TexelRows>,
    /// All planes of all materials, for prefetching; none where texels are listed.
    pub(super) planes: Vec<&'a [f32]>,
    /// The number of texels that are compared.
    pub(super) texels: usize,
    /// The number of blocks of at most [`TEXELS_PER_BLOCK`] texels.
    pub(super) blocks: usize,
}

impl<'a> LossInputs<'a> {
    pub(super) fn new(comparison: &'a Comparison<'_, f32>, listed: Option<&'a [usize]>) -> Self {
        let (ground_truth, predictions) = (comparison.ground_truth(), comparison.predictions());
        let (grid, places) = comparison.places();
        let texels = listed.map_or(ground_truth.width() * ground_truth.height(), <[usize]>::len);
        let planes = [&ground_truth].into_iter().chain(predictions);
        let planes = planes.flat_map(|m| m.planes().all()).filter(|_| listed.is_none());
        Self {
            ground_truth,
            predictions,
            convention: comparison.convention(),
            params: ShadingParams::from(comparison.convention()),
            axes: match listed.or(places) {
                None => GridAxes::from(grid),
                Some(_) => GridAxes::without_runs(grid),
            },
            reach: grid.position::<DVec3>(0, 0).length(),
            places,
            listed,
            rows: None,
            planes: planes.collect(),
            texels,
            blocks: texels.div_ceil(TEXELS_PER_BLOCK),
        }
    }

    /// The texels number `range.start` to `range.end` (excluded) of those that are compared.
    pub(super) fn span(&self, range: Range<usize>) -> TexelSpan<'a> {
        match self.listed {
            None => TexelSpan::Range(range),
            Some(texels) => TexelSpan::Listed(&texels[range]),
        }
    }
}
