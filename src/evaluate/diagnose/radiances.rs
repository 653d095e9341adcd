//! Radiances of a ground truth and a prediction on random texels of each scene.

use svbrdf_core::error::Error;
use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_sample;

/// Radiances of the ground truth and of the prediction, RGB each.
pub(super) type Radiances = [[f32; 3]; 2];

/// For each of `scenes` the radiances of a ground truth and a prediction on the texels of `of_scene`: their numbers in the materials, and
/// their places on `grid`.
pub(super) fn radiances(
    materials: [&Material<f32>; 2],
    grid: Grid,
    scenes: &[Scene],
    of_scene: impl Fn(usize) -> Vec<[usize; 2]> + Sync,
    convention: &Convention,
    progress: &Progress,
) -> Result<Vec<Vec<Radiances>>, Error> {
    let model = Model::from(convention);
    let in_scene = |index: usize| {
        let rays = scenes[index].rays();
        let pair = |[texel, place]: [usize; 2]| {
            materials.map(|material| render_sample(&material.texel(texel), &model, &rays, grid, place))
        };
        let pairs = of_scene(index).into_iter().map(pair).collect();
        progress.step()?;
        Ok(pairs)
    };
    parallel::try_map(scenes.len(), in_scene)
}
