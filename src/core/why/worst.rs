//! The scene with the largest loss: global sampling, then local refinement.
//!
//! A scene is a point of the unit cube, and the search moves in this cube: 6 numbers of a near-field scene, 4 of a distant one. Both
//! stages compare few texels, the same in all scenes; the losses of the last candidates are over all texels.

use super::attribution::MOST_SCENES;
use crate::error::Error;
use crate::loss::{Comparison, Compute, Estimate, SharedTexels};
use crate::material::Material;
use crate::model::convention::Convention;
use crate::model::scene::{Kind, Scene};
use crate::progress::Progress;

/// Sampled scenes: near-field, distant.
const SAMPLED: [usize; 2] = [4096, 2048];
/// Scenes that are refined.
const CANDIDATES: usize = 16;
/// Scenes around each candidate in a round of refinement.
const AROUND: usize = 16;
const ROUNDS: usize = 24;
/// Reach of the first round in each dimension of the unit cube, and what it shrinks by in each.
const REACH: f64 = 0.1;
const SHRINK: f64 = 0.75;
/// Distances are within the central 99% of their distributions, which have no end.
const TAIL: f64 = 0.005;
/// Subsets of texels, and the texels of each: while sampling, and while refining.
const COARSE: [usize; 2] = [1, 256];
const FINE: [usize; 2] = [1, 1024];
/// Scenes between two steps of progress.
const AT_A_TIME: usize = 512;
/// Scenes whose losses are computed.
const EVALUATIONS: usize = SAMPLED[0] + SAMPLED[1] + CANDIDATES * (1 + ROUNDS * (1 + AROUND));

/// The worst scene that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Worst {
    /// The name of the prediction.
    pub prediction: String,
    pub scene: Scene,
    /// Its loss over all texels.
    pub loss: f64,
    /// The loss over all scenes, to +-1% where at most [`MOST_SCENES`] are enough.
    pub mean: Estimate,
    /// The scenes that `mean` is over.
    pub mean_scenes: usize,
    /// The scenes whose losses were computed in search of it.
    pub evaluations: usize,
}

/// A point of the unit cube; distant scenes use the first four numbers.
#[derive(Clone, Copy, Debug)]
struct CubePoint {
    kind: Kind,
    at: [f64; 6],
}

/// The scene with the largest loss of `prediction`, searched over all scenes that the loss samples from.
///
/// The search is deterministic; `seed` names the scenes that it starts from. It may miss a maximum that is narrower than the gaps
/// between these. The mean has its own count of `progress`; then a step is a scene.
///
/// # Errors
/// [`Error::SizesDiffer`], [`Error::Cancelled`].
pub fn worst<T: Compute>(
    ground_truth: &Material<T>,
    prediction: &Material<T>,
    convention: &Convention,
    seed: u64,
    progress: &Progress,
) -> Result<Worst, Error> {
    let comparison = Comparison::new(ground_truth, &[prediction], *convention)?;
    let mut all = comparison.clone().at_most(MOST_SCENES).over_all_scenes(seed, progress)?;
    let (mean, mean_scenes) = (all.losses.remove(0).estimate, all.scenes.len());
    progress.begin(EVALUATIONS as u64);
    let search = Search { comparison, seed: seed as u32 ^ (seed >> 32) as u32, progress };
    let points = search.refined(search.sampled()?)?;
    let scenes: Vec<Scene> = points.iter().map(|point| point.scene(convention)).collect();
    let losses = T::cpu().scene_losses(&search.comparison, &scenes, None, &progress.part())?.remove(0);
    let best = scenes.into_iter().zip(losses).max_by(|a, b| a.1.total_cmp(&b.1));
    let (scene, loss) =
        best.ok_or_else(|| Error::Internal("the search for the worst scene is empty".to_owned()))?;
    progress.advance(CANDIDATES as u64)?;
    let prediction = prediction.name().to_owned();
    Ok(Worst { prediction, scene, loss, mean, mean_scenes, evaluations: EVALUATIONS })
}

struct Search<'a, T> {
    comparison: Comparison<'a, T>,
    seed: u32,
    progress: &'a Progress,
}

impl<T: Compute> Search<'_, T> {
    /// The worst of evenly spread scenes, worst first.
    fn sampled(&self) -> Result<Vec<CubePoint>, Error> {
        let kinds = [(Kind::Near, SAMPLED[0]), (Kind::Distant, SAMPLED[1])];
        let spread =
            |(kind, count): (Kind, usize)| (0..count).map(move |i| CubePoint { kind, at: self.sobol(i, 0) });
        let points: Vec<CubePoint> = kinds.into_iter().flat_map(spread).map(CubePoint::bounded).collect();
        let losses = self.losses(&SharedTexels::new(&self.comparison, COARSE, 0), &points)?;
        let mut ranked: Vec<_> = points.into_iter().zip(losses).collect();
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        Ok(ranked.into_iter().take(CANDIDATES).map(|(point, _)| point).collect())
    }

    /// Moves each candidate to the worst of scenes around it, which come closer round by round.
    fn refined(&self, mut candidates: Vec<CubePoint>) -> Result<Vec<CubePoint>, Error> {
        let texels = SharedTexels::new(&self.comparison, FINE, 0);
        for round in 0..ROUNDS {
            let reach = REACH * SHRINK.powi(round as i32);
            let around = |(number, point): (usize, &CubePoint)| -> Vec<CubePoint> {
                let turn = 1 + (round * CANDIDATES + number) as u32;
                let moved = |i| point.moved(self.sobol(i, turn), reach);
                [*point].into_iter().chain((0..AROUND).map(moved)).collect()
            };
            let points: Vec<CubePoint> = candidates.iter().enumerate().flat_map(around).collect();
            let losses = self.losses(&texels, &points)?;
            let groups = points.chunks(1 + AROUND).zip(losses.chunks(1 + AROUND));
            let best = |(points, losses): (&[CubePoint], &[f64])| {
                points.iter().zip(losses).max_by(|a, b| a.1.total_cmp(b.1)).map(|(point, _)| *point)
            };
            candidates = groups.filter_map(best).collect();
        }
        Ok(candidates)
    }

    fn losses(&self, texels: &SharedTexels, points: &[CubePoint]) -> Result<Vec<f64>, Error> {
        let convention = self.comparison.convention();
        let scenes: Vec<Scene> = points.iter().map(|point| point.scene(convention)).collect();
        let mut losses = Vec::new();
        for some in scenes.chunks(AT_A_TIME) {
            losses.extend(texels.losses(&self.comparison, some, &self.progress.part())?.remove(0));
            self.progress.advance(some.len() as u64)?;
        }
        Ok(losses.into_iter().map(|scene| scene.loss).collect())
    }

    /// Point `index` of the `turn`-th scrambling of the Sobol sequence.
    fn sobol(&self, index: usize, turn: u32) -> [f64; 6] {
        /// An odd number, so that turns have different seeds.
        const STEP: u32 = 0x9e37_79b9;
        let seed = self.seed.wrapping_add(STEP.wrapping_mul(turn + 1));
        std::array::from_fn(|dimension| f64::from(sobol_burley::sample(index as u32, dimension as u32, seed)))
    }
}

impl CubePoint {
    fn scene(&self, convention: &Convention) -> Scene {
        let [a, b, c, d, ..] = self.at;
        match self.kind {
            Kind::Near => Scene::near_from_point(self.at, convention),
            Kind::Distant => Scene::distant_from_point([a, b, c, d], convention),
        }
    }

    /// The point moved towards a point of the unit cube, whose middle moves nothing, by at most `reach` in each dimension.
    fn moved(self, towards: [f64; 6], reach: f64) -> Self {
        let at = std::array::from_fn(|i| self.at[i] + reach * (2.0 * towards[i] - 1.0));
        Self { at, ..self }.bounded()
    }

    /// The point in the cube: azimuths go round, other numbers stop at its sides.
    fn bounded(self) -> Self {
        let is_azimuth = |i| match self.kind {
            Kind::Near => i == 3,
            Kind::Distant => i == 1 || i == 3,
        };
        let is_distance = |i| self.kind == Kind::Near && i >= 4;
        let bound = |i: usize| match self.at[i] {
            x if is_azimuth(i) => x.rem_euclid(1.0),
            x if is_distance(i) => x.clamp(TAIL, 1.0 - TAIL),
            x => x.clamp(0.0, 1.0),
        };
        Self { at: std::array::from_fn(bound), ..self }
    }
}
