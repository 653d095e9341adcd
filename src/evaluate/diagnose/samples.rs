//! The texels that scenes are compared on, taken out of a map.

use svbrdf_core::loss::{Comparison, Sampling};
use svbrdf_core::material::{Grid, Material};
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::parallel;

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
