//! How far f32 may be off a rendering, for any renderer: by what a few ulps of the inputs change.

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::grammar::words::{Maps, Transfer};
use svbrdf_core::model::scene::Scene;
use svbrdf_core::render::render_texel;

use super::compare::{Worst, compare_rgb_with};
use super::points::{Generator, U};
use super::tolerance::{ENCODED_ULPS, SPREAD, SPREAD_ULPS, VALUE_ULPS};

/// Renderings with other inputs.
const SAMPLES: usize = 10;

/// What a rendering should be, and how far f32 may be off.
pub struct Expected {
    pub values: Vec<[f64; 3]>,
    bounds: Vec<[f64; 3]>,
}

fn radiances(material: &Material<f64>, scene: &Scene, convention: &Convention) -> Vec<[f64; 3]> {
    let (model, rays) = (Model::from(convention), scene.rays());
    let [width, height] = material.size();
    let of = |index: usize| render_texel(material, &model, &rays, index % width, index / width);
    (0..width * height).map(of).collect()
}

impl Expected {
    /// The bound is [`SPREAD`] times the most that inputs which are off by [`SPREAD_ULPS`] change the value, and [`VALUE_ULPS`] of it.
    pub fn of(material: &Material<f64>, scene: &Scene, convention: &Convention) -> Self {
        let values = radiances(material, scene, convention);
        let largest = values.as_flattened().iter().fold(0.0_f64, |most, x| most.max(*x));
        let is_encoded = convention.member.is_some_and(|m| m.terms.output.transfer != Transfer::Linear);
        let ulps = if is_encoded { ENCODED_ULPS } else { VALUE_ULPS };
        let mut bounds: Vec<[f64; 3]> =
            values.iter().map(|rgb| rgb.map(|x| ulps * U * x + 1e-9 * U * largest)).collect();
        // Base colour and metallic are made of both colours.
        let inverts = convention.member.is_some_and(|m| m.terms.material.material == Maps::Metallic);
        let mut random = Generator::new(9, 0);
        for _ in 0..SAMPLES {
            let mut off = |x: &mut f64| *x += SPREAD_ULPS * U * (2.0 * random.uniform() - 1.0);
            let mut planes = material.planes().clone();
            planes.normal.iter_mut().flatten().for_each(&mut off);
            planes.roughness.iter_mut().for_each(&mut off);
            if inverts {
                planes.diffuse.iter_mut().chain(&mut planes.specular).flatten().for_each(&mut off);
            }
            let colours = planes.diffuse.iter_mut().chain(&mut planes.specular).flatten();
            colours.chain(&mut planes.roughness).for_each(|x| *x = x.clamp(0.0, 1.0));
            let mut moved = *scene;
            moved.view.iter_mut().chain(&mut moved.light).for_each(&mut off);
            let [width, height] = material.size();
            let changed = Material::new("changed", width, height, planes).expect("valid");
            let changed = radiances(&changed, &moved, convention);
            for ((bound, value), changed) in bounds.iter_mut().zip(&values).zip(changed) {
                for c in 0..3 {
                    bound[c] = bound[c].max(SPREAD * (changed[c] - value[c]).abs());
                }
            }
        }
        Self { values, bounds }
    }

    pub fn compare(&self, got: &[[f32; 3]]) -> Result<Worst, String> {
        compare_rgb_with(got, &self.values, |index, channel, _| self.bounds[index][channel])
    }

    /// Whether values that others computed are these, as nearly as f64 has them.
    pub fn with_values(self, values: Vec<[f64; 3]>) -> Self {
        Self { values, ..self }
    }
}
