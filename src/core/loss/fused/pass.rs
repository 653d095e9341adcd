//! One scene over the tile in cache: all materials are rendered and compared.

use super::compare::TileDifferences;
use super::inputs::LossInputs;
use super::rows::Gathered;
use crate::render::simd::geometry::{Geometry, KernelScene, TileGeometry, is_short};
use crate::render::simd::lanes::{Lanes, V};
use crate::render::simd::shade::{ShadingParams, TileRadiance};
use crate::render::simd::tile::{MaterialTerms, Positions, TexelSpan};

/// The tile of all materials that is in cache.
pub(super) struct LossTile {
    /// Where on the grid its texels are, if that is not their order.
    places: Vec<usize>,
    positions: Positions,
    geometry: TileGeometry,
    ground_truth: MaterialTerms,
    predictions: Vec<MaterialTerms>,
    gathered: Gathered,
    expected: TileRadiance,
    predicted: TileRadiance,
}

impl LossTile {
    pub(super) fn new(predictions: usize) -> Self {
        Self {
            places: Vec::new(),
            positions: Positions::ZERO,
            geometry: TileGeometry::ZERO,
            ground_truth: MaterialTerms::ZERO,
            predictions: vec![MaterialTerms::ZERO; predictions],
            gathered: Gathered::new(),
            expected: TileRadiance::ZERO,
            predicted: TileRadiance::ZERO,
        }
    }

    #[inline(always)]
    pub(super) fn fill<S: Lanes>(&mut self, simd: S, inputs: &LossInputs<'_>, span: &TexelSpan<'_>) {
        match (inputs.places, span) {
            (None, span) => self.positions.fill(&inputs.axes, span),
            (Some(places), TexelSpan::Range(range)) => {
                self.positions.fill(&inputs.axes, &TexelSpan::Listed(&places[range.clone()]));
            }
            (Some(places), TexelSpan::Listed(texels)) => {
                self.places.clear();
                self.places.extend(texels.iter().map(|&texel| places[texel]));
                self.positions.fill(&inputs.axes, &TexelSpan::Listed(&self.places));
            }
        }
        let ShadingParams { roughness_floor: floor, narrow, .. } = inputs.params;
        let terms = std::iter::once(&mut self.ground_truth).chain(&mut self.predictions);
        let materials = std::iter::once(&inputs.ground_truth).chain(inputs.predictions);
        let gathered = match (inputs.rows, span) {
            (Some(rows), TexelSpan::Listed(texels)) => {
                self.gathered.gather(rows, texels);
                Some(TexelSpan::Range(0..texels.len()))
            }
            _ => None,
        };
        for (index, (terms, material)) in terms.zip(materials).enumerate() {
            let (planes, span) = match &gathered {
                Some(span) => (self.gathered.planes(index), span),
                None => (material.planes(), span),
            };
            terms.fill(simd, planes, span, floor, narrow);
        }
    }

    /// Adds the differences in one scene to the sums of the predictions. `distant` is the geometry of a distant scene.
    #[inline(always)]
    pub(super) fn add<S: Lanes, D: TileDifferences<S>>(
        &mut self,
        simd: S,
        params: &ShadingParams,
        scene: &KernelScene,
        distant: Option<Geometry<V<S>>>,
        sums: &mut [D],
    ) {
        match distant {
            Some(geometry) => self.add_with(
                simd,
                params,
                scene,
                is_short(simd, geometry.square),
                sums,
                #[inline(always)]
                |_, _| geometry,
            ),
            None => {
                let is_short = self.geometry.fill(simd, scene, &self.positions);
                self.add_with(
                    simd,
                    params,
                    scene,
                    is_short,
                    sums,
                    #[inline(always)]
                    |geometry, i| geometry.load(simd, i),
                );
            }
        }
    }

    #[inline(always)]
    fn add_with<S: Lanes, D: TileDifferences<S>>(
        &mut self,
        simd: S,
        params: &ShadingParams,
        scene: &KernelScene,
        is_short: bool,
        sums: &mut [D],
        geometry: impl Fn(&TileGeometry, usize) -> Geometry<V<S>>,
    ) {
        let tile = &self.geometry;
        let (expected, predicted) = (&mut self.expected, &mut self.predicted);
        let expected_is_small = expected.render(
            simd,
            params,
            scene,
            &self.ground_truth,
            is_short,
            #[inline(always)]
            |i| geometry(tile, i),
        );
        for (terms, sum) in self.predictions.iter().zip(sums) {
            let predicted_is_small = predicted.render(
                simd,
                params,
                scene,
                terms,
                is_short,
                #[inline(always)]
                |i| geometry(tile, i),
            );
            if predicted_is_small && expected_is_small {
                sum.add::<false>(simd, expected, predicted);
            } else {
                sum.add::<true>(simd, expected, predicted);
            }
        }
    }
}
