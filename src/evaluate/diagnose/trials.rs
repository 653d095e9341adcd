//! The losses of a prediction before and after changes, in the same scenes on the same texels.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use super::alignment::Interior;
use super::corrected::Corrected;
use super::exposure;
use super::factor;
use super::samples::{LossSamples, Pair, Radiances, SampledPair, radiances, subset};
use svbrdf_core::error::Error;
use svbrdf_core::loss::{Comparison, Compute as _, Request, Sampling, Texels};
use svbrdf_core::material::Material;
use svbrdf_core::model::convention::Convention;
use svbrdf_core::model::sampler::Sampler;
use svbrdf_core::model::scene::Scene;
use svbrdf_core::parallel;
use svbrdf_core::progress::Progress;
use svbrdf_files::changes::Change;

/// Changed predictions are rendered together as far as their maps fit into this much memory.
const MOST_BYTES: usize = 1 << 30;
/// Scenes whose texels are changed together where they are taken out of maps: few enough for the caches of a processor.
const BAND: usize = 32;
/// Texels of a scene whose radiances are compared one by one, for exposures.
const RADIANCES: usize = 1024;

/// Radiances in each scene.
type SceneRadiances = Arc<Vec<Vec<Radiances>>>;

/// A pair, and the scenes that changes of it are tried in.
#[derive(Debug)]
pub(super) struct Trials<'a> {
    pub(super) pair: Pair<'a>,
    pub(super) convention: &'a Convention,
    pub(super) sampling: Sampling,
    /// Most texels of a scene.
    pub(super) texels: usize,
    pub(super) scenes: Vec<Scene>,
    pub(super) progress: &'a Progress,
    /// `None`: all texels of the pair are changed.
    samples: Option<SampledPair>,
    /// The radiances that were computed last, and the changes of their pair: exposures of one and of three channels are fitted to and tried
    /// on the same ones.
    latest: Mutex<Option<(Vec<Change>, SceneRadiances)>>,
}

/// The losses of each scene without and with changes, on the texels that both have.
#[derive(Clone, Debug)]
pub(super) struct Paired {
    pub(super) before: Vec<f64>,
    pub(super) after: Vec<f64>,
}

/// The mean; 0 of none.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

impl<'a> Trials<'a> {
    pub(super) fn new(
        pair: Pair<'a>,
        convention: &'a Convention,
        [near, distant, texels]: [usize; 3],
        seed: u64,
        progress: &'a Progress,
    ) -> Result<Self, Error> {
        // Texels that are listed take far longer than whole maps.
        let is_whole = pair.ground_truth.width() * pair.ground_truth.height() <= texels;
        let texels = if is_whole { texels } else { texels / 8 };
        let sampling =
            Sampling { near, distant, seed, sampler: Sampler::Sobol, texels: Texels::Sampled(texels) };
        let scenes = sampling.scenes(convention)?;
        let samples = LossSamples::of(&sampling, &scenes, pair.ground_truth.grid());
        let samples = samples.map(|samples| SampledPair::new(samples, &pair));
        Ok(Self { pair, convention, sampling, texels, scenes, progress, samples, latest: Mutex::default() })
    }

    /// The losses under each of `trials`.
    pub(super) fn losses(&self, trials: &[Vec<Change>]) -> Result<Vec<Paired>, Error> {
        if trials.is_empty() {
            return Ok(Vec::new());
        }
        let count = self.scenes.len();
        if let Some(sampled) = self.samples.as_ref().filter(|_| count > BAND) {
            let band = |index: usize| {
                let scenes = index * BAND..((index + 1) * BAND).min(count);
                self.of_scenes(sampled, scenes).losses(trials)
            };
            let bands = parallel::try_map(count.div_ceil(BAND), band)?;
            let all = |trial: usize, of: fn(&Paired) -> &Vec<f64>| {
                bands.iter().flat_map(|band| of(&band[trial])).copied().collect()
            };
            let paired =
                |trial| Paired { before: all(trial, |one| &one.before), after: all(trial, |one| &one.after) };
            return Ok((0..trials.len()).map(paired).collect());
        }
        let [width, height] = self.materials()[0].size();
        let bytes = 10 * size_of::<f32>() * width * height;
        let mut losses = Vec::new();
        for trials in trials.chunks((MOST_BYTES / bytes.max(1)).max(1)) {
            let corrected = parallel::try_map(trials.len(), |index| self.corrected(&trials[index]))?;
            losses.extend(self.of_corrected(&corrected)?);
        }
        Ok(losses)
    }

    /// The trials in some of the scenes.
    fn of_scenes(&self, sampled: &SampledPair, scenes: Range<usize>) -> Self {
        Self {
            samples: Some(sampled.of_scenes(scenes.clone())),
            scenes: self.scenes[scenes].to_vec(),
            latest: Mutex::default(),
            ..*self
        }
    }

    /// The losses without changes.
    pub(super) fn unchanged(&self) -> Result<Paired, Error> {
        let [ground_truth, prediction] = self.materials();
        let losses = self.on_all_texels(ground_truth, &[prediction])?;
        let losses = losses.into_iter().next().unwrap_or_default();
        Ok(Paired { before: losses.clone(), after: losses })
    }

    fn corrected(&self, changes: &[Change]) -> Result<Corrected, Error> {
        Corrected::new(&self.pair, self.samples.as_ref(), changes)
    }

    /// The ground truth and the prediction, or the texels of them that are compared.
    fn materials(&self) -> [&Material<f32>; 2] {
        match &self.samples {
            Some(SampledPair { ground_truth, prediction, .. }) => [ground_truth, prediction],
            None => [self.pair.ground_truth, self.pair.prediction],
        }
    }

    fn of_corrected(&self, corrected: &[Corrected]) -> Result<Vec<Paired>, Error> {
        let is_whole = |one: &&Corrected| one.interior.is_none() && one.ground_truth.is_none();
        let whole = corrected.iter().filter(is_whole).map(|one| &one.material);
        let [ground_truth, prediction] = self.materials();
        let materials: Vec<_> = std::iter::once(prediction).chain(whole).collect();
        let mut losses = self.on_all_texels(ground_truth, &materials)?.into_iter();
        let before = losses.next().unwrap_or_default();
        let one = |corrected: &Corrected| {
            let whole = if is_whole(&corrected) { losses.next() } else { None };
            let paired = match whole {
                Some(after) => Paired { before: before.clone(), after },
                None => self.alone(corrected, &before)?,
            };
            match corrected.stops {
                Some(stops) => self.exposed(paired, corrected, stops),
                None => Ok(paired),
            }
        };
        corrected.iter().map(one).collect()
    }

    /// On a part of the texels, or against another ground truth.
    fn alone(&self, corrected: &Corrected, before: &[f64]) -> Result<Paired, Error> {
        let [ground_truth, prediction] = self.materials();
        let changed = corrected.ground_truth.as_ref().unwrap_or(ground_truth);
        let losses = match &corrected.interior {
            None => {
                let after = self.on_all_texels(changed, &[&corrected.material])?;
                [vec![before.to_vec()], after].concat()
            }
            Some(interior) if corrected.ground_truth.is_none() => {
                self.within(interior, changed, &[prediction, &corrected.material])?
            }
            Some(interior) => [
                self.within(interior, ground_truth, &[prediction])?,
                self.within(interior, changed, &[&corrected.material])?,
            ]
            .concat(),
        };
        let mut losses = losses.into_iter();
        Ok(Paired { before: losses.next().unwrap_or_default(), after: losses.next().unwrap_or_default() })
    }

    /// The losses of each scene, of each prediction. All materials hold what [`Self::materials`] hold.
    fn on_all_texels(
        &self,
        ground_truth: &Material<f32>,
        predictions: &[&Material<f32>],
    ) -> Result<Vec<Vec<f64>>, Error> {
        let comparison = Comparison::new(ground_truth, predictions, *self.convention)?;
        let Some(SampledPair { samples, .. }) = &self.samples else { return self.of_maps(comparison) };
        let subset = |number: usize| samples.of_scene(number).collect();
        let (comparison, progress) = (samples.placed(comparison), self.progress.part());
        f32::cpu().losses_on_own_texels(&comparison, &self.scenes, &subset, &progress)
    }

    /// The same for whole maps.
    fn of_maps(&self, comparison: Comparison<'_, f32>) -> Result<Vec<Vec<f64>>, Error> {
        let request = Request::Scenes(self.sampling);
        let outcome = comparison.without_pilot().run(&request, &self.progress.part())?;
        Ok(outcome.losses.into_iter().map(|loss| loss.per_scene).collect())
    }

    /// The same on a part of the texels: in each scene on those of its subset that are in `interior`. Trials of other parts are compared on
    /// the same subset. A scene without any has a loss of 0.
    fn within(
        &self,
        interior: &Interior,
        ground_truth: &Material<f32>,
        predictions: &[&Material<f32>],
    ) -> Result<Vec<Vec<f64>>, Error> {
        let comparison = Comparison::new(ground_truth, predictions, *self.convention)?;
        let comparison = match &self.samples {
            Some(sampled) => sampled.samples.placed(comparison),
            None => comparison,
        };
        let progress = self.progress.part();
        if self.sampling.texels.sampled(self.pair.ground_truth.size()).is_some() {
            let subset = |number: usize| {
                let all = self.subset(number, self.texels).into_iter();
                all.filter(|[_, place]| interior.contains(*place)).map(|[texel, _]| texel).collect()
            };
            f32::cpu().losses_on_own_texels(&comparison, &self.scenes, &subset, &progress)
        } else if interior.is_empty() {
            Ok(vec![vec![0.0; self.scenes.len()]; predictions.len()])
        } else {
            f32::cpu().scene_losses(&comparison, &self.scenes, Some(&interior.texels()), &progress)
        }
    }

    /// At most `count` of the texels that a scene is compared on: their numbers in [`Self::materials`], and their places on the map.
    fn subset(&self, number: usize, count: usize) -> Vec<[usize; 2]> {
        let (kind, size) = (self.scenes[number].kind, self.pair.ground_truth.size());
        let all = size[0] * size[1];
        match &self.samples {
            Some(SampledPair { samples, .. }) => {
                samples.of_scene(number).take(count).map(|texel| [texel, samples.texels[texel]]).collect()
            }
            None if all <= count => (0..all).map(|texel| [texel; 2]).collect(),
            None => {
                let texels = subset(&self.sampling, kind, number, count, size);
                texels.into_iter().map(|texel| [texel; 2]).collect()
            }
        }
    }

    /// Adds what an exposure changes on random texels of each scene.
    fn exposed(&self, paired: Paired, corrected: &Corrected, stops: [f64; 3]) -> Result<Paired, Error> {
        let epsilon = self.convention.epsilon;
        let changes = self.radiances(corrected)?;
        let after = |scene: usize| {
            let loss = |stops| exposure::loss(&changes[scene], stops, epsilon);
            paired.after[scene] + (loss(stops) - loss([0.0; 3]))
        };
        Ok(Paired { after: parallel::map(changes.len(), after), ..paired })
    }

    fn radiances(&self, corrected: &Corrected) -> Result<SceneRadiances, Error> {
        let latest = || self.latest.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, radiances)) = latest().as_ref().filter(|(changes, _)| *changes == corrected.changes) {
            return Ok(radiances.clone());
        }
        let [ground_truth, _] = self.materials();
        let is_inside = |place| corrected.interior.as_ref().is_none_or(|interior| interior.contains(place));
        let of_scene = |number: usize| {
            let mut texels = self.subset(number, RADIANCES.min(self.texels));
            texels.retain(|[_, place]| is_inside(*place));
            texels
        };
        let radiances = radiances(
            [corrected.ground_truth.as_ref().unwrap_or(ground_truth), &corrected.material],
            self.pair.ground_truth.grid(),
            &self.scenes,
            of_scene,
            self.convention,
            &self.progress.part(),
        )?;
        let radiances = Arc::new(radiances);
        *latest() = Some((corrected.changes.clone(), radiances.clone()));
        Ok(radiances)
    }

    /// The factors on diffuse and on specular of the prediction that bring them closest to those of the ground truth, after `changes`.
    pub(super) fn best_factors(&self, changes: &[Change]) -> Result<[f64; 2], Error> {
        let corrected = self.corrected(changes)?;
        let is_inside = |texel: &usize| match (&self.samples, &corrected.interior) {
            (None, Some(interior)) => interior.contains(*texel),
            _ => true,
        };
        let [truth, _] = self.materials();
        let truth = corrected.ground_truth.as_ref().unwrap_or(truth);
        Ok(factor::best_factors([truth, &corrected.material], is_inside))
    }

    /// The stops of red, green and blue with the least loss, each or all together, after `changes` other than exposures.
    pub(super) fn best_exposure(&self, changes: &[Change], per_channel: bool) -> Result<[f64; 3], Error> {
        let pairs = self.radiances(&self.corrected(changes)?)?;
        Ok(exposure::best_exposure(&pairs, self.convention.epsilon, per_channel))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::materials::{generated, with};
    use super::*;
    use svbrdf_core::model::convention::PRINTED;
    use svbrdf_files::changes::{Reading, Symmetry};
    use svbrdf_files::read::{Albedo, Storage};

    #[test]
    fn changes_of_the_compared_texels_alone_have_the_losses_of_changed_maps_bit_for_bit() {
        let (truth, other) = (generated(0, 96), generated(1, 96));
        let darker = with(&other, |planes| planes.diffuse.iter_mut().flatten().for_each(|d| *d *= 0.5));
        let (progress, storage) = (Progress::default(), Storage::default());
        let without_kernel: Convention = "gltf-viewer".parse().unwrap();
        assert!(without_kernel.member.is_some());
        let pair = Pair { ground_truth: &truth, prediction: &darker, storages: [&storage; 2] };
        let [gloss, linear] = [Reading::Gloss, Reading::Colours(Albedo::Linear)];
        let sets = vec![
            vec![Change::Reading(gloss)],
            vec![
                Change::Symmetry(Symmetry::ALL[4]),
                Change::Reading(Reading::NormalY),
                Change::Shift([2, -1]),
            ],
            vec![Change::GroundTruth(linear), Change::Shift([0, 3])],
            vec![Change::GroundTruth(gloss), Change::Symmetry(Symmetry::ALL[5])],
            vec![Change::Exposure([0.5, 0.25, 1.0]), Change::Symmetry(Symmetry::ALL[3])],
            vec![Change::Exposure([0.5; 3]), Change::Shift([-4, 0])],
        ];
        for convention in [&PRINTED, &without_kernel] {
            let mut trials = Trials::new(pair, convention, [16, 8, 2048], 3, &progress).unwrap();
            assert!(trials.samples.as_ref().is_some_and(|sampled| sampled.samples.texels.len() == 24 * 256));
            let of_samples = trials.losses(&sets).unwrap();
            let stops = |trials: &Trials<'_>| trials.best_exposure(&sets[1], true).unwrap();
            let stops_of_samples = stops(&trials);
            trials.samples = None;
            *trials.latest.lock().unwrap() = None;
            let of_maps = trials.losses(&sets).unwrap();
            for ((set, found), expected) in sets.iter().zip(&of_samples).zip(&of_maps) {
                assert_eq!((&found.before, &found.after), (&expected.before, &expected.after), "{set:?}");
                assert!(mean(&found.after) != mean(&found.before), "{set:?}");
            }
            assert_eq!(stops_of_samples, stops(&trials));
        }
    }
}
