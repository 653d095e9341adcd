//! The scene with the largest loss: global sampling, then local refinement.
//!
//! A scene is a point of the unit cube, and the search moves in this cube: 6 numbers of a near-field scene, 4 of a distant one, with
//! distances in equal steps of their logarithm. All stages but the last compare 1,024 texels, the same in all scenes; the last one all of
//! them, up to 65,536.

use statrs::distribution::{ContinuousCDF, Normal};

use super::attribution::MOST_SCENES;
use super::cloud::Cloud;
use crate::error::Error;
use svbrdf_core::loss::{Comparison, Compute, Estimate, Request, SharedTexels};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::scene::{Kind, Scene};
use svbrdf_core::progress::Progress;
use svbrdf_core::statistics::sort_by_number;
use svbrdf_files::Error as FilesError;

/// Sampled scenes: near-field, distant.
const SAMPLED: [usize; 2] = [8192, 4096];
/// Distant scenes with light and view as low as they are sampled, in mirror directions of each other: highlights are the strongest
/// there, and narrower than the gaps between sampled scenes.
const GRAZING: usize = 1024;
/// Scenes whose variants are compared, and candidates among these for refinement, other than neighbours: of the sampled scenes,
/// and of the grazing ones.
const COMPARED: [usize; 2] = [256, 64];
const CANDIDATES: [usize; 2] = [16, 8];
/// Scenes around each candidate in a round of refinement, and how many of them the next round is around.
const AROUND: usize = 24;
const ELITE: usize = 6;
const ROUNDS: usize = 24;
/// Candidates that are refined on all texels, and rounds of this.
const LAST_CANDIDATES: usize = 4;
const LAST_ROUNDS: usize = 6;
/// Standard deviation of the first round, around sampled and grazing scenes, and of the last ones, in each dimension of the unit
/// cube.
const REACH: [f64; 2] = [0.06, 0.01];
const LAST_REACH: f64 = 0.004;
/// Candidates are at least this far apart in some dimension.
const APART: f64 = 0.08;
/// The distances at which the search starts, as quantiles: near, in the middle and far.
const DISTANCES: [f64; 3] = [0.0, 0.5, 1.0];
/// Distances are within the central 99% of their distributions, which have no end, unless another share is requested.
pub const TAIL: f64 = 0.005;
/// Texels while sampling and refining.
const FEW: usize = 1024;
/// Texels in the last rounds, up to which all are compared.
const LAST: usize = 1 << 16;
/// Scenes between two steps of progress.
const AT_A_TIME: usize = 512;

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

/// The scene with the largest loss of `prediction`, searched over the scenes that the loss samples from, without the share `tail`
/// of nearest and the share `tail` of farthest distances; [`TAIL`] is the default.
///
/// The search is deterministic; `seed` names the scenes that it starts from. It may miss a maximum that is narrower than the gaps
/// between these. The mean has its own count of `progress`; then a step is a scene.
///
/// # Errors
/// [`SizesDiffer`](svbrdf_core::error::Error::SizesDiffer), [`Cancelled`](Error::is_cancelled).
pub fn worst<T: Compute>(
    ground_truth: &Material<T>,
    prediction: &Material<T>,
    convention: &Convention,
    seed: u64,
    tail: f64,
    progress: &Progress,
) -> Result<Worst, Error> {
    let comparison = Comparison::new(ground_truth, &[prediction], *convention)?;
    let mut all = comparison.clone().at_most(MOST_SCENES).run(&Request::over_all_scenes(seed), progress)?;
    let (mean, mean_scenes) = (all.losses.remove(0).estimate, all.scenes.len());
    progress.begin(EVALUATIONS as u64);
    let farthest = -Normal::standard().inverse_cdf(tail.clamp(1e-9, 0.49));
    let search = Search { comparison, seed: seed as u32 ^ (seed >> 32) as u32, farthest, progress };
    let (scene, loss) = search.worst()?;
    let prediction = prediction.name().to_owned();
    Ok(Worst { prediction, scene, loss, mean, mean_scenes, evaluations: EVALUATIONS })
}

/// Scenes whose losses are computed.
const EVALUATIONS: usize = SAMPLED[0]
    + SAMPLED[1]
    + GRAZING
    + (COMPARED[0] + COMPARED[1]) * VARIANTS
    + (CANDIDATES[0] + CANDIDATES[1]) * (1 + ROUNDS * AROUND)
    + LAST_CANDIDATES * (1 + LAST_ROUNDS * AROUND + 1);
/// A scene and its changes that are compared, too.
const VARIANTS: usize = 1 + DISTANCES.len() * DISTANCES.len();

struct Search<'a, T> {
    comparison: Comparison<'a, T>,
    seed: u32,
    /// The largest logarithm of a distance, in standard deviations from the mean.
    farthest: f64,
    progress: &'a Progress,
}

impl<T: Compute> Search<'_, T> {
    fn worst(&self) -> Result<(Scene, f64), Error> {
        let [few, last] = [FEW, LAST].map(|count| SharedTexels::new(&self.comparison, count));
        let sampled = self.candidates(&few, self.sampled(), COMPARED[0], CANDIDATES[0])?;
        let grazing = self.candidates(&few, grazing(), COMPARED[1], CANDIDATES[1])?;
        let mut refined = self.refined(&few, sampled, ROUNDS, REACH[0])?;
        refined.extend(self.refined(&few, grazing, ROUNDS, REACH[1])?);
        sort_by_number(&mut refined, |(_, loss)| -loss);
        let best = refined.into_iter().take(LAST_CANDIDATES).map(|(point, _)| point).collect();
        let found = self.refined(&last, best, LAST_ROUNDS, LAST_REACH)?;
        let scenes: Vec<Scene> = found.iter().map(|(point, _)| self.scene(point)).collect();
        let losses = T::cpu().scene_losses(&self.comparison, &scenes, None, &self.progress.part())?.remove(0);
        self.progress.advance(scenes.len() as u64)?;
        let best = scenes.into_iter().zip(losses).max_by(|a, b| a.1.total_cmp(&b.1));
        best.ok_or_else(|| FilesError::Internal("the search for the worst scene is empty".to_owned()).into())
    }

    /// Evenly spread scenes.
    fn sampled(&self) -> Vec<CubePoint> {
        let kinds = [(Kind::Near, SAMPLED[0]), (Kind::Distant, SAMPLED[1])];
        let normal = Normal::standard();
        let spread = |(kind, count): (Kind, usize)| {
            (0..count).map(move |i| {
                let mut at = self.sobol(i, 0);
                if kind == Kind::Near {
                    let log = |u: f64| normal.inverse_cdf(u.clamp(1e-9, 1.0 - 1e-9)) / self.farthest;
                    at[4..].iter_mut().for_each(|u| *u = 0.5 + 0.5 * log(*u));
                }
                CubePoint { kind, at }.bounded()
            })
        };
        kinds.into_iter().flat_map(spread).collect()
    }

    /// The `count` worst variants of the `compared` worst `points`, apart from each other.
    fn candidates(
        &self,
        texels: &SharedTexels,
        points: Vec<CubePoint>,
        compared: usize,
        count: usize,
    ) -> Result<Vec<CubePoint>, Error> {
        let worst = self.ranked(texels, points)?.into_iter().take(compared);
        let variants = worst.flat_map(|(point, _)| point.variants()).collect();
        Ok(apart(self.ranked(texels, variants)?, count))
    }

    /// Points with their losses, worst first.
    fn ranked(&self, texels: &SharedTexels, points: Vec<CubePoint>) -> Result<Vec<(CubePoint, f64)>, Error> {
        let losses = self.losses(texels, &points)?;
        let mut ranked: Vec<_> = points.into_iter().zip(losses).collect();
        sort_by_number(&mut ranked, |(_, loss)| -loss);
        Ok(ranked)
    }

    /// The worst points that clouds around the candidates find, worst first.
    fn refined(
        &self,
        texels: &SharedTexels,
        candidates: Vec<CubePoint>,
        rounds: usize,
        reach: f64,
    ) -> Result<Vec<(CubePoint, f64)>, Error> {
        let mut best = self.ranked(texels, candidates)?;
        let count = best.len();
        let mut clouds: Vec<Cloud> = best.iter().map(|(point, _)| Cloud::new(point.at, reach)).collect();
        for round in 0..rounds {
            let around = |(number, cloud): (usize, &Cloud)| -> Vec<CubePoint> {
                let turn = 1 + (round * count + number) as u32;
                let point = |i| CubePoint { kind: best[number].0.kind, at: cloud.point(self.sobol(i, turn)) };
                (0..AROUND).map(|i| point(i).bounded()).collect()
            };
            let points: Vec<CubePoint> = clouds.iter().enumerate().flat_map(around).collect();
            let losses = self.losses(texels, &points)?;
            for (number, (points, losses)) in points.chunks(AROUND).zip(losses.chunks(AROUND)).enumerate() {
                let mut ranked: Vec<_> = points.iter().copied().zip(losses.iter().copied()).collect();
                ranked.push(best[number]);
                sort_by_number(&mut ranked, |(_, loss)| -loss);
                best[number] = ranked[0];
                let elite: Vec<[f64; 6]> = ranked.iter().take(ELITE).map(|(point, _)| point.at).collect();
                clouds[number].follow(&elite, |i| best[number].0.is_azimuth(i));
            }
        }
        sort_by_number(&mut best, |(_, loss)| -loss);
        Ok(best)
    }

    fn scene(&self, point: &CubePoint) -> Scene {
        let convention = self.comparison.convention();
        let [a, b, c, d, view, light] = point.at;
        let quantile = |at: f64| Normal::standard().cdf(self.farthest * (2.0 * at - 1.0));
        match point.kind {
            Kind::Near => Scene::near_from_point([a, b, c, d, quantile(view), quantile(light)], convention),
            Kind::Distant => Scene::distant_from_point([a, b, c, d], convention),
        }
    }

    fn losses(&self, texels: &SharedTexels, points: &[CubePoint]) -> Result<Vec<f64>, Error> {
        let scenes: Vec<Scene> = points.iter().map(|point| self.scene(point)).collect();
        let mut losses = Vec::new();
        for some in scenes.chunks(AT_A_TIME) {
            losses.extend(texels.losses(&self.comparison, some, &self.progress.part())?.remove(0));
            self.progress.advance(some.len() as u64)?;
        }
        Ok(losses)
    }

    /// Point `index` of the `turn`-th scrambling of the Sobol sequence.
    fn sobol(&self, index: usize, turn: u32) -> [f64; 6] {
        /// An odd number, so that turns have different seeds.
        const STEP: u32 = 0x9e37_79b9;
        let seed = self.seed.wrapping_add(STEP.wrapping_mul(turn + 1));
        std::array::from_fn(|dimension| f64::from(sobol_burley::sample(index as u32, dimension as u32, seed)))
    }
}

/// Grazing scenes all around.
fn grazing() -> Vec<CubePoint> {
    let point = |i: usize| {
        let azimuth = (i as f64 + 0.5) / GRAZING as f64;
        CubePoint { kind: Kind::Distant, at: [1.0, azimuth, 1.0, azimuth + 0.5, 0.5, 0.5] }.bounded()
    };
    (0..GRAZING).map(point).collect()
}

/// The `count` worst points that are apart from each other, worst first.
fn apart(ranked: Vec<(CubePoint, f64)>, count: usize) -> Vec<CubePoint> {
    let mut chosen: Vec<CubePoint> = Vec::new();
    for (candidate, _) in ranked {
        if chosen.len() < count && chosen.iter().all(|other| other.is_apart(&candidate)) {
            chosen.push(candidate);
        }
    }
    chosen
}

impl CubePoint {
    /// The point itself; then with other distances, or the light in the mirror direction of the view and near it.
    fn variants(self) -> [Self; VARIANTS] {
        let changed = |index: usize| {
            let mut at = self.at;
            let [first, second] = [index / DISTANCES.len(), index % DISTANCES.len()].map(|i| DISTANCES[i]);
            match self.kind {
                Kind::Near => (at[4], at[5]) = (first, second),
                Kind::Distant => {
                    at[2] = at[0] + 0.02 * (first - 0.5);
                    at[3] = at[1] + 0.5 + 0.02 * (second - 0.5);
                }
            }
            Self { at, ..self }.bounded()
        };
        std::array::from_fn(|index| index.checked_sub(1).map_or(self, changed))
    }

    fn is_azimuth(&self, dimension: usize) -> bool {
        match self.kind {
            Kind::Near => dimension == 3,
            Kind::Distant => dimension == 1 || dimension == 3,
        }
    }

    fn is_apart(&self, other: &Self) -> bool {
        let distance = |i: usize| {
            let distance = (self.at[i] - other.at[i]).abs();
            if self.is_azimuth(i) { distance.min(1.0 - distance) } else { distance }
        };
        let dimensions = if self.kind == Kind::Near { 6 } else { 4 };
        self.kind != other.kind || (0..dimensions).any(|i| distance(i) > APART)
    }

    /// The point in the cube: azimuths go round, other numbers stop at its sides.
    fn bounded(self) -> Self {
        let bound = |i: usize| {
            if self.is_azimuth(i) { self.at[i].rem_euclid(1.0) } else { self.at[i].clamp(0.0, 1.0) }
        };
        Self { at: std::array::from_fn(bound), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::tests::materials::{generated, with};
    use svbrdf_core::model::convention::PRINTED;

    /// The largest loss of 7,200 distant scenes with light and view as low as they are sampled, in mirror directions of each other:
    /// highlights of smooth materials are narrower there than the gaps between sampled scenes.
    #[test]
    fn narrow_highlights_at_grazing_angles_are_found() {
        let scene = |i: usize| {
            let azimuth = i as f64 / 7200.0;
            Scene::distant_from_point([1.0, azimuth, 1.0, (azimuth + 0.5).rem_euclid(1.0)], &PRINTED)
        };
        let scenes: Vec<Scene> = (0..7200).map(scene).collect();
        let smooth =
            |seed| with(&generated(seed, 32), |planes| planes.roughness.iter_mut().for_each(|r| *r *= 0.4));
        for pair in [[0, 6], [3, 6], [0, 8], [1, 8], [3, 8], [5, 10]] {
            let [truth, prediction] = pair.map(smooth);
            let progress = Progress::default();
            let found = worst(&truth, &prediction, &PRINTED, 0, TAIL, &progress).unwrap();
            let comparison = Comparison::new(&truth, &[&prediction], PRINTED).unwrap();
            let losses = f32::cpu().scene_losses(&comparison, &scenes, None, &progress).unwrap().remove(0);
            let ratio = found.loss / losses.into_iter().fold(0.0, f64::max);
            assert!(ratio > 0.99, "{pair:?}: {ratio}");
        }
    }
}
