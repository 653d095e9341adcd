//! Pairs of a ground truth and a prediction, the texels that scenes are compared on, taken out of a map, and their radiances.

use std::ops::Range;

use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Sampling};
use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::brdf::Model;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_core::render::render_sample;
use svbrdf_files::read::Storage;

/// The independent random subset of `count` texels of a map of `size` (width, height) on which scene `number` of `sampling` is compared,
/// which is of this `kind`.
pub(super) fn subset(
    sampling: &Sampling,
    kind: Kind,
    number: usize,
    count: usize,
    size: [usize; 2],
) -> Vec<usize> {
    let in_kind = if kind == Kind::Near { number } else { number - sampling.near };
    sampling.sampler.texels(sampling.seed, kind, in_kind, count, size)
}

/// The subsets of all scenes, one after the other, where they have fewer texels than the map: what is changed is then these alone.
#[derive(Debug)]
pub(super) struct LossSamples {
    grid: Grid,
    /// Places on the grid, as row * width + column.
    pub(super) texels: Vec<usize>,
    /// Texels of each scene.
    count: usize,
}

impl LossSamples {
    /// `None` where they have no fewer texels than a map of this `grid`.
    pub(super) fn of(sampling: &Sampling, scenes: &[Scene], grid: Grid) -> Option<Self> {
        let size = [grid.width, grid.height];
        let count = sampling.texels.sampled(size)?;
        let is_part = scenes.len() * count < grid.width * grid.height;
        let of_scene = |number: usize| subset(sampling, scenes[number].kind, number, count, size);
        is_part.then(|| Self { grid, texels: parallel::map(scenes.len(), of_scene).concat(), count })
    }

    /// The material of these texels alone.
    pub(super) fn of_map(&self, map: &Material<f32>) -> Material<f32> {
        map.gathered(&self.texels, [self.texels.len(), 1])
    }

    /// The texels of a scene among these.
    pub(super) fn of_scene(&self, number: usize) -> impl Iterator<Item = usize> + use<> {
        number * self.count..(number + 1) * self.count
    }

    /// A comparison of materials of these texels.
    pub(super) fn placed<'a>(&'a self, comparison: Comparison<'a, f32>) -> Comparison<'a, f32> {
        comparison.at(self.grid, &self.texels)
    }
}

/// A ground truth and a prediction, and how each is stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair<'a> {
    pub(super) ground_truth: &'a Material<f32>,
    pub(super) prediction: &'a Material<f32>,
    /// Of the ground truth and of the prediction.
    pub(super) storages: [&'a Storage; 2],
}

/// The texels of a pair that it is compared on.
#[derive(Debug)]
pub(super) struct SampledPair {
    pub(super) samples: LossSamples,
    pub(super) ground_truth: Material<f32>,
    pub(super) prediction: Material<f32>,
}

impl SampledPair {
    pub(super) fn new(samples: LossSamples, pair: &Pair<'_>) -> Self {
        let [ground_truth, prediction] = [pair.ground_truth, pair.prediction].map(|map| samples.of_map(map));
        Self { samples, ground_truth, prediction }
    }

    /// The texels of some of the scenes.
    pub(super) fn of_scenes(&self, scenes: Range<usize>) -> Self {
        let LossSamples { grid, texels, count } = &self.samples;
        let of = scenes.start * count..scenes.end * count;
        let own: Vec<usize> = of.clone().collect();
        let [ground_truth, prediction] =
            [&self.ground_truth, &self.prediction].map(|all| all.gathered(&own, [own.len(), 1]));
        let samples = LossSamples { grid: *grid, texels: texels[of].to_vec(), count: *count };
        Self { samples, ground_truth, prediction }
    }
}

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
