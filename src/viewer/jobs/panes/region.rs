//! Statistics of the rectangle.

use std::sync::Arc;

use rayon::prelude::*;

use svbrdf_core::material::Material;
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::picture::difference::Difference;
use svbrdf_core::picture::quantity::Quantity;
use svbrdf_core::picture::statistics::Statistics;
use svbrdf_core::render::render_texel;

use super::computed_maps::ComputedMaps;
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
    /// The difference that the panes show; `None` for values.
    difference: Option<Difference>,
    /// Which maps hold it, where it is not of single texels of one scene.
    computed: Option<usize>,
    scene: Scene,
    convention: Convention,
}

/// The numbers of one material in the rectangle.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionNumbers {
    /// The name and the statistics of each channel of the quantity, or of the difference; `None` where nothing is finite.
    pub rows: Vec<(&'static str, Option<Statistics>)>,
    /// Whether they are of the difference from the ground truth.
    pub is_difference: bool,
    /// The rendering loss of the rectangle under this scene; `None` for the ground truth.
    pub loss: Option<f64>,
}

/// The statistics of the rectangle, of every material.
#[derive(Debug, Default)]
pub struct RegionJob(Latest<RegionKey, Vec<RegionNumbers>>);

impl RegionJob {
    /// Takes over a result, and computes what is needed now.
    pub fn follow(
        &mut self,
        work: &JobContext<'_>,
        region: Option<Region>,
        computed: Option<&Arc<ComputedMaps>>,
    ) -> Option<Error> {
        let region = region.filter(|_| !work.materials.is_empty());
        let wanted = region.map(|region| key(region, work.materials, work.view, computed));
        let convention = work.view.convention();
        self.0.follow(wanted, |key| {
            let materials = work.materials();
            let (key, computed) = (key.clone(), computed.cloned());
            Job::start(work.waker, move |_| {
                let materials = materials.iter().map(|loaded| loaded.material());
                Ok(numbers(materials, &key, &convention, computed.as_deref()))
            })
        })
    }

    /// The latest numbers, and whether they are up to date.
    pub fn get(
        &self,
        region: Region,
        materials: &[LoadedMaterial],
        state: &ViewState,
        computed: Option<&Arc<ComputedMaps>>,
    ) -> Option<(&[RegionNumbers], bool)> {
        let (of, numbers) = self.0.get()?;
        let now = key(region, materials, state, computed);
        let shown = |key: &RegionKey| (key.quantity, key.difference, key.computed.is_some());
        (of.ids == now.ids && shown(of) == shown(&now)).then_some((numbers.as_slice(), *of == now))
    }
}

fn key(
    region: Region,
    materials: &[LoadedMaterial],
    state: &ViewState,
    computed: Option<&Arc<ComputedMaps>>,
) -> RegionKey {
    // Until the maps are there, of the values.
    let is_there = !state.is_computed() || computed.is_some();
    let shows_difference = state.display.difference && is_there && materials.len() > 1;
    RegionKey {
        ids: materials.iter().map(LoadedMaterial::id).collect(),
        region,
        quantity: state.display.quantity,
        difference: shows_difference.then(|| state.difference_kind()),
        computed: computed.filter(|_| shows_difference).map(|maps| Arc::as_ptr(maps).addr()),
        scene: state.scene,
        convention: state.convention(),
    }
}

fn numbers<'a>(
    materials: impl Iterator<Item = &'a Material<f32>>,
    RegionKey { region, quantity, difference, scene, .. }: &RegionKey,
    convention: &Convention,
    computed: Option<&ComputedMaps>,
) -> Vec<RegionNumbers> {
    let mut materials = materials.peekable();
    let size = materials.peek().map_or([0; 2], |material| material.size());
    let texels: Vec<[usize; 2]> = region.texels(size).collect();
    let (model, rays) = (Model::<f32>::from(convention), scene.rays::<f32>());
    // Renderings and values of the ground truth.
    let mut ground_truth: Option<[Vec<[f32; 3]>; 2]> = None;
    let mut all = Vec::new();
    for (index, material) in materials.enumerate() {
        let render = |at: &[usize; 2]| render_texel(material, &model, &rays, at[0], at[1]);
        let renderings: Vec<[f32; 3]> = texels.par_iter().map(render).collect();
        let values: Vec<[f32; 3]> = match quantity {
            Quantity::Rendering => renderings.clone(),
            map => texels.iter().map(|at| map.at(material, scene, convention, *at)).collect(),
        };
        let channel = |c: usize| Statistics::of(&values.iter().map(|v| v[c]).collect::<Vec<f32>>());
        let of_difference = |kind: &Difference, expected: &[[f32; 3]]| {
            let pairs = expected.iter().zip(&values);
            let terms: Vec<f32> = match computed {
                Some(maps) => texels.iter().map(|at| maps.at(index, *at) as f32).collect(),
                None => pairs.map(|(g, p)| kind.of_texel(*g, *p, convention.epsilon) as f32).collect(),
            };
            Statistics::of(&terms)
        };
        let of_values =
            || channels(*quantity).iter().enumerate().map(|(c, name)| (*name, channel(c))).collect();
        let (rows, is_difference) = match (difference, &ground_truth) {
            (Some(kind), Some([_, expected])) => (vec![(kind.unit(), of_difference(kind, expected))], true),
            // The ground truth has no difference.
            (Some(_), None) => (Vec::new(), false),
            (None, _) => (of_values(), false),
        };
        let loss = ground_truth.as_ref().map(|[ground_truth, _]| {
            let numbers = |all: &Vec<[f32; 3]>| -> Vec<f64> {
                all.as_flattened().iter().map(|x| f64::from(*x)).collect()
            };
            let norm = convention.norm();
            norm.of(&numbers(ground_truth), &numbers(&renderings), convention.epsilon).unwrap_or_default()
        });
        all.push(RegionNumbers { rows, is_difference, loss });
        ground_truth.get_or_insert([renderings, values]);
    }
    all
}

/// The names of the channels that differ from each other.
fn channels(quantity: Quantity) -> &'static [&'static str] {
    match quantity {
        Quantity::Normal => &["x", "y", "z"],
        Quantity::Roughness => &["r"],
        Quantity::Rendering | Quantity::Diffuse | Quantity::Specular => &["R", "G", "B"],
    }
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
            let key = |difference| RegionKey {
                ids: Vec::new(),
                region,
                quantity: Quantity::Roughness,
                difference,
                computed: None,
                scene,
                convention: PRINTED,
            };
            let found = numbers(materials.iter(), &key(None), &PRINTED, None);
            assert!(found[0].loss.is_none());
            assert!((found[1].loss.unwrap() - of(region)).abs() < 1e-5, "{found:?}, expected {}", of(region));
            let rough: Vec<f32> =
                region.texels([256; 2]).map(|[c, r]| materials[1].texel(r * 256 + c).roughness).collect();
            assert_eq!(found[1].rows, [("r", Statistics::of(&rough))]);
            let signed: Vec<f32> = region
                .texels([256; 2])
                .map(|[c, r]| r * 256 + c)
                .map(|i| materials[1].texel(i).roughness - materials[0].texel(i).roughness)
                .collect();
            let found = numbers(materials.iter(), &key(Some(Difference::Signed)), &PRINTED, None);
            let [(_, Some(found))] = found[1].rows[..] else { panic!("{found:?}") };
            let expected = Statistics::of(&signed).unwrap();
            assert!((found.mean - expected.mean).abs() < 1e-6, "{found:?}, expected {expected:?}");
        }
        assert!((of(all) - of(part)).abs() > 1e-3, "the planted fault differs");
    }
}
