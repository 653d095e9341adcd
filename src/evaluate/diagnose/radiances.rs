//! Radiances of a ground truth and a prediction on random texels of each scene.

use rayon::prelude::*;

use super::corrected::Corrected;
use svbrdf_core::error::Error;
use svbrdf_core::loss::Sampling;
use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_texel;

/// Radiances of the ground truth and of the prediction, RGB each.
pub(super) type Radiances = [[f32; 3]; 2];

/// For each of the `scenes` of `sampling` the radiances on `count` random texels; on all where there are no more.
pub(super) fn radiances(
    ground_truth: &Material<f32>,
    corrected: &Corrected,
    sampling: &Sampling,
    scenes: &[Scene],
    count: usize,
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Vec<Radiances>>, Error> {
    let [width, height] = ground_truth.size();
    let model = Model::from(convention);
    let available = corrected.texels.as_ref().map_or(width * height, Vec::len);
    let of_scene = |index: usize| {
        let scene = &scenes[index];
        let in_kind = if scene.kind == Kind::Near { index } else { index - sampling.near };
        let sampled = |size| sampling.sampler.texels(sampling.seed, scene.kind, in_kind, count, size);
        let texels = match &corrected.texels {
            _ if available <= count => corrected.texels.clone().unwrap_or_else(|| (0..available).collect()),
            Some(texels) => sampled([available, 1]).into_iter().map(|at| texels[at]).collect(),
            None => sampled([width, height]),
        };
        let rays = scene.rays();
        let pair = |texel: usize| {
            let [column, row] = [texel % width, texel / width];
            [ground_truth, &corrected.material]
                .map(|material| render_texel(material, &model, &rays, column, row))
        };
        let pairs = texels.into_iter().map(pair).collect();
        progress.step()?;
        Ok(pairs)
    };
    (0..scenes.len()).into_par_iter().map(of_scene).collect()
}
