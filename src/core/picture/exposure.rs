//! Automatic exposure: the brightest 1% of a rendering just clip.

use crate::material::Material;
use crate::model::brdf::Model;
use crate::model::convention::Convention;
use crate::model::scene::Scene;
use crate::render::render_texel;
use crate::statistics::quantile;

/// Most texels that are rendered to find the exposure.
const TEXELS: usize = 20_000;

/// The stops by which a rendering of `material` is brightened so that the brightest 1% of its texels just clip; 0
/// where these are black.
pub fn automatic(material: &Material<f32>, scene: &Scene, convention: &Convention) -> f32 {
    let (model, rays) = (Model::from(convention), scene.rays());
    let texels = material.width() * material.height();
    let mut brightest: Vec<f32> = (0..texels)
        .step_by(texels.div_ceil(TEXELS))
        .map(|i| {
            let rgb = render_texel(material, &model, &rays, i % material.width(), i / material.width());
            rgb.into_iter().fold(0.0, f32::max)
        })
        .collect();
    match quantile(&mut brightest, 0.99) {
        Some(white) if white > 0.0 => -(white as f32).log2(),
        _ => 0.0,
    }
}
