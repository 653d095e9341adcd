//! Statistics of the rectangle.

use rayon::prelude::*;

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::render::render_texel;

use crate::error::Error;
use crate::jobs::work::context::JobContext;
use crate::jobs::work::job::Job;
use crate::jobs::work::latest::Latest;
use crate::model::inspection::Region;
use crate::model::material::loaded::LoadedMaterial;
use crate::model::material::read::MaterialId;
use crate::model::view::state::ViewState;

/// What the statistics depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionKey {
    ids: Vec<MaterialId>,
    pub region: Region,
    pub quantity: Quantity,
    scene: Scene,
    convention: &'static str,
}

/// The numbers of one material in the rectangle.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionNumbers {
    /// Of each channel of the quantity; `None` where nothing is finite.
    pub channels: [Option<Statistics>; 3],
    /// The rendering loss of the rectangle under this scene; `None` for the ground truth.
    pub loss: Option<f64>,
}

/// The statistics of the rectangle, of every material.
#[derive(Debug, Default)]
pub struct RegionJob(Latest<RegionKey, Vec<RegionNumbers>>);

impl RegionJob {
    /// Takes over a result, and computes what is needed now.
    pub fn follow(&mut self, work: &JobContext<'_>, region: Option<Region>) -> Option<Error> {
        let region = region.filter(|_| !work.materials.is_empty());
        let wanted = region.map(|region| key(region, work.materials, work.view));
        let convention = work.view.convention();
        self.0.follow(wanted, |key| {
            let materials = work.materials();
            let (region, quantity, scene) = (key.region, key.quantity, key.scene);
            Job::start(work.waker, move |_| {
                let materials = materials.iter().map(|loaded| loaded.material());
                Ok(numbers(materials, region, quantity, &scene, &convention))
            })
        })
    }

    /// The latest numbers, and whether they are up to date.
    pub fn get(
        &self,
        region: Region,
        materials: &[LoadedMaterial],
        state: &ViewState,
    ) -> Option<(&[RegionNumbers], bool)> {
        let (of, numbers) = self.0.get()?;
        let now = key(region, materials, state);
        (of.ids == now.ids && of.quantity == now.quantity).then_some((numbers.as_slice(), *of == now))
    }
}

fn key(region: Region, materials: &[LoadedMaterial], state: &ViewState) -> RegionKey {
    RegionKey {
        ids: materials.iter().map(LoadedMaterial::id).collect(),
        region,
        quantity: state.display.quantity,
        scene: state.scene,
        convention: state.convention().name,
    }
}

fn numbers<'a>(
    materials: impl Iterator<Item = &'a Material<f32>>,
    region: Region,
    quantity: Quantity,
    scene: &Scene,
    convention: &Convention,
) -> Vec<RegionNumbers> {
    let mut materials = materials.peekable();
    let size = materials.peek().map_or([0; 2], |material| material.size());
    let texels: Vec<[usize; 2]> = region.texels(size).collect();
    let (model, rays) = (Model::<f32>::from(convention), scene.rays::<f32>());
    let mut ground_truth: Option<Vec<[f32; 3]>> = None;
    let mut all = Vec::new();
    for material in materials {
        let render = |at: &[usize; 2]| render_texel(material, &model, &rays, at[0], at[1]);
        let renderings: Vec<[f32; 3]> = texels.par_iter().map(render).collect();
        let values: Vec<[f32; 3]> = match quantity {
            Quantity::Rendering => renderings.clone(),
            map => texels.iter().map(|at| map.at(material, scene, convention, *at)).collect(),
        };
        let channel = |c: usize| Statistics::of(&values.iter().map(|v| v[c]).collect::<Vec<f32>>());
        let loss = ground_truth.as_ref().map(|ground_truth| {
            let pairs = ground_truth.par_iter().zip(&renderings);
            let terms: Vec<f64> =
                pairs.map(|(g, p)| Difference::Log.of_texel(*g, *p, convention.epsilon)).collect();
            terms.iter().sum::<f64>() / terms.len() as f64
        });
        all.push(RegionNumbers { channels: [channel(0), channel(1), channel(2)], loss });
        ground_truth.get_or_insert(renderings);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::view::state::ViewState;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_files::samples;

    #[test]
    fn the_loss_of_the_whole_is_that_of_the_scene_and_that_of_a_part_the_mean_of_its_texels() {
        let samples = samples::load::<f32>().unwrap();
        let materials = [samples.ground_truth.material, samples.predictions[0].material.clone()];
        let scene = ViewState::default().scene;
        let pictures = [0, 1].map(|i| {
            svbrdf_core::render::render(&materials[i].cast::<f64>(), &scene, &PRINTED, &Default::default())
                .unwrap()
        });
        let of = |region: Region| {
            let ln = |v: f64| (v + PRINTED.epsilon).ln();
            let texels: Vec<usize> =
                region.texels([256; 2]).map(|[column, row]| row * 256 + column).collect();
            let term = |i: usize, c: usize| {
                (ln(pictures[1].pixels[i][c]) - ln(pictures[0].pixels[i][c])).abs() / 3.0
            };
            let sum: f64 = texels.iter().map(|i| (0..3).map(|c| term(*i, c)).sum::<f64>()).sum();
            sum / texels.len() as f64
        };
        let all = Region { first: [0, 0], last: [255, 255] };
        let part = Region { first: [200, 10], last: [255, 12] };
        let over_seams = Region { first: [250, 240], last: [260, 257] };
        for region in [all, part, over_seams] {
            let found = numbers(materials.iter(), region, Quantity::Roughness, &scene, &PRINTED);
            assert!(found[0].loss.is_none());
            assert!((found[1].loss.unwrap() - of(region)).abs() < 1e-5, "{found:?}, expected {}", of(region));
            let rough: Vec<f32> =
                region.texels([256; 2]).map(|[c, r]| materials[1].texel(r * 256 + c).roughness).collect();
            assert_eq!(found[1].channels[0], Statistics::of(&rough));
        }
        assert!((of(all) - of(part)).abs() > 1e-3, "the planted fault differs");
    }
}
