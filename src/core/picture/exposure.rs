//! Automatic exposure: the brightest 1% of a rendering just clip.

use crate::material::Material;
use crate::model::brdf::Model;
use crate::model::convention::Convention;
use crate::model::sampler::Sampler;
use crate::model::scene::{Kind, Scene};
use crate::render::render_texel;
use crate::statistics::quantile;

/// Most texels that are rendered to find the exposure: of a larger map, random ones.
const TEXELS: usize = 20_000;

/// The stops by which a rendering of `material` is brightened so that the brightest 1% of its texels just clip; 0
/// where these are black.
pub fn automatic(material: &Material<f32>, scene: &Scene, convention: &Convention) -> f32 {
    let (model, rays) = (Model::from(convention), scene.rays());
    let brightness = |i: usize| {
        let rgb = render_texel(material, &model, &rays, i % material.width(), i / material.width());
        rgb.into_iter().fold(0.0, f32::max)
    };
    let all = material.width() * material.height();
    let mut brightest: Vec<f32> = if all <= TEXELS {
        (0..all).map(brightness).collect()
    } else {
        let texels = Sampler::Random.texels(0, Kind::Near, 0, TEXELS, material.size());
        texels.into_iter().map(brightness).collect()
    };
    match quantile(&mut brightest, 0.99) {
        Some(found) if found > 0.0 => -(found as f32).log2(),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Planes;
    use crate::model::brdf::Texel;

    #[test]
    fn stripes_of_every_fourth_column_are_a_quarter_of_the_texels() {
        let side = 256;
        let bright = |i: usize| i % 4 == 1;
        let diffuse: Vec<f32> = (0..side * side).map(|i| if bright(i) { 0.8 } else { 0.1 }).collect();
        let plane = |value: f32| vec![value; side * side];
        let planes = Planes {
            normal: [plane(0.0), plane(0.0), plane(1.0)],
            diffuse: [diffuse.clone(), diffuse.clone(), diffuse],
            specular: [0.0; 3].map(plane),
            roughness: plane(1.0),
        };
        let material = Material::new("stripes", side, side, planes).unwrap();
        let convention = Convention::default();
        let scene = Sampler::Random.scenes(0, 0, 1, &convention)[0];
        let stripes = automatic(&material, &scene, &convention);
        let texel = |diffuse| Texel {
            normal: glam::Vec3::Z,
            diffuse: [diffuse; 3],
            specular: [0.0; 3],
            roughness: 1.0,
        };
        let uniform =
            |diffuse| automatic(&Material::uniform("", 8, 8, &texel(diffuse)).unwrap(), &scene, &convention);
        assert!(
            (stripes - uniform(0.8)).abs() < 1e-4,
            "{stripes}, not {} but {}",
            uniform(0.1),
            uniform(0.8)
        );
    }
}
